"""A loss of power as a torque on the shaft, in tiers whose rollers orbit kinematically."""

from __future__ import annotations

import math

from beardyn_core.base.jit import inline

SMALLEST_LOAD = 1e-3  # of a contact that carries any, [N]


@inline
def smooth_lever(lever, speed, floor):
    """Smooth the lever of a couple against a rotation at `lever` times the shaft's speed at standstill."""
    rate = lever * speed
    return lever * rate / math.sqrt(rate * rate + floor * floor)


@inline
def squared_over(squared, speed):
    """Divide squared slip by the shaft speed; zero at rest."""
    return squared * (speed / (speed * speed + 1e-12))

"""Seals between cup and shaft."""

from __future__ import annotations

import math
from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.bodies import ring_direction
from beardyn_core.model.layout import ANGULAR, CONE_BODY, CUP_BODY, ENERGY_LOST, LOSS_SEAL, RATE


@inline
def add_seals(bodies: Any, wrenches: Any, energy: Any, step: Any, seal: Any) -> None:
    """Add the torque of both seals to shaft and cup, equal and opposite, about the shaft's axis.

    Dry friction, smooth through standstill, and a part that grows with speed. Neglects the radial and
    axial force of the lips.
    """
    if seal is None:
        return
    ax, ay, az = ring_direction(bodies, CONE_BODY)
    axis = (ax, ay, az)
    speed = bodies[CONE_BODY, RATE]
    for i in range(3):
        speed += axis[i] * (bodies[CONE_BODY, ANGULAR + i] - bodies[CUP_BODY, ANGULAR + i])
    dry = seal.torque / math.sqrt(speed * speed + seal.regularisation * seal.regularisation)
    torque = (dry + seal.speed_coefficient) * speed
    for i in range(3):
        wrenches[CONE_BODY, 3 + i] -= torque * axis[i]
        wrenches[CUP_BODY, 3 + i] += torque * axis[i]
    energy[ENERGY_LOST + LOSS_SEAL] += step * torque * speed

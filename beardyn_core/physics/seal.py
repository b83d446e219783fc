"""Seals between cup and shaft: their torque on both, dry and with the speed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import ring_direction

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


class SealParams(NamedTuple):
    """Both seals on the shaft."""

    torque: float  # [N m]
    speed_coefficient: float  # [N m s/rad]
    regularisation: float  # [rad/s]


SEALS = 2.0


def seal_params(scene: Scene) -> SealParams | None:
    """Add up both seals."""
    seal = scene.effects.seal
    if seal is None:
        return None
    both = SEALS * seal.stiffening(scene.lubricant.kinematic_viscosity(scene.temperature))
    return SealParams(
        torque=both * seal.torque,
        speed_coefficient=both * seal.speed_coefficient,
        regularisation=seal.regularisation_speed,
    )


@inline
def seal_torque(speed, seal):
    """Work out the torque of both seals, along the shaft's rotation, [N m]."""
    if seal is None:
        return 0.0
    dry = seal.torque / math.sqrt(speed * speed + seal.regularisation * seal.regularisation)
    return (dry + seal.speed_coefficient) * speed


@inline
def add_seals(bodies, wrenches, energy, step, seal):
    """Add the torque of both seals to shaft and cup, equal and opposite, about the shaft's axis.

    Dry friction, smooth through standstill, and a part that grows with speed. Neglects the radial and
    axial force of the lips.
    """
    if seal is None:
        return
    ax, ay, az = ring_direction(bodies, layout.CONE_BODY)
    axis = (ax, ay, az)
    speed = bodies[layout.CONE_BODY, layout.RATE]
    for i in range(3):
        speed += axis[i] * (
            bodies[layout.CONE_BODY, layout.ANGULAR + i] - bodies[layout.CUP_BODY, layout.ANGULAR + i]
        )
    torque = seal_torque(speed, seal)
    for i in range(3):
        wrenches[layout.CONE_BODY, 3 + i] -= torque * axis[i]
        wrenches[layout.CUP_BODY, 3 + i] += torque * axis[i]
    energy[layout.ENERGY_LOST + layout.LOSS_SEAL] += step * torque * speed

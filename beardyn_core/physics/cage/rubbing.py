"""Friction of the pockets where rollers have no dynamics: what pushes a roller round that no cone drives."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.kinematics import roller_spin
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import KinematicCage
from beardyn_core.physics.bodies.power import SMALLEST_LOAD
from beardyn_core.physics.drag import drag_push
from beardyn_core.physics.lanes.lane_math import where_greater
from beardyn_core.scene.scene import Scene


class PocketParams(NamedTuple):
    """Friction of the pockets, from what it takes to push a roller round that no cone drives."""

    weight: float  # part of a roller's weight that its bar carries on average over the orbit [N]
    lever: float  # torque on the shaft over the push: both bars, friction, spin over shaft speed [m]
    regularisation: float  # shaft speed below which it falls to zero [rad/s]


def pocket_params(scene: Scene) -> PocketParams | None:
    """Work out the friction of the pockets; none without a cage, or with a prescribed one."""
    cage, bearing = scene.effects.cage, scene.bearing
    if cage is None or isinstance(cage, KinematicCage):
        return None
    spin = surface_speed(bearing)
    fall = scene.effects.gravity.acceleration if scene.effects.gravity else 0.0
    return PocketParams(
        weight=bar_weight(bearing, fall),
        lever=2.0 * cage.friction * spin,
        regularisation=cage.regularisation_speed / spin,
    )


def surface_speed(bearing: RollerBearing) -> float:
    """Work out the speed of a roller's surface against its bar over that of the shaft, [m]."""
    return 0.5 * bearing.roller_diameter * roller_spin(bearing, 1.0)


def bar_weight(bearing: RollerBearing, gravity: float) -> float:
    """Work out what a roller that no cone drives lays on its bar, on average over the orbit, [N].

    Parameters
    ----------
    gravity : float
        [m/s^2].
    """
    return 2.0 / math.pi * gravity * bearing.roller_mass


@inline
def pocket_torque(cone_load, speeds, k, drag, pocket):
    """Work out the torque of the pockets of a block of rollers, along the shaft's rotation, [N m].

    A roller that the cone does not press is pushed round by its bar, against the medium and its weight; what
    it takes another roller in the load zone gives to its own bar. Neglects what ribs and rolling resistance
    drive or brake idle rollers with, and the rattle of those that the load holds.
    """
    if pocket is None:
        return 0.0 * cone_load
    push = pocket.weight + drag_push(speeds, k, drag)
    floor = pocket.regularisation
    torque = pocket.lever * push * (speeds[0] / math.sqrt(speeds[0] * speeds[0] + floor * floor))
    return where_greater(cone_load, SMALLEST_LOAD, 0.0 * cone_load, torque + 0.0 * cone_load)

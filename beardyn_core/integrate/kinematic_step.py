"""What the tiers with kinematic rollers share of a time step: orbit before the forces, rings after them."""

from __future__ import annotations

import math
from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.bodies import drift_bodies, kick_cone
from beardyn_core.kernels.box import kick_box
from beardyn_core.kernels.kinematic_rollers import collect_rows, rib_torque, turn_cages, turned
from beardyn_core.model.layout import (
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    PENETRATION,
    RATE,
    SIGNAL_ACCELERATION,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    TURN,
)


@inline
def begin_block(rollers: Any, bodies: Any) -> Any:
    """Direction of the cages, as cosine and sine; the largest penetration of a block starts anew."""
    rollers[:, PENETRATION] = 0.0
    return math.cos(bodies[CAGE_BODY, TURN]), math.sin(bodies[CAGE_BODY, TURN])


@inline
def begin_step(bodies: Any, direction: Any, p: Any) -> Any:
    """Move all bodies and the rollers with the cages.

    Returns
    -------
    direction : tuple of 2 floats
        Cosine and sine of the cages' angle.
    turns : tuple of 3 floats
        Angle of cages and cone, and of the rollers in their pockets, [rad].
    speeds : tuple of 2 floats
        Of shaft and cages, [rad/s].
    """
    direction = turned(direction, p.step * bodies[CAGE_BODY, RATE])
    drift_bodies(bodies, p.step)
    turn = bodies[CAGE_BODY, TURN]
    turns = (turn, bodies[CONE_BODY, TURN], p.kinematic.spin_ratio * turn)
    return direction, turns, (bodies[CONE_BODY, RATE], bodies[CAGE_BODY, RATE])


@inline
def finish_step(
    bodies: Any,
    sums: Any,
    wrenches: Any,
    box: Any,
    load_before: Any,
    load: Any,
    signal: Any,
    energy: Any,
    direction: Any,
    p: Any,
) -> None:
    """Accelerate the rings under the rollers' loads and write what happens at the end of the step.

    Parameters
    ----------
    load_before, load : float64 array, shape [10]
        Load row at the beginning and at the end of the step.
    signal : float64 array, shape [SIGNAL_CHANNELS]
        Written.
    """
    base, k = p.base, p.kinematic
    rib = collect_rows(sums, wrenches, direction, base.cup.cosine, base.cup.sine, k.rolling_weight)
    for i in range(6):
        signal[SIGNAL_FORCE + i] = wrenches[CUP_BODY, i]
    kick_box(
        bodies, wrenches[CUP_BODY], load, load_before, energy, box, p.step, base.mounting,
        base.effects.gravity, base.mounting.coupling,
    )  # fmt: skip
    for i in range(6):
        signal[SIGNAL_ACCELERATION + i] = box[i]
    signal[SIGNAL_TORQUE] = rib_torque(rib, bodies[CONE_BODY, RATE], k, base.effects.rib)
    kick_cone(bodies, wrenches[CONE_BODY], load, energy, p.step, base.mounting)
    turn_cages(bodies, k)

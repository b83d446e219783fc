"""What the tiers with kinematic rollers share of a time step: orbit before the forces, rings after them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.jit import inline
from beardyn_core.kernels.bodies import LOAD_BOGIE, LOAD_SPEED
from beardyn_core.kernels.box import kick_box
from beardyn_core.kernels.kinematic_rings import add_response, journal_velocity
from beardyn_core.kernels.kinematic_rollers import turned
from beardyn_core.model.layout import (
    ANGULAR,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    PENETRATION,
    POSITION,
    RATE,
    SIGNAL_ACCELERATION,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    TILT,
    TURN,
)

TRENDS_PER_BLOCK = 8  # instants at 400 Hz in 20 ms


class Drive(NamedTuple):
    """What the rollers do to the rings over a step.

    Massless rollers pass on what they get: the cone feels the opposite of their wrench on the cup, and the
    weight of what rolls.
    """

    wrench: Any  # 6, of the rollers on the cup [N, N m]
    rib_load: float  # sum over all rollers [N]
    losses: Any  # 2, from `held_losses`


@inline
def begin_advance(rollers):
    """Start the largest penetration anew."""
    rollers[:, PENETRATION] = 0.0


@inline
def cage_direction(bodies):
    """Take the direction of the cages, as cosine and sine."""
    return math.cos(bodies[CAGE_BODY, TURN]), math.sin(bodies[CAGE_BODY, TURN])


@inline
def begin_step(bodies, direction, p):
    """Move all bodies, and the rollers with the cages; returns ``direction``, ``turns`` and ``speeds``."""
    direction = turned(direction, p.step * bodies[CAGE_BODY, RATE])
    for body in range(CAGE_BODY):
        for i in range(3):
            bodies[body, POSITION + i] += p.step * bodies[body, LINEAR + i]
            bodies[body, TILT + i] += p.step * bodies[body, ANGULAR + i]
    for body in range(CONE_BODY, bodies.shape[0]):
        bodies[body, TURN] += p.step * bodies[body, RATE]
    turn = bodies[CAGE_BODY, TURN]
    turns = (turn, bodies[CONE_BODY, TURN], p.kinematic.spin_ratio * turn)
    return direction, turns, (bodies[CONE_BODY, RATE], bodies[CAGE_BODY, RATE])


@inline
def finish_step(bodies, drive, wrenches, box, load_before, load, signal, energy, response, p):
    """Accelerate the rings under the rollers' loads and write what happens at the end of the step.

    ``bodies`` [2 + row, BODY_STATES]: changed; ``wrenches`` [2 + row, 6], ``box`` [12]: work space;
    ``load_before``, ``load`` [10]: rows at the beginning and at the end of the step; ``signal``
    [SIGNAL_CHANNELS]: written; ``energy``: not kept by these tiers, but a coupled box adds to it;
    ``response``: the work space of `kernels.kinematic_rings`.

    Arrays come one by one: the references to those of a tuple would be counted in every step.
    """
    base, k, wrench = p.base, p.kinematic, drive.wrench
    before = journal_velocity(bodies)
    signal[SIGNAL_TORQUE] = -(drive.losses[0] + drive.losses[1] * drive.rib_load)
    for i in range(6):
        signal[SIGNAL_FORCE + i] = wrench[i]
    _kick_box(bodies, wrenches, box, load_before, load, signal, energy, base.mounting.coupling, p)
    _kick_journal(bodies, wrench, load, k.rolling_weight, p.step, p.motion)
    _prop_journal(bodies, p.step, p.motion, base.mounting)
    bodies[CONE_BODY, RATE] = load[LOAD_SPEED]
    for body in range(CAGE_BODY, bodies.shape[0]):
        bodies[body, RATE] = k.cage_ratio * load[LOAD_SPEED]
    add_response(bodies, before, signal, response, p)


@inline
def _kick_box(bodies, wrenches, box, load_before, load, signal, energy, coupling, p):
    """Accelerate the axlebox under the wrench in the signals, and write its acceleration there."""
    if coupling is None:
        _kick_free_box(bodies, load_before, load, signal, p.step, p.base.mounting, p.motion)
        return
    for i in range(6):
        wrenches[CUP_BODY, i] = signal[SIGNAL_FORCE + i]
    kick_box(
        bodies, wrenches[CUP_BODY], load, load_before, energy, box, p.step, p.base.mounting,
        p.base.effects.gravity, coupling,
    )  # fmt: skip
    for i in range(6):
        signal[SIGNAL_ACCELERATION + i] = box[i]


@inline
def _kick_free_box(bodies, load_before, load, signal, step, mounting, motion):
    for i in range(3):
        bogie = load[LOAD_BOGIE + i]
        bogie_speed = (bogie - load_before[LOAD_BOGIE + i]) * motion.rate
        stretch = bodies[CUP_BODY, POSITION + i] - bogie
        speed = bodies[CUP_BODY, LINEAR + i]
        spring = mounting.stiffness[i] * stretch + mounting.damping[i] * (speed - bogie_speed)
        linear = motion.box_push[i] * (signal[SIGNAL_FORCE + i] + (motion.steady[i] - spring))
        bodies[CUP_BODY, LINEAR + i] = speed + step * linear
        signal[SIGNAL_ACCELERATION + i] = linear
        rate = bodies[CUP_BODY, ANGULAR + i]
        hold = mounting.stiffness[3 + i] * bodies[CUP_BODY, TILT + i] + mounting.damping[3 + i] * rate
        angular = motion.box_push[3 + i] * (signal[SIGNAL_FORCE + 3 + i] + (motion.steady[3 + i] - hold))
        bodies[CUP_BODY, ANGULAR + i] = rate + step * angular
        signal[SIGNAL_ACCELERATION + 3 + i] = angular


@inline
def _kick_journal(bodies, wrench, load, weight, step, motion):
    push, turn = step * motion.journal_push, step * motion.journal_turn
    bodies[CONE_BODY, LINEAR] += push * (load[0] - wrench[0])
    bodies[CONE_BODY, LINEAR + 1] += push * (load[1] - wrench[1])
    bodies[CONE_BODY, LINEAR + 2] += push * (load[2] - wrench[2] - weight)
    bodies[CONE_BODY, ANGULAR] += turn * (load[3] - wrench[3])
    bodies[CONE_BODY, ANGULAR + 2] += turn * (load[5] - wrench[5])


@inline
def _prop_journal(bodies, step, motion, mounting):
    """Push the journal by its axial prop, as `kernels.bodies.kick_cone` does."""
    speed = bodies[CONE_BODY, LINEAR + 1]
    push = mounting.prop_stiffness * bodies[CONE_BODY, POSITION + 1] + mounting.prop_damping * speed
    bodies[CONE_BODY, LINEAR + 1] = speed - step * motion.journal_push * push

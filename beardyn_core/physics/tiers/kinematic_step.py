"""What the tiers with kinematic rollers share of a time step: orbit before the forces, rings after them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import LOAD_BOGIE, LOAD_SPEED
from beardyn_core.physics.journal import bend_axle
from beardyn_core.physics.suspension import kick_box
from beardyn_core.physics.tiers.kinematic_rings import add_response, journal_velocity
from beardyn_core.physics.tiers.kinematic_rollers import rotate

TRENDS_PER_BLOCK = 8  # instants at 400 Hz in 20 ms


class Drive(NamedTuple):
    """What the rollers do to the rings over a step.

    Rollers pass on what they get: the cone feels the opposite of their wrench on the cup, the weight of what
    rolls, and what rollers and cages with a mass take to be accelerated.
    """

    wrench: Any  # 6, of the rollers on the cup [N, N m]
    rib_load: float  # sum over all rollers [N]
    losses: Any  # 2, from `held_losses`
    kept: Any  # 6, accelerates rollers and cages [N, N m]; ``None``: massless ones


@inline
def begin_advance(rollers):
    """Start the largest penetration anew."""
    rollers[:, layout.PENETRATION] = 0.0


@inline
def copy_table(source, target):
    """Copy an array of two axes; an array assignment would make a copy of its own first."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j] = source[i, j]


@inline
def cage_direction(bodies):
    """Take the direction of the cages, as cosine and sine."""
    return math.cos(bodies[layout.CAGE_BODY, layout.TURN]), math.sin(bodies[layout.CAGE_BODY, layout.TURN])


@inline
def begin_step(bodies, direction, p):
    """Move all bodies, and the rollers with the cages; returns ``direction``, ``turns`` and ``speeds``."""
    direction = rotate(direction, p.step * bodies[layout.CAGE_BODY, layout.RATE])
    for body in range(layout.CAGE_BODY):
        for i in range(3):
            bodies[body, layout.POSITION + i] += p.step * bodies[body, layout.LINEAR + i]
            bodies[body, layout.TILT + i] += p.step * bodies[body, layout.ANGULAR + i]
    for body in range(layout.CONE_BODY, bodies.shape[0]):
        bodies[body, layout.TURN] += p.step * bodies[body, layout.RATE]
    turn = bodies[layout.CAGE_BODY, layout.TURN]
    turns = (turn, bodies[layout.CONE_BODY, layout.TURN], p.kinematic.spin_ratio * turn)
    return direction, turns, (bodies[layout.CONE_BODY, layout.RATE], bodies[layout.CAGE_BODY, layout.RATE])


@inline
def finish_step(
    lanes, bodies, flex, axle, drive, wrenches, box, load_before, load, signal, energy, response, p
):
    """Accelerate the rings under the rollers' loads and write what happens at the end of the step.

    ``bodies`` [2 + row, BODY_STATES], ``flex`` [2, mode],
    ``axle`` [2, plane, mode]: changed; ``wrenches`` [2 + row, 6],
    ``box`` [BOX_FIELDS]: work space;
    ``load_before``, ``load`` [10]: rows at the beginning and at the end of the step; ``signal``
    [SIGNAL_CHANNELS]: written; ``energy``: not kept by these tiers, but a coupled box adds to it;
    ``response``: the work space of `physics.tiers.kinematic_rings`.

    Arrays come one by one: the references to those of a tuple would be counted in every step.
    """
    base, k, wrench = p.base, p.kinematic, drive.wrench
    passed = passed_on(wrench, drive.kept)
    before = journal_velocity(bodies)
    signal[layout.SIGNAL_TORQUE] = -(drive.losses[0] + drive.losses[1] * drive.rib_load)
    for i in range(6):
        signal[layout.SIGNAL_FORCE + i] = wrench[i]
    _kick_box(bodies, wrenches, box, load_before, load, signal, energy, base.mounting.coupling, p)
    _kick_journal(bodies, passed, load, k.rolling_weight, p.step, p.motion)
    _prop_journal(bodies, p.step, p.motion, base.mounting)
    on_cone = (-passed[0], -passed[1], -passed[2] - k.rolling_weight, -passed[3], 0.0, -passed[5])
    bend_axle(bodies, axle, on_cone, load, energy, p.step, base.mounting.journal)
    bodies[layout.CONE_BODY, layout.RATE] = load[LOAD_SPEED]
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        bodies[body, layout.RATE] = k.cage_ratio * load[LOAD_SPEED]
    add_response(lanes, bodies, flex, axle, before, signal, box, response, p)


@inline
def passed_on(wrench, kept):
    """Work out the opposite of what the cone feels but for weight: the wrench on the cup and what is kept."""
    if kept is None:
        return wrench
    return (
        wrench[0] + kept[0],
        wrench[1] + kept[1],
        wrench[2] + kept[2],
        wrench[3] + kept[3],
        0.0,
        wrench[5] + kept[5],
    )


@inline
def _kick_box(bodies, wrenches, box, load_before, load, signal, energy, coupling, p):
    """Accelerate the axlebox under the wrench in the signals, and write its acceleration there."""
    if coupling is None:
        _kick_free_box(bodies, load_before, load, signal, p.step, p.base.mounting, p.motion)
        return
    for i in range(6):
        wrenches[layout.CUP_BODY, i] = signal[layout.SIGNAL_FORCE + i]
    kick_box(
        bodies, wrenches[layout.CUP_BODY], load, load_before, energy, box, p.step, p.base.mounting,
        p.base.effects.gravity, coupling,
    )  # fmt: skip
    for i in range(6):
        signal[layout.SIGNAL_ACCELERATION + i] = box[i]


@inline
def _kick_free_box(bodies, load_before, load, signal, step, mounting, motion):
    for i in range(3):
        bogie = load[LOAD_BOGIE + i]
        bogie_speed = (bogie - load_before[LOAD_BOGIE + i]) * motion.rate
        stretch = bodies[layout.CUP_BODY, layout.POSITION + i] - bogie
        speed = bodies[layout.CUP_BODY, layout.LINEAR + i]
        spring = mounting.stiffness[i] * stretch + mounting.damping[i] * (speed - bogie_speed)
        linear = motion.box_push[i] * (signal[layout.SIGNAL_FORCE + i] + (motion.steady[i] - spring))
        bodies[layout.CUP_BODY, layout.LINEAR + i] = speed + step * linear
        signal[layout.SIGNAL_ACCELERATION + i] = linear
        rate = bodies[layout.CUP_BODY, layout.ANGULAR + i]
        hold = (
            mounting.stiffness[3 + i] * bodies[layout.CUP_BODY, layout.TILT + i]
            + mounting.damping[3 + i] * rate
        )
        angular = motion.box_push[3 + i] * (
            signal[layout.SIGNAL_FORCE + 3 + i] + (motion.steady[3 + i] - hold)
        )
        bodies[layout.CUP_BODY, layout.ANGULAR + i] = rate + step * angular
        signal[layout.SIGNAL_ACCELERATION + 3 + i] = angular


@inline
def _kick_journal(bodies, wrench, load, weight, step, motion):
    push, turn = step * motion.journal_push, step * motion.journal_turn
    bodies[layout.CONE_BODY, layout.LINEAR] += push * (load[0] - wrench[0])
    bodies[layout.CONE_BODY, layout.LINEAR + 1] += push * (load[1] - wrench[1])
    bodies[layout.CONE_BODY, layout.LINEAR + 2] += push * (load[2] - wrench[2] - weight)
    bodies[layout.CONE_BODY, layout.ANGULAR] += turn * (load[3] - wrench[3])
    bodies[layout.CONE_BODY, layout.ANGULAR + 2] += turn * (load[5] - wrench[5])


@inline
def _prop_journal(bodies, step, motion, mounting):
    """Push the journal by its axial prop, as `physics.bodies.rigid_bodies.kick_cone` does."""
    speed = bodies[layout.CONE_BODY, layout.LINEAR + 1]
    push = (
        mounting.prop_stiffness * bodies[layout.CONE_BODY, layout.POSITION + 1]
        + mounting.prop_damping * speed
    )
    bodies[layout.CONE_BODY, layout.LINEAR + 1] = speed - step * motion.journal_push * push

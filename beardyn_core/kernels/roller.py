"""One time step of a block of rollers: drift, contacts, implicit solve, kick.

Positions live at whole steps, velocities half a step later. A step moves the rollers along their
velocities, evaluates every contact, solves one 6x6 system per roller for the velocity change under linearly
implicit contacts, and applies to roller and ring the very same forces: friction of the end of the step,
contact damping of its middle, springs with a share of what they change by, which makes the rollers on their
springs and dampers second order in the step; rings and pockets lag by half a step. Momentum is therefore
exchanged exactly and the energy audit closes. The explicit step, for references only, takes the forces of
the beginning instead (`velocity_change`).
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.drag import add_drag, drag_before, drag_matrix, finish_drag
from beardyn_core.kernels.exchange import account_gravity, load_vector, store_vector
from beardyn_core.kernels.orbit import angular_velocity, drift, ring_view, weight
from beardyn_core.kernels.pocket_step import add_cage, cage_before, finish_cage
from beardyn_core.kernels.raceway_step import finish_raceway, raceway_contact, raceway_matrix, raceway_wrench
from beardyn_core.kernels.rib_step import add_rib, finish_rib, rib_before, rib_matrix
from beardyn_core.kernels.ring_flexibility import about_rigid_cup, bend_cup, bent_cup
from beardyn_core.kernels.rolling import add_rolling, finish_rolling, rolling_before, rolling_matrix
from beardyn_core.kernels.small_rib import add_small_rib, finish_small_rib, small_rib_before, small_rib_matrix
from beardyn_core.kernels.solve import inertia_matrix, solve
from beardyn_core.kernels.stage_timer import mark
from beardyn_core.kernels.vectors import add, add_scaled, dot, turn_in
from beardyn_core.model.layout import (
    ANGLE,
    AXIAL,
    AXIS,
    CONE,
    CUP,
    MASK,
    MOMENTUM,
    OVERSIZE,
    RADIUS,
    RING_TURN,
    RING_VELOCITY,
    SPIN,
    VELOCITY,
)
from beardyn_core.model.stages import CAGE, CONTACT, LOSS, MOTION, RIB, SETTLE, SOLVE

_PI = 3.141592653589793


@inline
def velocity_change(matrix: Any, right: Any, zero: Any, explicit: Any) -> Any:
    """Change of velocity and angular velocity that the contacts are settled with.

    With the explicit step it is zero: every contact keeps the force it has at the beginning of the step, on
    roller and ring alike, and the compiler drops the matrix. Losses are taken at the beginning as well, so
    that the energy audit closes as far as slips change little over a step.
    """
    if explicit is not None:
        still = (zero, zero, zero)
        return still, still
    return solve(matrix, right)


@inline
def step_rollers(lanes: Any, block: Any, rollers: Any, rings: Any, sums: Any, flex: Any, p: Any) -> None:
    """Advance one block of rollers by one step and add what it does to the rings.

    Parameters
    ----------
    lanes : Lanes
    block : int
    rollers : float64 array, shape [block, ROLLER_FIELDS, lane]
        State, changed in place.
    rings : float64 array, shape [ring, RING_FIELDS, lane]
        Cup, cone and cage as the rollers of each row see them, at the end of the drift.
    sums : float64 array, shape [1, SUM_FIELDS + 2 x mode, lane]
        Reactions, energy terms and modal forces, added to.
    flex : float64 array, shape [mode, 2, 2]
        Bending of the cup.
    p : Parameters
    """
    step, effects, roller = p.step, p.effects, p.roller
    reference_velocity = load_vector(lanes, rings, CUP, RING_VELOCITY)
    polar, velocity, momentum, axis, half_turn, orbit_rate, direction = drift(
        lanes, rollers, block, reference_velocity, step, roller
    )
    radius, azimuth, axial = polar
    cosine, sine = direction
    mask = lanes.load(p.rollers, block, MASK)
    oversize = lanes.load(p.rollers, block, OVERSIZE)
    omega = angular_velocity(momentum, axis, roller)
    zero = lanes.constant(0.0)
    body = ((radius, zero, axial), axis, velocity, omega, orbit_rate)
    cup_view = ring_view(lanes, rings, CUP, cosine, sine)
    bent_view, shift = bent_cup(lanes, flex, cup_view, cosine, sine, effects.ring_flexibility)
    cone_view = ring_view(lanes, rings, CONE, cosine, sine)
    spin = lanes.load(rollers, block, SPIN)
    faults, timers = effects.faults, effects.timers
    mark(timers, MOTION)

    cup = raceway_contact(
        lanes, block, CUP, bent_view, body, oversize,
        (azimuth - lanes.load(rings, CUP, RING_TURN), -spin), p.cup,
        (faults.cup, faults.roller, faults.cup_damage, faults.cup_waves, faults.roller_waves), p,
    )  # fmt: skip
    cup = about_rigid_cup(cup, shift, effects.ring_flexibility)
    cone = raceway_contact(
        lanes, block, CONE, cone_view, body, oversize,
        (azimuth - lanes.load(rings, CONE, RING_TURN), _PI - spin), p.cone,
        (faults.cone, faults.roller, faults.cone_damage, faults.cone_waves, faults.roller_waves), p,
    )  # fmt: skip
    mark(timers, CONTACT)
    cup_rolling = rolling_before(cup, CUP, cup_view, body, effects.rolling)
    cone_rolling = rolling_before(cone, CONE, cone_view, body, effects.rolling)
    drag = drag_before(body, cup_view, effects.drag)
    mark(timers, LOSS)
    rib = rib_before(body, cone_view, zero, effects.rib, effects.damping)
    small_rib = small_rib_before(body, cone_view, zero, effects.small_rib)
    mark(timers, RIB)
    cage = cage_before(
        lanes, rings, p.rollers, block, body, azimuth, cosine, sine, roller, faults.pockets, effects.cage
    )

    mark(timers, CAGE)
    matrix = inertia_matrix(roller.mass, roller.axial_inertia, roller.transverse_inertia, axis, zero)
    matrix = raceway_matrix(matrix, cup, p)
    matrix = raceway_matrix(matrix, cone, p)
    matrix = rolling_matrix(matrix, cup_rolling, step, effects.rolling)
    matrix = rolling_matrix(matrix, cone_rolling, step, effects.rolling)
    matrix = drag_matrix(matrix, drag, step, effects.drag)
    matrix = rib_matrix(matrix, rib, effects.rib, p)
    matrix = small_rib_matrix(matrix, small_rib, effects.small_rib, p)

    cup_force, cup_moment = raceway_wrench(cup, effects.damping)
    cone_force, cone_moment = raceway_wrench(cone, effects.damping)
    gravity = weight(cosine, sine, roller.mass, effects.gravity)
    force = add(add(cup_force, cone_force), gravity)
    moment = add(cup_moment, cone_moment)
    moment = add_rolling(add_rolling(moment, cup_rolling, effects.rolling), cone_rolling, effects.rolling)
    force, moment = add_drag(force, moment, drag, effects.drag)
    force, moment = add_rib(force, moment, rib, effects.rib)
    force, moment = add_small_rib(force, moment, small_rib, effects.small_rib)
    force, moment = add_cage(force, moment, cage, effects.cage)
    turning_force = (
        force[0] + roller.mass * orbit_rate * velocity[1],
        force[1] - roller.mass * orbit_rate * velocity[0],
        force[2],
    )
    turning_moment = (
        moment[0] + orbit_rate * momentum[1],
        moment[1] - orbit_rate * momentum[0],
        moment[2],
    )
    right = (
        step * turning_force[0], step * turning_force[1], step * turning_force[2],
        step * turning_moment[0], step * turning_moment[1], step * turning_moment[2],
    )  # fmt: skip
    change = velocity_change(matrix, right, zero, p.explicit)
    mark(timers, SOLVE)

    force, moment = finish_raceway(lanes, rollers, sums, block, CUP, cup, change, mask, cosine, sine, p)
    bend_cup(lanes, sums, force, mask, cosine, sine, flex.shape[0], effects.ring_flexibility)
    cone_force, cone_moment = finish_raceway(
        lanes, rollers, sums, block, CONE, cone, change, mask, cosine, sine, p
    )
    force = add(add(force, cone_force), gravity)
    moment = add(moment, cone_moment)
    mark(timers, SETTLE)
    moment = finish_rolling(
        lanes, sums, CUP, cup_rolling, change, moment, mask, cosine, sine, effects.rolling, p
    )
    moment = finish_rolling(
        lanes, sums, CONE, cone_rolling, change, moment, mask, cosine, sine, effects.rolling, p
    )
    force, moment = finish_drag(lanes, sums, drag, change, force, moment, mask, cosine, sine, effects.drag, p)
    mark(timers, LOSS)
    force, moment = finish_rib(
        lanes, rollers, sums, block, rib, change, force, moment, mask, cosine, sine, effects.rib, p
    )
    force, moment = finish_small_rib(
        lanes, sums, small_rib, change, force, moment, mask, cosine, sine, effects.small_rib, p
    )
    mark(timers, RIB)
    finish_cage(lanes, rollers, sums, block, cage, change, mask, cosine, sine, effects.cage, p)
    force, moment = add_cage(force, moment, cage, effects.cage)
    mark(timers, CAGE)
    work = step * dot(gravity, add_scaled(velocity, 0.5, change[0]))
    account_gravity(lanes, sums, mask, work, effects.audit)

    velocity = turn_in(velocity, half_turn[0], half_turn[1])
    momentum = turn_in(momentum, half_turn[0], half_turn[1])
    lanes.store(rollers, block, RADIUS, radius)
    lanes.store(rollers, block, ANGLE, azimuth)
    lanes.store(rollers, block, AXIAL, axial)
    store_vector(lanes, rollers, block, AXIS, axis)
    store_vector(lanes, rollers, block, VELOCITY, add_scaled(velocity, step / roller.mass, force))
    store_vector(lanes, rollers, block, MOMENTUM, add_scaled(momentum, step, moment))
    mark(timers, MOTION)

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

from beardyn_core.base.jit import inline
from beardyn_core.physics import raceway
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import Here, account_gravity, load_vector, store_vector
from beardyn_core.physics.bodies.orbit import Body, angular_velocity, drift, ring_view, rotate_weight
from beardyn_core.physics.bodies.stage_timer import mark
from beardyn_core.physics.bodies.step_stages import CAGE, CONTACT, LOSS, MOTION, RIB, SETTLE, SOLVE
from beardyn_core.physics.cage.pocket import prepare_pocket, push_pocket, settle_pocket
from beardyn_core.physics.drag import prepare_drag, push_drag, settle_drag, stiffen_drag
from beardyn_core.physics.flanges import prepare_flanges, push_flanges, settle_flanges, stiffen_flanges
from beardyn_core.physics.lanes.solve import inertia_matrix, solve
from beardyn_core.physics.lanes.vectors import Twist, Wrench, add, add_scaled, dot, scale, turn_in
from beardyn_core.physics.rib import prepare_rib, push_rib, settle_rib, stiffen_rib
from beardyn_core.physics.ring_modes import about_rigid_cup, bend_cup, bent_cup
from beardyn_core.physics.rolling_resistance import prepare_rolling, push_rolling, settle_rolling
from beardyn_core.physics.small_rib import (
    prepare_small_rib,
    push_small_rib,
    settle_small_rib,
    stiffen_small_rib,
)

_PI = 3.141592653589793


@inline
def velocity_change(matrix, right, zero, explicit):
    """Solve for the change of velocity and angular velocity that the contacts are settled with.

    With the explicit step it is zero: every contact keeps the force it has at the beginning of the step, on
    roller and ring alike, and the compiler drops the matrix. Losses are taken at the beginning as well, so
    that the energy audit closes as far as slips change little over a step.
    """
    if explicit is not None:
        still = (zero, zero, zero)
        return Twist(still, still)
    return solve(matrix, right)


@inline
def step_rollers(lanes, block, rollers, rings, sums, bends, fresh, p):
    """Advance one block of rollers by one step, their state in place, and add what it does to the rings.

    ``fresh``: whether friction is worked out, whatever is held, and outputs are written.
    """
    step, effects, roller = p.step, p.effects, p.roller
    orbit = drift(
        lanes, rollers, block, load_vector(lanes, rings, layout.CUP, layout.RING_DRIFT), step, roller
    )
    cosine, sine, azimuth, momentum = orbit.cosine, orbit.sine, orbit.azimuth, orbit.momentum
    mask = lanes.load(p.rollers, block, layout.MASK)
    here = Here(lanes, block, rollers, sums, mask, cosine, sine, fresh)
    oversize = lanes.load(p.rollers, block, layout.OVERSIZE)
    omega = angular_velocity(momentum, orbit.axis, roller)
    zero = lanes.constant(0.0)
    body = Body((orbit.radius, zero, orbit.axial), orbit.axis, orbit.velocity, omega, orbit.rate)
    cup_view = ring_view(lanes, rings, layout.CUP, cosine, sine)
    bent_view, shift = bent_cup(lanes, bends, cup_view, orbit.radius, cosine, sine, effects.structure)
    cone_view = ring_view(lanes, rings, layout.CONE, cosine, sine)
    spin = lanes.load(rollers, block, layout.SPIN)
    timers = effects.timers
    mark(timers, MOTION)

    azimuths = (azimuth - lanes.load(rings, layout.CUP, layout.RING_TURN), -spin)
    ring = raceway.Ring(layout.CUP, p.cup, raceway.faults_of_cup(effects.faults), bent_view)
    cup = raceway.prepare_raceway(lanes, block, ring, body, oversize, azimuths, fresh, p)
    cup = about_rigid_cup(cup, shift, effects.structure)
    azimuths = (azimuth - lanes.load(rings, layout.CONE, layout.RING_TURN), _PI - spin)
    ring = raceway.Ring(layout.CONE, p.cone, raceway.faults_of_cone(effects.faults), cone_view)
    cone = raceway.prepare_raceway(lanes, block, ring, body, oversize, azimuths, fresh, p)
    mark(timers, CONTACT)
    cup_rolling = prepare_rolling(cup, layout.CUP, cup_view, body, effects.rolling)
    cone_rolling = prepare_rolling(cone, layout.CONE, cone_view, body, effects.rolling)
    drag = prepare_drag(body, cup_view, effects.drag)
    mark(timers, LOSS)
    rib = prepare_rib(body, cone_view, zero, effects.rib, effects.damping)
    small_rib = prepare_small_rib(body, cone_view, zero, effects.small_rib)
    flanges = prepare_flanges(body, cup_view, cone_view, zero, effects.flanges, effects.damping)
    mark(timers, RIB)
    pocket = prepare_pocket(lanes, rings, block, body, orbit, effects.faults.pockets, p, effects.cage)

    mark(timers, CAGE)
    matrix = inertia_matrix(roller.mass, roller.axial_inertia, roller.transverse_inertia, orbit.axis, zero)
    matrix = raceway.stiffen_raceway(matrix, cup, p)
    matrix = raceway.stiffen_raceway(matrix, cone, p)
    matrix = stiffen_drag(matrix, drag, step, effects.drag)
    matrix = stiffen_rib(matrix, rib, effects.rib, p)
    matrix = stiffen_small_rib(matrix, small_rib, effects.small_rib, p)
    matrix = stiffen_flanges(matrix, flanges, effects.flanges, p)

    on_cup, on_cone = raceway.push_raceway(cup, effects.damping), raceway.push_raceway(cone, effects.damping)
    gravity = rotate_weight(cosine, sine, roller.mass, effects.gravity)
    force, moment = add(add(on_cup.force, on_cone.force), gravity), add(on_cup.moment, on_cone.moment)
    total = Wrench(force, moment)
    total = push_rolling(push_rolling(total, cup_rolling, effects.rolling), cone_rolling, effects.rolling)
    total = push_drag(total, drag, effects.drag)
    total = push_rib(total, rib, effects.rib)
    total = push_small_rib(total, small_rib, effects.small_rib)
    total = push_flanges(total, flanges, effects.flanges)
    total = push_pocket(total, pocket, effects.cage)
    force, moment = total.force, total.moment
    turning_force = (
        force[0] + roller.mass * orbit.rate * orbit.velocity[1],
        force[1] - roller.mass * orbit.rate * orbit.velocity[0],
        force[2],
    )
    turning_moment = (moment[0] + orbit.rate * momentum[1], moment[1] - orbit.rate * momentum[0], moment[2])
    change = velocity_change(
        matrix, scale(step, turning_force) + scale(step, turning_moment), zero, p.explicit
    )
    mark(timers, SOLVE)

    on_cup = raceway.settle_raceway(layout.CUP, cup, change, here, p)
    bend_cup(on_cup.force, here, effects.structure)
    on_cone = raceway.settle_raceway(layout.CONE, cone, change, here, p)
    total = Wrench(add(add(on_cup.force, on_cone.force), gravity), add(on_cup.moment, on_cone.moment))
    mark(timers, SETTLE)
    total = settle_rolling(layout.CUP, cup_rolling, change, total, here, effects.rolling, p)
    total = settle_rolling(layout.CONE, cone_rolling, change, total, here, effects.rolling, p)
    total = settle_drag(drag, change, total, here, effects.drag, p)
    mark(timers, LOSS)
    total = settle_rib(rib, change, total, here, effects.rib, p)
    total = settle_small_rib(small_rib, change, total, here, effects.small_rib, p)
    total = settle_flanges(flanges, change, total, here, effects.flanges, p)
    mark(timers, RIB)
    settle_pocket(pocket, change, here, effects.cage, p)
    total = push_pocket(total, pocket, effects.cage)
    mark(timers, CAGE)
    work = step * dot(gravity, add_scaled(orbit.velocity, 0.5, change.velocity))
    account_gravity(here, work, effects.audit)

    velocity = turn_in(orbit.velocity, orbit.half_cosine, orbit.half_sine)
    momentum = turn_in(momentum, orbit.half_cosine, orbit.half_sine)
    lanes.store(rollers, block, layout.RADIUS, orbit.radius)
    lanes.store(rollers, block, layout.ANGLE, azimuth)
    lanes.store(rollers, block, layout.AXIAL, orbit.axial)
    store_vector(lanes, rollers, block, layout.AXIS, orbit.axis)
    store_vector(
        lanes, rollers, block, layout.VELOCITY, add_scaled(velocity, step / roller.mass, total.force)
    )
    store_vector(lanes, rollers, block, layout.MOMENTUM, add_scaled(momentum, step, total.moment))
    mark(timers, MOTION)

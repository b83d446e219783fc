"""Pockets of the cage: the contact of a roller within a step, in the full cage and the simpler ones.

A pocket has two bars and two ends. The full cage has disc against plane at two abscissae of both bars and end
against plane at both ends; the cheaper cages have two touches along the pitch circle only. Only sums over the
walls are kept until the step is settled: five walls with all they have would take more of the cache than all
else that a roller keeps.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    account,
    account_loss,
    accumulate_vector,
    output_contact,
    react,
)
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    LOSS_POCKET,
    LOST_ON_CAGE,
    POCKET,
    POCKET_ANGLE,
    RING_TURN,
)
from beardyn_core.physics.bodies.orbit import ring_view
from beardyn_core.physics.cage.pocket_wear import pocket_length, pocket_wear
from beardyn_core.physics.cage.walls import (
    Motion,
    Wall,
    Walls,
    add_kinematic_spring,
    empty_sums,
    touch_wall,
    wall_slip,
)
from beardyn_core.physics.lanes.lane_math import cos_sin, magnitude, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import (
    Vector,
    Wrench,
    add,
    add_scaled,
    add_wrenches,
    cross,
    dot,
    scale,
    subtract,
    turn_out,
)


class PocketContact(NamedTuple):
    """A pocket contact before the solve."""

    centre: Vector  # of mass of the roller from the cage's origin [m]
    walls: Walls
    slip_squared: Any  # at the bar that presses more [m^2/s^2]
    bar: Vector  # contact with the nearer bar from the centre of mass [m]


class Pocket(NamedTuple):
    """Where a roller is in its pocket.

    The order of the members decides the last bits, see `contact_output.react`.
    """

    centre: Vector  # of mass of the roller from the cage's origin [m]
    axis: Vector  # of the roller
    motion: Motion
    advance: Any  # azimuth of the roller less that of its pocket [rad]
    tilt: Vector  # small rotation of the cage without its spin [rad]
    wear: Any  # half of the clearance added by wear and scatter [m]
    length: Any  # half of that added at the ends [m]


@inline
def prepare_pocket(lanes, rings, block, body, orbit, pockets, p, cage):
    """Work out the pocket contact of one block before the solve, a `PocketContact`; zeros without a cage.

    ``pockets`` [block, 2, lane] (or ``None``): half of the clearance added to pockets, along the pitch circle
    and at the ends [m].
    """
    if cage is None:
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        return PocketContact(nothing, empty_sums(zero), zero, nothing)
    view = ring_view(lanes, rings, CAGE_BODY, orbit.cosine, orbit.sine)
    place = lanes.load(rings, CAGE_BODY, RING_TURN) + lanes.load(p.rollers, block, POCKET_ANGLE)
    wear, length = pocket_wear(lanes, block, pockets), pocket_length(lanes, block, pockets)
    centre = subtract(body.place, view.origin)
    motion = Motion(body.velocity, body.omega, view.velocity, view.omega)
    pocket = Pocket(centre, body.axis, motion, orbit.azimuth - place, view.axis, wear, length)
    return _touch(pocket, p.roller, cage, cage.rotating, cage.kinematic)


@inline
def _touch(pocket, roller, cage, rotating, kinematic):
    if kinematic is not None:
        return kinematic_pocket(pocket, cage, kinematic)
    if rotating is not None:
        return rotating_pocket(pocket, roller, cage)
    return free_pocket(pocket, roller, cage)


@inline
def push_pocket(total, contact, cage):
    """Add the pocket's wrench to that of the roller."""
    if cage is None:
        return total
    return add_wrenches(total, Wrench(contact.walls.force, contact.walls.moment))


@inline
def settle_pocket(contact, change, here, cage, p):
    """Write reaction, output and audit of the pocket contact, which is explicit.

    The loss is taken at the middle of the step. It changes the roller's velocity here; what it changes in
    the cage's is known when all pockets have pushed, see `motion.settle_cages`. Kinetic energy is the
    mean of what the velocities before and after the step have, which lies above that of the instant by a
    quarter of what the springs give in the step: the elastic energy is booked without it.
    """
    if cage is None:
        return
    walls, zero = contact.walls, here.lanes.constant(0.0)
    react(CAGE_BODY, contact.centre, Wrench(walls.force, walls.moment), here)
    output = ContactOutput(walls.force, contact.bar, sqrt(contact.slip_squared), zero)
    output_contact(here.lanes, here.rollers, here.block, POCKET, output)
    lost = walls.power + 0.5 * (dot(walls.lost_force, change.velocity) + dot(walls.lost_moment, change.omega))
    account_loss(here, LOSS_POCKET, p.step * lost, p.effects.audit)
    spring = add(walls.force, walls.lost_force)
    turning = add(walls.moment, walls.lost_moment)
    kinetic = 0.25 * p.step * (dot(spring, change.velocity) + dot(turning, change.omega))
    account(here, zero, walls.energy - kinetic, p.effects.audit)
    _keep_lost(contact, here, p.effects.audit)


@inline
def _keep_lost(contact, here, audit):
    """Sum the lost part of the pocket's force, negated, and its moment about the cage's origin."""
    if audit is None:
        return
    walls = contact.walls
    if any_positive(walls.power):
        moment = add(walls.lost_moment, cross(contact.centre, walls.lost_force))
        force = turn_out(scale(here.mask, walls.lost_force), here.cosine, here.sine)
        turn = turn_out(scale(here.mask, moment), here.cosine, here.sine)
        accumulate_vector(here, LOST_ON_CAGE, force)
        accumulate_vector(here, LOST_ON_CAGE + 3, turn)


# --- the three kinds of pockets


@inline
def free_pocket(pocket, roller, cage):
    """Work out the force of a free cage on the roller, and what it loses, as a `PocketContact`.

    Disc against plane at two abscissae of both bars, and end against plane at both pocket ends: linear
    springs with damping that never pull, and regularised Coulomb friction; at the bars a lubricant film if
    the cage has one. The bar faces lean, so that the rollers guide the cage radially. Neglects the bending of
    the bars, and the turn of the touching points under skew (1 um per mrad).
    """
    centre, axis, tilt, motion = pocket.centre, pocket.axis, pocket.tilt, pocket.motion
    cosine, sine = cos_sin(pocket.advance)
    still = 0.0 * sine
    ahead = (sine, cosine, still)
    ahead = add(ahead, cross(tilt, ahead))
    outward = (cosine, -sine, still)
    outward = add(outward, cross(tilt, outward))
    pocket_axis = (cage.axis_radial * cosine, -cage.axis_radial * sine, cage.axis_axial + still)
    pocket_axis = add(pocket_axis, cross(tilt, pocket_axis))

    height = cage.bar_sine * (dot(outward, centre) - cage.roller_height)
    offset = cage.bar_cosine * dot(ahead, centre)
    skew = cage.bar_cosine * dot(ahead, axis)
    lift = cage.bar_sine * (dot(outward, axis) - cage.axis_radial)
    front = add_scaled(scale(cage.bar_cosine, ahead), cage.bar_sine, outward)
    behind = add_scaled(scale(-cage.bar_cosine, ahead), cage.bar_sine, outward)
    clearance = cage.bar_cosine * (cage.half_clearance + pocket.wear)
    small, large = -cage.bar_place, cage.bar_place
    small_radius = roller.radius - cage.bar_place * roller.taper
    large_radius = roller.radius + cage.bar_place * roller.taper
    small_arm, large_arm = scale(small, axis), scale(large, axis)
    small_end, large_end = (axis, small_radius), (axis, large_radius)
    small_front = add_scaled(small_arm, small_radius, front)
    small_behind = add_scaled(small_arm, small_radius, behind)
    walls = empty_sums(0.0 * still)
    depth = height + offset + small * (lift + skew) - clearance
    wall = Wall(centre, small_front, front, depth)
    walls = touch_wall(walls, wall, motion, cage, small_end, cage.film)
    large_front = add_scaled(large_arm, large_radius, front)
    depth = height + offset + large * (lift + skew) - clearance
    wall = Wall(centre, large_front, front, depth)
    walls = touch_wall(walls, wall, motion, cage, large_end, cage.film)
    pushed_back = walls.force
    depth = height - offset + small * (lift - skew) - clearance
    wall = Wall(centre, small_behind, behind, depth)
    walls = touch_wall(walls, wall, motion, cage, small_end, cage.film)
    large_behind = add_scaled(large_arm, large_radius, behind)
    depth = height - offset + large * (lift - skew) - clearance
    wall = Wall(centre, large_behind, behind, depth)
    walls = touch_wall(walls, wall, motion, cage, large_end, cage.film)
    pushed_on = subtract(walls.force, pushed_back)
    slip_squared = where_greater(
        dot(pushed_on, pushed_on),
        dot(pushed_back, pushed_back),
        _slip_squared(centre, small_behind, motion),
        _slip_squared(centre, small_front, motion),
    )
    slide = dot(pocket_axis, centre) - cage.roller_place
    side = where_greater(slide, 0.0, 1.0 + still, -1.0 + still)
    shorter = roller.half_length * (1.0 - dot(pocket_axis, axis))
    arm, direction = scale(side * roller.half_length, axis), scale(side, pocket_axis)
    end = Wall(centre, arm, direction, magnitude(slide) - shorter - cage.half_end_clearance - pocket.length)
    walls = touch_wall(walls, end, motion, cage, (axis, roller.radius), None)
    bar = scale(where_greater(offset, 0.0, roller.radius + still, -roller.radius + still), ahead)
    return PocketContact(centre, walls, slip_squared, bar)


@inline
def rotating_pocket(pocket, roller, cage):
    """Work out the contact with the nearer bar at both ends of the roller; as `free_pocket`.

    Without play there is no nearer bar; the side a roller is on then pushes it back, as both bars would.
    Neglects the lean of the bars, the lubricant, and the pocket ends.
    """
    centre, axis, motion = pocket.centre, pocket.axis, pocket.motion
    ahead, offset, skew = _along_pitch_circle(pocket)
    clearance = cage.half_clearance + pocket.wear
    small_place, large_place = -cage.bar_place, cage.bar_place
    small_offset = offset + small_place * skew
    large_offset = offset + large_place * skew
    small_side = where_greater(small_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    large_side = where_greater(large_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    small_radius = roller.radius + small_place * roller.taper
    large_radius = roller.radius + large_place * roller.taper
    small_normal, large_normal = scale(small_side, ahead), scale(large_side, ahead)
    small_arm = add_scaled(scale(small_place, axis), small_radius, small_normal)
    nothing = empty_sums(0.0 * offset)
    wall = Wall(centre, small_arm, small_normal, magnitude(small_offset) - clearance)
    small = touch_wall(nothing, wall, motion, cage, (axis, small_radius), None)
    large_arm = add_scaled(scale(large_place, axis), large_radius, large_normal)
    wall = Wall(centre, large_arm, large_normal, magnitude(large_offset) - clearance)
    both = touch_wall(small, wall, motion, cage, (axis, large_radius), None)
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small.force, both.force)
    bar = scale(
        where_greater(offset, 0.0, roller.radius + 0.0 * offset, -roller.radius + 0.0 * offset), ahead
    )
    return PocketContact(centre, both, slip_squared, bar)


@inline
def kinematic_pocket(pocket, cage, kinematic):
    """Hold the roller's axis at its pocket's place by two weak springs with dampers, without play.

    They hold the skew too.
    """
    centre, axis, motion = pocket.centre, pocket.axis, pocket.motion
    ahead, offset, skew = _along_pitch_circle(pocket)
    small_arm, large_arm = scale(-cage.bar_place, axis), scale(cage.bar_place, axis)
    nothing = empty_sums(0.0 * offset)
    small = add_kinematic_spring(
        nothing, centre, small_arm, ahead, offset - cage.bar_place * skew, motion, kinematic
    )
    both = add_kinematic_spring(
        small, centre, large_arm, ahead, offset + cage.bar_place * skew, motion, kinematic
    )
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small.force, both.force)
    return PocketContact(centre, both, slip_squared, scale(0.0, ahead))


@inline
def _along_pitch_circle(pocket):
    """Take the direction of growing azimuth at the pocket; offset [m] and skew of the roller along it."""
    cosine, sine = cos_sin(pocket.advance)
    ahead = (sine, cosine, 0.0 * sine)
    ahead = add(ahead, cross(pocket.tilt, ahead))
    return ahead, dot(ahead, pocket.centre), dot(ahead, pocket.axis)


@inline
def _pair_slip_squared(centre, small_arm, large_arm, motion, small_force, both_force):
    """Square the slip at the large end where more than half of the force is there, else at the small end."""
    large_force = subtract(both_force, small_force)
    small_slip, large_slip = wall_slip(centre, small_arm, motion), wall_slip(centre, large_arm, motion)
    return where_greater(
        4.0 * dot(large_force, large_force),
        dot(both_force, both_force),
        dot(large_slip, large_slip),
        dot(small_slip, small_slip),
    )


@inline
def _slip_squared(centre, arm, motion):
    slip = wall_slip(centre, arm, motion)
    return dot(slip, slip)

"""Walls of a pocket: spring, damper and friction where a roller touches one, summed over all of them."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.cage.pocket_film import is_reached, pocket_loads, rolling_speed
from beardyn_core.physics.lanes.lane_math import at_least, magnitude, sqrt, where_greater
from beardyn_core.physics.lanes.vectors import Vector, add, add_scaled, cross, dot, scale, subtract

_SMALLEST_WAY = 1e-15


class Walls(NamedTuple):
    """Sums over the walls of a pocket."""

    force: Vector  # on the roller [N]
    moment: Vector  # about its centre of mass [N m]
    energy: Any  # elastic [J]
    power: Any  # lost at the present slip [W]
    lost_force: Vector  # lost part of the force, negated [N]
    lost_moment: Vector  # its moment [N m]


class Wall(NamedTuple):
    """A wall of a pocket that a roller may touch."""

    centre: Vector  # of mass of the roller from the cage's origin [m]
    arm: Vector  # where the roller touches it, from the centre of mass [m]
    direction: Vector  # normal of the wall, towards it
    depth: Any  # approach beyond touching, negative for a gap [m]


class Motion(NamedTuple):
    """How a roller and its cage move, in the orbit frame."""

    velocity: Vector  # of the roller's centre of mass [m/s]
    omega: Vector  # [rad/s]
    cage_velocity: Vector  # of the cage's origin [m/s]
    cage_omega: Vector  # [rad/s]


@inline
def empty_sums(zero):
    """Make sums over no walls from a zero, or a NaN, which stays one."""
    nothing = (zero, zero, zero)
    return Walls(nothing, nothing, zero, zero, nothing, nothing)


@inline
def _add_touch(walls, arm, slip, force, lost, energy):
    """Add one wall to the sums over the walls of a pocket."""
    return Walls(
        add(walls.force, force),
        add(walls.moment, cross(arm, force)),
        walls.energy + energy,
        walls.power + dot(lost, slip),
        add(walls.lost_force, lost),
        add(walls.lost_moment, cross(arm, lost)),
    )


@inline
def touch_wall(walls, wall, motion, cage, shape, film):
    """Add one wall to the sums: a spring-damper with friction; one that no roller reaches costs nothing.

    ``shape`` is the roller's axis and its radius at the wall, for the film if there is one.
    """
    if is_reached(wall.depth, film):
        slip = wall_slip(wall.centre, wall.arm, motion)
        return _press_wall(walls, wall.arm, slip, wall.direction, wall.depth, cage, shape, film)
    force = walls.force
    force = (force[0] + 0.0 * wall.depth, force[1], force[2])  # a NaN stays one
    return Walls(force, walls.moment, walls.energy, walls.power, walls.lost_force, walls.lost_moment)


@inline
def _press_wall(walls, arm, slip, direction, depth, cage, shape, film):
    inside = at_least(depth, 0.0)
    rate = dot(slip, direction)
    stored = 0.5 * cage.stiffness * inside * inside
    spring = cage.stiffness * partial_contact_mean(inside, rate, cage.step)
    damping = where_greater(depth, 0.0, cage.damping + 0.0 * depth, 0.0 * depth)
    axis, radius = shape
    rolling = rolling_speed(slip, direction, axis, film)
    load, solid, shear = pocket_loads(depth, spring + damping * rate, rate, rolling, radius, film)
    tangential = add_scaled(slip, -rate, direction)
    speed = sqrt(dot(tangential, tangential) + cage.regularisation * cage.regularisation)
    friction = cage.friction * solid / speed + shear
    force = add_scaled(scale(-load, direction), -friction, tangential)
    lost = add_scaled(scale(load - spring, direction), friction, tangential)
    return _add_touch(walls, arm, slip, force, lost, stored)


@inline
def partial_contact_mean(inside, rate, step):
    """Take what a wall's spring presses with where its contact begins or ends within a step, [m].

    A whole step of the force at the first or last instant of contact takes or gives k d (u h - d) / 2 more
    than the spring stores, d being its depth there and u the speed; this much less is exact. As in
    `laminae`, for a spring that is linear and explicit.
    """
    way = at_least(magnitude(rate) * step, _SMALLEST_WAY)
    return inside * (1.0 - 0.5 * at_least(1.0 - inside / way, 0.0))


@inline
def add_kinematic_spring(walls, centre, arm, direction, offset, motion, kinematic):
    """Add one spring-damper that pulls as well as it pushes."""
    slip = wall_slip(centre, arm, motion)
    damper = kinematic.damping * dot(slip, direction)
    spring = kinematic.stiffness * offset
    force, lost = scale(-spring - damper, direction), scale(damper, direction)
    return _add_touch(walls, arm, slip, force, lost, 0.5 * spring * offset)


@inline
def wall_slip(centre, arm, motion):
    """Work out the velocity of the roller against the cage at a point, [m/s]."""
    velocity, omega, cage_velocity, cage_omega = motion
    return subtract(
        subtract(add(velocity, cross(omega, arm)), cage_velocity), cross(cage_omega, add(centre, arm))
    )

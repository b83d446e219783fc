"""Contact of a roller with its cage pocket: the bars in front and behind, and both ends."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, cos_sin, magnitude, sqrt, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.pocket_film import pocket_loads
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract


@inline
def pocket_contact(
    centre: Any,
    axis: Any,
    velocity: Any,
    omega: Any,
    advance: Any,
    tilt: Any,
    ring_velocity: Any,
    ring_omega: Any,
    wear: Any,
    roller: Any,
    cage: Any,
) -> Any:
    """Force of the cage on the roller, and what it loses.

    Disc against plane at two abscissae of both bars, and end against plane at both pocket ends: linear
    springs with damping that never pull, and regularised Coulomb friction; at the bars a lubricant film if
    the cage has one. The bar faces lean, so that the rollers guide the cage radially. Neglects the bending of
    the bars, and the turn of the touching points under skew (1 um per mrad).

    Parameters
    ----------
    centre : vector
        Centre of mass of the roller from the cage's origin, [m].
    axis, velocity, omega : vector
        Of the roller.
    advance : lane value
        Azimuth of the roller less that of its pocket, [rad].
    tilt : vector
        Small rotation of the cage without its spin, [rad].
    ring_velocity, ring_omega : vector
        Of the cage at its origin.
    wear : lane value
        Half of the clearance that wear has added, [m].
    roller : RollerParams
    cage : CageParams

    Returns
    -------
    touches : tuple of 5 tuples
        Per wall (front and back bar at the small and large end, pocket end): force on the roller, arm,
        lost part of the force negated, slip, elastic energy.
    bar : vector
        Contact with the nearer bar from the centre of mass, [m].
    """
    cosine, sine = cos_sin(advance)
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
    clearance = cage.bar_cosine * (cage.half_clearance + wear)
    motion = (velocity, omega, ring_velocity, ring_omega)
    small, large = -cage.bar_place, cage.bar_place
    small_radius = roller.radius - cage.bar_place * roller.taper
    large_radius = roller.radius + cage.bar_place * roller.taper
    small_front = touch_wall(
        centre, add_scaled(scale(small, axis), small_radius, front), front,
        height + offset + small * (lift + skew) - clearance, motion, cage,
        (axis, small_radius), cage.film,
    )  # fmt: skip
    large_front = touch_wall(
        centre, add_scaled(scale(large, axis), large_radius, front), front,
        height + offset + large * (lift + skew) - clearance, motion, cage,
        (axis, large_radius), cage.film,
    )  # fmt: skip
    small_behind = touch_wall(
        centre, add_scaled(scale(small, axis), small_radius, behind), behind,
        height - offset + small * (lift - skew) - clearance, motion, cage,
        (axis, small_radius), cage.film,
    )  # fmt: skip
    large_behind = touch_wall(
        centre, add_scaled(scale(large, axis), large_radius, behind), behind,
        height - offset + large * (lift - skew) - clearance, motion, cage,
        (axis, large_radius), cage.film,
    )  # fmt: skip
    slide = dot(pocket_axis, centre) - cage.roller_place
    side = where_greater(slide, 0.0, 1.0 + still, -1.0 + still)
    shorter = roller.half_length * (1.0 - dot(pocket_axis, axis))
    end = touch_wall(
        centre, scale(side * roller.half_length, axis), scale(side, pocket_axis),
        magnitude(slide) - shorter - cage.half_end_clearance, motion, cage, (axis, roller.radius), None,
    )  # fmt: skip
    touches = (small_front, large_front, small_behind, large_behind, end)
    bar = scale(where_greater(offset, 0.0, roller.radius + still, -roller.radius + still), ahead)
    return touches, bar


@inline
def pocket_sum(touches: Any) -> Any:
    """Force, moment about the roller's centre of mass and elastic energy of all walls of a pocket."""
    a, b, c, d, e = touches
    force = add(add(add(a[0], b[0]), add(c[0], d[0])), e[0])
    moment = add(
        add(add(cross(a[1], a[0]), cross(b[1], b[0])), add(cross(c[1], c[0]), cross(d[1], d[0]))),
        cross(e[1], e[0]),
    )
    return force, moment, a[4] + b[4] + c[4] + d[4] + e[4]


@inline
def pocket_loss(touches: Any, change: Any) -> Any:
    """Power lost in a pocket at the middle of a step that changes the roller's velocities, [W]."""
    a, b, c, d, e = touches
    return (
        touch_loss(a, change)
        + touch_loss(b, change)
        + touch_loss(c, change)
        + touch_loss(d, change)
        + touch_loss(e, change)
    )


@inline
def touch_loss(touch: Any, change: Any) -> Any:
    """Power lost at one wall at the middle of a step that changes the roller's velocities, [W]."""
    middle = add_scaled(touch[3], 0.5, add(change[0], cross(change[1], touch[1])))
    return dot(touch[2], middle)


@inline
def wall_slip(centre: Any, arm: Any, motion: Any) -> Any:
    """Velocity of the roller against the cage at a point, [m/s]."""
    velocity, omega, ring_velocity, ring_omega = motion
    return subtract(
        subtract(add(velocity, cross(omega, arm)), ring_velocity), cross(ring_omega, add(centre, arm))
    )


@inline
def touch_wall(
    centre: Any, arm: Any, direction: Any, depth: Any, motion: Any, cage: Any, shape: Any, film: Any
) -> Any:
    """One spring-damper with friction; force, arm, lost part of the force, slip, elastic energy.

    ``shape`` is the roller's axis and its radius at the wall, for the film if there is one. A wall that no
    roller of the block reaches costs its slip only.
    """
    slip = wall_slip(centre, arm, motion)
    if _is_reached(depth, film):
        return _press_wall(arm, slip, direction, depth, cage, shape, film)
    zero = 0.0 * depth  # a NaN stays one
    return (zero, zero, zero), arm, (zero, zero, zero), slip, zero


@inline
def _is_reached(depth: Any, film: Any) -> Any:
    """Whether the wall acts on any lane; a film acts at a distance."""
    if film is None:
        return any_positive(depth)
    return True


@inline
def _press_wall(arm: Any, slip: Any, direction: Any, depth: Any, cage: Any, shape: Any, film: Any) -> Any:
    inside = at_least(depth, 0.0)
    rate = dot(slip, direction)
    spring = cage.stiffness * inside
    damping = where_greater(depth, 0.0, cage.damping + 0.0 * depth, 0.0 * depth)
    load, solid, shear = pocket_loads(depth, spring + damping * rate, rate, slip, direction, shape, film)
    tangential = add_scaled(slip, -rate, direction)
    speed = sqrt(dot(tangential, tangential) + cage.regularisation * cage.regularisation)
    friction = cage.friction * solid / speed + shear
    force = add_scaled(scale(-load, direction), -friction, tangential)
    lost = add_scaled(scale(load - spring, direction), friction, tangential)
    return force, arm, lost, slip, 0.5 * spring * inside

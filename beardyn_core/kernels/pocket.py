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
    touches : tuple
        Sums over front and back bar at the small and large end and the pocket end: force on the roller and
        moment about its centre of mass, elastic energy, power lost at the present slip, lost part of the
        force negated, its moment.
    slip_squared : lane value
        At the bar that presses more, [m^2/s^2].
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
    small_arm, large_arm = scale(small, axis), scale(large, axis)
    small_front = add_scaled(small_arm, small_radius, front)
    small_behind = add_scaled(small_arm, small_radius, behind)
    zero = 0.0 * still
    nothing = (zero, zero, zero)
    touches = (nothing, nothing, zero, zero, nothing, nothing)
    touches = touch_wall(
        touches, centre, small_front, front,
        height + offset + small * (lift + skew) - clearance, motion, cage, (axis, small_radius), cage.film,
    )  # fmt: skip
    touches = touch_wall(
        touches, centre, add_scaled(large_arm, large_radius, front), front,
        height + offset + large * (lift + skew) - clearance, motion, cage, (axis, large_radius), cage.film,
    )  # fmt: skip
    pushed_back = touches[0]
    touches = touch_wall(
        touches, centre, small_behind, behind,
        height - offset + small * (lift - skew) - clearance, motion, cage, (axis, small_radius), cage.film,
    )  # fmt: skip
    touches = touch_wall(
        touches, centre, add_scaled(large_arm, large_radius, behind), behind,
        height - offset + large * (lift - skew) - clearance, motion, cage, (axis, large_radius), cage.film,
    )  # fmt: skip
    pushed_on = subtract(touches[0], pushed_back)
    slip_squared = where_greater(
        dot(pushed_on, pushed_on),
        dot(pushed_back, pushed_back),
        _slip_squared(centre, small_behind, motion),
        _slip_squared(centre, small_front, motion),
    )
    slide = dot(pocket_axis, centre) - cage.roller_place
    side = where_greater(slide, 0.0, 1.0 + still, -1.0 + still)
    shorter = roller.half_length * (1.0 - dot(pocket_axis, axis))
    touches = touch_wall(
        touches, centre, scale(side * roller.half_length, axis), scale(side, pocket_axis),
        magnitude(slide) - shorter - cage.half_end_clearance, motion, cage, (axis, roller.radius), None,
    )  # fmt: skip
    bar = scale(where_greater(offset, 0.0, roller.radius + still, -roller.radius + still), ahead)
    return touches, slip_squared, bar


@inline
def add_touch(touches: Any, arm: Any, slip: Any, force: Any, lost: Any, energy: Any) -> Any:
    """Add one wall to the sums over the walls of a pocket.

    Only sums are kept until the step is settled: five walls with all they have would take more of the
    cache than all else that a roller keeps.
    """
    return (
        add(touches[0], force),
        add(touches[1], cross(arm, force)),
        touches[2] + energy,
        touches[3] + dot(lost, slip),
        add(touches[4], lost),
        add(touches[5], cross(arm, lost)),
    )


@inline
def touch_loss(touches: Any, change: Any) -> Any:
    """Power lost in a pocket at the middle of a step that changes the roller's velocities, [W]."""
    return touches[3] + 0.5 * (dot(touches[4], change[0]) + dot(touches[5], change[1]))


@inline
def _slip_squared(centre: Any, arm: Any, motion: Any) -> Any:
    slip = wall_slip(centre, arm, motion)
    return dot(slip, slip)


@inline
def wall_slip(centre: Any, arm: Any, motion: Any) -> Any:
    """Velocity of the roller against the cage at a point, [m/s]."""
    velocity, omega, ring_velocity, ring_omega = motion
    return subtract(
        subtract(add(velocity, cross(omega, arm)), ring_velocity), cross(ring_omega, add(centre, arm))
    )


@inline
def touch_wall(
    touches: Any,
    centre: Any,
    arm: Any,
    direction: Any,
    depth: Any,
    motion: Any,
    cage: Any,
    shape: Any,
    film: Any,
) -> Any:
    """Add one wall to the sums: a spring-damper with friction.

    ``shape`` is the roller's axis and its radius at the wall, for the film if there is one. A wall that no
    roller of the block reaches costs nothing.
    """
    if _is_reached(depth, film):
        slip = wall_slip(centre, arm, motion)
        return _press_wall(touches, arm, slip, direction, depth, cage, shape, film)
    force = touches[0]
    force = (force[0] + 0.0 * depth, force[1], force[2])  # a NaN stays one
    return force, touches[1], touches[2], touches[3], touches[4], touches[5]


@inline
def _is_reached(depth: Any, film: Any) -> Any:
    """Whether the wall acts on any lane; a film acts within the thickness of its layer."""
    if film is None:
        return any_positive(depth)
    return any_positive(1.0 + film.inverse_layer * depth)


@inline
def _press_wall(
    touches: Any, arm: Any, slip: Any, direction: Any, depth: Any, cage: Any, shape: Any, film: Any
) -> Any:
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
    return add_touch(touches, arm, slip, force, lost, 0.5 * spring * inside)

"""Small roller end at the small rib of the cone: the flat end against a circle of the rib."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import implicit_time
from beardyn_core.kernels.lane_math import at_least, sqrt, where_greater
from beardyn_core.kernels.rib_step import is_pressed, settle_point
from beardyn_core.kernels.solve import add_point, add_point_everywhere
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.model.layout import LOSS_SMALL_RIB


@inline
def small_rib_contact(
    centre: Any,
    axis: Any,
    velocity: Any,
    omega: Any,
    ring_axis: Any,
    ring_velocity: Any,
    ring_omega: Any,
    rib: Any,
) -> Any:
    """Force of the small rib on the roller: plane on circle, closed form.

    Adds the stop that holds a roller when the load is away. The rib bears on a circle at half its height;
    of all its points the one furthest behind the plane of the roller end lies in the direction in which the
    roller axis leans away from the cone's. Neglects the width of the rib's face.

    Parameters and returns as in `kernels.rib.rib_contact`, without a film.
    """
    along = dot(axis, ring_axis)
    across = add_scaled(axis, -along, ring_axis)
    lean = sqrt(dot(across, across))
    point = add_scaled(scale(rib.place, ring_axis), rib.radius / lean, across)
    arm = subtract(point, centre)
    depth = dot(arm, axis) - rib.end_place
    normal = scale(-1.0, axis)
    slip = subtract(
        subtract(add(velocity, cross(omega, arm)), ring_velocity), cross(ring_omega, add(centre, arm))
    )
    touching = at_least(depth, 0.0)
    rate = dot(slip, normal)
    push = touching + where_greater(depth, 0.0, rib.damping.time_constant * rate, 0.0 * depth)
    tangent = where_greater(push, 0.0, rib.stiffness + 0.0 * depth, 0.0 * depth)
    load = tangent * push
    tangential = add_scaled(slip, -rate, normal)
    speed = sqrt(dot(tangential, tangential) + rib.regularisation * rib.regularisation)
    zero = 0.0 * depth
    elastic = rib.stiffness * touching
    energy = 0.5 * rib.stiffness * touching * touching
    friction = rib.friction * load / speed
    return normal, arm, load, tangent, friction, elastic, energy, slip, zero, zero, zero


@inline
def small_rib_before(body: Any, view: Any, zero: Any, rib: Any) -> Any:
    """Small-rib contact before the solve; without one zeros of the same type, which nothing uses."""
    if rib is None:
        nothing = (zero, zero, zero)
        return nothing, (nothing, nothing, zero, zero, zero, zero, zero, nothing, zero, zero, zero)
    place, axis, velocity, omega, _rate = body
    centre = subtract(place, view[0])
    return centre, small_rib_contact(centre, axis, velocity, omega, view[1], view[2], view[3], rib)


@inline
def small_rib_matrix(matrix: Any, contact: Any, rib: Any, p: Any) -> Any:
    """Add the implicit part of the small-rib contact."""
    if rib is None:
        return matrix
    if not is_pressed(contact):
        return matrix
    normal, arm, tangent, friction = contact[1][0], contact[1][1], contact[1][3], contact[1][4]
    rough = p.step * friction
    stiff = p.step * implicit_time(p.spring_time, rib.damping) * tangent
    return add_point(add_point_everywhere(matrix, arm, rough), normal, arm, stiff - rough)


@inline
def add_small_rib(force: Any, moment: Any, contact: Any, rib: Any) -> Any:
    """Add the small rib's wrench from the velocities at the beginning of the step to a sum."""
    if rib is None:
        return force, moment
    if not is_pressed(contact):
        return force, moment
    normal, arm, load, friction, slip = (
        contact[1][0],
        contact[1][1],
        contact[1][2],
        contact[1][4],
        contact[1][7],
    )
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    push = add_scaled(scale(-load, normal), -friction, tangential)
    return add(force, push), add(moment, cross(arm, push))


@inline
def finish_small_rib(
    lanes: Any,
    sums: Any,
    contact: Any,
    change: Any,
    force: Any,
    moment: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    rib: Any,
    p: Any,
) -> Any:
    """Settle the small-rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return force, moment
    push, turn = settle_point(
        lanes, sums, contact, change, mask, cosine, sine, LOSS_SMALL_RIB, rib.damping.time_constant, None, p
    )
    return add(force, push), add(moment, turn)

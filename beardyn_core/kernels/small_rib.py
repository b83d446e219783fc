"""Small roller end at the small rib of the cone, the flat end against a circle of the rib."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, sqrt, where_greater
from beardyn_core.kernels.point_contact import (
    PointContact,
    absent_point,
    is_pressed,
    push_point,
    settle_point,
    stiffen_point,
)
from beardyn_core.kernels.vectors import add, add_scaled, add_wrenches, cross, dot, scale, subtract
from beardyn_core.model.layout import LOSS_SMALL_RIB


@inline
def prepare_small_rib(body: Any, view: Any, zero: Any, rib: Any) -> Any:
    """Work out the small-rib contact before the solve; without one zeros, which nothing uses."""
    if rib is None:
        return absent_point(zero)
    return small_rib_contact(subtract(body.place, view.origin), body, view, rib)


@inline
def small_rib_contact(centre: Any, body: Any, view: Any, rib: Any) -> Any:
    """Work out the force of the small rib on the roller: plane on circle, closed form.

    Adds the stop that holds a roller when the load is away. The rib bears on a circle at half its height;
    of all its points the one furthest behind the plane of the roller end lies in the direction in which the
    roller axis leans away from the cone's. Neglects the width of the rib's face.
    """
    axis, ring_axis = body.axis, view.axis
    along = dot(axis, ring_axis)
    across = add_scaled(axis, -along, ring_axis)
    lean = sqrt(dot(across, across))
    point = add_scaled(scale(rib.place, ring_axis), rib.radius / lean, across)
    arm = subtract(point, centre)
    depth = dot(arm, axis) - rib.end_place
    normal = scale(-1.0, axis)
    at_arm = add(body.velocity, cross(body.omega, arm))
    slip = subtract(subtract(at_arm, view.velocity), cross(view.omega, add(centre, arm)))
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
    return PointContact(centre, normal, arm, load, tangent, friction, elastic, energy, slip, zero, zero, zero)


@inline
def stiffen_small_rib(matrix: Any, contact: Any, rib: Any, p: Any) -> Any:
    """Add the implicit part of the small-rib contact to the roller's matrix."""
    if rib is None:
        return matrix
    if not is_pressed(contact):
        return matrix
    return stiffen_point(matrix, contact, rib.damping, None, p)


@inline
def push_small_rib(total: Any, contact: Any, rib: Any) -> Any:
    """Add the small rib's wrench at the beginning of the step to that of the roller."""
    if rib is None:
        return total
    if not is_pressed(contact):
        return total
    return add_wrenches(total, push_point(contact, None))


@inline
def settle_small_rib(contact: Any, change: Any, total: Any, here: Any, rib: Any, p: Any) -> Any:
    """Settle the small-rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return total
    time_constant = rib.damping.time_constant
    return add_wrenches(total, settle_point(contact, change, here, LOSS_SMALL_RIB, time_constant, None, p))

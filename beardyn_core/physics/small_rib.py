"""Small rib: the flat small end of a roller against a circle of the rib, with parameters and builder."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import EffectSet
from beardyn_core.physics.bodies.layout import CONE, LOSS_SMALL_RIB
from beardyn_core.physics.contact_damping import DampingParams
from beardyn_core.physics.lanes.lane_math import at_least, sqrt, where_greater
from beardyn_core.physics.lanes.vectors import add, add_scaled, add_wrenches, cross, dot, scale, subtract
from beardyn_core.physics.point_contact import (
    PointContact,
    absent_point,
    is_pressed,
    push_point,
    settle_point,
    stiffen_point,
)


class SmallRibParams(NamedTuple):
    """Small roller end at the cone's small rib."""

    radius: float  # of the rib's contact circle [m]
    place: float  # of that circle, axial from the cone's origin [m]
    end_place: float  # of the flat end on the axis from the centre of mass [m]
    stiffness: float  # [N/m]
    damping: DampingParams
    friction: float
    regularisation: float  # [m/s]


def small_rib_params(bearing: RollerBearing, effects: EffectSet) -> SmallRibParams | None:
    """Describe the small rib in cone coordinates; its clearance opens with the roller on the large rib."""
    effect = effects.small_rib
    if effect is None or not isinstance(bearing, Bearing):
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    along = -0.5 * bearing.roller_length - bearing.small_rib_clearance
    below = bearing.small_end_radius - 0.5 * bearing.small_rib_height
    return SmallRibParams(
        radius=0.5 * bearing.pitch_diameter + along * sine - below * cosine,
        place=0.5 * bearing.row_spacing + along * cosine + below * sine,
        end_place=-0.5 * bearing.roller_length - bearing.roller_mass_offset,
        stiffness=effect.stiffness,
        damping=DampingParams(effect.damping / effect.stiffness),
        friction=effect.friction,
        regularisation=effect.regularisation_speed,
    )


@inline
def prepare_small_rib(body, view, zero, rib):
    """Work out the small-rib contact before the solve; without one zeros, which nothing uses."""
    if rib is None:
        return absent_point(zero)
    return small_rib_contact(subtract(body.place, view.origin), body, view, rib)


@inline
def small_rib_contact(centre, body, view, rib):
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
def stiffen_small_rib(matrix, contact, rib, p):
    """Add the implicit part of the small-rib contact to the roller's matrix."""
    if rib is None:
        return matrix
    if not is_pressed(contact):
        return matrix
    return stiffen_point(matrix, contact, rib.damping, None, p)


@inline
def push_small_rib(total, contact, rib):
    """Add the small rib's wrench at the beginning of the step to that of the roller."""
    if rib is None:
        return total
    if not is_pressed(contact):
        return total
    return add_wrenches(total, push_point(contact, None))


@inline
def settle_small_rib(contact, change, total, here, rib, p):
    """Settle the small-rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return total
    time_constant = rib.damping.time_constant
    return add_wrenches(
        total, settle_point(contact, change, here, CONE, LOSS_SMALL_RIB, time_constant, None, p)
    )

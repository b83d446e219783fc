"""Large roller end on its rib: parameters, and the contact within a step."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing import contact_law
from beardyn_core.bearing.contact_law import exact_rib_contact
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import Rib
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    load_vector,
    output_contact,
    watch_largest,
)
from beardyn_core.physics.bodies.layout import (
    CONE,
    CONTACT_OUTPUT,
    LOSS_RIB,
    OUTPUT_FIELDS,
    OUTPUT_FORCE,
    RIB,
)
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.lanes.lane_math import at_least, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import add, add_scaled, add_wrenches, cross, dot, subtract
from beardyn_core.physics.point_contact import (
    PointContact,
    absent_point,
    is_pressed,
    push_point,
    settle_point,
    stiffen_point,
)
from beardyn_core.physics.rib_friction import (
    RibDrillingParams,
    RibFilmParams,
    rib_drilling_params,
    rib_film_params,
    rub,
    spin_reach,
    with_spin,
)
from beardyn_core.physics.rib_gap import (
    RibEndParams,
    RibWindowParams,
    rib_window,
    rim_points,
    roller_end,
    sphere_point,
)


class RibParams(NamedTuple):
    """Large roller end on the cone rib."""

    stiffness: float  # [N/m^1.5]
    sphere_radius: float  # [m]
    sphere_place: float  # of the sphere centre on the axis from the centre of mass [m]
    normal_axial: float
    normal_radial: float
    distance: float  # of the nominal contact along the normal [m]
    friction: float
    regularisation: float  # [m/s]
    window: RibWindowParams | None
    end: RibEndParams | None
    film: RibFilmParams | None
    drilling: RibDrillingParams | None


def rib_params(
    bearing: Bearing, rib: Rib | None, lubricant: Lubricant, temperature: float
) -> RibParams | None:
    """Describe the rib contact in the cone's coordinates; the nominal roller just touches it.

    Parameters
    ----------
    temperature : float
        Of the lubricant at the inlet, [K].
    """
    if rib is None:
        return None
    normal_axial, normal_radial = math.cos(bearing.rib_lean), math.sin(bearing.rib_lean)
    centre_radial, centre_axial = bearing.end_sphere
    contact = exact_rib_contact(bearing) if rib.stiffness == "exact" else contact_law.rib_contact(bearing)
    nominal = centre_radial * normal_axial - centre_axial * normal_radial
    return RibParams(
        stiffness=contact.factor,
        sphere_radius=bearing.sphere_radius,
        sphere_place=bearing.sphere_centre - bearing.roller_mass_offset,
        normal_axial=normal_axial,
        normal_radial=normal_radial,
        distance=centre_axial * normal_axial + centre_radial * normal_radial + bearing.sphere_radius,
        friction=rib.friction,
        regularisation=rib.regularisation_speed,
        window=rib_window(bearing, nominal, rib),
        end=roller_end(bearing) if rib.roller_end else None,
        film=rib_film_params(
            bearing.rib_roughness, rib, lubricant, temperature, contact, contact_law.rib_contact(bearing)
        ),
        drilling=rib_drilling_params(rib, contact),
    )


def large_rib_params(
    bearing: RollerBearing, rib: Rib | None, lubricant: Lubricant, temperature: float
) -> RibParams | None:
    """Describe the rib of tapered rollers as `rib_params`; ``None`` for rollers with two like ends."""
    return rib_params(bearing, rib, lubricant, temperature) if isinstance(bearing, Bearing) else None


_RIB_FORCE = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS + OUTPUT_FORCE
_SMALLEST_ELASTIC = 1e-30


class RibContact(NamedTuple):
    """Contact of the large end: its sphere, or its rim at one point; at two where the sphere is too flat."""

    first: PointContact
    second: PointContact


@inline
def prepare_rib(body, view, zero, rib, damping):
    """Work out the rib contact before the solve, a `RibContact`; without a rib zeros that nothing uses."""
    if rib is None:
        nothing = absent_point(zero)
        return RibContact(nothing, nothing)
    return rib_contact(subtract(body.place, view.origin), body, view, rib, damping)


@inline
def rib_contact(centre, body, view, rib, damping):
    """Work out the force of the rib on the roller as a `RibContact`: sphere on cone, closed form.

    Adds the axial guidance of the rollers. The stiffness is that of the face, also on an edge of the rib or
    on the rim of the roller end, where a Hertz contact is up to a third softer.

    References
    ----------
    Hertz (1881) with the stiffness of Hamrock and Brewe (1983); the gap is exact (a sphere's distance
    to a cone is its centre's).
    """
    sphere = sphere_point(centre, body.axis, view.axis, rib, rib.window)
    return _pressed_points(sphere, centre, body, view, (rib, damping), rib.end)


@inline
def _pressed_points(sphere, centre, body, view, law, end):
    """Load the sphere where it is inside the rim, and else the rim, which is nowhere deeper in the rib."""
    along = dot(sphere.normal, body.axis)
    first = _load_point(sphere, centre, body, view, law)
    if end is None:
        return RibContact(first, absent_point(0.0 * along))
    if any_positive(where_greater(sphere.depth, 0.0, end.cosine - along, 0.0 * along)):
        deeper, other = rim_points(sphere, centre, body.axis, view.axis, law[0], end)
        first = _load_point(deeper, centre, body, view, law)
        return RibContact(first, _load_other(other, centre, body, view, law, end.both))
    return RibContact(first, absent_point(0.0 * along))


@inline
def _load_other(point, centre, body, view, law, both):
    """Load the second point of the rim where the sphere is so flat that both sides of the rim bear."""
    if both is None:
        return absent_point(0.0 * point.depth)
    return _load_point(point, centre, body, view, law)


@inline
def _load_point(point, centre, body, view, law):
    """Work out the force at one point as a `PointContact`; ``law``: `RibParams` and damping."""
    depth, normal, arm = point
    rib, damping = law
    at_arm = add(body.velocity, cross(body.omega, arm))
    slip = subtract(subtract(at_arm, view.velocity), cross(view.omega, add(centre, arm)))
    touching = at_least(depth, 0.0)
    root = sqrt(touching)
    tangent = 1.5 * rib.stiffness * root
    push = _push(touching, dot(slip, normal), damping)
    energy = 0.4 / 1.5 * tangent * touching * touching
    elastic = tangent * touching * (1.0 / 1.5)
    tangent = where_greater(push, 0.0, tangent, 0.0 * depth)
    load = tangent * push
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    spin = dot(subtract(body.omega, view.omega), normal)
    reach = spin_reach(touching, rib.drilling)
    sliding = with_spin(dot(tangential, tangential), reach, spin, rib.drilling)
    friction, film = rub(load, root, sliding, (centre, arm, normal), body, view, rib)
    return PointContact(
        centre, normal, arm, load, tangent, friction, elastic, energy, slip, reach * friction, spin, film
    )


@inline
def _push(depth, rate, damping):
    if damping is None:
        return depth * (1.0 / 1.5)
    return depth * (1.0 / 1.5) + damping.time_constant * rate


@inline
def stiffen_rib(matrix, contact, rib, p):
    """Add the implicit part of the rib contact to the roller's matrix."""
    if rib is None:
        return matrix
    return _stiffen_other(_add_rib_stiffness(matrix, contact.first, rib, p), contact.second, rib, p, rib.end)


@inline
def _stiffen_other(matrix, point, rib, p, end):
    if end is None:
        return matrix
    if end.both is None:
        return matrix
    return _add_rib_stiffness(matrix, point, rib, p)


@inline
def _add_rib_stiffness(matrix, point, rib, p):
    if not is_pressed(point):
        return matrix
    return stiffen_point(matrix, point, p.effects.damping, rib.drilling, p)


@inline
def push_rib(total, contact, rib):
    """Add the rib's wrench at the beginning of the step to that of the roller."""
    if rib is None:
        return total
    return _push_other(_push_on(total, contact.first, rib), contact.second, rib, rib.end)


@inline
def _push_other(total, point, rib, end):
    if end is None:
        return total
    if end.both is None:
        return total
    return _push_on(total, point, rib)


@inline
def _push_on(total, point, rib):
    if not is_pressed(point):
        return total
    return add_wrenches(total, push_point(point, rib.drilling))


@inline
def settle_rib(contact, change, total, here, rib, p):
    """Settle the rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return total
    first, time_constant = contact.first, damper_time(p.effects.damping)
    wrench = settle_point(first, change, here, CONE, LOSS_RIB, time_constant, rib.drilling, p)
    sliding = add_scaled(first.slip, -dot(first.slip, first.normal), first.normal)
    output = ContactOutput(wrench.force, first.arm, sqrt(dot(sliding, sliding)), first.film)
    output_contact(here.lanes, here.rollers, here.block, RIB, output)
    watch_largest(here.lanes, here.rollers, here.block, RIB, dot(output.force, output.force))
    return _settle_other(contact, change, add_wrenches(total, wrench), here, (rib, p), rib.end)


@inline
def _settle_other(contact, change, total, here, law, end):
    """Settle the second point of the rim; the output has the sum of both forces, at their mean place."""
    if end is None:
        return total
    if end.both is None:
        return total
    (rib, p), (first, second) = law, contact
    if not is_pressed(second):
        return total
    time_constant = damper_time(p.effects.damping)
    wrench = settle_point(second, change, here, CONE, LOSS_RIB, time_constant, rib.drilling, p)
    both = add_wrenches(total, wrench)
    share = second.elastic / (first.elastic + second.elastic + _SMALLEST_ELASTIC)
    arm = add_scaled(first.arm, share, subtract(second.arm, first.arm))
    sliding = add_scaled(first.slip, -dot(first.slip, first.normal), first.normal)
    force = load_vector(here.lanes, here.rollers, here.block, _RIB_FORCE)
    output = ContactOutput(add(force, wrench.force), arm, sqrt(dot(sliding, sliding)), first.film)
    output_contact(here.lanes, here.rollers, here.block, RIB, output)
    watch_largest(here.lanes, here.rollers, here.block, RIB, dot(output.force, output.force))
    return both

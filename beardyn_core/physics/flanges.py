"""Ends of cylindrical rollers on the ribs of both rings: parameters, and the contacts within a step.

A rib is that of `physics.rib`, a cone before a sphere with a rim. One at the inner end of the rollers is seen
from its own side: with the axes of roller and ring the other way round it is one at the outer end.

The output has the rib of the cone that carries most, or that of the cup where the cone has none: a roller
that passes thrust on is pressed by one of each with nearly the same load, and there is place for one of them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.kinematics import roller_cone_spin
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.rib_face import RibFace, rib_faces
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import Rib
from beardyn_core.physics.bodies.contact_output import ContactOutput, output_contact, watch_largest
from beardyn_core.physics.bodies.layout import CONE, CUP, LOSS_RIB, RIB
from beardyn_core.physics.bodies.orbit import Body, View
from beardyn_core.physics.bodies.power import SMALLEST_LOAD, squared_over
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.lanes.lane_math import at_least, exp2, log2, sqrt, where_greater
from beardyn_core.physics.lanes.vectors import add_scaled, add_wrenches, choose_vector, dot, scale, subtract
from beardyn_core.physics.point_contact import settle_point
from beardyn_core.physics.rib import (
    RibContact,
    RibParams,
    prepare_rib,
    push_rib,
    rib_contact,
    stiffen_rib,
)
from beardyn_core.physics.rib_friction import (
    rib_drilling_params,
    rib_film_params,
    rib_friction,
    rib_log2_film,
    spin_reach,
    with_spin,
)
from beardyn_core.physics.rib_gap import RibEndParams, RibWindowParams, smallest_bend

FLANGES = ("cone_outer", "cone_inner", "cup_outer", "cup_inner")


class Flange(NamedTuple):
    """One rib of a row. Rolling, the roller end slides on it with ``slip`` times the shaft speed."""

    rib: RibParams  # as seen from the side of the roller end
    inner: float | None  # ``None``: at the outer end of the rollers
    slip: float  # [m]
    spin: float  # about the normal, over the shaft speed
    surface: float  # speed of the ring against the contact, over the shaft speed [m]


class FlangeParams(NamedTuple):
    """Ribs of both rings; ``None`` is absent."""

    cone_outer: Flange | None
    cone_inner: Flange | None
    cup_outer: Flange | None
    cup_inner: Flange | None


def flange_params(
    bearing: RollerBearing, rib: Rib | None, lubricant: Lubricant, temperature: float
) -> FlangeParams | None:
    """Describe the ribs of a cylindrical roller bearing, mounted with its end play; ``None`` for others.

    Parameters
    ----------
    temperature : float
        Of the lubricant at the inlet, [K].
    """
    if rib is None or not isinstance(bearing, CylindricalBearing):
        return None
    faces = {f"{face.ring}_{'outer' if face.side > 0.0 else 'inner'}": face for face in rib_faces(bearing)}
    made = {name: _flange(bearing, face, rib, lubricant, temperature) for name, face in faces.items()}
    return FlangeParams(*(made.get(name) for name in FLANGES))


def _flange(
    bearing: CylindricalBearing, face: RibFace, rib: Rib, lubricant: Lubricant, temperature: float
) -> Flange:
    normal_axial, normal_radial = math.cos(face.lean), math.sin(face.lean)
    centre_radial, centre_axial = face.sphere_place[0], face.side * face.sphere_place[1]
    law = face.contact  # exact whatever the options are: the ellipse is nearly a circle, where the fit is off
    nominal = centre_radial * normal_axial - centre_axial * normal_radial
    shape = RibParams(
        stiffness=law.factor,
        sphere_radius=face.sphere_radius,
        sphere_place=face.side * face.sphere_centre,
        normal_axial=normal_axial,
        normal_radial=normal_radial,
        distance=centre_axial * normal_axial + centre_radial * normal_radial + face.sphere_radius + face.gap,
        friction=rib.friction,
        regularisation=rib.regularisation_speed,
        window=_window(face, nominal, rib),
        end=_end(bearing, face) if rib.roller_end else None,
        film=rib_film_params(bearing.rib_roughness, rib, lubricant, temperature, law, law),
        drilling=rib_drilling_params(rib, law),
    )
    radius = centre_radial + face.sphere_radius * normal_radial
    if face.ring == "cone":
        turning, surface = roller_cone_spin(bearing, 1.0), (1.0 - bearing.cage_ratio) * radius
    else:
        turning, surface = bearing.cone_radius / bearing.roller_diameter, bearing.cage_ratio * radius
    return Flange(
        rib=shape,
        inner=None if face.side > 0.0 else 1.0,
        slip=turning * bearing.rib_contact_height,
        spin=turning * normal_axial,
        surface=surface,
    )


def _window(face: RibFace, nominal: float, rib: Rib) -> RibWindowParams | None:
    if not rib.window:
        return None
    low, high = (nominal + edge for edge in face.edges)
    rounding = min(rib.edge_radius, 0.5 * (high - low))
    return RibWindowParams(low + rounding, high - rounding, rounding)


def _end(bearing: CylindricalBearing, face: RibFace) -> RibEndParams:
    radius = bearing.large_end_radius - bearing.roller_chamfer
    ahead = math.sqrt(face.sphere_radius**2 - radius**2)
    return RibEndParams(
        radius=radius,
        place=face.side * face.sphere_centre + ahead,
        cosine=ahead / face.sphere_radius,
        smallest_bend=smallest_bend(bearing.rib_opening),
        both=None,
    )


class FlangeContacts(NamedTuple):
    """Contacts of a roller with all ribs."""

    cone_outer: RibContact
    cone_inner: RibContact
    cup_outer: RibContact
    cup_inner: RibContact


@inline
def _prepare(body, view, zero, flange, damping):
    if flange is None:
        return prepare_rib(body, view, zero, None, damping)
    return rib_contact(
        subtract(body.place, view.origin),
        _body_from_side(body, flange.inner),
        _view_from_side(view, flange.inner),
        flange.rib,
        damping,
    )


@inline
def _body_from_side(body, inner):
    """Turn axis and sense of the orbit round for a rib at the inner end."""
    if inner is None:
        return body
    return Body(body.place, scale(-1.0, body.axis), body.velocity, body.omega, -body.orbit_rate)


@inline
def _view_from_side(view, inner):
    if inner is None:
        return view
    return View(view.origin, scale(-1.0, view.axis), view.velocity, view.omega)


@inline
def prepare_flanges(body, cup_view, cone_view, zero, flanges, damping):
    """Work out the contacts with all ribs before the solve, `FlangeContacts`; zeros without ribs."""
    if flanges is None:
        nothing = prepare_rib(body, cone_view, zero, None, damping)
        return FlangeContacts(nothing, nothing, nothing, nothing)
    return FlangeContacts(
        _prepare(body, cone_view, zero, flanges.cone_outer, damping),
        _prepare(body, cone_view, zero, flanges.cone_inner, damping),
        _prepare(body, cup_view, zero, flanges.cup_outer, damping),
        _prepare(body, cup_view, zero, flanges.cup_inner, damping),
    )


@inline
def _shape(flange):
    if flange is None:
        return None
    return flange.rib


@inline
def stiffen_flanges(matrix, contacts, flanges, p):
    """Add the implicit part of all rib contacts to the roller's matrix."""
    if flanges is None:
        return matrix
    matrix = stiffen_rib(matrix, contacts.cone_outer, _shape(flanges.cone_outer), p)
    matrix = stiffen_rib(matrix, contacts.cone_inner, _shape(flanges.cone_inner), p)
    matrix = stiffen_rib(matrix, contacts.cup_outer, _shape(flanges.cup_outer), p)
    return stiffen_rib(matrix, contacts.cup_inner, _shape(flanges.cup_inner), p)


@inline
def push_flanges(total, contacts, flanges):
    """Add the wrenches of all ribs at the beginning of the step to that of the roller."""
    if flanges is None:
        return total
    total = push_rib(total, contacts.cone_outer, _shape(flanges.cone_outer))
    total = push_rib(total, contacts.cone_inner, _shape(flanges.cone_inner))
    total = push_rib(total, contacts.cup_outer, _shape(flanges.cup_outer))
    return push_rib(total, contacts.cup_inner, _shape(flanges.cup_inner))


@inline
def settle_flanges(contacts, change, total, here, flanges, p):
    """Settle all rib contacts after the solve and add their wrenches to the roller's."""
    if flanges is None:
        return total
    zero = 0.0 * change.velocity[0]
    nothing = (zero, zero, zero)
    most = ContactOutput(nothing, nothing, zero, zero)
    total, most = _settle(contacts.cone_outer, change, total, most, here, CONE, flanges.cone_outer, p)
    total, most = _settle(contacts.cone_inner, change, total, most, here, CONE, flanges.cone_inner, p)
    total, of_cup = _settle(contacts.cup_outer, change, total, most, here, CUP, flanges.cup_outer, p)
    total, of_cup = _settle(contacts.cup_inner, change, total, of_cup, here, CUP, flanges.cup_inner, p)
    most = of_output(most, of_cup, flanges.cone_outer, flanges.cone_inner)
    output_contact(here.lanes, here.rollers, here.block, RIB, most)
    watch_largest(here.lanes, here.rollers, here.block, RIB, dot(most.force, most.force))
    return total


@inline
def of_output(of_cone, of_cup, cone_outer, cone_inner):
    """Take what the output has: of the cone, and of the cup where both ribs of the cone are ``None``."""
    if cone_outer is None:
        if cone_inner is None:
            return of_cup
    return of_cone


@inline
def _settle(contact, change, total, most, here, ring, flange, p):
    if flange is None:
        return total, most
    point, time_constant = contact.first, damper_time(p.effects.damping)
    wrench = settle_point(point, change, here, ring, LOSS_RIB, time_constant, flange.rib.drilling, p)
    sliding = add_scaled(point.slip, -dot(point.slip, point.normal), point.normal)
    here_load, most_load = dot(wrench.force, wrench.force), dot(most.force, most.force)
    kept = ContactOutput(
        choose_vector(here_load, most_load, wrench.force, most.force),
        choose_vector(here_load, most_load, point.arm, most.arm),
        where_greater(here_load, most_load, sqrt(dot(sliding, sliding)), most.slip),
        where_greater(here_load, most_load, point.film, most.film),
    )
    return add_wrenches(total, wrench), kept


@inline
def flange_torque(load, speed, flange):
    """Work out the torque of roller ends that slide on one rib in pure rolling, along the rotation, [N m].

    ``load``: on the rib [N]; ``speed``: of the shaft [rad/s]. See `rib_friction.sliding_torque`.
    """
    rib = flange.rib
    slip, spin = flange.slip * speed, flange.spin * speed
    root = exp2((1.0 / 3.0) * log2(at_least(load, SMALLEST_LOAD) * (1.0 / rib.stiffness)))
    squared = with_spin(slip * slip, spin_reach(root * root, rib.drilling), spin, rib.drilling)
    log2_film = rib_log2_film(load, flange.surface * speed - 0.5 * slip, rib.film)
    friction = rib_friction(load, root, squared, log2_film, rib, rib.film)
    return friction * squared_over(squared, speed)

"""Large roller end on its rib: parameters, where a sphere meets the cone of a rib, its film and friction."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing import contact_law
from beardyn_core.bearing.contact_law import SPIN_SHARE, exact_rib_contact
from beardyn_core.bearing.film_thickness import LOAD_EXPONENT, SPEED_EXPONENT, log2_rib_film_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import Rib, RibShearedFilm
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    load_vector,
    output_contact,
    watch_largest,
)
from beardyn_core.physics.bodies.layout import CONTACT_OUTPUT, LOSS_RIB, OUTPUT_FIELDS, OUTPUT_FORCE, RIB
from beardyn_core.physics.bodies.power import SMALLEST_LOAD, squared_over
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.film import asperity_share
from beardyn_core.physics.lanes.lane_math import (
    LOG2_E,
    at_least,
    at_most,
    exp2,
    log2,
    magnitude,
    sqrt,
    where_greater,
)
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import (
    Vector,
    add,
    add_scaled,
    add_wrenches,
    choose_vector,
    cross,
    dot,
    scale,
    subtract,
)
from beardyn_core.physics.point_contact import (
    PointContact,
    absent_point,
    is_pressed,
    push_point,
    settle_point,
    stiffen_point,
)


class RibWindowParams(NamedTuple):
    """Edges of the rib face."""

    low: float  # coordinate along the generator of the face [m]
    high: float
    rounding: float  # radius of the edges [m]


class RibEndParams(NamedTuple):
    """Rim of the spherical roller end."""

    radius: float  # [m]
    place: float  # on the axis from the centre of mass [m]
    cosine: float  # of the angle under which the sphere's centre sees it
    smallest_bend: float  # floor of the second derivative in the search along the rim
    both: float | None  # whether both sides of the rim bear: the sphere is too flat for its apex distance


class RibShearParams(NamedTuple):
    """Film that shears up to a limit."""

    viscosity: float  # [Pa s]
    pressure_viscosity: float  # [1/Pa]
    limiting_shear: float
    pressure: float  # mean pressure over the root of the approach [Pa/m^0.5]


class RibFilmParams(NamedTuple):
    """Point-contact film of the rib and the friction that goes with it."""

    log2_factor: float  # film thickness at 1 N and 1 m/s [log2 m]
    speed_exponent: float
    load_exponent: float
    log2_roughness: float  # composite rms [log2 m]
    boundary_friction: float
    film_friction: float
    sheared: RibShearParams | None


class RibDrillingParams(NamedTuple):
    """Friction of the spin inside the contact ellipse."""

    reach: float  # 0.18 a^2 over the approach [m]


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


# Floor of the second derivative in the search along the rim, as part of the sine of the rib's polar angle.
_SMALLEST_BEND = 0.01


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
        window=_window(bearing, nominal, rib),
        end=_roller_end(bearing) if rib.roller_end else None,
        film=_film(bearing, rib, lubricant, temperature, contact),
        drilling=RibDrillingParams(SPIN_SHARE * _around_squared(contact)) if rib.drilling else None,
    )


def _window(bearing: Bearing, nominal: float, rib: Rib) -> RibWindowParams | None:
    """Lay the edges of the face on its generator; rounding takes at most the whole face."""
    if not rib.window:
        return None
    low, high = (nominal + edge for edge in bearing.rib_face)
    rounding = min(rib.edge_radius, 0.5 * (high - low))
    return RibWindowParams(low + rounding, high - rounding, rounding)


def _roller_end(bearing: Bearing) -> RibEndParams:
    """Work out the rim where the spherical face of the roller end meets the chamfer."""
    radius = bearing.large_end_radius - bearing.roller_chamfer
    ahead = math.sqrt(bearing.sphere_radius**2 - radius**2)
    return RibEndParams(
        radius=radius,
        place=bearing.sphere_centre - bearing.roller_mass_offset + ahead,
        cosine=ahead / bearing.sphere_radius,
        smallest_bend=_SMALLEST_BEND * math.sin(bearing.rib_polar_angle),
        both=1.0 if bearing.sphere_ratio >= 1.0 else None,
    )


def _film(
    bearing: Bearing, rib: Rib, lubricant: Lubricant, temperature: float, contact: contact_law.PointContact
) -> RibFilmParams | None:
    """Work out film thickness at the temperature of the inlet, and its friction."""
    lubrication = rib.lubrication
    if lubrication is None:
        return None
    viscosity = lubricant.dynamic_viscosity(temperature)
    pressure_viscosity = lubricant.pressure_viscosity_at(temperature)
    sheared = None
    if isinstance(lubrication, RibShearedFilm):
        larger, smaller = contact.semi_axes(1.0)
        approach = contact.factor ** (-2.0 / 3.0)
        pressure = 1.0 / (math.pi * larger * smaller) / math.sqrt(approach)
        sheared = RibShearParams(viscosity, pressure_viscosity, lubrication.limiting_shear, pressure)
    return RibFilmParams(
        log2_factor=log2_rib_film_factor(bearing, viscosity, pressure_viscosity, lubrication.starvation),
        speed_exponent=SPEED_EXPONENT,
        load_exponent=LOAD_EXPONENT,
        log2_roughness=math.log2(bearing.rib_roughness),
        boundary_friction=lubrication.boundary_friction,
        film_friction=0.0 if isinstance(lubrication, RibShearedFilm) else lubrication.film_friction,
        sheared=sheared,
    )


def _around_squared(contact: contact_law.PointContact) -> float:
    """Compute the square of the ellipse's semi-axis around the ring over the approach, [m]."""
    larger, _ = contact.semi_axes(1.0)
    return float(larger**2 * contact.factor ** (2.0 / 3.0))


_LARGEST_TURN = 0.4
_RIM_STEPS = 5
# Cosine of the least turn from the meridian plane at which the search along the rim begins.
_STEEPEST_START = 0.95
# Two points of the rim are the same one up to 1 - cosine = 1/50 between them (11 degrees), and two from twice
# that on; between, the second is taken out of the rib by a part of 0.1 mm.
_BOTH_APART, _FADE = 50.0, 1e-4
# Keeps the direction of a sphere centred on the ring axis finite; far below any distance that occurs.
_AXIS_FLOOR = 1e-30


class RibPoint(NamedTuple):
    """Where the large end is nearest to the rib."""

    depth: Any  # penetration [m]
    normal: Vector  # unit, into the rib
    arm: Vector  # from the roller's centre of mass [m]


@inline
def rib_gap(centre, axis, ring_axis, rib, window, end):
    """Work out where the large end is nearest to the rib, a `RibPoint`; of two points of the rim the deeper.

    The rib face is a cone between two circles: the undercut below and the rib's outer corner above. The
    nearest point of that face from the sphere's centre has its coordinate along the generator clamped to the
    face, so the distance is exact and its gradient continuous from the face over the edge: the force is
    conservative. The roller end is a sphere only inside its rim; beyond it the rim circle carries, on the
    cone of the face without its edges.

    Parameters
    ----------
    window : RibWindowParams or None
        Edges of the rib face; without it the face is an unlimited cone.
    end : RibEndParams or None
        Rim of the roller end; without it the end is a whole sphere.
    """
    sphere = sphere_point(centre, axis, ring_axis, rib, window)
    if end is None:
        return sphere
    if not any_positive(end.cosine - dot(sphere.normal, axis)):
        return sphere
    return rim_points(sphere, centre, axis, ring_axis, rib, end)[0]


@inline
def sphere_point(centre, axis, ring_axis, rib, window):
    """Work out where the whole sphere is nearest to the face of the rib."""
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = add_scaled(place, -along, ring_axis)
    distance = sqrt(dot(across, across) + _AXIS_FLOOR)
    outward = scale(1.0 / distance, across)
    depth = along * rib.normal_axial + distance * rib.normal_radial + rib.sphere_radius - rib.distance
    depth, normal_axial, normal_radial = _on_the_face(depth, along, distance, rib, window)
    normal = add_scaled(scale(normal_axial, ring_axis), normal_radial, outward)
    return RibPoint(depth, normal, add_scaled(sphere, rib.sphere_radius, normal))


@inline
def _on_the_face(depth, along, distance, rib, window):
    """Keep the nearest point on the face: depth and normal; a rounded edge is a torus."""
    if window is None:
        return depth, rib.normal_axial, rib.normal_radial
    height = distance * rib.normal_axial - along * rib.normal_radial
    beyond = height - at_most(at_least(height, window.low), window.high)
    if not any_positive(magnitude(beyond)):
        still = 0.0 * depth  # a NaN stays one
        return depth, rib.normal_axial + still, rib.normal_radial + still
    ahead = rib.sphere_radius + window.rounding - depth
    reach = sqrt(ahead * ahead + beyond * beyond)
    # reach - ahead, without the difference of two nearly equal lengths
    depth = depth - beyond * beyond / (reach + ahead)
    cosine, sine = ahead / reach, beyond / reach
    normal_axial = cosine * rib.normal_axial + sine * rib.normal_radial
    normal_radial = cosine * rib.normal_radial - sine * rib.normal_axial
    return depth, normal_axial, normal_radial


@inline
def rim_points(sphere, centre, axis, ring_axis, rib, end):
    """Work out where the rim of the roller end is deepest behind the cone of the rib: two `RibPoint`.

    A sphere within the apex distance is the deeper the nearer to its one deepest point, also on the rim: only
    the deeper point bears. A larger one is flatter around the ring than the rib and bears on both sides.

    Over the turn t from the meridian plane the depth is g cos t + h sin t + q sin^2 t, q being half of what
    the cone recedes at the side of the rim: with the lean g of the rim small against it there is one deepest
    point on each side, with a large one a single point in the plane. The search begins on both sides. The
    deeper point comes first; the other is far outside the rib where it is the same one, and both where the
    sphere is inside its rim.

    Parameters
    ----------
    sphere : RibPoint
        Of the whole sphere, which stays where it is inside the rim.
    """
    middle = add_scaled(centre, end.place, axis)
    across = add_scaled(middle, -dot(middle, ring_axis), ring_axis)
    upright = add_scaled(across, -dot(across, axis), axis)
    upright = scale(1.0 / sqrt(dot(upright, upright)), upright)
    aside = cross(axis, upright)
    distance = sqrt(dot(across, across))
    lean = rib.normal_axial * dot(upright, ring_axis) + rib.normal_radial * dot(upright, across) / distance
    cosine = lean * distance / (magnitude(rib.normal_radial) * end.radius)
    cosine = at_most(at_least(cosine, -_STEEPEST_START), _STEEPEST_START)
    sine = sqrt(1.0 - cosine * cosine)
    ahead = add_scaled(scale(cosine, upright), sine, aside)
    behind = add_scaled(scale(cosine, upright), -1.0 * sine, aside)
    for _ in range(_RIM_STEPS):
        ahead = _deeper(ahead, middle, axis, ring_axis, rib, end)
        behind = _deeper(behind, middle, axis, ring_axis, rib, end)
    one = _rim_point(ahead, middle, centre, ring_axis, rib, end)
    two = _rim_point(behind, middle, centre, ring_axis, rib, end)
    deeper = _choose(two.depth, one.depth, two, one)
    other = _choose(two.depth, one.depth, one, two)
    apart = _BOTH_APART * (1.0 - dot(ahead, behind)) - 1.0
    fade = _FADE * at_most(at_least(1.0 - apart, 0.0), 1.0)
    along = dot(sphere.normal, axis)
    outside = where_greater(end.cosine, along, other.depth - fade, -_FADE + 0.0 * along)
    return _choose(end.cosine, along, deeper, sphere), RibPoint(outside, other.normal, other.arm)


@inline
def _choose(a, b, first, second):
    """Take the first point where ``a`` is greater than ``b``, else the second."""
    return RibPoint(
        where_greater(a, b, first.depth, second.depth),
        choose_vector(a, b, first.normal, second.normal),
        choose_vector(a, b, first.arm, second.arm),
    )


@inline
def _rim_point(radial, middle, centre, ring_axis, rib, end):
    """Work out the `RibPoint` of the rim in one direction from the roller's axis."""
    point = add_scaled(middle, end.radius, radial)
    height = dot(point, ring_axis)
    across = add_scaled(point, -height, ring_axis)
    distance = sqrt(dot(across, across))
    depth = height * rib.normal_axial + distance * rib.normal_radial - rib.distance
    normal = add_scaled(scale(rib.normal_axial, ring_axis), rib.normal_radial / distance, across)
    return RibPoint(depth, normal, subtract(point, centre))


@inline
def _deeper(radial, middle, axis, ring_axis, rib, end):
    """Take one safeguarded Newton step along the rim towards its deepest point behind the cone."""
    ahead = cross(axis, radial)
    point = add_scaled(middle, end.radius, radial)
    across = add_scaled(point, -dot(point, ring_axis), ring_axis)
    curvature = 1.0 / sqrt(dot(across, across))
    outward = scale(curvature, across)
    slope = rib.normal_axial * dot(ahead, ring_axis) + rib.normal_radial * dot(ahead, outward)
    lean = rib.normal_axial * dot(radial, ring_axis) + rib.normal_radial * dot(radial, outward)
    sideways = 1.0 - dot(ahead, ring_axis) * dot(ahead, ring_axis) - dot(ahead, outward) * dot(ahead, outward)
    bend = lean - rib.normal_radial * end.radius * curvature * sideways
    turn = at_most(at_least(slope / at_least(bend, end.smallest_bend), -_LARGEST_TURN), _LARGEST_TURN)
    return scale(1.0 / sqrt(1.0 + turn * turn), add_scaled(radial, turn, ahead))


_RIB_FORCE = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS + OUTPUT_FORCE
_SMALLEST_ELASTIC = 1e-30

_LARGEST_LOG2_THICKENING = 30.0


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
def rub(load, root, sliding, place, body, view, rib):
    """Work out friction over slip speed and film thickness; nothing where no roller is pressed."""
    if not any_positive(load):
        return 0.0 * load, 0.0 * load  # a NaN stays one
    centre, arm, normal = place
    log2_film = rib_log2_film(load, _rib_entrainment(centre, arm, normal, body, view, rib.film), rib.film)
    friction = rib_friction(load, root, sliding, log2_film, rib, rib.film)
    return friction, _film_output(load, log2_film, rib.film)


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
    wrench = settle_point(first, change, here, LOSS_RIB, time_constant, rib.drilling, p)
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
    wrench = settle_point(second, change, here, LOSS_RIB, time_constant, rib.drilling, p)
    both = add_wrenches(total, wrench)
    share = second.elastic / (first.elastic + second.elastic + _SMALLEST_ELASTIC)
    arm = add_scaled(first.arm, share, subtract(second.arm, first.arm))
    sliding = add_scaled(first.slip, -dot(first.slip, first.normal), first.normal)
    force = load_vector(here.lanes, here.rollers, here.block, _RIB_FORCE)
    output = ContactOutput(add(force, wrench.force), arm, sqrt(dot(sliding, sliding)), first.film)
    output_contact(here.lanes, here.rollers, here.block, RIB, output)
    watch_largest(here.lanes, here.rollers, here.block, RIB, dot(output.force, output.force))
    return both


# --- film and friction


@inline
def _rib_entrainment(centre, arm, normal, body, view, film):
    """Work out the mean surface speed of roller end and rib against the contact, which orbits, [m/s]."""
    if film is None:
        return 0.0
    around = cross(view.axis, normal)
    around = scale(1.0 / sqrt(dot(around, around)), around)
    point = add(centre, arm)
    cone = dot(add(view.velocity, cross(view.omega, point)), around)
    roller = dot(add(body.velocity, cross(body.omega, arm)), around)
    contact = dot(view.velocity, around) + body.orbit_rate * dot(cross(view.axis, point), around)
    return 0.5 * (cone + roller) - contact


@inline
def rib_log2_film(load, speed, film):
    """Take the binary logarithm of the central film thickness, [log2 m]; loads below 1 mN count as 1 mN.

    References
    ----------
    Hamrock and Dowson (1977), see `bearing.film_thickness`.
    """
    if film is None:
        return 0.0
    return (
        film.log2_factor
        + film.speed_exponent * log2(magnitude(speed) + 1e-3)
        + film.load_exponent * log2(at_least(load, 1e-3))
    )


@inline
def _film_output(load, log2_film, film):
    """Take the film thickness of a loaded rib contact, [m]; 0 without a film or load."""
    if film is None:
        return 0.0 * load
    thickness = exp2(log2_film)
    return where_greater(load, 0.0, thickness, 0.0 * thickness)


@inline
def rib_friction(load, root_depth, speed_squared, log2_film, rib, film):
    """Work out friction over slip speed, [N s/m]: dry, or shared by asperities and film.

    The film carries the share 1 - exp(-1.8 Lambda^1.2) of the load. Neglects heating of the film.

    References
    ----------
    Zhao et al. (2026) for the load sharing at the rib.
    """
    dry = load / sqrt(speed_squared + rib.regularisation * rib.regularisation)
    if film is None:
        return rib.friction * dry
    asperities = asperity_share(log2_film - film.log2_roughness)
    wet = _film_friction(load, root_depth, speed_squared, dry, log2_film, film, film.sheared)
    return wet + (film.boundary_friction * dry - wet) * asperities


@inline
def _film_friction(load, root_depth, speed_squared, dry, log2_film, film, sheared):
    """Shear the film: constant coefficient, or Newtonian at mean Hertz pressure up to a limiting stress."""
    if sheared is None:
        return film.film_friction * dry
    pressure = sheared.pressure * root_depth
    thickening = at_most(pressure * (sheared.pressure_viscosity * LOG2_E), _LARGEST_LOG2_THICKENING)
    shear = sheared.viscosity * exp2(thickening - log2_film)
    limit = sheared.limiting_shear * pressure
    # load / pressure is the area; 1e-30 keeps an unloaded contact at zero friction, not 0/0
    return load * sheared.limiting_shear * shear / sqrt(limit * limit + shear * shear * speed_squared + 1e-30)


@inline
def spin_reach(touching, drilling):
    """Square the radius at which spin about the normal counts as slip, 0.18 a^2, [m^2].

    A Hertz ellipse that slides with u and spins with w dissipates mu Q sqrt(u^2 + 0.18 a^2 w^2) to good
    approximation, a being its half axis along the slip's normal; a^2 grows with the approach.

    References
    ----------
    Zhao et al. (2026): T = mu Q h sqrt(1 + 0.18 (a/h)^2), there with u = w h.
    """
    if drilling is None:
        return 0.0 * touching
    return drilling.reach * touching


@inline
def with_spin(sliding, reach, spin, drilling):
    """Add the square of the spin's speed to that of the slip, [m^2/s^2]."""
    if drilling is None:
        return sliding
    return sliding + reach * spin * spin


@inline
def sliding_torque(load, speeds, k, cone, rib):
    """Work out the torque of large ends that slide on their ribs, along the shaft's rotation, [N m].

    The contact is taken in the roller's meridian plane at its nominal height. ``cone``: sine and cosine of
    its raceway.
    """
    if rib is None:
        return 0.0 * load
    slip = k.rib_slip * speeds[0]
    radius = k.radius + rib.sphere_place * k.axis_radial + rib.sphere_radius * rib.normal_radial
    entrainment = (speeds[0] - speeds[1]) * radius - 0.5 * slip
    # load = K depth^1.5
    root = exp2((1.0 / 3.0) * log2(at_least(load, SMALLEST_LOAD) * (1.0 / rib.stiffness)))
    along = cone.sine * rib.normal_radial + cone.cosine * rib.normal_axial
    spin = k.rib_spin * along * speeds[0]
    squared = with_spin(slip * slip, spin_reach(root * root, rib.drilling), spin, rib.drilling)
    log2_film = rib_log2_film(load, entrainment, rib.film)
    friction = rib_friction(load, root, squared, log2_film, rib, rib.film)
    return friction * squared_over(squared, speeds[0])

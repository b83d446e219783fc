"""Contact of the spherical large roller end with the conical cone rib: prepare, stiffen, push, settle."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.kernels import point_contact
from beardyn_core.kernels.exchange import (
    ContactOutput,
    damper_time,
    load_vector,
    output_contact,
    watch_largest,
)
from beardyn_core.kernels.lane_math import (
    LOG2_E,
    at_least,
    at_most,
    exp2,
    log2,
    magnitude,
    sqrt,
    where_greater,
)
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.large_end import rim_points, sphere_point
from beardyn_core.kernels.vectors import (
    add,
    add_scaled,
    add_wrenches,
    cross,
    dot,
    scale,
    subtract,
)
from beardyn_core.model.layout import CONTACT_OUTPUT, LOSS_RIB, OUTPUT_FIELDS, OUTPUT_FORCE, RIB

_RIB_FORCE = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS + OUTPUT_FORCE
_SMALLEST_LOAD = 1e-30

_SHARE_FACTOR = -1.8 * LOG2_E
_SHARE_EXPONENT = 1.2
_LARGEST_LOG2_THICKENING = 30.0


class RibContact(NamedTuple):
    """Contact of the large end: its sphere, or its rim at one point; at two where the sphere is too flat."""

    first: Any  # `PointContact`
    second: Any


@inline
def prepare_rib(body, view, zero, rib, damping):
    """Work out the rib contact before the solve, a `RibContact`; without a rib zeros that nothing uses."""
    if rib is None:
        nothing = point_contact.absent_point(zero)
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
        return RibContact(first, point_contact.absent_point(0.0 * along))
    if any_positive(where_greater(sphere.depth, 0.0, end.cosine - along, 0.0 * along)):
        deeper, other = rim_points(sphere, centre, body.axis, view.axis, law[0], end)
        first = _load_point(deeper, centre, body, view, law)
        return RibContact(first, _load_other(other, centre, body, view, law, end.both))
    return RibContact(first, point_contact.absent_point(0.0 * along))


@inline
def _load_other(point, centre, body, view, law, both):
    """Load the second point of the rim where the sphere is so flat that both sides of the rim bear."""
    if both is None:
        return point_contact.absent_point(0.0 * point.depth)
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
    friction, film = _rub(load, root, sliding, (centre, arm, normal), body, view, rib)
    return point_contact.PointContact(
        centre, normal, arm, load, tangent, friction, elastic, energy, slip, reach * friction, spin, film
    )


@inline
def _push(depth, rate, damping):
    if damping is None:
        return depth * (1.0 / 1.5)
    return depth * (1.0 / 1.5) + damping.time_constant * rate


@inline
def _rub(load, root, sliding, place, body, view, rib):
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
    return _stiffen_other(_stiffen(matrix, contact.first, rib, p), contact.second, rib, p, rib.end)


@inline
def _stiffen_other(matrix, point, rib, p, end):
    if end is None:
        return matrix
    if end.both is None:
        return matrix
    return _stiffen(matrix, point, rib, p)


@inline
def _stiffen(matrix, point, rib, p):
    if not point_contact.is_pressed(point):
        return matrix
    return point_contact.stiffen_point(matrix, point, p.effects.damping, rib.drilling, p)


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
    if not point_contact.is_pressed(point):
        return total
    return add_wrenches(total, point_contact.push_point(point, rib.drilling))


@inline
def settle_rib(contact, change, total, here, rib, p):
    """Settle the rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return total
    first, time_constant = contact.first, damper_time(p.effects.damping)
    wrench = point_contact.settle_point(first, change, here, LOSS_RIB, time_constant, rib.drilling, p)
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
    if not point_contact.is_pressed(second):
        return total
    time_constant = damper_time(p.effects.damping)
    wrench = point_contact.settle_point(second, change, here, LOSS_RIB, time_constant, rib.drilling, p)
    both = add_wrenches(total, wrench)
    share = second.elastic / (first.elastic + second.elastic + _SMALLEST_LOAD)
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
    lambda_power = exp2(_SHARE_EXPONENT * (log2_film - film.log2_roughness))
    asperities = exp2(_SHARE_FACTOR * lambda_power)
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

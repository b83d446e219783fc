"""Contact of the spherical large roller end with the conical cone rib: prepare, stiffen, push, settle."""

from __future__ import annotations

from beardyn_core.jit import inline
from beardyn_core.kernels import point_contact
from beardyn_core.kernels.exchange import ContactOutput, damper_time, output_contact
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
from beardyn_core.kernels.vectors import (
    add,
    add_scaled,
    add_wrenches,
    choose_vector,
    cross,
    dot,
    scale,
    subtract,
)
from beardyn_core.model.layout import LOSS_RIB, RIB

_LARGEST_TURN = 0.4
# Keeps the direction of a sphere centred on the ring axis finite; far below any distance that occurs.
_AXIS_FLOOR = 1e-30
_SHARE_FACTOR = -1.8 * LOG2_E
_SHARE_EXPONENT = 1.2
_LARGEST_LOG2_THICKENING = 30.0


@inline
def prepare_rib(body, view, zero, rib, damping):
    """Work out the rib contact before the solve, a `PointContact`; without a rib zeros that nothing uses."""
    if rib is None:
        return point_contact.absent_point(zero)
    return rib_contact(subtract(body.place, view.origin), body, view, rib, damping)


@inline
def rib_contact(centre, body, view, rib, damping):
    """Work out the force of the rib on the roller as a `PointContact`: sphere on cone, closed form.

    Adds the axial guidance of the rollers. The stiffness is that of the face, also on an edge of the rib or
    on the rim of the roller end, where a Hertz contact is up to a third softer.

    References
    ----------
    Hertz (1881) with the stiffness of Hamrock and Brewe (1983); the gap is exact (a sphere's distance
    to a cone is its centre's).
    """
    depth, normal, arm = rib_gap(centre, body.axis, view.axis, rib, rib.window, rib.end)
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
    if not point_contact.is_pressed(contact):
        return matrix
    return point_contact.stiffen_point(matrix, contact, p.effects.damping, rib.drilling, p)


@inline
def push_rib(total, contact, rib):
    """Add the rib's wrench at the beginning of the step to that of the roller."""
    if rib is None:
        return total
    if not point_contact.is_pressed(contact):
        return total
    return add_wrenches(total, point_contact.push_point(contact, rib.drilling))


@inline
def settle_rib(contact, change, total, here, rib, p):
    """Settle the rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return total
    time_constant = damper_time(p.effects.damping)
    wrench = point_contact.settle_point(contact, change, here, LOSS_RIB, time_constant, rib.drilling, p)
    sliding = add_scaled(contact.slip, -dot(contact.slip, contact.normal), contact.normal)
    output = ContactOutput(wrench.force, contact.arm, sqrt(dot(sliding, sliding)), contact.film)
    output_contact(here.lanes, here.rollers, here.block, RIB, output)
    return add_wrenches(total, wrench)


# --- where the large end meets the rib: sphere, rib face with its edges, rim of the roller end


@inline
def rib_gap(centre, axis, ring_axis, rib, window, end):
    """Work out penetration, normal and place of the rib contact.

    The rib face is a cone between two circles: the undercut below and the rib's outer corner above. The
    nearest point of that face from the sphere's centre has its coordinate along the generator clamped to the
    face, so the distance is exact and its gradient continuous from the face over the edge: the force is
    conservative. The roller end is a sphere only inside its rim; beyond it the deepest point of the rim
    circle carries.

    Parameters
    ----------
    window : RibWindowParams or None
        Edges of the rib face; without it the face is an unlimited cone.
    end : RibEndParams or None
        Rim of the roller end; without it the end is a whole sphere.

    Returns
    -------
    depth : lane value
        [m].
    normal, arm : vector
        Unit normal into the rib; contact from the roller's centre of mass, [m].
    """
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = add_scaled(place, -along, ring_axis)
    distance = sqrt(dot(across, across) + _AXIS_FLOOR)
    outward = scale(1.0 / distance, across)
    depth = along * rib.normal_axial + distance * rib.normal_radial + rib.sphere_radius - rib.distance
    depth, normal_axial, normal_radial = _on_the_face(depth, along, distance, rib, window)
    normal = add_scaled(scale(normal_axial, ring_axis), normal_radial, outward)
    arm = add_scaled(sphere, rib.sphere_radius, normal)
    return _within_the_rim(depth, normal, arm, centre, axis, ring_axis, rib, end)


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
def _within_the_rim(depth, normal, arm, centre, axis, ring_axis, rib, end):
    """Take the contact of the rim circle where the sphere's lies beyond the rim of the roller end."""
    if end is None:
        return depth, normal, arm
    along = dot(normal, axis)
    if not any_positive(end.cosine - along):
        return depth, normal, arm
    radial = add_scaled(normal, -along, axis)
    radial = scale(1.0 / sqrt(dot(radial, radial) + _AXIS_FLOOR), radial)
    middle = add_scaled(centre, end.place, axis)
    for _ in range(3):
        radial = _deeper(radial, middle, axis, ring_axis, rib, end)
    rim = scale(end.radius, radial)
    point = add(middle, rim)
    height = dot(point, ring_axis)
    across = add_scaled(point, -height, ring_axis)
    distance = sqrt(dot(across, across))
    rim_depth = height * rib.normal_axial + distance * rib.normal_radial - rib.distance
    rim_normal = add_scaled(scale(rib.normal_axial, ring_axis), rib.normal_radial / distance, across)
    rim_arm = subtract(point, centre)
    return (
        where_greater(end.cosine, along, rim_depth, depth),
        choose_vector(end.cosine, along, rim_normal, normal),
        choose_vector(end.cosine, along, rim_arm, arm),
    )


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

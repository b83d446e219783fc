"""Film and friction of the large roller end on its rib, the spin in the contact included."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.contact_law import SPIN_SHARE, PointContact
from beardyn_core.bearing.film_thickness import LOAD_EXPONENT, SPEED_EXPONENT, log2_point_film_factor
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import Rib, RibShearedFilm
from beardyn_core.physics.bodies.power import SMALLEST_LOAD, squared_over
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
from beardyn_core.physics.lanes.vectors import add, cross, dot, scale

_LARGEST_LOG2_THICKENING = 30.0


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


def rib_film_params(
    roughness: float,
    rib: Rib,
    lubricant: Lubricant,
    temperature: float,
    contact: PointContact,
    fitted: PointContact,
) -> RibFilmParams | None:
    """Work out film thickness at the temperature of the inlet, and its friction.

    ``roughness``: composite rms [m]; ``contact``: whose pressure shears the film; ``fitted``: the one with
    the formula's radii.
    """
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
        log2_factor=log2_point_film_factor(fitted, viscosity, pressure_viscosity, lubrication.starvation),
        speed_exponent=SPEED_EXPONENT,
        load_exponent=LOAD_EXPONENT,
        log2_roughness=math.log2(roughness),
        boundary_friction=lubrication.boundary_friction,
        film_friction=0.0 if isinstance(lubrication, RibShearedFilm) else lubrication.film_friction,
        sheared=sheared,
    )


def rib_drilling_params(rib: Rib, contact: PointContact) -> RibDrillingParams | None:
    """Square the ellipse's semi-axis around the ring, over the approach; nothing where spin does not rub."""
    if not rib.drilling:
        return None
    larger, _ = contact.semi_axes(1.0)
    return RibDrillingParams(SPIN_SHARE * float(larger**2 * contact.factor ** (2.0 / 3.0)))


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

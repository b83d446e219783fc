"""Slow, obvious references of film and traction: scalars, SI, one formula at a time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from scipy.integrate import quad

from beardyn_core.bearing.film_thickness import line_film, rigid_line_film, thermal_factor, thermal_loading
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import CoulombTraction, LineFilm, LoadSharingTraction
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive
from test.kernels.naive import left_of_film


@dataclass(frozen=True)
class Lamina:
    """One lamina of one raceway contact: geometry, oil and temperature."""

    length: float
    radius: float
    contact_modulus: float
    roughness: float
    oil: Lubricant
    temperature: float

    def mean_pressure(self, load: float) -> float:
        """pi/4 of p0 = sqrt(q E* / (pi R))."""
        line_load = load / self.length
        return math.pi / 4.0 * math.sqrt(line_load * 0.5 * self.contact_modulus / (math.pi * self.radius))


def film(load: float, speed: float, lamina: Lamina, options: LineFilm) -> float:
    """Film thickness with all options, [m]; speed not below 1 mm/s, load not below 1 mN."""
    oil, q = lamina.oil, max(load, 1e-3) / lamina.length
    viscosity = oil.dynamic_viscosity(lamina.temperature)
    alpha = oil.pressure_viscosity_at(lamina.temperature)
    found = line_film(q, speed, lamina.radius, lamina.contact_modulus, viscosity, alpha, options.formula)
    if options.thermal != "none":
        loading = thermal_loading(viscosity, oil.temperature_coefficient, speed, oil.thermal_conductivity)
        found *= thermal_factor(loading, options.thermal)
    if options.isoviscous:
        found = max(
            found, min(rigid_line_film(q, speed, lamina.radius, viscosity), 1e-4 / options.constant_share)
        )
    return left_of_film(found, viscosity * speed, options)


def dry_friction(load: float, slip: float, traction: CoulombTraction) -> float:
    """Coulomb friction by its named regularisation, [N]."""
    full, u, speed = traction.friction * load, slip, traction.regularisation_speed
    if traction.regularisation == "threlfall":
        return full * -math.expm1(-3.0 * u / speed) if u <= speed else 0.95 * full
    if traction.regularisation == "ambrosio":
        start = traction.regularisation_start
        return full * min(1.0, max(0.0, (u - start) / (speed - start)))
    if traction.regularisation == "arctangent":
        return full * 2.0 / math.pi * math.atan(u / speed)
    return full * u / math.hypot(u, speed)


def roelands_viscosity(oil: Lubricant, temperature: float, pressure: float) -> float:
    level, exponent = oil.roelands_constants(temperature)
    thickening = level * ((1.0 + 5.1e-9 * pressure) ** exponent - 1.0)
    return oil.dynamic_viscosity(temperature) * math.exp(thickening)


def viscosity_at(pressure: float, lamina: Lamina, thickening: str) -> float:
    """Viscosity in the contact, at most 2^30 times that of the inlet, [Pa s]."""
    oil, temperature = lamina.oil, lamina.temperature
    ambient = oil.dynamic_viscosity(temperature)
    if thickening == "roelands":
        return min(roelands_viscosity(oil, temperature, pressure), ambient * 2.0**30)
    exponent = oil.pressure_viscosity_at(temperature) * pressure
    return ambient * math.exp(min(exponent, 30.0 * math.log(2.0)))


def aihara(
    viscosity: float, largest_pressure: float, slip: float, speed: float, largest_slide: float
) -> float:
    """Aihara's coefficient in his units: cP, mm/s, kgf/mm^2."""
    eta, u, p = viscosity * 1e3, speed * 1e3, largest_pressure / 9.80665e6
    s_max = min(1.2448e7 * eta**-1.5 * u**-0.75 * p**-1.5, largest_slide)
    if p > 94.404:
        mu_max = 4.078e-2 * eta**0.1 * u**-0.12 * p**0.18
    else:
        mu_max = 1.008e-4 * eta**0.1 * u**-0.12 * p**1.5
    return mu_max * -math.expm1(-2.6 * slip / speed / s_max)


def inlet_friction(slip: float, thickness: float, lamina: Lamina) -> float:
    """eta u l times the integral of dx/h over the parabolic gap, by quadrature up to Reynolds' exit, [N]."""
    stretch = math.sqrt(2.0 * lamina.radius * thickness)
    integral = quad(lambda s: 1.0 / (1.0 + s * s), -math.inf, 0.47513)[0]
    viscosity = lamina.oil.dynamic_viscosity(lamina.temperature)
    return viscosity * slip * lamina.length * stretch / thickness * integral


def film_friction(
    load: float, slip: float, speed: float, thickness: float, lamina: Lamina, traction: LoadSharingTraction,
    thickening: str,
) -> float:  # fmt: skip
    """Friction of the film alone, [N]."""
    pressure = lamina.mean_pressure(load)
    area = load / pressure
    if traction.inlet_shear:
        around = inlet_friction(slip, thickness, lamina)
        return around + film_friction(
            load, slip, speed, thickness, lamina, replace(traction, inlet_shear=False), thickening
        )
    if traction.film_traction == "aihara":
        ambient, largest = lamina.oil.dynamic_viscosity(lamina.temperature), 4.0 / math.pi * pressure
        sheared = film_friction(
            load, slip, speed, thickness, lamina, replace(traction, film_traction="bair_winer"), thickening
        )
        share = min(max(math.log2(largest / 0.25e9), 0.0), 1.0)  # of the fit: all from 0.5 GPa on
        return (1.0 - share) * sheared + share * load * aihara(
            ambient, largest, slip, speed, traction.largest_slide
        )
    newton = viscosity_at(pressure, lamina, thickening) * slip / thickness
    if traction.film_traction == "eyring":
        return area * traction.eyring_stress * math.asinh(newton / traction.eyring_stress)
    limit = traction.limiting_shear * pressure
    return area * limit * -math.expm1(-newton / limit)


def shared_friction(
    load: float, slip: float, speed: float, lamina: Lamina, traction: LoadSharingTraction,
    options: LineFilm | None,
) -> float:  # fmt: skip
    """Friction of asperities and film that share the load, [N]."""
    if load <= 0.0:
        return 0.0
    full = traction.boundary_friction * load
    asperities = full * 2.0 / math.pi * math.atan(traction.boundary_slope * slip / speed)
    if options is None:
        return asperities
    thickness = film(load, speed, lamina, options)
    share = -math.expm1(-1.8 * (thickness / lamina.roughness) ** 1.2)
    wet = film_friction(load, slip, speed, thickness, lamina, traction, options.thickening)
    return share * min(wet, full) + (1.0 - share) * asperities


SIDES = ("cup", "cone")


def lamina_friction(
    scene: Any, p: Parameters, ring: int, k: int, load: float, slip: float, speed: float
) -> float:
    """Naive friction of a lamina of the standard scene."""
    bearing = scene.bearing
    place = p.laminae[0, k] + p.roller.mass_offset
    length = bearing.effective_length / p.laminae.shape[1]
    radius = equivalent_radius(bearing, place, SIDES[ring])
    oil = scene.lubricant
    lamina = naive.FilmLamina(
        length, radius, bearing.material.contact_modulus, oil.dynamic_viscosity(scene.temperature),
        oil.pressure_viscosity_at(scene.temperature), scene.effects.film,
    )  # fmt: skip
    thickness = naive.film_thickness(max(load, 1e-3), speed + 1e-3, lamina)
    pressure = naive.mean_hertz_pressure(load, length, radius, bearing.material.contact_modulus)
    return naive.mixed_friction(load, slip, thickness, pressure, p.effects.mixed, p.effects.film)


def equivalent_radius(bearing: Any, place: float, side: str) -> float:
    """Radii of curvature of the two cones in the plane square to the common generator."""
    distance = bearing.apex_distance + place
    roller = distance * math.tan(bearing.half_angle) / math.cos(bearing.half_angle)
    angle = bearing.cup_angle if side == "cup" else bearing.cone_angle
    raceway = distance / math.cos(bearing.half_angle) * math.tan(angle)
    return 1.0 / (1.0 / roller + (-1.0 if side == "cup" else 1.0) / raceway)

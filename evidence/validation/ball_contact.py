"""Formulas of ball contacts, which the twin does not have, at the published numbers of their sources.

They show that the groups of numbers which the line formulas share are right for other contacts too. All
arguments SI.
"""

from __future__ import annotations

import math

from beardyn_core.bearing.rolling_resistance import AIHARA_LOAD, RollingContact, aihara_line


def curvature_sum(curvatures: tuple[float, float, float, float]) -> float:
    """Compute the sum of the principal curvatures (body I x, I y, body II x, II y), [1/m]."""
    return sum(curvatures)


def curvature_difference(curvatures: tuple[float, float, float, float]) -> float:
    """Compute F(rho) = |(rho_I1 - rho_I2) + (rho_II1 - rho_II2)| / sum(rho), [-].

    References
    ----------
    Harris, T. A. (2001), Rolling Bearing Analysis, 4th ed., chapter 2.
    """
    first_x, first_y, second_x, second_y = curvatures
    return abs((first_x - first_y) + (second_x - second_y)) / curvature_sum(curvatures)


def ellipticity(radius_x: float, radius_y: float) -> float:
    """Compute the axis ratio of the contact ellipse, across over along the rolling direction x, [-].

    References
    ----------
    Hamrock, B. J. and Brewe, D. (1983), ASME J. Lubr. Technol. 105: k = 1.0339 (Ry/Rx)^0.636.
    """
    return 1.0339 * (radius_y / radius_x) ** 0.636


def point_film_central(
    load: float,
    entrainment_speed: float,
    radius_x: float,
    radius_y: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
) -> float:
    """Compute the flooded isothermal central film of an elastohydrodynamic point contact.

    Parameters
    ----------
    load : float
        [N].
    entrainment_speed : float
        Along x, [m/s].
    radius_x, radius_y : float
        Equivalent radii along and across the entrainment, [m].
    contact_modulus : float
        E', [Pa].
    viscosity : float
        Dynamic viscosity at inlet temperature, [Pa s].
    pressure_viscosity : float
        Pressure-viscosity coefficient, [1/Pa].

    Returns
    -------
    float
        Film thickness, [m].

    References
    ----------
    Hamrock, B. J. and Dowson, D. (1977), ASME J. Lubr. Technol. 99, 264:
    H_c = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k)).
    """
    speed, material, normal = _point_groups(
        load, entrainment_speed, radius_x, contact_modulus, viscosity, pressure_viscosity
    )
    shape = 1.0 - 0.61 * math.exp(-0.73 * ellipticity(radius_x, radius_y))
    return 2.69 * radius_x * speed**0.67 * material**0.53 * normal**-0.067 * shape


def point_film_minimum(
    load: float,
    entrainment_speed: float,
    radius_x: float,
    radius_y: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
) -> float:
    """Compute the flooded isothermal minimum film of a point contact; as `point_film_central`.

    References
    ----------
    Hamrock, B. J. and Dowson, D. (1977), ASME J. Lubr. Technol. 99, 264:
    H_min = 3.63 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k)).
    """
    speed, material, normal = _point_groups(
        load, entrainment_speed, radius_x, contact_modulus, viscosity, pressure_viscosity
    )
    shape = 1.0 - math.exp(-0.68 * ellipticity(radius_x, radius_y))
    return 3.63 * radius_x * speed**0.68 * material**0.49 * normal**-0.073 * shape


def _point_groups(
    load: float,
    entrainment_speed: float,
    radius_x: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
) -> tuple[float, float, float]:
    """Compute U, G and W of a point contact."""
    return (
        viscosity * entrainment_speed / (contact_modulus * radius_x),
        pressure_viscosity * contact_modulus,
        load / (contact_modulus * radius_x**2),
    )


def starvation_central(
    flooded_film: float, radius_x: float, inlet_distance: float, half_width: float
) -> float:
    """Compute the central film over the flooded one when the oil begins close before the contact, 0 to 1.

    Parameters
    ----------
    flooded_film : float
        Flooded central film, [m].
    radius_x : float
        Equivalent radius along the entrainment, [m].
    inlet_distance : float
        From the edge of the contact to the meniscus, [m].
    half_width : float
        Half width of the contact along the entrainment, [m].

    References
    ----------
    Hamrock, B. J. and Dowson, D. (1977), ASME J. Lubr. Technol. 99, 15 (part IV, starvation): the film is
    flooded from f_c = 3.06 (H (R/b)^2)^0.58 half widths on, and falls as (f / f_c)^0.29 before.
    """
    return _starvation(flooded_film * radius_x / half_width**2, inlet_distance / half_width, 3.06, 0.29)


def starvation_minimum(
    flooded_film: float, radius_x: float, inlet_distance: float, half_width: float
) -> float:
    """Compute the minimum film over the flooded one, as `starvation_central` with 3.34 and 0.25."""
    return _starvation(flooded_film * radius_x / half_width**2, inlet_distance / half_width, 3.34, 0.25)


def _starvation(height: float, inlet: float, factor: float, exponent: float) -> float:
    flooded_from = factor * height**0.58
    return min(1.0, (inlet / flooded_from) ** exponent)


def gupta_cheng_factor(
    loading: float, largest_pressure: float, contact_modulus: float, slide_ratio: float
) -> float:
    """Compute the film over the isothermal one with load and sliding, 0 to 1.

    Parameters
    ----------
    loading : float
        From `thermal_loading`.
    largest_pressure : float
        Hertz pressure p0, [Pa].
    contact_modulus : float
        E', [Pa].
    slide_ratio : float
        Slip speed over entrainment speed, not negative.

    References
    ----------
    Gupta, P. K., Cheng, H. S., Zhu, D., Forster, N. H. and Schrand, J. B. (1992), Tribol. Trans. 35, 269:
    (1 - 13.2 (p0/E') L^0.42) / (1 + 0.213 (1 + 2.23 S^0.83) L^0.64).
    """
    load_term = max(0.0, 1.0 - 13.2 * largest_pressure / contact_modulus * loading**0.42)
    return load_term / (1.0 + 0.213 * (1.0 + 2.23 * slide_ratio**0.83) * loading**0.64)


def _load_parameter(contact: RollingContact) -> float:
    """Return W = Q / (E' R^2) of a point contact, [-]."""
    return contact.load / (contact.contact_modulus * contact.radius**2)


def aihara_point(contact: RollingContact) -> float:
    """Compute the rolling couple of a point contact, isothermal; `length` is the semi-major axis, [N m].

    References
    ----------
    Aihara (1987) as applied to balls by D-BRAIN (Tribology.cpp): line formula with W = Q/(E' R^2), l = a.
    """
    return aihara_line(contact) * (_load_parameter(contact) / contact.line_load_parameter) ** AIHARA_LOAD


def fujiwara_point(contact: RollingContact, aspect: float) -> float:
    """Compute the rolling couple of a point contact, isothermal, [N m].

    Parameters
    ----------
    contact : RollingContact
    aspect : float
        Semi-minor over semi-major axis as the source code has it, b/a.

    References
    ----------
    Fujiwara, NTN Technical Review 82 (2014), as in D-BRAIN (Tribology.cpp):
    F = 44.6/alpha U^0.694 G^0.961 W^0.401 (1 - 0.962 exp(-0.818 k)) R^2, M = F R.
    """
    force = (
        44.6
        * contact.speed_parameter**0.694
        * contact.material_parameter**0.961
        * _load_parameter(contact) ** 0.401
        * (1.0 - 0.962 * math.exp(-0.818 * aspect))
    )
    return force * contact.radius**3 / contact.pressure_viscosity


def houpert_point(contact: RollingContact, semi_minor: float) -> float:
    """Compute the rolling couple of a point contact from the rigid to the elastic regime, isothermal, [N m].

    Parameters
    ----------
    contact : RollingContact
    semi_minor : float
        Semi-axis in rolling direction b, [m].

    References
    ----------
    Houpert (1987), ASME J. Lubr. Technol. 109, 363, as in D-BRAIN (Tribology.cpp), whose code divides
    whole numbers in the exponent -1/3 and so misses its own test value by 2 %.
    """
    semi_major, modulus, radius = contact.length, contact.contact_modulus, contact.radius
    pressure = 1.5 * contact.load / (math.pi * semi_major * semi_minor)
    aspect = semi_minor / semi_major
    slenderness = semi_minor * modulus / (math.pi * pressure * radius)
    load = 2.0 * math.pi * pressure * semi_minor**2 / (3.0 * aspect * modulus * radius**2)
    speed = 2.0 * contact.speed_parameter
    regime = slenderness**0.25 * aspect * load * speed**-0.75
    elastic = 1.8 * slenderness**-0.25
    rigid = 0.77 * slenderness ** (-1.0 / 3.0) * aspect**0.12 * speed ** (-1.0 / 12.0)
    level = (rigid - elastic) / (1.0 + regime / 6.6) + elastic
    return 2.0 * semi_major / radius * level * speed**0.75 * modulus * radius**3

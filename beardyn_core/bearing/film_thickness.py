"""Lubricant films as plain formulas: line and point contacts, starvation, inlet heating, rigid surfaces.

All arguments SI. The entrainment speed is the mean of both surface speeds in the frame in which the contact
stands still. E' = 2 / sum((1 - nu^2) / E).

With U = eta u / (E' R), G = alpha E', and W = w / (E' R) for a line (w load per length) or Q / (E' R^2) for
a point, a film formula is H = h / R = c U^a G^b W^c times, for a point, a factor of the ellipticity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class LineFormula:
    """Film of a line contact, H = coefficient U^speed G^material W^load.

    Parameters
    ----------
    coefficient, speed_exponent, material_exponent, load_exponent : float
    what : str
        ``minimum`` at the constriction of the outlet, or ``central`` in the flat of the contact.
    source : str
    """

    coefficient: float
    speed_exponent: float
    material_exponent: float
    load_exponent: float
    what: str
    source: str


LINE_FORMULAS: dict[str, LineFormula] = {
    "dowson_higginson": LineFormula(2.65, 0.7, 0.54, -0.13, "minimum", "Dowson and Higginson (1966)"),
    "pan_hamrock": LineFormula(1.714, 0.694, 0.568, -0.128, "minimum", "Pan and Hamrock (1989)"),
    "pan_hamrock_central": LineFormula(2.922, 0.692, 0.470, -0.166, "central", "Pan and Hamrock (1989)"),
    "dowson_toyoda": LineFormula(3.06, 0.69, 0.56, -0.10, "central", "Dowson and Toyoda (1978)"),
}


def line_film(
    load_per_length: float,
    entrainment_speed: float,
    radius: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
    formula: str = "dowson_higginson",
) -> float:
    """Compute the flooded isothermal film of an elastohydrodynamic line contact.

    Parameters
    ----------
    load_per_length : float
        [N/m].
    entrainment_speed : float
        [m/s].
    radius : float
        Equivalent radius in rolling direction, [m].
    contact_modulus : float
        E', [Pa].
    viscosity : float
        Dynamic viscosity at inlet temperature, [Pa s].
    pressure_viscosity : float
        Pressure-viscosity coefficient, [1/Pa].
    formula : str
        Key of `LINE_FORMULAS`.

    Returns
    -------
    float
        Film thickness, [m].

    References
    ----------
    Dowson, D. and Higginson, G. R. (1966), Elasto-hydrodynamic Lubrication: H_min = 2.65 U^0.7 G^0.54
    W^-0.13.
    Pan, P. and Hamrock, B. J. (1989), ASME J. Tribol. 111, 246: H_min = 1.714 U^0.694 G^0.568 W^-0.128 and
    H_c = 2.922 U^0.692 G^0.470 W^-0.166.
    Dowson, D. and Toyoda, S. (1978), 5th Leeds-Lyon Symposium: H_c = 3.06 U^0.69 G^0.56 W^-0.10.
    """
    law = LINE_FORMULAS[formula]
    speed = viscosity * entrainment_speed / (contact_modulus * radius)
    material = pressure_viscosity * contact_modulus
    load = load_per_length / (contact_modulus * radius)
    groups = speed**law.speed_exponent * material**law.material_exponent * load**law.load_exponent
    return law.coefficient * radius * groups


def rigid_line_film(
    load_per_length: float, entrainment_speed: float, radius: float, viscosity: float
) -> float:
    """Compute the film of a line contact of rigid surfaces with an oil that pressure does not thicken, [m].

    The film of lightly loaded rollers; where it is thicker than the elastohydrodynamic one, it rules.

    References
    ----------
    Martin, H. M. (1916), Engineering (London) 102, 119: H = 4.9 U / W.
    """
    return 4.9 * viscosity * entrainment_speed * radius / load_per_length


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


@dataclass(frozen=True)
class ThermalFormula:
    """Film reduction by shear heating of the inlet, 1 / (1 + coefficient L^exponent)."""

    coefficient: float
    exponent: float
    source: str


THERMAL_FORMULAS: dict[str, ThermalFormula] = {
    "murch_wilson": ThermalFormula(1.0 / 3.94, 0.62, "Murch and Wilson (1975)"),
    "wilson": ThermalFormula(0.1, 0.64, "Wilson (1979)"),
    # pure rolling under light load, where the load and slide terms of the full formula vanish
    "gupta_cheng": ThermalFormula(0.213, 0.64, "Gupta, Cheng, Zhu, Forster and Schrand (1992)"),
}


def thermal_loading(
    viscosity: float, temperature_coefficient: float, entrainment_speed: float, conductivity: float
) -> float:
    """Compute the thermal loading of the inlet, L = eta beta u^2 / k, [-]; beta = -d(ln eta)/dT in SI."""
    return viscosity * temperature_coefficient * entrainment_speed**2 / conductivity


def thermal_factor(loading: float, formula: str) -> float:
    """Compute the film over the isothermal one at a thermal loading, 0 to 1.

    Parameters
    ----------
    loading : float
        From `thermal_loading`.
    formula : str
        Key of `THERMAL_FORMULAS`.

    References
    ----------
    Murch, L. E. and Wilson, W. R. D. (1975), ASME J. Lubr. Technol. 97, 212: 3.94 / (3.94 + L^0.62).
    Wilson, A. R. (1979), Proc. Inst. Mech. Eng. 193, 185: 1 / (1 + 0.1 L^0.64).
    """
    law = THERMAL_FORMULAS[formula]
    return 1.0 / (1.0 + law.coefficient * loading**law.exponent)


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

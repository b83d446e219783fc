"""Lubricant films as plain formulas: line contacts, elastic, rigid, with a heated inlet; the rib contact.

All arguments SI. The entrainment speed is the mean of both surface speeds in the frame in which the contact
stands still. E' = 2 / sum((1 - nu^2) / E).

With U = eta u / (E' R), G = alpha E' and W = w / (E' R), w the load per length, a film formula is
H = h / R = c U^a G^b W^c.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.bearing.contact_law import PointContact, rib_contact
from beardyn_core.bearing.geometry import Bearing

SPEED_EXPONENT, MATERIAL_EXPONENT, LOAD_EXPONENT = 0.67, 0.53, -0.067  # of the rib film


class LineFormula(NamedTuple):
    """Film of a line contact, H = coefficient U^speed G^material W^load; see `line_film`."""

    coefficient: float
    speed_exponent: float
    material_exponent: float
    load_exponent: float


LINE_FORMULAS = {
    "dowson_higginson": LineFormula(2.65, 0.7, 0.54, -0.13),
    "pan_hamrock": LineFormula(1.714, 0.694, 0.568, -0.128),
    "pan_hamrock_central": LineFormula(2.922, 0.692, 0.470, -0.166),
    "dowson_toyoda": LineFormula(3.06, 0.69, 0.56, -0.10),
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
    load_per_length, entrainment_speed : float
        [N/m], [m/s].
    radius : float
        Equivalent radius in rolling direction, [m].
    contact_modulus : float
        E', [Pa].
    viscosity, pressure_viscosity : float
        Dynamic viscosity at inlet temperature, [Pa s], and its pressure coefficient, [1/Pa].
    formula : str
        Key of `LINE_FORMULAS`.

    Returns
    -------
    float
        Thickness at the constriction of the outlet (H_min) or in the flat of the contact (H_c), [m].

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


class ThermalFormula(NamedTuple):
    """Film reduction by shear heating of the inlet, 1 / (1 + coefficient L^exponent)."""

    coefficient: float
    exponent: float


THERMAL_FORMULAS = {
    "murch_wilson": ThermalFormula(1.0 / 3.94, 0.62),
    "wilson": ThermalFormula(0.1, 0.64),
    # pure rolling under light load, where the load and slide terms of the full formula vanish
    "gupta_cheng": ThermalFormula(0.213, 0.64),
}


def thermal_loading(
    viscosity: float, temperature_coefficient: float, entrainment_speed: float, conductivity: float
) -> float:
    """Compute the thermal loading of the inlet, L = eta beta u^2 / k, [-]; beta = -d(ln eta)/dT in SI."""
    return viscosity * temperature_coefficient * entrainment_speed**2 / conductivity


def thermal_factor(loading: float, formula: str) -> float:
    """Compute the film over the isothermal one at a `thermal_loading` by a key of `THERMAL_FORMULAS`, 0 to 1.

    References
    ----------
    Murch, L. E. and Wilson, W. R. D. (1975), ASME J. Lubr. Technol. 97, 212: 3.94 / (3.94 + L^0.62).
    Wilson, A. R. (1979), Proc. Inst. Mech. Eng. 193, 185: 1 / (1 + 0.1 L^0.64).
    Gupta, Cheng, Zhu, Forster and Schrand (1992): 1 / (1 + 0.213 L^0.64).
    """
    law = THERMAL_FORMULAS[formula]
    return 1.0 / (1.0 + law.coefficient * loading**law.exponent)


def rib_film_thickness(
    bearing: Bearing, load: float, entrainment_speed: float, viscosity: float, pressure_viscosity: float
) -> float:
    """Compute the central film thickness of the flooded rib contact, [m].

    Under a load [N], with the mean surface speed against the contact around the ring [m/s], the dynamic
    viscosity at inlet temperature [Pa s] and its pressure coefficient [1/Pa]. The lubricant enters around the
    ring, along the larger axis of the ellipse: k, the axis across the entrainment over that along it, is 0.26
    for a usual rib, where the formula, meant for k >= 1, is an extrapolation.

    References
    ----------
    Hamrock, B. J. and Dowson, D. (1977), H_c = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)).
    """
    return point_film_thickness(rib_contact(bearing), load, entrainment_speed, viscosity, pressure_viscosity)


def point_film_thickness(
    contact: PointContact,
    load: float,
    entrainment_speed: float,
    viscosity: float,
    pressure_viscosity: float,
) -> float:
    """Compute the central film of a flooded point contact that is entrained along its second radius, [m].

    Arguments and formula as of `rib_film_thickness`.
    """
    modulus = contact.contact_modulus
    radius, side_radius = contact.radius_y, contact.radius_x
    ellipticity = 1.0339 * (side_radius / radius) ** 0.636
    speed = viscosity * entrainment_speed / (modulus * radius)
    material = pressure_viscosity * modulus
    force = load / (modulus * radius**2)
    side_leakage = 1.0 - 0.61 * math.exp(-0.73 * ellipticity)
    return (
        2.69
        * radius
        * speed**SPEED_EXPONENT
        * material**MATERIAL_EXPONENT
        * force**LOAD_EXPONENT
        * side_leakage
    )


def log2_point_film_factor(
    contact: PointContact, viscosity: float, pressure_viscosity: float, starvation: float
) -> float:
    """Compute the binary logarithm of the film thickness at 1 N and 1 m/s, [log2 m]."""
    return math.log2(starvation * point_film_thickness(contact, 1.0, 1.0, viscosity, pressure_viscosity))

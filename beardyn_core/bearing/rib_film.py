"""Film thickness of the rib contact: the plain formula, and its factor for the kernel."""

from __future__ import annotations

import math

from beardyn_core.bearing.contact_law import rib_contact
from beardyn_core.bearing.geometry import Bearing

SPEED_EXPONENT = 0.67
MATERIAL_EXPONENT = 0.53
LOAD_EXPONENT = -0.067


def rib_film_thickness(
    bearing: Bearing, load: float, entrainment_speed: float, viscosity: float, pressure_viscosity: float
) -> float:
    """Compute the central film thickness of the flooded rib contact, [m].

    Parameters
    ----------
    bearing : Bearing
    load : float
        [N].
    entrainment_speed : float
        Mean surface speed against the contact, around the ring, [m/s].
    viscosity : float
        Dynamic viscosity at inlet temperature, [Pa s].
    pressure_viscosity : float
        [1/Pa].

    Notes
    -----
    The lubricant enters around the ring, along the larger axis of the ellipse: k, the axis across the
    entrainment over that along it, is 0.26 for a usual rib, where the formula, meant for k >= 1, is an
    extrapolation.

    References
    ----------
    Hamrock, B. J. and Dowson, D. (1977), H_c = 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k)).
    """
    contact = rib_contact(bearing)
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


def log2_rib_film_factor(
    bearing: Bearing, viscosity: float, pressure_viscosity: float, starvation: float
) -> float:
    """Compute the binary logarithm of the film thickness at 1 N and 1 m/s, [log2 m]."""
    return math.log2(starvation * rib_film_thickness(bearing, 1.0, 1.0, viscosity, pressure_viscosity))

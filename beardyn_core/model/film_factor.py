"""Film thickness of a line contact: the plain formula, and its factor for the kernel's table."""

from __future__ import annotations

import math

SPEED_EXPONENT = 0.7
MATERIAL_EXPONENT = 0.54
LOAD_EXPONENT = -0.13


def minimum_film_thickness(
    load_per_length: float,
    entrainment_speed: float,
    radius: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
) -> float:
    """Minimum film thickness of a line contact: the plain formula, reference of the kernel.

    Parameters
    ----------
    load_per_length : float
        [N/m].
    entrainment_speed : float
        Mean surface speed in the contact-fixed frame, [m/s].
    radius : float
        Equivalent radius in rolling direction, [m].
    contact_modulus : float
        E' = 2 / sum((1 - nu^2) / E), [Pa].
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
    Dowson and Higginson (1966), H_min = 2.65 U^0.7 G^0.54 W^-0.13.
    """
    speed = viscosity * entrainment_speed / (contact_modulus * radius)
    material = pressure_viscosity * contact_modulus
    load = load_per_length / (contact_modulus * radius)
    return 2.65 * radius * speed**SPEED_EXPONENT * material**MATERIAL_EXPONENT * load**LOAD_EXPONENT


def log2_film_factor(
    radius: float,
    lamina_length: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
    starvation: float,
) -> float:
    """Binary logarithm of the film thickness at 1 N on the lamina and 1 m/s, [log2 m]."""
    thickness = minimum_film_thickness(
        1.0 / lamina_length, 1.0, radius, contact_modulus, viscosity, pressure_viscosity
    )
    return math.log2(starvation * thickness)

"""Traction of a full elastohydrodynamic film: friction force of a lamina over its slip speed.

Isothermal: shear heating of the film between the flats is neglected, so traction at large slip is an upper
estimate. Pressure is that of Hertz, of one lamina; the area is load over mean pressure. A law that is not
chosen is ``None`` and adds nothing.
"""

from __future__ import annotations

import math
from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, sqrt, where_greater
from beardyn_core.kernels.saturation import asinh_over, decay_over, decay_rate
from beardyn_core.model.contact_parameters import LAMINA_PRESSURE

_LOG2_E = 1.4426950408889634
_LARGEST_LOG2_THICKENING = 30.0
_SMALLEST_PRESSURE = 1e-3
# Aihara's units: largest Hertz pressure in kgf/mm^2, speed in mm/s from m/s
_LOG2_SPEED_UNIT = math.log2(1000.0)
_LOG2_PRESSURE_BEND = math.log2(94.404)
_LOG2_AT_HIGH_PRESSURE = math.log2(4.078e-2)
_LOG2_STEEPNESS = math.log2(2.6)
_LOG2_AT_LOW_PRESSURE = math.log2(1.008e-4)


@inline
def mean_pressure(load: Any, lamina: Any, ring: Any, laminae: Any) -> Any:
    """Mean Hertz pressure of a lamina, [Pa]."""
    return sqrt(load * laminae[LAMINA_PRESSURE + ring, lamina])


@inline
def log2_thickening(pressure: Any, film: Any) -> Any:
    """Binary logarithm of the viscosity at a pressure over the ambient one, at most 30.

    References
    ----------
    Barus (1893): exp(alpha p), or Roelands (1966) where the film has it.
    """
    return at_most(
        _log2_thickening(pressure, film.pressure_viscosity, film.roelands), _LARGEST_LOG2_THICKENING
    )


@inline
def _log2_thickening(pressure: Any, pressure_viscosity: Any, roelands: Any) -> Any:
    if roelands is None:
        return pressure * (pressure_viscosity * _LOG2_E)
    return roelands.log2_level * (exp2(roelands.exponent * log2(1.0 + 5.1e-9 * pressure)) - 1.0)


@inline
def aihara_rate(
    load: Any,
    log2_force: Any,
    slip: Any,
    inverse_slip: Any,
    log2_rolling: Any,
    lamina: Any,
    ring: Any,
    aihara: Any,
) -> Any:
    """Traction fitted to tests of rolling contacts, [N s/m].

    mu = mu_max (1 - exp(-2.6 s / s_max)), s slip over entrainment speed, with eta in cP, u in mm/s and the
    largest Hertz pressure p in kgf/mm^2: s_max = 1.2448e7 eta^-1.5 u^-0.75 p^-1.5, mu_max = 4.078e-2 eta^0.1
    u^-0.12 p^0.18 above 94.4 kgf/mm^2 and 1.008e-4 eta^0.1 u^-0.12 p^1.5 below. Where thin or light films
    put s_max beyond the fit it is limited to the largest slide.

    References
    ----------
    Aihara, S. (1987), A new running torque formula for tapered roller bearings under axial load, ASME J.
    Tribol. 109, 471; coefficients as in the published source of D-BRAIN (NSK).
    """
    if aihara is None:
        return 0.0
    log2_pressure = 0.5 * log2_force + aihara.log2_pressure[ring, lamina]
    log2_speed = log2_rolling + _LOG2_SPEED_UNIT
    log2_slide = (aihara.log2_slide - 0.75 * log2_speed) - 1.5 * log2_pressure
    log2_slide = at_most(log2_slide, aihara.log2_largest_slide)
    log2_friction = where_greater(
        log2_pressure,
        _LOG2_PRESSURE_BEND,
        _LOG2_AT_HIGH_PRESSURE + 0.18 * log2_pressure,
        _LOG2_AT_LOW_PRESSURE + 1.5 * log2_pressure,
    )
    friction = exp2((aihara.log2_friction - 0.12 * log2_speed) + log2_friction)
    per_slip = exp2((_LOG2_STEEPNESS - log2_rolling) - log2_slide)
    return load * friction * decay_rate(per_slip, slip, inverse_slip)


@inline
def eyring_rate(
    load: Any, slip: Any, log2_film: Any, lamina: Any, ring: Any, laminae: Any, film: Any, eyring: Any
) -> Any:
    """Shear stress tau_0 asinh(eta u / (h tau_0)) on the Hertz area, [N s/m].

    References
    ----------
    Eyring (1936), after Johnson, K. L. and Tevaarwerk, J. L. (1977), Proc. R. Soc. A 356, 215.
    """
    if eyring is None:
        return 0.0
    pressure = mean_pressure(load, lamina, ring, laminae)
    area = load / at_least(pressure, _SMALLEST_PRESSURE)
    shear = film.viscosity * exp2(log2_thickening(pressure, film) - log2_film)
    return area * shear * asinh_over(shear * slip / eyring.stress)


@inline
def bair_winer_rate(
    load: Any, slip: Any, log2_film: Any, lamina: Any, ring: Any, laminae: Any, film: Any, limit: Any
) -> Any:
    """Shear stress tau_L (1 - exp(-eta u / (h tau_L))), tau_L a share of the mean pressure, [N s/m].

    References
    ----------
    Bair, S. and Winer, W. O. (1979), A rheological model for elastohydrodynamic contacts based on primary
    laboratory data, ASME J. Lubr. Technol. 101, 258.
    """
    if limit is None:
        return 0.0
    pressure = mean_pressure(load, lamina, ring, laminae)
    bounded = at_least(pressure, _SMALLEST_PRESSURE)
    shear = film.viscosity * exp2(log2_thickening(pressure, film) - log2_film)
    return load / bounded * shear * decay_over(shear * slip / (limit.limiting_shear * bounded))


@inline
def inlet_rate(log2_film: Any, lamina: Any, ring: Any, laminae: Any, factor: Any) -> Any:
    """Shear of the oil at ambient viscosity in the parabolic gap around a contact, [N s/m].

    eta l times the integral of dx/h from the far inlet to Reynolds' exit, h + x^2/2R: all the friction of
    rigid surfaces, and small beside that of the flats where they are pressed.

    References
    ----------
    Martin (1916), after Dowson, D. and Higginson, G. R. (1966), Elasto-Hydrodynamic Lubrication, ch. 4.
    """
    if factor is None:
        return 0.0
    return factor * sqrt(exp2(-log2_film) / laminae[LAMINA_PRESSURE + ring, lamina])


@inline
def limited_newton_rate(
    load: Any, slip_squared: Any, log2_film: Any, lamina: Any, ring: Any, laminae: Any, film: Any, limit: Any
) -> Any:
    """Newtonian stress bent into the limiting one, tau_N tau_L / sqrt(tau_N^2 + tau_L^2), [N s/m].

    References
    ----------
    Bair and Winer (1979) for the limiting shear stress.
    """
    pressure = mean_pressure(load, lamina, ring, laminae)
    shear = film.viscosity * exp2(log2_thickening(pressure, film) - log2_film)
    highest = limit.limiting_shear * pressure
    # load / pressure is the area; 1e-30 keeps an unloaded lamina at zero friction, not 0/0
    return (
        load * limit.limiting_shear * shear / sqrt(highest * highest + shear * shear * slip_squared + 1e-30)
    )

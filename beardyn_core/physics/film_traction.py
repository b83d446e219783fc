"""Traction of full films, from fits to tests to the limiting stress: parameters and laws.

Films are isothermal: shear heating between the flats is neglected, so traction at large slip is an upper
estimate. Pressure is that of Hertz, of one lamina; the area is load over mean pressure. A law that is not
chosen is ``None`` and adds nothing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import inline
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import LoadSharingTraction
from beardyn_core.physics.bodies.layout import LAMINA_PRESSURE
from beardyn_core.physics.lamina_table import for_springs
from beardyn_core.physics.lanes.lane_math import (
    LOG2_E,
    asinh_over,
    at_least,
    at_most,
    decay_rate,
    exp2,
    log2,
    sqrt,
    where_greater,
)
from beardyn_core.scene.scene import Scene

# All of Aihara's fit holds from twice this largest Hertz pressure on, the lowest of its tests; below it is
# blended away.
_NO_LONGER_FITTED = 0.25e9  # [Pa]
_KGF_PER_MM2 = 1e6 * STANDARD_GRAVITY  # [Pa]
REYNOLDS_EXIT = 0.47513  # where the film of a parabolic gap ends, over sqrt(2 R h)
_SMALLEST_PRESSURE = 1e-3
_LARGEST_LOG2_THICKENING = 30.0
# Aihara's units: largest Hertz pressure in kgf/mm^2, speed in mm/s from m/s
_LOG2_SPEED_UNIT = math.log2(1000.0)
_LOG2_PRESSURE_BEND = math.log2(94.404)
_LOG2_NO_LONGER_FITTED = math.log2(_NO_LONGER_FITTED / _KGF_PER_MM2)
_LOG2_AT_HIGH_PRESSURE = math.log2(4.078e-2)
_LOG2_STEEPNESS = math.log2(2.6)
_LOG2_AT_LOW_PRESSURE = math.log2(1.008e-4)


class ShearedFilmParams(NamedTuple):
    """Film that shears up to a limit."""

    limiting_shear: float


class AiharaParams(NamedTuple):
    """Aihara's traction: parts of its logarithms that only the oil decides."""

    log2_slide: float
    log2_friction: float
    log2_largest_slide: float
    log2_pressure: Any  # largest Hertz pressure at 1 N on the lamina, [ring, spring], [log2 kgf/mm^2]


class EyringParams(NamedTuple):
    """Film with Eyring's sinh law."""

    stress: float  # [Pa]


class BairWinerParams(NamedTuple):
    """Film whose stress rises to a share of the mean pressure."""

    limiting_shear: float
    log2_shear: Any  # viscosity over mean pressure at 1 N on the lamina, [ring, spring], [log2 s]


def aihara_params(
    lubricant: Lubricant, temperature: float, largest_slide: float, laminae: NDArray[np.float64]
) -> AiharaParams:
    """Work out Aihara's traction of an oil at a temperature [K] on the laminae of a table.

    The fit wants the viscosity in cP and the largest pressure in kgf/mm^2.
    """
    log2_viscosity = math.log2(1e3 * lubricant.dynamic_viscosity(temperature))
    mean = np.sqrt(laminae[LAMINA_PRESSURE : LAMINA_PRESSURE + 2])
    return AiharaParams(
        log2_slide=math.log2(1.2448e7) - 1.5 * log2_viscosity,
        log2_friction=0.1 * log2_viscosity,
        log2_largest_slide=math.log2(largest_slide),
        log2_pressure=for_springs(np.log2(4.0 / math.pi * mean / _KGF_PER_MM2)),
    )


def bair_winer_params(
    scene: Scene, traction: LoadSharingTraction, laminae: NDArray[np.float64]
) -> BairWinerParams:
    """Work out the film whose stress rises to a share of the mean pressure, on the laminae of a table."""
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    mean = np.sqrt(laminae[LAMINA_PRESSURE : LAMINA_PRESSURE + 2])
    return BairWinerParams(traction.limiting_shear, for_springs(np.log2(viscosity / mean)))


def inlet_table(scene: Scene, laminae: NDArray[np.float64]) -> NDArray[np.float64]:
    """Tabulate the inlet shear of a lamina: eta l sqrt(2 R/h) (pi/2 + atan 0.4751) = factor/sqrt(c h).

    c is the lamina's `LAMINA_PRESSURE`, pi E'/(32 R l), which holds the radius.
    """
    length = scene.bearing.effective_length / scene.numerics.laminae
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    modulus = scene.bearing.material.contact_modulus
    reach = math.sqrt(2.0) * (0.5 * math.pi + math.atan(REYNOLDS_EXIT))
    factor = viscosity * reach * math.sqrt(math.pi / 32.0 * modulus * length)
    return for_springs(np.log2(factor / np.sqrt(laminae[LAMINA_PRESSURE : LAMINA_PRESSURE + 2])))


@inline
def flats_traction(contact, slip, inverse_slip, film, sharing, aihara):
    """Take the traction of the flats over slip speed and load; Aihara's only at the pressures of its tests.

    From 0.5 down to 0.25 GPa it gives way, with the logarithm of the pressure, to a film that shears.
    """
    sheared = bair_winer_shear(contact, slip, inverse_slip, film, sharing.bair_winer)
    if aihara is None:
        return eyring_shear(contact, slip, film, sharing.eyring) + sheared
    fitted, log2_pressure = aihara_traction(contact, slip, inverse_slip, aihara)
    share = at_most(at_least(log2_pressure - _LOG2_NO_LONGER_FITTED, 0.0), 1.0)
    return sheared + share * (fitted - sheared)


@inline
def mean_pressure(contact):
    """Work out the mean Hertz pressure of a lamina, [Pa]."""
    return sqrt(contact.load * contact.laminae[LAMINA_PRESSURE + contact.ring, contact.lamina])


@inline
def log2_thickening(pressure, film):
    """Take the binary logarithm of the viscosity at a pressure over the ambient one, at most 30.

    References
    ----------
    Barus (1893): exp(alpha p), or Roelands (1966) where the film has it.
    """
    return at_most(
        _log2_thickening(pressure, film.pressure_viscosity, film.roelands), _LARGEST_LOG2_THICKENING
    )


@inline
def _log2_thickening(pressure, pressure_viscosity, roelands):
    if roelands is None:
        return pressure * (pressure_viscosity * LOG2_E)
    return roelands.log2_level * (exp2(roelands.exponent * log2(1.0 + 5.1e-9 * pressure)) - 1.0)


@inline
def aihara_traction(contact, slip, inverse_slip, aihara):
    """Work out traction as fitted to tests of rolling contacts, and the largest pressure it is for.

    mu = mu_max (1 - exp(-2.6 s / s_max)), s slip over entrainment speed, with eta in cP, u in mm/s and the
    largest Hertz pressure p in kgf/mm^2: s_max = 1.2448e7 eta^-1.5 u^-0.75 p^-1.5, mu_max = 4.078e-2 eta^0.1
    u^-0.12 p^0.18 above 94.4 kgf/mm^2 and 1.008e-4 eta^0.1 u^-0.12 p^1.5 below. Where thin or light films
    put s_max beyond the fit it is limited to the largest slide.

    Returns
    -------
    coefficient : lane value
        Friction over slip speed and load, [s/m].
    log2_pressure : lane value
        Binary logarithm of the largest Hertz pressure, [log2 kgf/mm^2].

    References
    ----------
    Aihara, S. (1987), A new running torque formula for tapered roller bearings under axial load, ASME J.
    Tribol. 109, 471; coefficients as in the published source of D-BRAIN (NSK).
    """
    log2_pressure = 0.5 * contact.log2_load + aihara.log2_pressure[contact.ring, contact.lamina]
    log2_speed = contact.log2_rolling + _LOG2_SPEED_UNIT
    log2_slide = (aihara.log2_slide - 0.75 * log2_speed) - 1.5 * log2_pressure
    log2_slide = at_most(log2_slide, aihara.log2_largest_slide)
    log2_friction = where_greater(
        log2_pressure,
        _LOG2_PRESSURE_BEND,
        _LOG2_AT_HIGH_PRESSURE + 0.18 * log2_pressure,
        _LOG2_AT_LOW_PRESSURE + 1.5 * log2_pressure,
    )
    friction = exp2((aihara.log2_friction - 0.12 * log2_speed) + log2_friction)
    per_slip = exp2((_LOG2_STEEPNESS - contact.log2_rolling) - log2_slide)
    return friction * decay_rate(per_slip, slip, inverse_slip), log2_pressure


@inline
def eyring_shear(contact, slip, film, eyring):
    """Shear the Hertz area with the stress tau_0 asinh(eta u / (h tau_0)), over slip speed and load, [s/m].

    References
    ----------
    Eyring (1936), after Johnson, K. L. and Tevaarwerk, J. L. (1977), Proc. R. Soc. A 356, 215.
    """
    if eyring is None:
        return 0.0
    pressure = mean_pressure(contact)
    area = 1.0 / at_least(pressure, _SMALLEST_PRESSURE)
    shear = film.viscosity * exp2(log2_thickening(pressure, film) - contact.log2_film)
    return area * shear * asinh_over(shear * slip / eyring.stress)


@inline
def bair_winer_shear(contact, slip, inverse_slip, film, limit):
    """Shear with tau_L (1 - exp(-eta u / (h tau_L))), tau_L a share of the mean pressure, over slip and load.

    [s/m]; what the stress rises with, eta / (h tau_L), is put together as a logarithm, without a division.

    References
    ----------
    Bair, S. and Winer, W. O. (1979), A rheological model for elastohydrodynamic contacts based on primary
    laboratory data, ASME J. Lubr. Technol. 101, 258.
    """
    if limit is None:
        return 0.0
    thickening = log2_thickening(mean_pressure(contact), film)
    thinner = 0.5 * contact.log2_load + contact.log2_film
    shear = exp2((thickening - thinner) + limit.log2_shear[contact.ring, contact.lamina])
    return limit.limiting_shear * decay_rate(shear * (1.0 / limit.limiting_shear), slip, inverse_slip)


@inline
def inlet_shear(contact, inlet):
    """Shear the oil at ambient viscosity in the parabolic gap around a contact, over slip and load, [s/m].

    eta l times the integral of dx/h from the far inlet to Reynolds' exit, h + x^2/2R: all the friction of
    rigid surfaces, and small compared with that of the flats where they are pressed.

    References
    ----------
    Martin (1916), after Dowson, D. and Higginson, G. R. (1966), Elasto-Hydrodynamic Lubrication, ch. 4.
    """
    if inlet is None:
        return 0.0
    return exp2((inlet[contact.ring, contact.lamina] - 0.5 * contact.log2_film) - contact.log2_load)


@inline
def limited_newton_rate(contact, film, limit):
    """Bend the Newtonian stress into the limiting one, tau_N tau_L / sqrt(tau_N^2 + tau_L^2), [N s/m].

    References
    ----------
    Bair and Winer (1979) for the limiting shear stress.
    """
    pressure = mean_pressure(contact)
    shear = film.viscosity * exp2(log2_thickening(pressure, film) - contact.log2_film)
    highest = limit.limiting_shear * pressure
    stress = sqrt(highest * highest + shear * shear * contact.slip_squared + 1e-30)
    # load / pressure is the area; 1e-30 keeps an unloaded lamina at zero friction, not 0/0
    return contact.load * limit.limiting_shear * shear / stress

"""Traction of the raceway contacts: parameters and laws, from boundary friction to the limiting stress.

Every law acts against the slip, so it dissipates; none sticks: below its slip speed a contact creeps. Full
films are isothermal: shear heating between the flats is neglected, so traction at large slip is an upper
estimate. Pressure is that of Hertz, of one lamina; the area is load over mean pressure. A law that is not
chosen is ``None`` and adds nothing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import inline, plain
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import (
    CoulombTraction,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
    Traction,
)
from beardyn_core.physics.bodies.layout import LAMINA_PRESSURE
from beardyn_core.physics.film import (
    FilmParams,
    asperity_share,
    film_params,
    log2_entrainment,
    log2_film_thickness,
)
from beardyn_core.physics.lamina_table import for_springs, lamina_table
from beardyn_core.physics.lanes.lane_math import (
    LOG2_E,
    arctangent_over,
    arctangent_with,
    asinh_over,
    at_least,
    at_most,
    decay_over,
    decay_rate,
    exp2,
    log2,
    sqrt,
    where_greater,
)
from beardyn_core.scene.scene import Scene


class SlipLawParams(NamedTuple):
    """Which law rounds the corner of dry friction: the member that is not ``None``."""

    threlfall: float | None  # steepness, 3
    ambrosio_start: float | None  # [m/s]
    arctangent: float | None  # steepness, 1


class CoulombParams(NamedTuple):
    """Dry friction."""

    friction: float
    regularisation: float  # [m/s]
    law: SlipLawParams | None = None


class ShearedFilmParams(NamedTuple):
    """Film that shears up to a limit."""

    limiting_shear: float


class MixedParams(NamedTuple):
    """Boundary and full-film friction blended over the film parameter."""

    friction: float
    regularisation: float  # [m/s]
    film_friction: float
    boundary_film: float
    full_film: float
    sheared_film: ShearedFilmParams | None
    law: SlipLawParams | None = None


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


class LoadSharingParams(NamedTuple):
    """Asperities and film share the load; the film has the laws of the members that are not ``None``."""

    friction: float
    slope: float
    log2_roughness: float  # [log2 m]
    aihara: AiharaParams | None
    eyring: EyringParams | None
    bair_winer: BairWinerParams | None
    inlet: Any  # shear of the gap around a contact with a film of 1 m, [ring, spring], [log2 N s/m m^0.5]


# All of Aihara's fit holds from twice this largest Hertz pressure on, the lowest of its tests; below it is
# blended away.
_NO_LONGER_FITTED = 0.25e9  # [Pa]
_KGF_PER_MM2 = 1e6 * STANDARD_GRAVITY  # [Pa]
REYNOLDS_EXIT = 0.47513  # where the film of a parabolic gap ends, over sqrt(2 R h)


def traction_params(
    scene: Scene,
) -> tuple[CoulombParams | None, MixedParams | None, LoadSharingParams | None]:
    """Choose the traction law; the blends without a film are dry friction of the asperities."""
    traction = scene.effects.traction
    if traction is None:
        return None, None, None
    if isinstance(traction, LoadSharingTraction):
        return None, None, _load_sharing_params(scene, traction)
    law = slip_law_params(traction)
    if isinstance(traction, CoulombTraction):
        return CoulombParams(traction.friction, traction.regularisation_speed, law), None, None
    if scene.effects.film is None:
        return CoulombParams(traction.boundary_friction, traction.regularisation_speed, law), None, None
    return None, _mixed_params(traction, law), None


class TractionLaws(NamedTuple):
    """What `friction_rate` reads of the effects."""

    film: FilmParams | None
    coulomb: CoulombParams | None
    mixed: MixedParams | None
    load_sharing: LoadSharingParams | None


def traction_laws(scene: Scene) -> TractionLaws:
    """Take film and traction of a scene as the steps have them."""
    return TractionLaws(film_params(scene), *traction_params(scene))


def slip_law_params(traction: Traction) -> SlipLawParams | None:
    """Choose the regularisation of dry friction; ``None`` is the smooth one."""
    if isinstance(traction, LoadSharingTraction) or traction.regularisation == "smooth":
        return None
    return SlipLawParams(
        threlfall=3.0 if traction.regularisation == "threlfall" else None,
        ambrosio_start=traction.regularisation_start if traction.regularisation == "ambrosio" else None,
        arctangent=1.0 if traction.regularisation == "arctangent" else None,
    )


def _mixed_params(traction: MixedTraction | ShearedFilmTraction, law: SlipLawParams | None) -> MixedParams:
    return MixedParams(
        friction=traction.boundary_friction,
        regularisation=traction.regularisation_speed,
        film_friction=0.0 if isinstance(traction, ShearedFilmTraction) else traction.full_film_friction,
        boundary_film=traction.boundary_film_parameter,
        full_film=traction.full_film_parameter,
        sheared_film=ShearedFilmParams(traction.limiting_shear)
        if isinstance(traction, ShearedFilmTraction)
        else None,
        law=law,
    )


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


def _load_sharing_params(scene: Scene, traction: LoadSharingTraction) -> LoadSharingParams:
    kind = traction.film_traction
    laminae = lamina_table(scene)
    return LoadSharingParams(
        friction=traction.boundary_friction,
        slope=traction.boundary_slope,
        log2_roughness=math.log2(scene.bearing.raceway_roughness),
        aihara=aihara_params(scene.lubricant, scene.temperature, traction.largest_slide, laminae)
        if kind == "aihara"
        else None,
        eyring=EyringParams(traction.eyring_stress) if kind == "eyring" else None,
        bair_winer=_bair_winer_params(scene, traction, laminae) if kind != "eyring" else None,
        inlet=_inlet_table(scene, laminae) if traction.inlet_shear else None,
    )


def _bair_winer_params(
    scene: Scene, traction: LoadSharingTraction, laminae: NDArray[np.float64]
) -> BairWinerParams:
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    mean = np.sqrt(laminae[LAMINA_PRESSURE : LAMINA_PRESSURE + 2])
    return BairWinerParams(traction.limiting_shear, for_springs(np.log2(viscosity / mean)))


def _inlet_table(scene: Scene, laminae: NDArray[np.float64]) -> NDArray[np.float64]:
    """Tabulate the inlet shear of a lamina: eta l sqrt(2 R/h) (pi/2 + atan 0.4751) = factor/sqrt(c h).

    c is the lamina's `LAMINA_PRESSURE`, pi E'/(32 R l), which holds the radius.
    """
    length = scene.bearing.effective_length / scene.numerics.laminae
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    modulus = scene.bearing.material.contact_modulus
    reach = math.sqrt(2.0) * (0.5 * math.pi + math.atan(REYNOLDS_EXIT))
    factor = viscosity * reach * math.sqrt(math.pi / 32.0 * modulus * length)
    return for_springs(np.log2(factor / np.sqrt(laminae[LAMINA_PRESSURE : LAMINA_PRESSURE + 2])))


TWO_OVER_PI = 0.6366197723675814
_SLOWEST = 1e-12
_SMALLEST_PRESSURE = 1e-3
_LARGEST_LOG2_THICKENING = 30.0
# Aihara's units: largest Hertz pressure in kgf/mm^2, speed in mm/s from m/s
_LOG2_SPEED_UNIT = math.log2(1000.0)
_LOG2_PRESSURE_BEND = math.log2(94.404)
_LOG2_NO_LONGER_FITTED = math.log2(_NO_LONGER_FITTED / _KGF_PER_MM2)
_LOG2_AT_HIGH_PRESSURE = math.log2(4.078e-2)
_LOG2_STEEPNESS = math.log2(2.6)
_LOG2_AT_LOW_PRESSURE = math.log2(1.008e-4)


class LaminaContact(NamedTuple):
    """A lamina that rubs."""

    load: Any  # [N]
    log2_load: Any  # [log2 N]
    slip_squared: Any  # [m^2/s^2]
    log2_film: Any  # film thickness [log2 m]
    log2_rolling: Any  # entrainment speed [log2 m/s]
    lamina: int
    ring: int
    laminae: Any  # lamina table [row of the table, lamina]


def rolling_lamina(
    load: Any, speed: float, slip: Any, ring: int, laws: TractionLaws, laminae: NDArray[np.float64]
) -> LaminaContact:
    """Describe the middle lamina of a contact that rolls, in plain Python.

    Parameters
    ----------
    load : float or float64 array
        Of the lamina, [N].
    speed : float
        Entrainment speed, [m/s].
    slip : float or float64 array
        Of the surfaces, [m/s].
    ring : int
        ``CUP`` or ``CONE``.
    laminae : float64 array, shape [LAMINA_ROWS, lamina]
        Of `lamina_table`.
    """
    middle = laminae.shape[1] // 2
    log2_load = np.log2(load)
    log2_speed = plain(log2_entrainment)(speed, laws.film)
    film = plain(log2_film_thickness)(log2_load, log2_speed, middle, ring, laminae, laws.film)
    return LaminaContact(load, log2_load, slip * slip, film, log2_speed[1], middle, ring, laminae)


def lamina_friction(contact: LaminaContact, laws: TractionLaws) -> Any:
    """Evaluate `friction_rate` in plain Python, [N s/m]."""
    return plain(friction_rate)(contact, laws)


@inline
def friction_rate(contact, effects):
    """Work out the friction of one lamina over its slip speed, 0 without traction, [N s/m]."""
    return _rate(contact, effects.film, effects.coulomb, effects.mixed, effects.load_sharing)


@inline
def _rate(contact, film, coulomb, mixed, load_sharing):
    if load_sharing is not None:
        return contact.load * load_sharing_coefficient(contact, film, load_sharing)
    if mixed is not None:
        return mixed_rate(contact, film, mixed)
    return coulomb_rate(contact, coulomb)


@inline
def traction_capacity(load, coulomb, mixed, load_sharing):
    """Take the friction at full slip in the dry limit, the scale of the chatter index, [N]."""
    if load_sharing is not None:
        return load_sharing.friction * load
    if mixed is not None:
        return mixed.friction * load
    if coulomb is not None:
        return coulomb.friction * load
    return load


# --- dry friction and the laws by which its corner at zero slip is rounded


@inline
def coulomb_rate(contact, coulomb):
    """Work out dry friction over slip speed, mu N / u with its corner at zero slip rounded, [N s/m].

    Adds friction of constant coefficient; neglects stiction and any lubricant.
    """
    if coulomb is None:
        return 0.0
    force = coulomb.friction * contact.load
    return slip_rate(force, contact.slip_squared, coulomb.regularisation, coulomb.law)


@inline
def slip_rate(force, slip_squared, speed, law):
    """Divide friction of the size ``force`` at full slip by the slip speed, its corner rounded, [N s/m].

    Without a named law the friction is u / sqrt(u^2 + speed^2) of the force: 71 % at that slip speed.
    """
    if law is None:
        return force / sqrt(slip_squared + speed * speed)
    slip = sqrt(slip_squared)
    return (
        threlfall_rate(force, slip, speed, law.threlfall)
        + ambrosio_rate(force, slip, speed, law.ambrosio_start)
        + arctangent_rate(force, slip, speed, law.arctangent)
    )


@inline
def threlfall_rate(force, slip, speed, steepness):
    """Take 1 - exp(-3 u / speed) of the force below the speed, 0.95 of it beyond, for a steepness of 3.

    References
    ----------
    Threlfall, D. C. (1978), The inclusion of Coulomb friction in mechanisms programs with particular
    reference to DRAM, Mech. Mach. Theory 13, 475.
    """
    if steepness is None:
        return 0.0
    per_slip = steepness / speed
    below = force * per_slip * decay_over(slip * per_slip)
    return where_greater(slip, speed, 0.95 * force / at_least(slip, _SLOWEST), below)


@inline
def ambrosio_rate(force, slip, full, start):
    """Take none of the force up to the slip speed ``start``, all of it from ``full`` on, linear in between.

    References
    ----------
    Ambrosio, J. (2003), Impact of rigid and flexible multibody systems: deformation description and contact
    models, Virtual Nonlinear Multibody Systems, 57.
    """
    if start is None:
        return 0.0
    moving = at_least(slip, _SLOWEST)
    ramp = at_most(at_least((moving - start) / (full - start), 0.0), 1.0)
    return force * ramp / moving


@inline
def arctangent_rate(force, slip, speed, steepness):
    """Take 2/pi atan(u / speed) of the force: half of it at that slip speed for a steepness of 1."""
    if steepness is None:
        return 0.0
    per_slip = steepness / speed
    return TWO_OVER_PI * force * per_slip * arctangent_over(slip * per_slip)


# --- asperities and film together


@inline
def mixed_rate(contact, film, mixed):
    """Blend boundary and full-film friction over slip speed, [N s/m].

    The blend weight is the sixth-power law of the mixed regime over the film parameter. Neglects heating
    of the film.

    References
    ----------
    Santos (2017), Eq. 8, after Harada and Sakaguchi (2005).
    """
    dry = slip_rate(contact.load, contact.slip_squared, mixed.regularisation, mixed.law)
    wet = _full_film_rate(contact, dry, film, mixed, mixed.sheared_film)
    share = boundary_share(exp2(contact.log2_film) / film.roughness, mixed)
    return wet + (mixed.friction * dry - wet) * share


@inline
def boundary_share(film_parameter, mixed):
    """Weigh the boundary friction: 1 below the boundary film parameter, 0 above the full-film one."""
    share = (mixed.full_film - film_parameter) / (mixed.full_film - mixed.boundary_film)
    share = at_most(at_least(share, 0.0), 1.0)
    share2 = share * share
    return share2 * share2 * share2


@inline
def _full_film_rate(contact, dry, film, mixed, sheared_film):
    """Take the full film's friction over slip speed, [N s/m]: constant coefficient, or a film that shears."""
    if sheared_film is None:
        return mixed.film_friction * dry
    return limited_newton_rate(contact, film, sheared_film)


@inline
def load_sharing_coefficient(contact, film, sharing):
    """Share the load between asperities and film, each with its friction over slip speed and load, [s/m].

    The film carries 1 - exp(-1.8 Lambda^1.2); asperities have mu_0 2/pi atan(slope s), s slip over
    entrainment speed. The film never has more friction than dry asperities: the fits extrapolate to that
    for cold oil. Without a film all load is on asperities.

    References
    ----------
    Load share and asperity law as in the published source of D-BRAIN (NSK).
    """
    slip = sqrt(contact.slip_squared)
    inverse_slip = 1.0 / at_least(slip, 1e-12)  # one division for all laws
    per_slip = sharing.slope * exp2(-contact.log2_rolling)
    saturated = per_slip * arctangent_with(per_slip * slip, inverse_slip * (1.0 / per_slip))
    asperities = sharing.friction * TWO_OVER_PI * saturated
    return _share_load(contact, slip, inverse_slip, asperities, film, sharing)


@inline
def _share_load(contact, slip, inverse_slip, asperities, film, sharing):
    if film is None:
        return asperities
    wet = flats_traction(contact, slip, inverse_slip, film, sharing, sharing.aihara) + inlet_shear(
        contact, sharing.inlet
    )
    wet = at_most(wet, sharing.friction * inverse_slip)
    return wet + (asperities - wet) * asperity_share(contact.log2_film - sharing.log2_roughness)


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


# --- full films


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
    rigid surfaces, and small beside that of the flats where they are pressed.

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

"""Traction of the raceway contacts: the choice of a law, and asperities and film together.

Every law acts against the slip, so it dissipates; none sticks: below its slip speed a contact creeps.
A law that is not chosen is ``None`` and adds nothing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import inline, plain
from beardyn_core.effects import CoulombTraction, LoadSharingTraction, MixedTraction, ShearedFilmTraction
from beardyn_core.physics.dry_friction import (
    TWO_OVER_PI,
    CoulombParams,
    SlipLawParams,
    coulomb_rate,
    slip_law_params,
    slip_rate,
)
from beardyn_core.physics.film import (
    FilmParams,
    asperity_share,
    film_params,
    log2_entrainment,
    log2_film_thickness,
)
from beardyn_core.physics.film_traction import (
    AiharaParams,
    BairWinerParams,
    EyringParams,
    ShearedFilmParams,
    aihara_params,
    bair_winer_params,
    flats_traction,
    inlet_shear,
    inlet_table,
    limited_newton_rate,
)
from beardyn_core.physics.lamina_table import lamina_table
from beardyn_core.physics.lanes.lane_math import arctangent_with, at_least, at_most, exp2, sqrt
from beardyn_core.scene.scene import Scene


class MixedParams(NamedTuple):
    """Boundary and full-film friction blended over the film parameter."""

    friction: float
    regularisation: float  # [m/s]
    film_friction: float
    boundary_film: float
    full_film: float
    sheared_film: ShearedFilmParams | None
    law: SlipLawParams | None = None


class LoadSharingParams(NamedTuple):
    """Asperities and film share the load; the film has the laws of the members that are not ``None``."""

    friction: float
    slope: float
    log2_roughness: float  # [log2 m]
    aihara: AiharaParams | None
    eyring: EyringParams | None
    bair_winer: BairWinerParams | None
    inlet: Any  # shear of the gap around a contact with a film of 1 m, [ring, spring], [log2 N s/m m^0.5]


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
        bair_winer=bair_winer_params(scene, traction, laminae) if kind != "eyring" else None,
        inlet=inlet_table(scene, laminae) if traction.inlet_shear else None,
    )


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

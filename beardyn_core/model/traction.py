"""Traction of the raceway contacts as kernel parameters."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.effects import (
    CoulombTraction,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
    Traction,
)
from beardyn_core.model.laminae import for_springs, lamina_table
from beardyn_core.model.layout import LAMINA_PRESSURE
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
        log2_pressure=for_springs(np.log2(4.0 / math.pi * mean / 9.80665e6)),
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

"""Film of the raceway contacts: kernel parameters from the lubricant and the options."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.bearing.film_thickness import (
    LINE_FORMULAS,
    THERMAL_FORMULAS,
    rigid_line_film,
    thermal_loading,
)
from beardyn_core.bearing.oil_layer import LAYER_EXPONENT, layer_thickness
from beardyn_core.model.laminae import equivalent_radius, for_springs, lamina_places
from beardyn_core.scene.scene import Scene


class ThermalFilmParams(NamedTuple):
    """Film reduction by inlet shear heating, 1 / (1 + coefficient L^exponent)."""

    log2_loading: float  # of L at 1 m/s
    coefficient: float
    exponent: float


class RigidFilmParams(NamedTuple):
    """Film of rigid surfaces, H = 4.9 U / W."""

    log2_factor: Any  # of the film at 1 N on the lamina and 1 m/s, [ring, spring], [log2 m]


class LayerParams(NamedTuple):
    """Layer of oil that starves the contacts."""

    log2_thickness: float  # at 1 m/s [log2 m]
    speed_exponent: float


class RoelandsParams(NamedTuple):
    """Viscosity at pressure: log2(eta / eta_0) = log2_level ((1 + 5.1e-9 p)^exponent - 1)."""

    log2_level: float
    exponent: float


class FilmParams(NamedTuple):
    """Line-contact film; the rest of its formula is in the lamina table."""

    viscosity: float  # [Pa s]
    pressure_viscosity: float  # [1/Pa]
    roughness: float  # composite rms [m]
    speed_exponent: float
    load_exponent: float
    thermal: ThermalFilmParams | None
    rigid: RigidFilmParams | None
    layer: LayerParams | None
    roelands: RoelandsParams | None


def film_params(scene: Scene) -> FilmParams | None:
    """Work out the film of the raceway contacts of a scene, ``None`` when absent."""
    options, bearing, count = scene.effects.film, scene.bearing, scene.numerics.laminae
    if options is None:
        return None
    place, lamina_length = lamina_places(bearing, count), bearing.effective_length / count
    radii = [list(equivalent_radius(bearing, place, ring)) for ring in ("cup", "cone")]
    oil, temperature = scene.lubricant, scene.temperature
    viscosity, formula = oil.dynamic_viscosity(temperature), LINE_FORMULAS[options.formula]
    thermal, rigid, roelands = None, None, None
    if options.thermal != "none":
        law = THERMAL_FORMULAS[options.thermal]
        loading = thermal_loading(viscosity, oil.temperature_coefficient, 1.0, oil.thermal_conductivity)
        thermal = ThermalFilmParams(math.log2(loading), law.coefficient, law.exponent)
    if options.isoviscous:
        films = [[rigid_line_film(1.0 / lamina_length, 1.0, r, viscosity) for r in ring] for ring in radii]
        rigid = RigidFilmParams(for_springs(np.log2(options.constant_share * np.array(films))))
    if options.thickening == "roelands":
        level, exponent = oil.roelands_constants(temperature)
        roelands = RoelandsParams(level / math.log(2.0), exponent)
    return FilmParams(
        viscosity=viscosity,
        pressure_viscosity=oil.pressure_viscosity_at(temperature),
        roughness=scene.bearing.raceway_roughness,
        speed_exponent=formula.speed_exponent,
        load_exponent=formula.load_exponent,
        thermal=thermal,
        rigid=rigid,
        layer=layer_params(options.oil_layer, viscosity),
        roelands=roelands,
    )


def layer_params(layer: float | None, viscosity: float) -> LayerParams | None:
    """Work out the layer of oil that a contact finds, ``None`` where there is enough."""
    if layer is None:
        return None
    return LayerParams(math.log2(layer_thickness(layer, viscosity, 1.0)), LAYER_EXPONENT)

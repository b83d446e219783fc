"""Film of the raceway contacts: from lubricant and options to its thickness on every lamina."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.jit import inline
from beardyn_core.bearing.film_thickness import (
    LINE_FORMULAS,
    THERMAL_FORMULAS,
    rigid_line_film,
    thermal_loading,
)
from beardyn_core.bearing.oil_layer import LAYER_EXPONENT, TRANSITION, layer_thickness
from beardyn_core.physics.bodies.layout import LAMINA_FILM
from beardyn_core.physics.lamina_table import equivalent_radius, for_springs, lamina_places
from beardyn_core.physics.lanes.lane_math import (
    LOG2_E,
    at_least,
    at_most,
    exp2,
    log2,
    log2_one_plus_exp2,
    magnitude,
)
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


_LOG2_LIGHTEST = -9.965784284662087  # 1 mN
_LOG2_THICKEST_RIGID_FILM = -13.287712379549449  # 0.1 mm, where an unloaded roller has no contact any more


@inline
def log2_entrainment(speed, film):
    """Work out what the film needs of the entrainment speed, once per contact.

    Returns ``speed_part``: speed part of the film thickness with the heating of the inlet [log2
    (m/s)^exponent]; ``log2_rolling``: the speed itself, not below 1 mm/s [log2 m/s].
    """
    log2_rolling = log2(magnitude(speed) + 1e-3)
    if film is None:
        return 0.0, log2_rolling
    return film.speed_exponent * log2_rolling + log2_thermal_factor(log2_rolling, film.thermal), log2_rolling


@inline
def log2_thermal_factor(log2_rolling, thermal):
    """Take log2 of the film reduction by inlet heating, 1 / (1 + c L^n), L = eta beta u^2 / k."""
    if thermal is None:
        return 0.0
    log2_loading = thermal.log2_loading + 2.0 * log2_rolling
    # log2(1) takes off the error that the logarithm has there, so that no heating is exactly none
    return log2(1.0) - log2(1.0 + thermal.coefficient * exp2(thermal.exponent * log2_loading))


@inline
def log2_load(load):
    """Work out the binary logarithm of the load of a lamina, not below that of 1e-12 N, [log2 N]."""
    return log2(at_least(load, 1e-12))


@inline
def log2_film_thickness(log2_force, log2_speed, lamina, ring, laminae, film):
    """Work out the binary logarithm of the film thickness of one lamina, [log2 m].

    Power law in speed and load, the rest of the formula is in the lamina table; with the guard of rigid
    surfaces the thicker of both films; thinner where there is too little oil. Loads below 1 mN are treated as
    1 mN.

    References
    ----------
    `beardyn_core.bearing.film_thickness` for the formulas.
    """
    if film is None:
        return 0.0
    bounded = at_least(log2_force, _LOG2_LIGHTEST)
    elastic = log2_speed[0] + film.load_exponent * bounded + laminae[LAMINA_FILM + ring, lamina]
    flooded = thicker_film(elastic, bounded, log2_speed[1], lamina, ring, film.rigid)
    return starved_film(flooded, log2_speed[1], film.layer)


@inline
def thicker_film(elastic, load_log2, log2_rolling, lamina, ring, rigid):
    """Take the elastohydrodynamic film, or that of rigid surfaces where it is thicker, [log2 m].

    References
    ----------
    Martin (1916): H = 4.9 U / W.
    """
    if rigid is None:
        return elastic
    film = log2_rolling - load_log2 + rigid.log2_factor[ring, lamina]
    return at_least(elastic, at_most(film, _LOG2_THICKEST_RIGID_FILM))


@inline
def starved_film(flooded, log2_rolling, layer):
    """Thin a flooded film to what a layer of oil leaves of it, [log2 m], within 4e-5 of the formula.

    References
    ----------
    Chevalier et al. (1998), see `bearing.oil_layer`.
    """
    if layer is None:
        return flooded
    ratio = flooded - layer.log2_thickness - layer.speed_exponent * log2_rolling
    return flooded - (1.0 / TRANSITION) * log2_one_plus_exp2(TRANSITION * ratio)


@inline
def film_output(load, log2_speed, ring, laminae, film):
    """Work out the film thickness of the middle lamina under the mean lamina load, [m]; 0 without a film."""
    if film is None:
        return 0.0
    middle = laminae.shape[1] // 2
    share = log2_load(load / laminae.shape[1])
    return exp2(log2_film_thickness(share, log2_speed, middle, ring, laminae, film))


@inline
def asperity_share(log2_parameter):
    """Work out the share of the load on asperities, 1 at a film parameter of 0, from its binary logarithm.

    References
    ----------
    exp(-1.8 Lambda^1.2), as in Zhao et al. (2026) and the published source of D-BRAIN (NSK).
    """
    return exp2(-1.8 * LOG2_E * exp2(1.2 * log2_parameter))

"""Film thickness of a lamina as factors for the kernel: its table entry and the optional parts."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.bearing.film_thickness import (
    LINE_FORMULAS,
    THERMAL_FORMULAS,
    line_film,
    rigid_line_film,
    thermal_loading,
)
from beardyn_core.effects import LineFilm
from beardyn_core.model.contact_parameters import (
    FilmParams,
    RigidFilmParams,
    RoelandsParams,
    ThermalFilmParams,
)
from beardyn_core.model.springs import for_springs
from beardyn_core.scene.scene import Scene


def log2_film_factor(
    radius: float,
    lamina_length: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
    options: LineFilm | None,
) -> float:
    """Binary logarithm of the film thickness at 1 N on the lamina and 1 m/s, [log2 m]."""
    film = LineFilm(starvation=1.0) if options is None else options
    thickness = line_film(
        1.0 / lamina_length, 1.0, radius, contact_modulus, viscosity, pressure_viscosity, film.formula
    )
    return math.log2(film.starvation * thickness)


def film_params(
    scene: Scene, options: LineFilm, radii: tuple[list[float], list[float]], lamina_length: float
) -> FilmParams:
    """Film of the raceway contacts.

    Parameters
    ----------
    scene : Scene
    options : LineFilm
    radii : tuple of 2 lists of float
        Equivalent radii of the laminae against cup and cone, [m].
    lamina_length : float
        [m].
    """
    oil, temperature = scene.lubricant, scene.temperature
    viscosity, formula = oil.dynamic_viscosity(temperature), LINE_FORMULAS[options.formula]
    thermal, rigid, roelands = None, None, None
    if options.thermal != "none":
        law = THERMAL_FORMULAS[options.thermal]
        loading = thermal_loading(viscosity, oil.temperature_coefficient, 1.0, oil.thermal_conductivity)
        thermal = ThermalFilmParams(math.log2(loading), law.coefficient, law.exponent)
    if options.isoviscous:
        films = [[rigid_line_film(1.0 / lamina_length, 1.0, r, viscosity) for r in ring] for ring in radii]
        rigid = RigidFilmParams(for_springs(np.log2(options.starvation * np.array(films))))
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
        roelands=roelands,
    )

"""Film and traction as kernel parameters."""

from __future__ import annotations

from beardyn_core.effects import CoulombTraction, ShearedFilmTraction
from beardyn_core.model.parameters import (
    CoulombParams,
    FilmParams,
    MixedParams,
    ShearedFilmParams,
)
from beardyn_core.scene.scene import Scene


def traction_params(scene: Scene) -> tuple[CoulombParams | None, MixedParams | None, FilmParams | None]:
    """Traction and film; mixed traction without a film is dry friction of the asperities."""
    traction, effects = scene.effects.traction, scene.effects
    film = None
    if effects.film is not None:
        film = FilmParams(
            viscosity=scene.lubricant.dynamic_viscosity(scene.temperature),
            pressure_viscosity=scene.lubricant.pressure_viscosity_at(scene.temperature),
            roughness=scene.bearing.raceway_roughness,
        )
    if traction is None:
        return None, None, film
    if not isinstance(traction, CoulombTraction) and film is not None:
        mixed = MixedParams(
            friction=traction.boundary_friction,
            regularisation=traction.regularisation_speed,
            film_friction=0.0 if isinstance(traction, ShearedFilmTraction) else traction.full_film_friction,
            boundary_film=traction.boundary_film_parameter,
            full_film=traction.full_film_parameter,
            sheared_film=ShearedFilmParams(traction.limiting_shear)
            if isinstance(traction, ShearedFilmTraction)
            else None,
        )
        return None, mixed, film
    friction = traction.friction if isinstance(traction, CoulombTraction) else traction.boundary_friction
    return CoulombParams(friction, traction.regularisation_speed), None, film

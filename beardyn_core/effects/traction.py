"""Friction of the raceway contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class CoulombTraction:
    """Dry friction, regularised over a slip speed.

    Parameters
    ----------
    friction : float
        Coefficient of friction at full slip.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Dry friction between rollers and raceways, smooth through zero slip.",
        states="none",
        cost="low",
        validity="Contacts without lubricant; creeps at the regularisation speed instead of sticking.",
        source="Coulomb's law with the regularisation u / sqrt(u^2 + u_r^2)",
    )

    friction: float = 0.1
    regularisation_speed: float = 0.01


@dataclass(frozen=True)
class MixedTraction:
    """Boundary and full-film friction blended over the film parameter, both regularised.

    Parameters
    ----------
    boundary_friction : float
        Coefficient of friction of the dry asperities.
    full_film_friction : float
        Coefficient of friction of the lubricant film at full slip.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    boundary_film_parameter : float
        Film parameter below which all load is carried by asperities.
    full_film_parameter : float
        Film parameter above which all load is carried by the film.
    """

    about: ClassVar[About] = About(
        adds="Raceway friction blended from boundary to full film over the film parameter.",
        states="none",
        cost="medium",
        validity="Film parameters of any size; constant coefficients, no heating of the film.",
        source="Santos (2017), Eq. 8, after Harada and Sakaguchi (2005)",
    )

    boundary_friction: float = 0.1
    full_film_friction: float = 0.02
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5


@dataclass(frozen=True)
class ShearedFilmTraction:
    """The blend of `MixedTraction` with a film that shears: Newtonian up to a limiting shear stress.

    Light contacts have almost no traction then, so the bearing can skid as a real one does.

    Parameters
    ----------
    boundary_friction, regularisation_speed, boundary_film_parameter, full_film_parameter : float
        As in `MixedTraction`.
    limiting_shear : float
        Limiting shear stress of the lubricant over the mean contact pressure.
    """

    about: ClassVar[About] = About(
        adds="The blend with a film that shears up to a limiting stress.",
        states="none",
        cost="medium",
        validity="Isothermal film at the mean Hertz pressure; light contacts may skid.",
        source="Bair and Winer (1979) for the limiting shear stress",
    )

    boundary_friction: float = 0.1
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5
    limiting_shear: float = 0.045


Traction = CoulombTraction | MixedTraction | ShearedFilmTraction

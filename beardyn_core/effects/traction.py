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
        Slip speed of the regularisation, [m/s]: 71 % of the friction is reached there by ``smooth``, 95 % by
        ``threlfall``, all by ``ambrosio``, half by ``arctangent``.
    regularisation : str
        ``smooth``, ``threlfall``, ``ambrosio`` or ``arctangent``.
    regularisation_start : float
        Slip speed below which ``ambrosio`` has no friction, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Dry friction between rollers and raceways, smooth through zero slip.",
        states="none",
        cost="low",
        validity="Contacts without lubricant; creeps at the regularisation speed instead of sticking.",
        source="Coulomb's law; u / sqrt(u^2 + u_r^2), Threlfall (1978) or Ambrosio (2003) near zero slip",
    )

    friction: float = 0.1
    regularisation_speed: float = 0.01
    regularisation: str = "smooth"
    regularisation_start: float = 0.0


@dataclass(frozen=True)
class MixedTraction:
    """Boundary and full-film friction blended over the film parameter, both regularised.

    Parameters
    ----------
    boundary_friction : float
        Coefficient of friction of the dry asperities.
    full_film_friction : float
        Coefficient of friction of the lubricant film at full slip.
    regularisation_speed, regularisation, regularisation_start : float, str, float
        As in `CoulombTraction`.
    boundary_film_parameter : float
        Film parameter below which all load is carried by asperities.
    full_film_parameter : float
        Film parameter above which all load is carried by the film.
    """

    about: ClassVar[About] = About(
        adds="Raceway friction blended from boundary to full film over the film parameter.",
        states="none",
        cost="high",
        validity="Film parameters of any size; constant coefficients, no heating of the film.",
        source="Santos (2017), Eq. 8, after Harada and Sakaguchi (2005)",
    )

    boundary_friction: float = 0.1
    full_film_friction: float = 0.02
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5
    regularisation: str = "smooth"
    regularisation_start: float = 0.0


@dataclass(frozen=True)
class ShearedFilmTraction:
    """The blend of `MixedTraction` with a film that shears: Newtonian up to a limiting shear stress.

    Light contacts have almost no traction then, so the bearing can skid as a real one does.

    Parameters
    ----------
    boundary_friction, boundary_film_parameter, full_film_parameter : float
        As in `MixedTraction`.
    regularisation_speed, regularisation, regularisation_start : float, str, float
        As in `CoulombTraction`, of the boundary friction.
    limiting_shear : float
        Limiting shear stress of the lubricant over the mean contact pressure.
    """

    about: ClassVar[About] = About(
        adds="The blend with a film that shears up to a limiting stress.",
        states="none",
        cost="high",
        validity="Isothermal film at the mean Hertz pressure; light contacts may skid.",
        source="Bair and Winer (1979) for the limiting shear stress",
    )

    boundary_friction: float = 0.1
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5
    limiting_shear: float = 0.045
    regularisation: str = "smooth"
    regularisation_start: float = 0.0


@dataclass(frozen=True)
class LoadSharingTraction:
    """Asperities and film share the load, each with its own friction.

    Parameters
    ----------
    boundary_friction : float
        Coefficient of friction of the asperities at full slip; also the most the film may have.
    boundary_slope : float
        How steeply the asperities' friction rises: argument of the arctangent over the slide-to-roll ratio.
    film_traction : str
        ``aihara`` (a fit to tests), ``eyring`` (sinh law) or ``bair_winer`` (limiting shear stress).
    largest_slide : float
        Upper limit of the slide-to-roll ratio s_max of ``aihara``, whose fit extrapolates to any size for
        thin oils and light loads.
    eyring_stress : float
        tau_0 of ``eyring``, [Pa].
    limiting_shear : float
        Limiting shear stress of ``bair_winer`` over the mean contact pressure.
    inlet_shear : bool
        Shear of the oil in the gap around the contact, which drives rollers that are hardly loaded: there it
        is many times what the small Hertzian area gives.
    """

    about: ClassVar[About] = About(
        adds="Raceway friction as a load-weighted sum of asperity friction and traction of a sheared film.",
        states="none",
        cost="high",
        validity="Isothermal film; aihara: extrapolated below 0.5 and above 2 GPa.",
        source="D-BRAIN (NSK); Aihara (1987); Johnson and Tevaarwerk (1977); Bair and Winer (1979)",
    )

    boundary_friction: float = 0.1
    boundary_slope: float = 1000.0
    film_traction: str = "aihara"
    largest_slide: float = 0.25
    eyring_stress: float = 5.0e6
    limiting_shear: float = 0.045
    inlet_shear: bool = False


Traction = CoulombTraction | MixedTraction | ShearedFilmTraction | LoadSharingTraction

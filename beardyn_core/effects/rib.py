"""Large roller end on the cone rib."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class RibMixedFilm:
    """Lubricant film of the rib that shares the load with the asperities, each with a constant coefficient.

    Parameters
    ----------
    starvation : float
        Film thickness over the fully flooded one, 0 to 1.
    boundary_friction : float
        Coefficient of friction of the asperities, 0.1 to 0.2.
    film_friction : float
        Coefficient of friction of the film, 0.002 to 0.02.
    """

    about: ClassVar[About] = About(
        adds="Film of the rib contact; its friction falls from boundary to film with the film parameter.",
        states="none",
        cost="low",
        validity="Elastohydrodynamic film, isothermal; entrainment along the ellipse is an extrapolation.",
        source="Hamrock and Dowson (1977); load sharing of Zhao et al. (2026)",
    )

    starvation: float = 0.7
    boundary_friction: float = 0.1
    film_friction: float = 0.01


@dataclass(frozen=True)
class RibShearedFilm:
    """Lubricant film of the rib that shears: Newtonian at the mean pressure up to a limiting shear stress.

    Parameters
    ----------
    starvation, boundary_friction : float
        As in `RibMixedFilm`.
    limiting_shear : float
        Limiting shear stress of the lubricant over the mean contact pressure.
    """

    about: ClassVar[About] = About(
        adds="Film of the rib contact with a friction that follows from its viscosity.",
        states="none",
        cost="low",
        validity="Elastohydrodynamic film, isothermal, at the mean Hertz pressure.",
        source="Hamrock and Dowson (1977); Bair and Winer (1979) for the limiting shear stress",
    )

    starvation: float = 0.7
    boundary_friction: float = 0.1
    limiting_shear: float = 0.045


RibLubrication = RibMixedFilm | RibShearedFilm


@dataclass(frozen=True)
class Rib:
    """Contact of the spherical large roller end with the conical cone rib.

    Parameters
    ----------
    friction : float
        Coefficient of friction of the rib contact; not used with a lubrication.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    stiffness : str
        ``fitted``: simplified elliptic integrals; ``exact``: complete elliptic integrals, 1 % apart.
    window : bool
        The face ends at the undercut and at the rib's corner; otherwise it is an unlimited cone.
    edge_radius : float
        Rounding of both edges of the face, [m].
    roller_end : bool
        The sphere ends at the rim of the roller end; otherwise it is a whole sphere.
    drilling : bool
        Friction of the spin inside the contact ellipse.
    lubrication : RibMixedFilm or RibShearedFilm or None
        Film and friction of the lubricated contact; None is dry friction.
    """

    about: ClassVar[About] = About(
        adds="Sphere-on-cone contact of the large roller end with the cone rib, its edges and its film.",
        states="none",
        cost="medium",
        validity="Elliptic Hertz contact, of the stiffness of the face also on an edge.",
        source="Hertz (1881), fit of Hamrock and Brewe (1983)",
    )

    friction: float = 0.05
    regularisation_speed: float = 0.05
    stiffness: str = "fitted"
    window: bool = True
    edge_radius: float = 0.3e-3
    roller_end: bool = False
    drilling: bool = False
    lubrication: RibLubrication | None = None

"""Roller ends on ribs: the large end of tapered rollers on the cone rib, both ends of cylinders."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import RIB_HEAT, About, SlipSpeed


@dataclass(frozen=True)
class RibMixedFilm:
    """Film and asperities of the rib share the load, each with a constant coefficient of friction."""

    kind: ClassVar[str] = "mixed"
    about: ClassVar[About] = About(
        loss="rib",
        heat=RIB_HEAT,
        adds="Film of the rib contact; its friction falls from boundary to film with the film parameter.",
        states="none",
        cost="low",
        validity="Elastohydrodynamic film, isothermal; entrainment along the ellipse is an extrapolation.",
        source="Hamrock and Dowson (1977); load sharing of Zhao et al. (2026)",
    )

    starvation: A[float, At(gt=0.0, le=1.0), "film over the fully flooded film"] = 0.7
    boundary_friction: A[float, SHARE, "coefficient of friction of the asperities, 0.1 to 0.2"] = 0.1
    film_friction: A[float, SHARE, "coefficient of friction of the film, 0.002 to 0.02"] = 0.01


@dataclass(frozen=True)
class RibShearedFilm:
    """Lubricant film of the rib that shears: Newtonian at the mean pressure up to a limiting shear stress."""

    kind: ClassVar[str] = "sheared_film"
    about: ClassVar[About] = About(
        loss="rib",
        heat=RIB_HEAT,
        adds="Film of the rib contact with a friction that follows from its viscosity.",
        states="none",
        cost="low",
        validity="Elastohydrodynamic film, isothermal, at the mean Hertz pressure.",
        source="Hamrock and Dowson (1977); Bair and Winer (1979) for the limiting shear stress",
    )

    starvation: A[float, At(gt=0.0, le=1.0), "film over the fully flooded film"] = 0.7
    boundary_friction: A[float, SHARE, "coefficient of friction of the asperities, 0.1 to 0.2"] = 0.1
    limiting_shear: A[
        float, At(gt=0.0, le=0.2), "limiting shear stress of the lubricant over the mean contact pressure"
    ] = 0.045


RibLubrication = RibMixedFilm | RibShearedFilm


@dataclass(frozen=True)
class Rib:
    """Contact of spherical roller ends with conical ribs: of the cone, with cylinders of both rings."""

    about: ClassVar[About] = About(
        loss="rib",
        heat=RIB_HEAT,
        adds="Sphere-on-cone contact of the large roller end with the cone rib, of cylinders with the ribs "
        "of both rings, with edges and film.",
        states="none",
        cost="medium",
        validity="Elliptic Hertz contact, of the stiffness of the face also on an edge.",
        bearings=("tapered", "cylindrical"),
        source="Hertz (1881), fit of Hamrock and Brewe (1983)",
    )

    friction: A[float, SHARE, "without a lubrication"] = 0.05
    regularisation_speed: SlipSpeed = 0.05
    stiffness: A[
        str, At(one_of=("fitted", "exact")), "elliptic integrals of the contact; of cylinders always exact"
    ] = "fitted"
    window: A[bool, "the face ends at the undercut and at the rib's corner"] = True
    edge_radius: A[float, At("mm", gt=0.0, le=2.0), "rounding of both edges of the face"] = 0.3e-3
    roller_end: A[bool, "the sphere ends at the rim of the roller end, which carries beyond it"] = True
    drilling: A[bool, "friction of the spin inside the contact ellipse"] = False
    lubrication: A[RibLubrication | None, "nothing: dry friction"] = None

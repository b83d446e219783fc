"""Friction of the raceway contacts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import RACEWAY_HEAT, About

REGULARISATIONS = ("smooth", "threlfall", "ambrosio", "arctangent")

RegularisationSpeed = A[
    float,
    At("m_per_s", gt=0.0),
    "slip speed at which smooth has 71 % of its friction, threlfall 95 %, ambrosio all, arctangent half",
]
Regularisation = A[str, At(one_of=REGULARISATIONS), "law of dry friction below the regularisation speed"]
RegularisationStart = A[float, At("m_per_s", ge=0.0), "slip speed below which ambrosio has no friction"]
BoundaryFriction = A[float, SHARE, "coefficient of friction of the asperities"]
BoundaryFilmParameter = A[float, At(ge=0.0), "film parameter below which asperities carry all load"]
FullFilmParameter = A[float, At(gt=0.0), "film parameter above which the film carries all load"]


@dataclass(frozen=True)
class CoulombTraction:
    """Dry friction, regularised over a slip speed."""

    kind: ClassVar[str] = "coulomb"
    about: ClassVar[About] = About(
        loss="raceway_sliding",
        heat=RACEWAY_HEAT,
        adds="Dry friction between rollers and raceways, smooth through zero slip.",
        states="none",
        cost="low",
        validity="Contacts without lubricant; creeps at the regularisation speed instead of sticking.",
        source="Coulomb's law; u / sqrt(u^2 + u_r^2), Threlfall (1978) or Ambrosio (2003) near zero slip",
    )

    friction: A[float, SHARE, "coefficient of friction at full slip"] = 0.1
    regularisation_speed: RegularisationSpeed = 0.01
    regularisation: Regularisation = "smooth"
    regularisation_start: RegularisationStart = 0.0

    def rules(self) -> Iterator[str]:
        """Check the options against each other."""
        return _mistakes(self)


@dataclass(frozen=True)
class MixedTraction:
    """Boundary and full-film friction blended over the film parameter, both regularised."""

    kind: ClassVar[str] = "mixed"
    about: ClassVar[About] = About(
        loss="raceway_sliding",
        heat=RACEWAY_HEAT,
        adds="Raceway friction blended from boundary to full film over the film parameter.",
        states="none",
        cost="high",
        validity="Film parameters of any size; constant coefficients, no heating of the film.",
        source="Santos (2017), Eq. 8, after Harada and Sakaguchi (2005)",
    )

    boundary_friction: BoundaryFriction = 0.1
    full_film_friction: A[float, SHARE, "coefficient of friction of the film at full slip"] = 0.02
    regularisation_speed: RegularisationSpeed = 0.02
    boundary_film_parameter: BoundaryFilmParameter = 0.01
    full_film_parameter: FullFilmParameter = 1.5
    regularisation: Regularisation = "smooth"
    regularisation_start: RegularisationStart = 0.0

    def rules(self) -> Iterator[str]:
        """Check the options against each other."""
        return _mistakes(self)


@dataclass(frozen=True)
class ShearedFilmTraction:
    """The blend of `MixedTraction` with a film that shears: Newtonian up to a limiting shear stress.

    Light contacts have almost no traction then, so the bearing can skid as a real one does.
    """

    kind: ClassVar[str] = "sheared_film"
    about: ClassVar[About] = About(
        loss="raceway_sliding",
        heat=RACEWAY_HEAT,
        adds="The blend with a film that shears up to a limiting stress.",
        states="none",
        cost="high",
        validity="Isothermal film at the mean Hertz pressure; light contacts may skid.",
        source="Bair and Winer (1979) for the limiting shear stress",
    )

    boundary_friction: BoundaryFriction = 0.1
    regularisation_speed: RegularisationSpeed = 0.02
    boundary_film_parameter: BoundaryFilmParameter = 0.01
    full_film_parameter: FullFilmParameter = 1.5
    limiting_shear: A[
        float, At(gt=0.0, le=0.2), "limiting shear stress of the lubricant over the mean contact pressure"
    ] = 0.045
    regularisation: Regularisation = "smooth"
    regularisation_start: RegularisationStart = 0.0

    def rules(self) -> Iterator[str]:
        """Check the options against each other."""
        return _mistakes(self)


@dataclass(frozen=True)
class LoadSharingTraction:
    """Asperities and film share the load, each with its own friction."""

    kind: ClassVar[str] = "load_sharing"
    about: ClassVar[About] = About(
        loss="raceway_sliding",
        heat=RACEWAY_HEAT,
        adds="Raceway friction as a load-weighted sum of asperity friction and traction of a sheared film.",
        states="none",
        cost="high",
        validity="Isothermal film; aihara from 0.5 to 2 GPa, below that towards bair_winer.",
        source="D-BRAIN (NSK); Aihara (1987); Johnson and Tevaarwerk (1977); Bair and Winer (1979)",
    )

    boundary_friction: BoundaryFriction = 0.1
    boundary_slope: A[
        float, At(gt=0.0), "steepness of the asperities' friction over slip per entrainment speed"
    ] = 1000.0
    film_traction: A[
        str,
        At(one_of=("aihara", "eyring", "bair_winer")),
        "a fit to tests (limiting shear stress below its pressures), a sinh law, or a limiting shear stress",
    ] = "aihara"
    largest_slide: A[float, At(gt=0.0, le=1.0), "upper limit of s_max of aihara"] = 0.25
    eyring_stress: A[float, At("MPa", gt=0.0), "tau_0 of eyring"] = 5.0e6
    limiting_shear: A[
        float,
        At(gt=0.0, le=0.2),
        "of bair_winer, and of aihara below its pressures, over the mean contact pressure",
    ] = 0.045
    inlet_shear: A[bool, "shear of the oil around the contact as well"] = True


Traction = CoulombTraction | MixedTraction | ShearedFilmTraction | LoadSharingTraction


def _mistakes(dry: CoulombTraction | MixedTraction | ShearedFilmTraction) -> Iterator[str]:
    """Check that the regularisation starts below its speed, and that the film parameters ascend."""
    start, full = dry.regularisation_start, dry.regularisation_speed
    if start > 0.0 and dry.regularisation != "ambrosio":
        yield (
            f"regularisation_start_m_per_s is {start:g}; only the regularisation ambrosio has one, "
            f"{dry.regularisation} starts at 0"
        )
    elif start >= full:
        yield (
            f"regularisation_start_m_per_s is {start:g}; it must be less than "
            f"regularisation_speed_m_per_s, {full:g}"
        )
    if not isinstance(dry, CoulombTraction) and dry.boundary_film_parameter >= dry.full_film_parameter:
        yield (
            f"boundary_film_parameter is {dry.boundary_film_parameter:g}; it must be less than "
            f"full_film_parameter, {dry.full_film_parameter:g}"
        )

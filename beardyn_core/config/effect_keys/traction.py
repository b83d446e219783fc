"""Keys of an effect: friction of the raceway contacts."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
    Friction,
    NonNegative,
    Positive,
    kind_tag,
    problem,
)
from beardyn_core.config.units import MEGA
from beardyn_core.effects import CoulombTraction, LoadSharingTraction, MixedTraction, ShearedFilmTraction


class _DryKeys(FileModel):
    """How dry friction passes through zero slip."""

    regularisation_speed_m_per_s: Positive
    regularisation: Literal["smooth", "threlfall", "ambrosio", "arctangent"] = Field(
        "smooth", description="law of dry friction below the regularisation speed"
    )
    regularisation_start_m_per_s: NonNegative = Field(
        CoulombTraction.regularisation_start, description="slip speed below which ambrosio has no friction"
    )

    @model_validator(mode="after")
    def _starts_before_full(self) -> Self:
        start, full = self.regularisation_start_m_per_s, self.regularisation_speed_m_per_s
        if start > 0.0 and self.regularisation != "ambrosio":
            raise problem(
                f"regularisation_start_m_per_s is {start:g}; only the regularisation ambrosio has one, "
                f"{self.regularisation} starts at 0"
            )
        if start >= full:
            raise problem(
                f"regularisation_start_m_per_s is {start:g}; it must be less than "
                f"regularisation_speed_m_per_s, {full:g}"
            )
        return self

    def regularised(self) -> dict[str, Any]:
        """The shared options, SI."""
        return {
            "regularisation_speed": self.regularisation_speed_m_per_s,
            "regularisation": self.regularisation,
            "regularisation_start": self.regularisation_start_m_per_s,
        }


class CoulombTractionKeys(_DryKeys):
    """Dry friction."""

    kind: Literal["coulomb"]
    friction: Friction = CoulombTraction.friction
    regularisation_speed_m_per_s: Positive = CoulombTraction.regularisation_speed

    def noun(self) -> CoulombTraction:
        """The coulomb traction, SI."""
        return CoulombTraction(friction=self.friction, **self.regularised())


class _BlendKeys(_DryKeys):
    """What the blended tractions share."""

    boundary_friction: Friction = MixedTraction.boundary_friction
    regularisation_speed_m_per_s: Positive = MixedTraction.regularisation_speed
    boundary_film_parameter: NonNegative = MixedTraction.boundary_film_parameter
    full_film_parameter: Positive = MixedTraction.full_film_parameter

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.boundary_film_parameter >= self.full_film_parameter:
            raise problem(
                f"boundary_film_parameter is {self.boundary_film_parameter:g}; it must be less than "
                f"full_film_parameter, {self.full_film_parameter:g}"
            )
        return self

    def shared(self) -> dict[str, Any]:
        """The shared options, SI."""
        return {
            "boundary_friction": self.boundary_friction,
            **self.regularised(),
            "boundary_film_parameter": self.boundary_film_parameter,
            "full_film_parameter": self.full_film_parameter,
        }


class MixedTractionKeys(_BlendKeys):
    """Boundary and full-film friction blended over the film parameter."""

    kind: Literal["mixed"]
    full_film_friction: Friction = MixedTraction.full_film_friction

    def noun(self) -> MixedTraction:
        """The mixed traction, SI."""
        return MixedTraction(full_film_friction=self.full_film_friction, **self.shared())


class ShearedFilmTractionKeys(_BlendKeys):
    """The blend with a film that shears up to a limiting stress: light contacts may skid."""

    kind: Literal["sheared_film"]
    limiting_shear: Annotated[Positive, Field(le=0.2)] = ShearedFilmTraction.limiting_shear

    def noun(self) -> ShearedFilmTraction:
        """The sheared-film traction, SI."""
        return ShearedFilmTraction(limiting_shear=self.limiting_shear, **self.shared())


class LoadSharingTractionKeys(FileModel):
    """Asperities and film share the load, each with its own friction."""

    kind: Literal["load_sharing"]
    boundary_friction: Friction = LoadSharingTraction.boundary_friction
    boundary_slope: Positive = Field(
        LoadSharingTraction.boundary_slope,
        description="steepness of the asperities' friction over slip per entrainment speed",
    )
    film_traction: Literal["aihara", "eyring", "bair_winer"] = Field(
        "aihara", description="a fit to tests, a sinh law, or a limiting shear stress"
    )
    largest_slide: Annotated[Fraction, Field(gt=0.0)] = Field(
        LoadSharingTraction.largest_slide, description="upper limit of s_max of aihara"
    )
    eyring_stress_MPa: Positive = Field(
        LoadSharingTraction.eyring_stress / MEGA, description="tau_0 of eyring"
    )
    limiting_shear: Annotated[Positive, Field(le=0.2)] = Field(
        LoadSharingTraction.limiting_shear, description="of bair_winer, over the mean contact pressure"
    )
    inlet_shear: bool = Field(
        LoadSharingTraction.inlet_shear, description="shear of the oil around the contact as well"
    )

    def noun(self) -> LoadSharingTraction:
        """The load-sharing traction, SI."""
        return LoadSharingTraction(
            boundary_friction=self.boundary_friction,
            boundary_slope=self.boundary_slope,
            film_traction=self.film_traction,
            largest_slide=self.largest_slide,
            eyring_stress=self.eyring_stress_MPa * MEGA,
            limiting_shear=self.limiting_shear,
            inlet_shear=self.inlet_shear,
        )


Traction = Annotated[
    Annotated[CoulombTractionKeys, Tag("<coulomb>")]
    | Annotated[MixedTractionKeys, Tag("<mixed>")]
    | Annotated[ShearedFilmTractionKeys, Tag("<sheared_film>")]
    | Annotated[LoadSharingTractionKeys, Tag("<load_sharing>")],
    Discriminator(kind_tag),
]

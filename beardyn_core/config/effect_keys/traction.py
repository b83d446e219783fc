"""Keys of an effect: friction of the raceway contacts."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, model_validator
from typing_extensions import Self

from beardyn_core.config.file_model import (
    FileModel,
    Friction,
    NonNegative,
    Positive,
    kind_tag,
    problem,
)
from beardyn_core.effects import CoulombTraction, MixedTraction, ShearedFilmTraction


class CoulombTractionKeys(FileModel):
    """Dry friction."""

    kind: Literal["coulomb"]
    friction: Friction = CoulombTraction.friction
    regularisation_speed_m_per_s: Positive = CoulombTraction.regularisation_speed

    def noun(self) -> CoulombTraction:
        """The coulomb traction, SI."""
        return CoulombTraction(friction=self.friction, regularisation_speed=self.regularisation_speed_m_per_s)


class _BlendKeys(FileModel):
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

    def shared(self) -> dict[str, float]:
        """The shared options, SI."""
        return {
            "boundary_friction": self.boundary_friction,
            "regularisation_speed": self.regularisation_speed_m_per_s,
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


Traction = Annotated[
    Annotated[CoulombTractionKeys, Tag("<coulomb>")]
    | Annotated[MixedTractionKeys, Tag("<mixed>")]
    | Annotated[ShearedFilmTractionKeys, Tag("<sheared_film>")],
    Discriminator(kind_tag),
]

"""Keys of an effect: large roller end on the cone rib."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
    Friction,
    Positive,
    kind_tag,
)
from beardyn_core.config.units import MM
from beardyn_core.effects import Rib, RibMixedFilm, RibShearedFilm


class _RibFilmKeys(FileModel):
    """What the lubrications of the rib share."""

    starvation: Annotated[Fraction, Field(gt=0.0)] = Field(
        RibMixedFilm.starvation, description="film over the fully flooded film"
    )
    boundary_friction: Friction = RibMixedFilm.boundary_friction


class RibMixedFilmKeys(_RibFilmKeys):
    """Film and asperities of the rib share the load, each with a constant coefficient of friction."""

    kind: Literal["mixed"]
    film_friction: Friction = RibMixedFilm.film_friction

    def noun(self) -> RibMixedFilm:
        """The lubrication, SI."""
        return RibMixedFilm(self.starvation, self.boundary_friction, self.film_friction)


class RibShearedFilmKeys(_RibFilmKeys):
    """The film of the rib shears up to a limiting stress."""

    kind: Literal["sheared_film"]
    limiting_shear: Annotated[Positive, Field(le=0.2)] = RibShearedFilm.limiting_shear

    def noun(self) -> RibShearedFilm:
        """The lubrication, SI."""
        return RibShearedFilm(self.starvation, self.boundary_friction, self.limiting_shear)


RibLubrication = Annotated[
    Annotated[RibMixedFilmKeys, Tag("<mixed>")] | Annotated[RibShearedFilmKeys, Tag("<sheared_film>")],
    Discriminator(kind_tag),
]


Truth = Annotated[bool, Field(strict=True)]


class RibKeys(FileModel):
    """Contact of the large roller end with the cone rib."""

    friction: Friction = Field(Rib.friction, description="without a lubrication")
    regularisation_speed_m_per_s: Positive = Rib.regularisation_speed
    stiffness: Literal["fitted", "exact"] = Field("fitted", description="elliptic integrals of the contact")
    window: Truth = Field(Rib.window, description="the face ends at the undercut and at the rib's corner")
    edge_radius_mm: Annotated[Positive, Field(le=2.0)] = Rib.edge_radius * MM
    roller_end: Truth = Field(Rib.roller_end, description="the sphere ends at the rim of the roller end")
    drilling: Truth = Field(Rib.drilling, description="friction of the spin inside the contact ellipse")
    lubrication: RibLubrication | None = Field(None, description="nothing: dry friction")

    def noun(self) -> Rib:
        """The rib, SI."""
        return Rib(
            friction=self.friction,
            regularisation_speed=self.regularisation_speed_m_per_s,
            stiffness=self.stiffness,
            window=self.window,
            edge_radius=self.edge_radius_mm / MM,
            roller_end=self.roller_end,
            drilling=self.drilling,
            lubrication=None if self.lubrication is None else self.lubrication.noun(),
        )

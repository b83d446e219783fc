"""Which effects a scene simulates, and their options."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator
from typing_extensions import Self

from beardyn_core.config.file_model import (
    FileModel,
    Fraction,
    Name,
    NonNegative,
    Positive,
    Switch,
    Text,
    kind_tag,
    problem,
)
from beardyn_core.config.units import US
from beardyn_core.effects import (
    Audit,
    Cage,
    ContactDamping,
    CoulombTraction,
    EffectSet,
    Gravity,
    LineFilm,
    MixedTraction,
    Rib,
    ShearedFilmTraction,
)

Friction = Annotated[NonNegative, Field(le=1.0)]


class ContactDampingKeys(FileModel):
    """Velocity-proportional loss of raceway and rib contacts."""

    time_constant_us: Annotated[Positive, Field(le=1000.0)] = ContactDamping.time_constant * US

    def noun(self) -> ContactDamping:
        """The contact damping, SI."""
        return ContactDamping(time_constant=self.time_constant_us / US)


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


class LineFilmKeys(FileModel):
    """Elastohydrodynamic film of the raceway contacts."""

    starvation: Annotated[Fraction, Field(gt=0.0)] = Field(
        0.7, description="film over the fully flooded film"
    )

    def noun(self) -> LineFilm:
        """The line film, SI."""
        return LineFilm(starvation=self.starvation)


class RibKeys(FileModel):
    """Contact of the large roller end with the cone rib."""

    friction: Friction = Rib.friction
    regularisation_speed_m_per_s: Positive = Rib.regularisation_speed

    def noun(self) -> Rib:
        """The rib, SI."""
        return Rib(friction=self.friction, regularisation_speed=self.regularisation_speed_m_per_s)


class CageEffectKeys(FileModel):
    """Cage of each row, touched by every roller in its pocket."""

    friction: Friction = Cage.friction
    regularisation_speed_m_per_s: Positive = Cage.regularisation_speed
    bar_inclination_deg: Annotated[NonNegative, Field(lt=90.0)] = Field(
        math.degrees(Cage.bar_inclination), description="of the bar faces against the radial plane"
    )
    initial_speed_ratio: Annotated[NonNegative, Field(le=2.0)] = Field(
        Cage.initial_speed_ratio, description="speed of cages and rollers at the start over the kinematic one"
    )

    def noun(self) -> Cage:
        """The cage, SI."""
        return Cage(
            friction=self.friction,
            regularisation_speed=self.regularisation_speed_m_per_s,
            bar_inclination=math.radians(self.bar_inclination_deg),
            initial_speed_ratio=self.initial_speed_ratio,
        )


class GravityKeys(FileModel):
    """Weight of rollers, cages and axlebox."""

    acceleration_m_per_s2: NonNegative = Gravity.acceleration

    def noun(self) -> Gravity:
        """The gravity, SI."""
        return Gravity(acceleration=self.acceleration_m_per_s2)


class AuditKeys(FileModel):
    """Energy balance kept while the model runs."""

    def noun(self) -> Audit:
        """The audit, SI."""
        return Audit()


Traction = Annotated[
    Annotated[CoulombTractionKeys, Tag("<coulomb>")]
    | Annotated[MixedTractionKeys, Tag("<mixed>")]
    | Annotated[ShearedFilmTractionKeys, Tag("<sheared_film>")],
    Discriminator(kind_tag),
]

_SWITCHED: dict[bool, Any] = {True: {}, False: None}


class EffectsKeys(FileModel):
    """The effects of a scene: options, `true` for the usual ones, `false` or nothing for absent."""

    name: Name = "custom"
    purpose: Text = ""
    preset: Name | None = Field(None, description="set to start from; the keys given here change it")
    contact_damping: Switch[ContactDampingKeys] = False
    traction: Traction | None = None
    film: Switch[LineFilmKeys] = False
    rib: Switch[RibKeys] = False
    cage: Switch[CageEffectKeys] = False
    gravity: Switch[GravityKeys] = False
    audit: Switch[AuditKeys] = False

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        # Written out, so that a recorded scene says every number.
        return {
            key: _SWITCHED.get(value, value) if isinstance(value, bool) else value
            for key, value in data.items()
        }

    def noun(self) -> EffectSet:
        """The effect set, SI."""
        return EffectSet(
            **{name: None if given is None else given.noun() for name, given in self._members().items()}
        )

    def _members(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) or None for field in fields(EffectSet)}


def overlay(preset: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Effects of a preset with some changed: named options replace those of the preset, the rest stays."""
    merged = dict(preset)
    for key, change in changes.items():
        base = preset.get(key)
        if (
            isinstance(change, dict)
            and isinstance(base, dict)
            and change.get("kind", base.get("kind")) == base.get("kind")
        ):
            merged[key] = {**base, **change}
        elif change is True and isinstance(base, dict):
            merged[key] = base
        else:
            merged[key] = change
    return merged

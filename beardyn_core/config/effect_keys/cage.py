"""Keys of an effect: cage of each row."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from beardyn_core.config.file_model import (
    FileModel,
    Friction,
    NonNegative,
    Number,
    Positive,
    Switch,
    kind_tag,
)
from beardyn_core.config.units import MEGA, MM, UM
from beardyn_core.effects import Cage, KinematicCage, LandGuidance, PocketFilm, RotatingCage

SpeedRatio = Annotated[NonNegative, Field(le=2.0)]


class PocketFilmKeys(FileModel):
    """Lubricant between the rollers and the bars of their pockets."""

    switch_thickness_um: Annotated[Positive, Field(le=100.0)] = Field(
        PocketFilm.switch_thickness * UM, description="below it the pocket's stiffness carries"
    )
    layer_um: Annotated[Positive, Field(le=2000.0)] = Field(
        PocketFilm.layer * UM, description="of lubricant on the faces; wider gaps are not bridged"
    )

    def noun(self) -> PocketFilm:
        """The pocket film, SI."""
        return PocketFilm(switch_thickness=self.switch_thickness_um / UM, layer=self.layer_um / UM)


class LandGuidanceKeys(FileModel):
    """Land of each cage in a cylinder of cup or cone."""

    on: Literal["cup", "cone"] = LandGuidance.on
    clearance_mm: Positive = Field(LandGuidance.clearance * MM, description="radial")
    land_width_mm: Positive = LandGuidance.land_width * MM
    land_diameter_mm: Positive | None = Field(
        None, description="pitch diameter and half a roller diameter more (cup) or less (cone) if not given"
    )
    land_offset_mm: Number | None = Field(
        None, description="outward from the cage's centre; above the large roller ends if not given"
    )
    friction: Friction = LandGuidance.friction
    regularisation_speed_m_per_s: Positive = LandGuidance.regularisation_speed

    def noun(self) -> LandGuidance:
        """The land guidance, SI."""
        return LandGuidance(
            on=self.on,
            clearance=self.clearance_mm / MM,
            land_width=self.land_width_mm / MM,
            land_diameter=None if self.land_diameter_mm is None else self.land_diameter_mm / MM,
            land_offset=None if self.land_offset_mm is None else self.land_offset_mm / MM,
            friction=self.friction,
            regularisation_speed=self.regularisation_speed_m_per_s,
        )


class _PocketKeys(FileModel):
    """What cages with pockets share."""

    friction: Friction = Cage.friction
    regularisation_speed_m_per_s: Positive = Cage.regularisation_speed
    initial_speed_ratio: SpeedRatio = Field(
        Cage.initial_speed_ratio, description="speed of cages and rollers at the start over the kinematic one"
    )
    pocket_wear_mm: Annotated[NonNegative, Field(le=5.0)] = Field(
        Cage.pocket_wear * MM, description="added to the circumferential clearance of every pocket"
    )

    def shared(self) -> dict[str, float]:
        """The shared options, SI."""
        return {
            "friction": self.friction,
            "regularisation_speed": self.regularisation_speed_m_per_s,
            "initial_speed_ratio": self.initial_speed_ratio,
            "pocket_wear": self.pocket_wear_mm / MM,
        }


class CageEffectKeys(_PocketKeys):
    """Cage of each row, free to move, touched by every roller in its pocket."""

    kind: Literal["six_dof"] = "six_dof"
    bar_inclination_deg: Annotated[NonNegative, Field(lt=90.0)] = Field(
        math.degrees(Cage.bar_inclination), description="of the bar faces against the radial plane"
    )
    lubrication: Switch[PocketFilmKeys] = False
    guidance: Switch[LandGuidanceKeys] = False

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        # Written out, so that a recorded scene says every number.
        return {
            key: {} if key in ("lubrication", "guidance") and value is True else value
            for key, value in data.items()
        }

    def noun(self) -> Cage:
        """The cage, SI."""
        return Cage(
            bar_inclination=math.radians(self.bar_inclination_deg),
            lubrication=self.lubrication.noun() if isinstance(self.lubrication, PocketFilmKeys) else None,
            guidance=self.guidance.noun() if isinstance(self.guidance, LandGuidanceKeys) else None,
            **self.shared(),
        )


class RotatingCageKeys(_PocketKeys):
    """Cage of each row that turns and otherwise stays between cup and cone."""

    kind: Literal["rotating"]

    def noun(self) -> RotatingCage:
        """The rotating cage, SI."""
        return RotatingCage(**self.shared())


class KinematicCageKeys(FileModel):
    """Cage of each row at a prescribed speed, to which weak springs hold the rollers."""

    kind: Literal["kinematic"]
    speed_ratio: SpeedRatio = Field(
        KinematicCage.speed_ratio, description="of the cage over that of rolling without slip"
    )
    stiffness_MN_per_m: Annotated[Positive, Field(le=10.0)] = Field(
        KinematicCage.stiffness / MEGA, description="along the pitch circle, of one roller"
    )
    damping_N_s_per_m: Annotated[NonNegative, Field(le=1000.0)] = Field(
        KinematicCage.damping, description="along the pitch circle, of one roller"
    )

    def noun(self) -> KinematicCage:
        """The kinematic cage, SI."""
        return KinematicCage(
            speed_ratio=self.speed_ratio,
            stiffness=self.stiffness_MN_per_m * MEGA,
            damping=self.damping_N_s_per_m,
        )


def _tag(value: Any) -> str | None:
    """A switch, or the kind that is given, or the free cage."""
    if value is None or isinstance(value, bool):
        return "<switch>"
    if isinstance(value, dict) and "kind" not in value:
        return "<six_dof>"
    return kind_tag(value)


CageSwitch = Annotated[
    Annotated[bool | None, Tag("<switch>")]
    | Annotated[CageEffectKeys, Tag("<six_dof>")]
    | Annotated[RotatingCageKeys, Tag("<rotating>")]
    | Annotated[KinematicCageKeys, Tag("<kinematic>")],
    Discriminator(_tag),
]

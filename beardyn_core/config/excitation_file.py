"""Defects of wheel and rail as written under an operation."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, model_validator
from typing_extensions import Self

from beardyn_core.config.file_model import (
    Count,
    FileModel,
    NonNegative,
    Number,
    Positive,
    kind_tag,
    problem,
)
from beardyn_core.config.units import DEG, MM, MRAD, UM
from beardyn_core.scene.excitation import Corrugation, DippedJoint, WheelFlat, WheelPolygon

Amplitude = Annotated[NonNegative, Field(le=2000.0)]


class WheelFlatKeys(FileModel):
    """A spot of the running surface ground flat by a sliding wheel."""

    kind: Literal["flat"]
    shape: Literal["fresh", "rounded"] = Field(
        "fresh", description="a chord with sharp ends, or rolled round (haversine)"
    )
    length_mm: Annotated[Positive, Field(ge=1.0, le=150.0)] = Field(
        description="along the circumference; of a rounded flat with its rounded ends"
    )
    depth_mm: NonNegative | None = Field(
        None, description="L^2 / (8 R) of a fresh, L^2 / (16 R) of a rounded flat when not given"
    )
    azimuth_deg: Number = Field(
        0.0, description="of its middle, from +z (the top) towards +x (forward) at the start of the run"
    )

    def contradictions(self, wheel_diameter_mm: float) -> list[str]:
        """What of this flat does not fit the wheel; key, value and what is allowed."""
        found = self.noun().contradiction(0.5 * wheel_diameter_mm / MM)
        return [f"depth_mm is {self.depth_mm:g}; {found}"] if found else []

    def noun(self) -> WheelFlat:
        """The flat, SI."""
        depth = None if self.depth_mm is None else self.depth_mm / MM
        return WheelFlat(self.length_mm / MM, depth, self.shape, self.azimuth_deg * DEG)


class WheelPolygonKeys(FileModel):
    """A wheel that is out of round with a number of waves around its circumference."""

    kind: Literal["polygon"]
    order: Annotated[Count, Field(ge=1, le=100)] = Field(description="waves per circumference")
    amplitude_um: Amplitude = Field(description="about the mean radius, half of valley to crest")
    azimuth_deg: Number = Field(0.0, description="of a crest, from +z towards +x at the start of the run")

    def contradictions(self, wheel_diameter_mm: float) -> list[str]:
        """What of this polygon does not fit the wheel; key, value and what is allowed."""
        found = self.noun().contradiction(0.5 * wheel_diameter_mm / MM)
        return [f"order is {self.order}; {found}"] if found else []

    def noun(self) -> WheelPolygon:
        """The polygon, SI."""
        return WheelPolygon(self.order, self.amplitude_um / UM, self.azimuth_deg * DEG)


class DippedJointKeys(FileModel):
    """A joint or weld whose two rail ends hang down and meet in a kink."""

    kind: Literal["dipped_joint"]
    position_m: Annotated[NonNegative, Field(le=1e6)] = Field(
        description="of the kink, from the start of the run"
    )
    angle_mrad: Annotated[NonNegative, Field(le=50.0)] = Field(
        description="between the two rail ends, twice the slope of each"
    )
    length_m: Annotated[Positive, Field(ge=0.05, le=5.0)] = Field(
        1.0, description="of the dip, both sides together"
    )
    spacing_m: Positive | None = Field(None, description="to the next such joint; only one when not given")

    @model_validator(mode="after")
    def _apart(self) -> Self:
        if self.spacing_m is not None and self.spacing_m < self.length_m:
            raise problem(f"spacing_m is {self.spacing_m:g}; it must be at least length_m, {self.length_m:g}")
        return self

    def noun(self) -> DippedJoint:
        """The joint, SI."""
        return DippedJoint(self.position_m, self.angle_mrad / MRAD, self.length_m, self.spacing_m)


class CorrugationKeys(FileModel):
    """Waves of one length on a stretch of rail."""

    kind: Literal["corrugation"]
    wavelength_mm: Annotated[Positive, Field(ge=20.0, le=2000.0)]
    amplitude_um: Amplitude = Field(description="about the mean, half of valley to crest")
    from_m: Annotated[NonNegative, Field(le=1e6)] = Field(0.0, description="from the start of the run")
    to_m: Positive | None = Field(None, description="to the end of the run when not given")

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        shortest_m = 4.0 * self.wavelength_mm / MM
        if self.to_m is not None and self.to_m < self.from_m + shortest_m:
            raise problem(
                f"to_m is {self.to_m:g}; it must be at least four waves behind from_m, "
                f"{self.from_m + shortest_m:g}"
            )
        return self

    def noun(self) -> Corrugation:
        """The corrugation, SI."""
        end = math.inf if self.to_m is None else self.to_m
        return Corrugation(self.wavelength_mm / MM, self.amplitude_um / UM, self.from_m, end)


WheelDefectKeys = Annotated[
    Annotated[WheelFlatKeys, Tag("<flat>")] | Annotated[WheelPolygonKeys, Tag("<polygon>")],
    Discriminator(kind_tag),
]
RailDefectKeys = Annotated[
    Annotated[DippedJointKeys, Tag("<dipped_joint>")] | Annotated[CorrugationKeys, Tag("<corrugation>")],
    Discriminator(kind_tag),
]

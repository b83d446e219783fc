"""Irregularity of the rail, and defects of wheel and rail, as written under an operation."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from beardyn_core.config.file_model import (
    Count,
    FileModel,
    NonNegative,
    Number,
    Positive,
    Text,
    kind_tag,
    problem,
)
from beardyn_core.config.units import DEG, MM, MRAD, UM
from beardyn_core.scene.excitation import (
    Corrugation,
    Crossing,
    DippedJoint,
    DippedWeld,
    WheelFlat,
    WheelOutOfRound,
    WheelPolygon,
)
from beardyn_core.scene.irregularity import MEASURED, Irregularity

Amplitude = Annotated[NonNegative, Field(le=2000.0)]
TrackPosition = Annotated[NonNegative, Field(le=1e6)]


class IrregularityKeys(FileModel):
    """Irregularity of the rail, vertical and, where its source has one, lateral."""

    kind: Literal[
        "german_low",
        "german_high",
        "fra_1",
        "fra_2",
        "fra_3",
        "fra_4",
        "fra_5",
        "fra_6",
        "sncf_good",
        "sncf_bad",
        "china_ballastless",
        "csv",
        "density_csv",
        "none",
    ] = Field("german_low", description="a spectrum by name, or a file of a profile or of a density")
    shortest_wavelength_m: Annotated[Positive, Field(ge=0.02, le=50.0)] = 0.1
    longest_wavelength_m: Annotated[Positive, Field(ge=1.0, le=1000.0)] = 150.0
    short_waves: Literal["iso_3095"] | None = Field(
        None, description="rail roughness between 1 cm and 0.5 m, at least that of the limit for test tracks"
    )
    path: Text | None = Field(
        None,
        description="of a kind from a file, relative to the scene file; columns distance_m, vertical_mm and "
        "perhaps lateral_mm, or wavelength_m, vertical_mm2_m and perhaps lateral_mm2_m",
    )

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.shortest_wavelength_m >= self.longest_wavelength_m:
            raise problem(
                f"shortest_wavelength_m is {self.shortest_wavelength_m:g}; it must be less than "
                f"longest_wavelength_m, {self.longest_wavelength_m:g}"
            )
        return self

    @model_validator(mode="after")
    def _file_where_it_belongs(self) -> Self:
        if self.kind in MEASURED and self.path is None:
            raise problem(f"path is missing; kind {self.kind!r} needs the path of a CSV file")
        if self.kind not in MEASURED and self.path is not None:
            raise problem(f"path is {self.path!r}; it goes with kind {' or '.join(map(repr, MEASURED))}")
        return self

    def noun(self) -> Irregularity:
        """The irregularity, SI."""
        return Irregularity(
            self.kind,
            self.shortest_wavelength_m,
            self.longest_wavelength_m,
            self.short_waves,
            None if self.path is None else Path(self.path),
        )


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


class WheelOutOfRoundKeys(FileModel):
    """A wheel with a whole spectrum of waves, as a roundness measurement gives it."""

    kind: Literal["out_of_round"]
    amplitudes_um: Annotated[tuple[Amplitude, ...], Field(min_length=1, max_length=100)] = Field(
        description="of the orders 1, 2, 3 ..., about the mean radius"
    )
    seed: Annotated[Count, Field(ge=0, le=2**32 - 1)] = Field(1, description="of the azimuths of the waves")

    def contradictions(self, wheel_diameter_mm: float) -> list[str]:
        """What of this wheel does not fit; key, value and what is allowed."""
        found = self.noun().contradiction(0.5 * wheel_diameter_mm / MM)
        return [f"amplitudes_um has {len(self.amplitudes_um)} orders; {found}"] if found else []

    def noun(self) -> WheelOutOfRound:
        """The waves, SI."""
        return WheelOutOfRound(tuple(amplitude / UM for amplitude in self.amplitudes_um), self.seed)


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


class DippedWeldKeys(FileModel):
    """A weld that has sunk: a long smooth hollow, and perhaps a short one in its middle."""

    kind: Literal["dipped_weld"]
    position_m: TrackPosition = Field(description="of its middle, from the start of the run")
    depth_mm: Annotated[NonNegative, Field(le=5.0)]
    length_m: Annotated[Positive, Field(ge=0.2, le=5.0)] = 1.0
    short_depth_mm: Annotated[NonNegative, Field(le=1.0)] = Field(
        0.0, description="of the short hollow in its middle, which adds to it"
    )
    short_length_m: Annotated[Positive, Field(ge=0.05, le=1.0)] = 0.1
    spacing_m: Positive | None = Field(None, description="to the next such weld; only one when not given")

    @model_validator(mode="after")
    def _apart(self) -> Self:
        if self.spacing_m is not None and self.spacing_m < self.length_m:
            raise problem(f"spacing_m is {self.spacing_m:g}; it must be at least length_m, {self.length_m:g}")
        if self.short_length_m > self.length_m:
            raise problem(
                f"short_length_m is {self.short_length_m:g}; it must be at most length_m, {self.length_m:g}"
            )
        return self

    def noun(self) -> DippedWeld:
        """The weld, SI."""
        return DippedWeld(
            self.position_m,
            self.depth_mm / MM,
            self.length_m,
            self.short_depth_mm / MM,
            self.short_length_m,
            self.spacing_m,
        )


class CrossingKeys(FileModel):
    """The fixed crossing of a turnout: the wheel sinks along the wing rail and is lifted by the nose."""

    kind: Literal["crossing"]
    position_m: TrackPosition = Field(
        description="where the nose takes the wheel over, from the start of the run"
    )
    depth_mm: Annotated[NonNegative, Field(le=10.0)] = Field(description="of the way of the wheel there")
    wing_length_m: Annotated[Positive, Field(ge=0.05, le=3.0)] = Field(
        0.3, description="from where the wheel begins to sink"
    )
    nose_length_m: Annotated[Positive, Field(ge=0.05, le=3.0)] = Field(
        0.2, description="to where the wheel is up again"
    )

    @model_validator(mode="after")
    def _not_a_step(self) -> Self:
        angle = self.noun().angle
        if angle > 0.1:
            raise problem(
                f"depth_mm is {self.depth_mm:g}; with these lengths the way of the wheel turns by "
                f"{1e3 * angle:.3g} mrad, allowed are 100: make it shallower or longer"
            )
        return self

    def noun(self) -> Crossing:
        """The crossing, SI."""
        return Crossing(self.position_m, self.depth_mm / MM, self.wing_length_m, self.nose_length_m)


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
    Annotated[WheelFlatKeys, Tag("<flat>")]
    | Annotated[WheelPolygonKeys, Tag("<polygon>")]
    | Annotated[WheelOutOfRoundKeys, Tag("<out_of_round>")],
    Discriminator(kind_tag),
]
RailDefectKeys = Annotated[
    Annotated[DippedJointKeys, Tag("<dipped_joint>")]
    | Annotated[DippedWeldKeys, Tag("<dipped_weld>")]
    | Annotated[CrossingKeys, Tag("<crossing>")]
    | Annotated[CorrugationKeys, Tag("<corrugation>")],
    Discriminator(kind_tag),
]

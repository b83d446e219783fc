"""Load and speed from a file, as written in a scene."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from beardyn_core.config.file_model import FileModel, NonNegative, Number, Positive, Text, Vector, problem
from beardyn_core.config.units import KMH, KN, MM
from beardyn_core.scene.measured import MeasuredOperation


class MeasuredSpeedPointKeys(FileModel):
    """Speed of the vehicle at one time."""

    time_s: NonNegative
    speed_kmh: Annotated[Number, Field(ge=-400.0, le=400.0)]


class _FileKeys(FileModel):
    """What measured operations have in common."""

    path: Text
    take: Literal["both", "force", "speed"] = Field(
        "both", description="force: the speed is modelled, speed_profile; speed: the load is, force_kN"
    )
    speed_profile: tuple[MeasuredSpeedPointKeys, ...] = Field(
        (), description="with take: force; linear in between, held before and after"
    )
    wheel_diameter_mm: Annotated[Positive, Field(ge=300.0, le=1500.0)] = 920.0
    force_kN: Vector | None = Field(None, description="with take: speed; on the journal along x, y, z")

    @model_validator(mode="after")
    def _each_from_somewhere(self) -> Self:
        wants_speed, wants_force = self.take == "force", self.take == "speed"
        if wants_speed and not self.speed_profile:
            raise problem("speed_profile is missing; take is 'force', so the speed must come from there")
        if wants_force and self.force_kN is None:
            raise problem("force_kN is missing; take is 'speed', so the load must come from there")
        if self.speed_profile and not wants_speed:
            raise problem(f"speed_profile is given and take is {self.take!r}; it needs take: force")
        if self.force_kN is not None and not wants_force:
            raise problem(f"force_kN is given and take is {self.take!r}; it needs take: speed")
        for index, (one, two) in enumerate(pairwise(self.speed_profile), start=1):
            if two.time_s <= one.time_s:
                raise problem(
                    f"speed_profile[{index}].time_s is {two.time_s:g}; it must be greater than the "
                    f"{one.time_s:g} before it"
                )
        return self

    def noun(self) -> MeasuredOperation:
        """The measured operation, SI."""
        force = None
        if self.force_kN is not None:
            x, y, z = self.force_kN
            force = (x * KN, y * KN, z * KN)
        return MeasuredOperation(
            Path(self.path),
            self.take,
            tuple((point.time_s, point.speed_kmh * KMH) for point in self.speed_profile),
            self.wheel_diameter_mm / MM,
            force,
        )


class CsvKeys(_FileKeys):
    """Load and speed of a CSV file."""

    kind: Literal["csv"]
    path: Text = Field(
        description="relative to the scene file; columns as in the documentation of `rail.measured`"
    )

    @model_validator(mode="after")
    def _no_recording(self) -> Self:
        if self.path.lower().endswith(".mcap"):
            raise problem(f"path is {self.path!r}; that is a recording: use kind: mcap")
        return self


class McapKeys(_FileKeys):
    """Load and speed of a recording."""

    kind: Literal["mcap"]
    path: Text = Field(
        description="relative to the scene file; with load/blocks, load/wrench and load/shaft, or force and "
        "shaft"
    )

    @model_validator(mode="after")
    def _a_recording(self) -> Self:
        if not self.path.lower().endswith(".mcap"):
            raise problem(f"path is {self.path!r}; a recording ends in .mcap: for CSV text use kind: csv")
        return self

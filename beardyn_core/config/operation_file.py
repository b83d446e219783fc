"""Where load and speed come from, as written in a scene."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from beardyn_core.config.excitation_file import IrregularityKeys, RailDefectKeys, WheelDefectKeys
from beardyn_core.config.file_model import (
    FileModel,
    NonNegative,
    Number,
    Positive,
    Reference,
    Text,
    Vector,
    kind_tag,
    problem,
)
from beardyn_core.config.measured_file import CsvKeys, McapKeys
from beardyn_core.config.running_file import BrakingKeys, CurveKeys, StartingKeys, TimetableKeys
from beardyn_core.config.units import KMH, KN, MEGA, MM, RPM
from beardyn_core.config.vehicle_file import TONNE, VehicleKeys
from beardyn_core.rail.measured import speed_points
from beardyn_core.scene.operation import (
    ConstantOperation,
    QuarterVehicleOperation,
    Step,
    SteppedOperation,
    Track,
)
from beardyn_core.scene.speed import Profile

Triple = tuple[float, float, float]
RotationalSpeed = Annotated[Number, Field(ge=-6000.0, le=6000.0)]
VehicleSpeed = Annotated[Number, Field(ge=-400.0, le=400.0)]
WheelDiameter = Annotated[Positive, Field(ge=300.0, le=1500.0)]
USUAL_WHEEL_DIAMETER_MM = 920.0


def scaled(vector: Triple, factor: float) -> Triple:
    """Vector in SI."""
    x, y, z = vector
    return (x * factor, y * factor, z * factor)


class ConstantKeys(FileModel):
    """One load and one speed."""

    kind: Literal["constant"]
    force_kN: Vector = Field(description="on the journal along x, y, z; +z lifts the journal")
    moment_kN_m: Vector = (0.0, 0.0, 0.0)
    speed_rpm: RotationalSpeed = Field(description="of the shaft, positive when rolling forward")

    def noun(self) -> ConstantOperation:
        """The constant operation, SI."""
        return ConstantOperation(
            scaled(self.force_kN, KN), self.speed_rpm * RPM, scaled(self.moment_kN_m, KN)
        )


class StepKeys(FileModel):
    """One level of load and speed."""

    time_s: NonNegative
    force_kN: Vector
    moment_kN_m: Vector = (0.0, 0.0, 0.0)
    speed_rpm: RotationalSpeed

    def noun(self) -> Step:
        """The step, SI."""
        return Step(
            self.time_s, scaled(self.force_kN, KN), self.speed_rpm * RPM, scaled(self.moment_kN_m, KN)
        )


class SteppedKeys(FileModel):
    """Levels of load and speed with smooth ramps in between."""

    kind: Literal["stepped"]
    ramp_s: Annotated[NonNegative, Field(le=3600.0)] = 0.2
    steps: Annotated[tuple[StepKeys, ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        _ascending("steps", [step.time_s for step in self.steps])
        for index, (one, two) in enumerate(zip(self.steps[1:], self.steps[2:], strict=False), start=2):
            if two.time_s < one.time_s + self.ramp_s:
                raise problem(
                    f"steps[{index}].time_s is {two.time_s:g}; the ramp of the step before ends at "
                    f"{one.time_s + self.ramp_s:g} s, it must not begin earlier"
                )
        return self

    def noun(self) -> SteppedOperation:
        """The stepped operation, SI."""
        return SteppedOperation(tuple(step.noun() for step in self.steps), self.ramp_s)


class SpeedPointKeys(FileModel):
    """Speed of the vehicle at one time."""

    time_s: NonNegative
    speed_kmh: VehicleSpeed = Field(description="negative when it runs backwards")


class TrackKeys(FileModel):
    """Ballasted track under one rail; what is not given is the track of Zhai."""

    rail_bending_stiffness_MN_m2: Positive | None = None
    rail_shear_stiffness_MN: Positive | None = Field(None, description="G A, A reduced to what shears")
    rail_mass_kg_per_m: Positive | None = None
    sleeper_spacing_mm: Positive | None = None
    pad_stiffness_MN_per_m: Positive | None = None
    pad_damping_kN_s_per_m: Positive | None = None
    sleeper_mass_kg: Positive | None = Field(None, description="half a sleeper")
    ballast_stiffness_MN_per_m: Positive | None = None
    ballast_damping_kN_s_per_m: Positive | None = None
    ballast_mass_kg: Positive | None = None
    subgrade_stiffness_MN_per_m: Positive | None = None
    subgrade_damping_kN_s_per_m: Positive | None = None

    def noun(self) -> Track:
        """The track, SI."""
        given = {
            "rail_bending_stiffness": (self.rail_bending_stiffness_MN_m2, MEGA),
            "rail_shear_stiffness": (self.rail_shear_stiffness_MN, MEGA),
            "rail_mass_per_length": (self.rail_mass_kg_per_m, 1.0),
            "sleeper_spacing": (self.sleeper_spacing_mm, 1.0 / MM),
            "pad_stiffness": (self.pad_stiffness_MN_per_m, MEGA),
            "pad_damping": (self.pad_damping_kN_s_per_m, KN),
            "sleeper_mass": (self.sleeper_mass_kg, 1.0),
            "ballast_stiffness": (self.ballast_stiffness_MN_per_m, MEGA),
            "ballast_damping": (self.ballast_damping_kN_s_per_m, KN),
            "ballast_mass": (self.ballast_mass_kg, 1.0),
            "subgrade_stiffness": (self.subgrade_stiffness_MN_per_m, MEGA),
            "subgrade_damping": (self.subgrade_damping_kN_s_per_m, KN),
        }
        return Track(
            **{field: value * factor for field, (value, factor) in given.items() if value is not None}
        )


def _one_or_list(schema: dict[str, Any]) -> None:
    """In the schema of a list: one item alone will do."""
    several = {"type": schema.pop("type"), "items": schema.pop("items")}
    schema["anyOf"] = [several["items"], several]


class QuarterVehicleKeys(FileModel):
    """The axlebox share of a vehicle on an irregular track."""

    kind: Literal["quarter_vehicle"]
    vehicle: Reference[VehicleKeys]
    irregularity: IrregularityKeys = IrregularityKeys()
    speed_profile: Annotated[tuple[SpeedPointKeys, ...], Field(min_length=1)] | None = Field(
        None, description="linear in between, held before and after"
    )
    measured_speed: Text | None = Field(
        None, description="instead: CSV file or recording, relative to the scene file, with the shaft speed"
    )
    timetable: TimetableKeys | None = Field(None, description="from stop to stop, instead of a profile")
    wheel_diameter_mm: WheelDiameter = USUAL_WHEEL_DIAMETER_MM
    lateral_force_kN: Annotated[Number, Field(ge=-100.0, le=100.0)] = 0.0
    track: TrackKeys = TrackKeys()
    wheel_defects: tuple[WheelDefectKeys, ...] = Field((), description="flats and polygons of the wheel")
    rail_defects: tuple[RailDefectKeys, ...] = Field(
        (), description="joints, welds, crossings and corrugation, besides the irregularity"
    )
    contact_patch_mm: Annotated[NonNegative, Field(le=30.0)] = Field(
        12.0, description="length of the wheel-rail contact, which smooths short waves; 0 for a point"
    )
    payload_t: Annotated[NonNegative, Field(le=100.0)] = Field(
        0.0, description="of the whole car, besides what its body_mass_t has in it"
    )
    lateral: bool | None = Field(None, description="sideways motion; where there are curves when not given")
    curve: tuple[CurveKeys, ...] = Field(
        (), description="one curve or a list in order of place", json_schema_extra=_one_or_list
    )
    braking: BrakingKeys | None = None
    starting: StartingKeys | None = None

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        curve = data.get("curve")
        return {**data, "curve": [curve]} if isinstance(curve, dict) else data

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        sources = ("speed_profile", "timetable", "measured_speed")
        given = [name for name in sources if getattr(self, name) is not None]
        if len(given) != 1:
            told = "speed_profile is missing" if not given else f"{' and '.join(given)} are given"
            raise problem(f"{told}; give exactly one of {', '.join(sources)}")
        if self.speed_profile is not None:
            _ascending("speed_profile", [point.time_s for point in self.speed_profile], from_zero=False)
        if self.curve and self.lateral is False:
            raise problem("lateral is false, and there is a curve; a curve needs the sideways motion")
        for index, (one, two) in enumerate(pairwise(self.curve), start=1):
            end = one.begin_m + one.length_m
            if two.begin_m < end:
                raise problem(
                    f"curve[{index}].begin_m is {two.begin_m:g}; it must be at least {end:g}, the end of "
                    "the curve before it"
                )
        return self

    def noun(self) -> QuarterVehicleOperation:
        """The quarter vehicle operation, SI."""
        assert isinstance(self.vehicle, VehicleKeys)  # references are resolved before
        return QuarterVehicleOperation(
            vehicle=self.vehicle.noun(),
            irregularity=self.irregularity.noun(),
            speed_profile=self._speed_profile(),
            wheel_diameter=self.wheel_diameter_mm / MM,
            lateral_force=self.lateral_force_kN * KN,
            track=self.track.noun(),
            wheel_defects=tuple(defect.noun() for defect in self.wheel_defects),
            rail_defects=tuple(defect.noun() for defect in self.rail_defects),
            contact_patch=self.contact_patch_mm / MM,
            payload=self.payload_t * TONNE,
            lateral=self.lateral,
            curves=tuple(curve.noun() for curve in self.curve),
            braking=None if self.braking is None else self.braking.noun(),
            starting=None if self.starting is None else self.starting.noun(),
        )

    def _speed_profile(self) -> Profile:
        if self.timetable is not None:
            return self.timetable.noun().speed_profile()
        if self.measured_speed is not None:
            return speed_points(Path(self.measured_speed), self.wheel_diameter_mm / MM)
        assert self.speed_profile is not None  # one of them is there
        return tuple((point.time_s, point.speed_kmh * KMH) for point in self.speed_profile)


OperationKeys = Annotated[
    Annotated[ConstantKeys, Tag("<constant>")]
    | Annotated[SteppedKeys, Tag("<stepped>")]
    | Annotated[QuarterVehicleKeys, Tag("<quarter_vehicle>")]
    | Annotated[CsvKeys, Tag("<csv>")]
    | Annotated[McapKeys, Tag("<mcap>")],
    Discriminator(kind_tag),
]


def _ascending(owner: str, times: list[float], from_zero: bool = True) -> None:
    if from_zero and times[0] != 0.0:
        raise problem(f"{owner}[0].time_s is {times[0]:g}; the first must be 0")
    for index, (one, two) in enumerate(pairwise(times), start=1):
        if two <= one:
            raise problem(
                f"{owner}[{index}].time_s is {two:g}; it must be greater than the {one:g} before it"
            )

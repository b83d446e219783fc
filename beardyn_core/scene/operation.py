"""Where load and speed come from: constant, stepped, a quarter vehicle on the track, or a measurement."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any, ClassVar

from beardyn_core.base.edge import At, Problem, Vector, refuse, write_noun
from beardyn_core.base.units import UNITS
from beardyn_core.scene.excitation import Irregularity, RailDefect, WheelDefect
from beardyn_core.scene.load_check import LARGEST_SPEED_JUMP
from beardyn_core.scene.mounting import Guidance, ProgressiveSuspension
from beardyn_core.scene.running import POINTS, Braking, Curve, Profile, Starting, not_ascending
from beardyn_core.scene.wheelset import Wheelset

WHEEL_PROFILES = ("worn", "cone")
WHEELSETS = ("coupled", "elastic", "rigid")
TAKES = ("both", "force", "speed")
MOST_RPM = 6000.0
STEP_SAMPLE_NS = 500_000  # between samples of the load of a stepped operation
SHAFT_SPEED = At("rpm", ge=-MOST_RPM, le=MOST_RPM)


@dataclass(frozen=True)
class ConstantOperation:
    """One load and one speed for the whole run."""

    kind: ClassVar[str] = "constant"

    force: A[Vector, At("kN"), "on the journal along x, y, z; +z lifts the journal"]
    speed: A[float, SHAFT_SPEED, "of the shaft, positive when rolling forward"]
    moment: A[Vector, At("kN_m"), "on the journal about the bearing centre"] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        refuse(self, "operation (constant)")


@dataclass(frozen=True)
class Step:
    """One level of a stepped operation."""

    time: A[float, At("s", ge=0.0), "when the change to this level begins"]
    force: A[Vector, At("kN"), "on the journal along x, y, z; +z lifts the journal"]
    speed: A[float, SHAFT_SPEED, "of the shaft, positive when rolling forward"]
    moment: A[Vector, At("kN_m"), "on the journal about the bearing centre"] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class SteppedOperation:
    """Levels of load and speed with cosine ramps in between."""

    kind: ClassVar[str] = "stepped"

    steps: A[tuple[Step, ...], At(size=(1, None)), "in order of time; the first begins at 0"]
    ramp: A[float, At("s", ge=0.0, le=3600.0), "duration of the change to each further step"] = 0.2

    def __post_init__(self) -> None:
        refuse(self, "operation (stepped)")

    def rules(self) -> Iterator[str]:
        """Check that the steps begin at 0, follow each other in time and leave room for the ramps."""
        times = [step.time for step in self.steps]
        if times and times[0] != 0.0:
            yield f"steps[0].time_s is {times[0]:g}; the first must be 0"
        yield from not_ascending("steps", times)
        # the first level is there from the start: only later steps have a ramp to finish
        for index, (one, two) in enumerate(itertools.pairwise(times[1:]), start=2):
            if one < two < one + self.ramp:
                yield (
                    f"steps[{index}].time_s is {two:g}; the ramp of the step before ends at "
                    f"{one + self.ramp:g} s, it must not begin earlier"
                )
        yield from self._jumps()

    def _jumps(self) -> Iterator[str]:
        """Find changes of speed that no load with such samples may have; see `scene.load_check`."""
        turn = math.pi * STEP_SAMPLE_NS * 1e-9 / max(self.ramp, STEP_SAMPLE_NS * 1e-9)
        share = math.sin(0.5 * min(turn, math.pi))  # of the change, within the steepest sample of the ramp
        for index, (one, two) in enumerate(itertools.pairwise(self.steps), start=1):
            change = abs(two.speed - one.speed)
            if share * change > LARGEST_SPEED_JUMP:
                least = 0.5 * math.pi * STEP_SAMPLE_NS * 1e-9 / math.asin(LARGEST_SPEED_JUMP / change)
                yield (
                    f"steps[{index}].speed_rpm changes by {UNITS['rpm'].to_edge(change):.4g} within ramp_s "
                    f"{self.ramp:g}; a wheelset changes by at most "
                    f"{UNITS['rpm'].to_edge(LARGEST_SPEED_JUMP):.0f} rpm in "
                    f"{STEP_SAMPLE_NS / 1e6:g} ms: make ramp_s at least {least * 1.001:.3g}"
                )


@dataclass(frozen=True)
class Vehicle:
    """A car with two bogies of two axles: sprung masses and secondary suspension.

    Wheelset, axlebox and, where it is linear, primary suspension belong to `scene.mounting.Mounting`, so
    that rail model and twin share them.
    """

    name: A[str, At(longest=80), "of the vehicle"]
    description: A[str, At(usual=""), "what it is, in a few words"]
    body_mass: A[float, At("t", gt=0.0, ge=1.0, le=200.0), "whole car body with its payload"]
    bogie_mass: A[float, At("t", gt=0.0, ge=0.1, le=30.0), "one bogie frame without wheelsets"]
    secondary_stiffness: A[
        float, At("kN_per_mm", gt=0.0, ge=0.01, le=100.0), "vertical, one side of one bogie"
    ]
    secondary_damping: A[float, At("kN_s_per_m", gt=0.0, le=10000.0), "vertical, one side of one bogie"]
    wheel_profile: A[str, At(one_of=WHEEL_PROFILES), "which fit of the Hertz wheel-rail contact applies"] = (
        "worn"
    )
    primary_suspension: A[
        ProgressiveSuspension | None, "of freight bogies; the vertical springs of the mounting when left out"
    ] = None
    guidance: A[Guidance, "what the sideways motion depends on"] = Guidance()
    wheelset: A[Wheelset | None, "what bends and twists of a wheelset; rigid when left out"] = None
    sources: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        """Give the name and the masses, in one line."""
        return f"Vehicle {self.name}: body {self.body_mass:g} kg, bogies {self.bogie_mass:g} kg each"

    def __post_init__(self) -> None:
        refuse(self, f"vehicle {self.name!r}")


@dataclass(frozen=True)
class Track:
    """Ballasted track under one rail; defaults are the track of Zhai.

    References
    ----------
    Values as in the TTB-2D track library (D. Cantero, NTNU), after Zhai, Wang, Lin (2004), Modelling
    and experiment of railway ballast vibrations, J. Sound Vib. 270. Half of the 251 kg sleeper. Shear of a
    60 kg rail, 0.4 of its section: Wu, Thompson (1999), J. Sound Vib. 224.
    """

    rail_bending_stiffness: A[float, At("MN_m2", gt=0.0, absent=True), "E I of one rail"] = (
        2.059e11 * 3.217e-5
    )
    rail_mass_per_length: A[float, At("kg_per_m", gt=0.0, absent=True, key="rail_mass"), "of one rail"] = (
        60.64
    )
    sleeper_spacing: A[float, At("mm", gt=0.0, absent=True), "from sleeper to sleeper"] = 0.6
    pad_stiffness: A[float, At("MN_per_m", gt=0.0, absent=True), "of one rail seat"] = 65.0e6
    pad_damping: A[float, At("kN_s_per_m", gt=0.0, absent=True), "of one rail seat"] = 75.0e3
    sleeper_mass: A[float, At("kg", gt=0.0, absent=True), "half a sleeper"] = 125.5
    ballast_stiffness: A[
        float, At("MN_per_m", gt=0.0, absent=True), "between half a sleeper and its block of ballast"
    ] = 137.75e6
    ballast_damping: A[
        float, At("kN_s_per_m", gt=0.0, absent=True), "between half a sleeper and its block of ballast"
    ] = 58.8e3
    ballast_mass: A[float, At("kg", gt=0.0, absent=True), "block of ballast under one rail seat"] = 531.0
    subgrade_stiffness: A[float, At("MN_per_m", gt=0.0, absent=True), "under one block of ballast"] = 77.5e6
    subgrade_damping: A[float, At("kN_s_per_m", gt=0.0, absent=True), "under one block of ballast"] = 31.15e3
    rail_shear_stiffness: A[float, At("MN", gt=0.0, absent=True), "G A, A reduced to what shears"] = (
        0.4 * 81.0e9 * 7.725e-3
    )

    def __post_init__(self) -> None:
        refuse(self, "track")


@dataclass(frozen=True)
class QuarterVehicleOperation:
    """An axlebox share of a vehicle running over an irregular track."""

    kind: ClassVar[str] = "quarter_vehicle"

    vehicle: A[Vehicle, At(reference=True), "a shipped vehicle, a path, or the keys of one"]
    irregularity: A[Irregularity, At(usual=Irregularity()), "of the rail"]
    speed_profile: A[
        Profile, POINTS, At(size=(1, None), optional=True), "linear in between, held before and after"
    ]
    wheel_diameter: A[float, At("mm", gt=0.0, ge=300.0, le=1500.0), "running diameter"] = 0.92
    lateral_force: A[float, At("kN", ge=-100.0, le=100.0), "on the journal along y"] = 0.0
    track: A[Track, "under the rail; what is not given is the track of Zhai"] = Track()
    wheel_defects: A[tuple[WheelDefect, ...], "flats and polygons of the wheel"] = ()
    rail_defects: A[
        tuple[RailDefect, ...], "joints, welds, crossings and corrugation, besides the irregularity"
    ] = ()
    contact_patch: A[
        float | None,
        At("mm", ge=0.0, le=30.0),
        "length of the wheel-rail contact, which smooths short waves, 0 for a point; that of a Hertz contact "
        "under the wheel's load when left out",
    ] = None
    payload: A[
        float, At("t", ge=0.0, le=100.0), "of the whole car, besides what its body_mass_t has in it"
    ] = 0.0
    lateral: A[bool | None, "sideways motion; where there are curves when left out"] = None
    curves: A[tuple[Curve, ...], At(key="curve"), "one curve or a list in order of place"] = ()
    braking: A[Braking | None, "the brake of this axle, where it brakes"] = None
    starting: A[Starting | None, "the drive of this axle, where it is driven"] = None
    wheelset: A[
        str,
        At(one_of=WHEELSETS),
        "coupled: it bends as the vehicle's wheelset does, where there is one, in the twin too, under wheel "
        "and bearing; elastic: it bends and twists in the rail model alone, and its load also moves the "
        "twin's rigid journal so, which is no load on the bearing; rigid: it does not",
    ] = "rigid"

    @property
    def body_mass(self) -> float:
        """Car body with all its payload, [kg]."""
        return self.vehicle.body_mass + self.payload

    @property
    def bends_in_the_twin(self) -> bool:
        """Whether the twin's half wheelset has modes."""
        return self.wheelset == "coupled" and self.vehicle.wheelset is not None

    @property
    def moves_sideways(self) -> bool:
        """Whether the lateral motion of the vehicle is simulated."""
        return bool(self.curves) if self.lateral is None else self.lateral

    def __post_init__(self) -> None:
        refuse(self, "operation (quarter_vehicle)")

    def rules(self) -> Iterator[str | Problem]:
        """Check the parts of the operation against each other."""
        yield from not_ascending("speed_profile", [time for time, _ in self.speed_profile])
        if self.curves and self.lateral is False:
            yield "lateral is false, and there is a curve; a curve needs the sideways motion"
        if self.bends_in_the_twin and self.moves_sideways:
            yield (
                "wheelset is coupled, and there is sideways motion, in which the wheels move against each "
                "other; the twin bends a wheelset whose wheels move alike: take wheelset: elastic, or "
                "lateral: false on straight track"
            )
        for index, (one, two) in enumerate(itertools.pairwise(self.curves), start=1):
            if two.begin < one.end:
                yield (
                    f"curve[{index}].begin_m is {two.begin:g}; it must be at least {one.end:g}, the end of "
                    "the curve before it"
                )
        for index, defect in enumerate(self.wheel_defects):
            for text in defect.contradictions(0.5 * self.wheel_diameter):
                yield Problem(text, ("wheel_defects", index))

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Write the timetable, when the speed follows from one, in place of the speed points."""
        source = getattr(self.speed_profile, "source", None)
        if source is None:
            return keys
        del keys["speed_profile"]
        if isinstance(source, Path):
            return {**keys, "measured_speed": str(source)}
        return {**keys, "timetable": write_noun(source)}


@dataclass(frozen=True)
class MeasuredOperation:
    """Load and speed read from a CSV file or from a recording (see `rail.measured`)."""

    KINDS: ClassVar[tuple[str, ...]] = ("csv", "mcap")

    path: A[
        Path,
        "relative to the scene file; of a CSV file columns as in the documentation of `rail.measured`, of a "
        "recording load/blocks, load/wrench and load/shaft, or force and shaft",
    ]
    take: A[
        str, At(one_of=TAKES), "force: the speed is modelled, speed_profile; speed: the load is, force_kN"
    ] = "both"
    speed_profile: A[Profile, POINTS, "with take: force; linear in between, held before and after"] = ()
    wheel_diameter: A[
        float, At("mm", gt=0.0, ge=300.0, le=1500.0), "running diameter, for the speed profile"
    ] = 0.92
    force: A[Vector | None, At("kN"), "with take: speed; on the journal along x, y, z"] = None

    def __post_init__(self) -> None:
        refuse(self, "operation (measured)")

    @property
    def kind(self) -> str:
        """Kind of the file."""
        return "mcap" if self.path.suffix.lower() == ".mcap" else "csv"

    def rules(self) -> Iterator[str]:
        """Check that load and speed each have exactly one source, and that times increase."""
        wants_speed, wants_force = self.take == "force", self.take == "speed"
        if wants_speed and not self.speed_profile:
            yield "speed_profile is missing; take is 'force', so the speed must come from there"
        if wants_force and self.force is None:
            yield "force_kN is missing; take is 'speed', so the load must come from there"
        if self.speed_profile and not wants_speed:
            yield f"speed_profile is given and take is {self.take!r}; it needs take: force"
        if self.force is not None and not wants_force:
            yield f"force_kN is given and take is {self.take!r}; it needs take: speed"
        yield from not_ascending("speed_profile", [time for time, _ in self.speed_profile])


Operation = ConstantOperation | SteppedOperation | QuarterVehicleOperation | MeasuredOperation

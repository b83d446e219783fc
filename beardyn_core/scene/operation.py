"""Where load and speed come from: constant, stepped, a quarter vehicle on the track, or a measurement."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from beardyn_core.scene.braking import Braking, Starting
from beardyn_core.scene.curve import Curve
from beardyn_core.scene.excitation import RailDefect, WheelDefect
from beardyn_core.scene.guidance import Guidance
from beardyn_core.scene.irregularity import Irregularity
from beardyn_core.scene.measured import MeasuredOperation
from beardyn_core.scene.ranges import not_finite, outside, refuse
from beardyn_core.scene.suspension import ProgressiveSuspension

Vector = tuple[float, float, float]

WHEEL_PROFILES = ("worn", "cone")
LIMIT = 400 / 3.6  # speed of a vehicle, [m/s]


@dataclass(frozen=True)
class ConstantOperation:
    """One load and one speed for the whole run.

    Parameters
    ----------
    force : tuple of 3 floats
        On the journal, world axes (+z lifts the journal), [N].
    speed : float
        Of the shaft, positive when rolling forward, [rad/s].
    moment : tuple of 3 floats
        On the journal about the bearing centre, [N m].
    """

    force: Vector
    speed: float
    moment: Vector = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        yield from not_finite("operation (constant)", "force", self.force)
        yield from not_finite("operation (constant)", "moment", self.moment)
        yield from not_finite("operation (constant)", "speed", (self.speed,))


@dataclass(frozen=True)
class Step:
    """One level of a stepped operation.

    Parameters
    ----------
    time : float
        When the change to this level begins, [s].
    force : tuple of 3 floats
        On the journal, [N].
    speed : float
        Of the shaft, [rad/s].
    moment : tuple of 3 floats
        On the journal, [N m].
    """

    time: float
    force: Vector
    speed: float
    moment: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class SteppedOperation:
    """Levels of load and speed with cosine ramps in between.

    Parameters
    ----------
    steps : tuple of Step
        In order of time; the first begins at 0.
    ramp : float
        Duration of the ramp that begins at each further step's time, [s].
    """

    steps: tuple[Step, ...]
    ramp: float = 0.2

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "operation (stepped)"
        if not self.steps:
            yield f"{owner}: steps is empty; give at least one step at time 0"
            return
        yield from outside(owner, "ramp", self.ramp, 0.0, 3600.0, "s")
        for index, step in enumerate(self.steps):
            name = f"{owner}, step {index}"
            yield from not_finite(name, "time", (step.time,))
            yield from not_finite(name, "force", step.force)
            yield from not_finite(name, "moment", step.moment)
            yield from not_finite(name, "speed", (step.speed,))
        if self.steps[0].time != 0.0:
            yield f"{owner}: the first step begins at {self.steps[0].time:g} s; it must begin at 0 s"
        for index, (one, two) in enumerate(itertools.pairwise(self.steps), start=1):
            # the first level is there from the start: only later steps have a ramp to finish
            earliest = one.time + (self.ramp if index > 1 else 0.0)
            if not (two.time >= earliest and two.time > one.time):
                yield (
                    f"{owner}, step {index}: time is {two.time:g} s; it must be after step {index - 1} "
                    f"and its ramp, at {earliest:g} s or later"
                )


@dataclass(frozen=True)
class Vehicle:
    """Sprung masses and secondary suspension of a car with two bogies of two axles.

    Wheelset, axlebox and, where it is linear, primary suspension belong to `scene.mounting.Mounting`, so
    that rail model and twin share them.

    Parameters
    ----------
    name, description : str
    body_mass : float
        Whole car body with its payload; an axlebox carries one eighth, [kg].
    bogie_mass : float
        One bogie frame without wheelsets; an axlebox carries one quarter, [kg].
    secondary_stiffness : float
        Vertical, one side of one bogie (shared by two axleboxes), [N/m].
    secondary_damping : float
        Vertical, one side of one bogie, [N s/m].
    wheel_profile : str
        ``worn`` or ``cone``: which fit of the Hertz wheel-rail contact applies.
    primary_suspension : ProgressiveSuspension or None
        Instead of the vertical springs and dampers of the mounting; ``None``: those.
    guidance : Guidance
        What its lateral motion depends on.
    sources : tuple of (field, source) pairs
    """

    name: str
    description: str
    body_mass: float
    bogie_mass: float
    secondary_stiffness: float
    secondary_damping: float
    wheel_profile: str = "worn"
    primary_suspension: ProgressiveSuspension | None = None
    guidance: Guidance = field(default_factory=Guidance)
    sources: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = f"vehicle {self.name!r}"
        yield from outside(owner, "body_mass", self.body_mass, 1e3, 2e5, "kg")
        yield from outside(owner, "bogie_mass", self.bogie_mass, 1e2, 3e4, "kg")
        yield from outside(owner, "secondary_stiffness", self.secondary_stiffness, 1e4, 1e8, "N/m")
        yield from outside(owner, "secondary_damping", self.secondary_damping, 0.0, 1e7, "N s/m")
        if self.wheel_profile not in WHEEL_PROFILES:
            yield f"{owner}: wheel_profile is {self.wheel_profile!r}; allowed are {', '.join(WHEEL_PROFILES)}"


@dataclass(frozen=True)
class Track:
    """Ballasted track under one rail; defaults are the track of Zhai.

    Parameters
    ----------
    rail_bending_stiffness : float
        E I of one rail, [N m^2].
    rail_mass_per_length : float
        One rail, [kg/m].
    rail_shear_stiffness : float
        G A of one rail, A reduced to 0.4 of the section, [N].
    sleeper_spacing : float
        [m].
    pad_stiffness, pad_damping : float
        One rail seat, [N/m], [N s/m].
    sleeper_mass : float
        Half a sleeper, [kg].
    ballast_stiffness, ballast_damping : float
        Between half a sleeper and its block of ballast, [N/m], [N s/m].
    ballast_mass : float
        Block of ballast under one rail seat, [kg].
    subgrade_stiffness, subgrade_damping : float
        Under one block of ballast, [N/m], [N s/m].

    References
    ----------
    Values as in the TTB-2D track library (D. Cantero, NTNU), after Zhai, Wang, Lin (2004), Modelling
    and experiment of railway ballast vibrations, J. Sound Vib. 270. Half of the 251 kg sleeper. Shear of a
    60 kg rail, 0.4 of its section: Wu, Thompson (1999), J. Sound Vib. 224.
    """

    rail_bending_stiffness: float = 2.059e11 * 3.217e-5
    rail_mass_per_length: float = 60.64
    sleeper_spacing: float = 0.6
    pad_stiffness: float = 65.0e6
    pad_damping: float = 75.0e3
    sleeper_mass: float = 125.5
    ballast_stiffness: float = 137.75e6
    ballast_damping: float = 58.8e3
    ballast_mass: float = 531.0
    subgrade_stiffness: float = 77.5e6
    subgrade_damping: float = 31.15e3
    rail_shear_stiffness: float = 0.4 * 81.0e9 * 7.725e-3

    def __post_init__(self) -> None:
        refuse(
            f"track: {name} is {value:g}; it must be a positive finite number"
            for name, value in vars(self).items()
            if not 0.0 < value < math.inf
        )


@dataclass(frozen=True)
class QuarterVehicleOperation:
    """An axlebox share of a vehicle running over an irregular track.

    Parameters
    ----------
    vehicle : Vehicle
    irregularity : Irregularity
    speed_profile : tuple of (time, speed) pairs
        Time, [s], and speed of the vehicle, negative when it runs backwards, [m/s]: linear in between,
        held before and after.
    wheel_diameter : float
        Running diameter, [m].
    lateral_force : float
        Constant force on the journal along +y (towards the outboard row of a left axlebox), [N].
    track : Track
    wheel_defects : tuple of WheelDefect
        Flats and polygons of the running surface; they come back every revolution.
    rail_defects : tuple of RailDefect
        Dips and corrugation at their places along the track, besides the irregularity.
    contact_patch : float
        Length of the wheel-rail contact along the rail, which smooths short waves, [m]; 0: a point.
    payload : float
        Besides what the vehicle's body mass has in it, whole car, [kg].
    lateral : bool or None
        Whether wheelset and bogie move sideways; ``None``: where there are curves.
    curves : tuple of Curve
        In order of place, not overlapping.
    braking, starting : Braking or Starting or None
        Forces at this axle while the vehicle slows down and speeds up; ``None``: this axle only rolls.
    """

    vehicle: Vehicle
    irregularity: Irregularity
    speed_profile: tuple[tuple[float, float], ...]
    wheel_diameter: float = 0.92
    lateral_force: float = 0.0
    track: Track = field(default_factory=Track)
    wheel_defects: tuple[WheelDefect, ...] = ()
    rail_defects: tuple[RailDefect, ...] = ()
    contact_patch: float = 0.012
    payload: float = 0.0
    lateral: bool | None = None
    curves: tuple[Curve, ...] = ()
    braking: Braking | None = None
    starting: Starting | None = None

    @property
    def body_mass(self) -> float:
        """Car body with all its payload, [kg]."""
        return self.vehicle.body_mass + self.payload

    @property
    def moves_sideways(self) -> bool:
        """Whether the lateral model runs."""
        return bool(self.curves) if self.lateral is None else self.lateral

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "operation (quarter_vehicle)"
        yield from outside(owner, "wheel_diameter", self.wheel_diameter, 0.3, 1.5, "m")
        yield from outside(owner, "lateral_force", self.lateral_force, -1e5, 1e5, "N")
        yield from outside(owner, "contact_patch", self.contact_patch, 0.0, 0.03, "m")
        if not self.speed_profile:
            yield f"{owner}: speed_profile is empty; give at least one (time, speed) point"
        for index, (time, speed) in enumerate(self.speed_profile):
            yield from not_finite(owner, f"time of speed_profile point {index}", (time,))
            yield from outside(owner, f"speed of speed_profile point {index}", speed, -LIMIT, LIMIT, "m/s")
        times = [time for time, _ in self.speed_profile]
        for index, (one, two) in enumerate(itertools.pairwise(times), start=1):
            if not two > one:
                yield (
                    f"{owner}: speed_profile point {index} is at {two:g} s; it must be later than point "
                    f"{index - 1} at {one:g} s"
                )
        yield from outside(owner, "payload", self.payload, 0.0, 1e5, "kg")
        yield from self._running_problems(owner)
        for index, defect in enumerate(self.wheel_defects):
            for problem in defect.problems(0.5 * self.wheel_diameter):
                yield f"{owner}, wheel defect {index}: {problem}"
        for index, fault in enumerate(self.rail_defects):
            for problem in fault.problems():
                yield f"{owner}, rail defect {index}: {problem}"

    def _running_problems(self, owner: str) -> Iterator[str]:
        if self.curves and self.lateral is False:
            yield f"{owner}: lateral is False with {len(self.curves)} curves; curves need the lateral motion"
        for index, (one, two) in enumerate(itertools.pairwise(self.curves), start=1):
            if not two.begin >= one.end:
                yield (
                    f"{owner}: curve {index} begins at {two.begin:g} m; it must begin at the end of curve "
                    f"{index - 1}, {one.end:g} m, or later"
                )


Operation = ConstantOperation | SteppedOperation | QuarterVehicleOperation | MeasuredOperation

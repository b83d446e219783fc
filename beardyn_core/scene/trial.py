"""A trial: a matrix of simulated runs on which a monitor is tested."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product
from math import pi
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import INTERNAL, At
from beardyn_core.effects import EffectSet
from beardyn_core.scene.excitation import WheelDefect
from beardyn_core.scene.scatter import GRADES
from beardyn_core.scene.surface import FACTORS

HEALTHY = "none"
FAULTS = ("cup", "cone", "roller")
CAGE = "cage"
SLOT = "slot"
SHAPES = (SLOT, "whole", "round", "irregular", "field")
TIERS = ("lumped", "quasistatic", "full")
REPEATS = At(ge=1, le=1000)


@dataclass(frozen=True)
class TrialWheel:
    """A wheel of the matrix."""

    name: A[str, At(longest=80), "of the wheel in the results"]
    defects: A[tuple[WheelDefect, ...], "flats and polygons of the wheel"] = ()


@dataclass(frozen=True)
class Spall:
    """Depth and shape of a spall as a function of its width."""

    length_per_width: A[float, At(gt=0.0, le=20.0), "along the roller"] = 2.0
    depth_per_width: A[float, At(gt=0.0, le=1.0), "depth over width"] = 0.1
    deepest: A[float, At("um", gt=0.0, le=1000.0), "limit of the depth"] = 100.0e-6

    def depth(self, width: float) -> float:
        """Compute the depth of a spall from its width, [m]."""
        return min(self.depth_per_width * width, self.deepest)


@dataclass(frozen=True)
class Cell:
    """One run of a trial."""

    fault: A[str, "``none``, or the part that is spalled or worn"]
    size: A[float, "width of the spall, or wear of the pocket, 0 without, [m]"]
    speed: A[float, "of the train, [m/s]"]
    track: str
    wheel: str
    repeat: A[int, "which of the runs that differ by their seed alone"]
    tier: str
    checks: A[bool, "whether it repeats a run of the matrix in the tier of the check"] = False
    shape: A[str, "of the spall, one of `SHAPES`"] = SLOT
    sensor: A[str, "kind of the accelerometers; '' that of the scene"] = ""
    surface: A[str, "of raceways and rollers; '' that of the scene"] = ""

    @property
    def conditions(self) -> str:
        """Conditions of the run in words, without its tier."""
        shape = "" if self.shape == SLOT else f"{self.shape}, "
        sensor = f"{self.sensor}, " if self.sensor else ""
        surface = f"{self.surface} surface, " if self.surface else ""
        return (
            f"{self.fault} {1e3 * self.size:g} mm, {shape}{3.6 * self.speed:g} km/h, {self.track}, "
            f"{self.wheel}, {sensor}{surface}run {self.repeat}"
        )

    @property
    def key(self) -> str:
        """Name of the run in the folder of results."""
        return f"{self.conditions}, {self.tier}"

    def seed(self, trial_seed: int) -> int:
        """Make the seed of track, noise, bearing and place of the spall, the same in every tier and order."""
        return zlib.crc32(f"{self.conditions}, {trial_seed}".encode())


@dataclass(frozen=True)
class Check:
    """Which runs are repeated in another tier."""

    tier: A[str, At(one_of=TIERS), "in which they are repeated"]
    every: A[int, At(ge=1), "every how manieth run of the matrix"]


@dataclass(frozen=True)
class TrialChoice:
    """What all runs of a tier are computed with, where scene and trial leave it open."""

    tier: str
    effects: EffectSet
    laminae: int
    steps_per_sample: float
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class Trial:
    """A matrix of simulated runs on which a monitor is tested.

    `folder` is that of its file, where a scene file is looked for first.
    """

    name: A[str, At(longest=80, key="trial"), "name of the trial"]
    purpose: A[str, "one line: what the trial is for"]
    scene: A[str, At(longest=80), "what every run starts from; its operation a quarter_vehicle"] = (
        "smooth_run"
    )
    folder: A[Path, INTERNAL] = Path()
    tier: A[str, At(one_of=TIERS), "of the runs"] = "quasistatic"
    effects: A[str | dict[str, Any] | None, "as in a scene file; the scene's when left out"] = None
    scatter: A[
        str | None,
        At(one_of=tuple(GRADES)),
        "grade of the bearings, in every run another of the lot; the scene's when left out",
    ] = None
    noise_density: A[
        float | None, At("m_per_s2_per_sqrt_Hz", ge=0.0), "of every accelerometer; the scene's when left out"
    ] = None
    faults: A[
        tuple[str, ...],
        At(one_of=(*FAULTS, CAGE)),
        "parts that are spalled, or cage: a worn pocket; none: healthy bearings only",
    ] = FAULTS
    sizes: A[
        tuple[float, ...], At("mm", gt=0.0, le=100.0), "widths of the spalls, or wear of the pocket"
    ] = ()
    shapes: A[
        tuple[str, ...],
        At(one_of=SHAPES),
        "of the spalls: slot as long as the spall, whole contact, round or irregular (both of thirteen "
        "strips side by side), or field, a field spall; a worn pocket has none",
    ] = (SLOT,)
    sensors: A[
        tuple[str, ...], At(longest=80), "kinds of the accelerometers; that of the scene when left out"
    ] = ()
    surfaces: A[
        tuple[str, ...],
        At(one_of=tuple(FACTORS)),
        "of raceways and rollers, as scatter.surface of a scene; that of the scene when left out",
    ] = ()
    spall: A[Spall, "how a spall of a width looks"] = Spall()
    speeds: A[
        tuple[float, ...], At("kmh", gt=0.0, ge=5.0, le=400.0, size=(1, None), required=True), "of the train"
    ] = ()
    tracks: A[tuple[str, ...], At(longest=80, size=(1, None), required=True), "kinds of irregularity"] = ()
    wheels: A[tuple[TrialWheel, ...], At(size=(1, None), required=True), "wheels of the matrix"] = ()
    repeats: A[int, REPEATS, "runs of each combination with a fault"] = 1
    healthy_repeats: A[int, REPEATS, "runs of each combination without"] = 1
    revolutions: A[float, At(gt=0.0, ge=16.0, le=10_000.0), "of the shaft, a run"] = 40.0
    interval: A[float, At("s", gt=0.0, ge=0.1, le=60.0), "between two analyses"] = 1.0
    seed: A[int, At(ge=0), "of tracks, noise, bearings and places of the spalls"] = 1
    check: A[Check | None, "repeat some runs in another tier"] = None
    choices: A[tuple[TrialChoice, ...], INTERNAL] = ()

    def rules(self) -> Iterator[str]:
        """Check that no entry occurs twice, and that the second tier differs from the first."""
        lists = {
            "faults": self.faults,
            "sizes_mm": self.sizes,
            "shapes": self.shapes,
            "sensors": self.sensors,
            "surfaces": self.surfaces,
            "speeds_kmh": self.speeds,
            "tracks": self.tracks,
        }
        for key, values in lists.items():
            if len(set(values)) < len(values):
                yield f"{key} has an entry twice; each must stand once"
        if not self.shapes:
            yield f"shapes is empty; it must have one of {', '.join(SHAPES)}"
        if self.faults and not self.sizes:
            yield "sizes_mm is missing; with faults it must have a width"
        names = [wheel.name for wheel in self.wheels]
        if len(set(names)) < len(names):
            yield "wheels has a name twice; each must stand once"
        if self.check is not None and self.check.tier == self.tier:
            yield f"check.tier is {self.check.tier!r}, the tier of the matrix itself; it must be another"

    def choice(self, tier: str) -> TrialChoice | None:
        """Find what the runs of a tier are computed with; ``None`` where each scene says so itself."""
        return next((choice for choice in self.choices if choice.tier == tier), None)

    @property
    def check_tier(self) -> str | None:
        """Tier in which some runs are repeated."""
        return None if self.check is None else self.check.tier

    def wheel(self, name: str) -> TrialWheel:
        """Find a wheel by its name."""
        return next(wheel for wheel in self.wheels if wheel.name == name)

    def duration(self, speed: float, wheel_diameter: float) -> float:
        """Compute the duration of a run from speed [m/s] and wheel radius [m], [s]."""
        return self.revolutions * pi * wheel_diameter / speed

    def cells(self) -> tuple[Cell, ...]:
        """List all runs, those of the check last."""
        loads = [(HEALTHY, 0.0, SLOT, self.healthy_repeats)]
        loads += [
            (fault, size, shape, self.repeats)
            for fault in self.faults
            for size in self.sizes
            for shape in ((SLOT,) if fault == CAGE else self.shapes)
        ]
        sensors, surfaces = self.sensors or ("",), self.surfaces or ("",)
        conditions = [
            Cell(HEALTHY, 0.0, speed, track, wheel.name, 0, self.tier, sensor=sensor, surface=surface)
            for speed, track, wheel, sensor, surface in product(
                self.speeds, self.tracks, self.wheels, sensors, surfaces
            )
        ]
        own = tuple(
            replace(cell, fault=fault, size=size, shape=shape, repeat=repeat)
            for fault, size, shape, repeats in loads
            for repeat in range(repeats)
            for cell in conditions
        )
        if self.check is None:
            return own
        # an odd stride walks through speeds, tracks and wheels
        checked = own[:: self.check.every]
        return (*own, *(replace(cell, tier=self.check.tier, checks=True) for cell in checked))

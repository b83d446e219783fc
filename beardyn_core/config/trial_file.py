"""The trial file: a matrix of faults, sizes, speeds, tracks and wheels, and the scene of one of its runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, ValidationError, model_validator

from beardyn_core.config.effects_file import overlay
from beardyn_core.config.excitation_file import WheelDefectKeys
from beardyn_core.config.file_model import Count, FileModel, Name, Positive, Text, problem
from beardyn_core.config.folders import find
from beardyn_core.config.load import scene_from_mapping
from beardyn_core.config.operation_file import USUAL_WHEEL_DIAMETER_MM
from beardyn_core.config.problems import Origin, sentences
from beardyn_core.config.units import KMH, MM, UM
from beardyn_core.config.yaml_text import read_file
from beardyn_core.errors import InputError
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import HEALTHY, Cell, Spall, Trial, TrialWheel

# a spall of the cup is where the load is
_LOAD_ZONE_DEG = 30.0

Tier = Literal["lumped", "quasistatic", "full"]
Fault = Literal["cup", "cone", "roller"]
Repeats = Annotated[Count, Field(ge=1, le=1000)]


class SpallKeys(FileModel):
    """How a spall of a width looks."""

    length_per_width: Annotated[Positive, Field(le=20.0)] = Field(2.0, description="along the roller")
    depth_per_width: Annotated[Positive, Field(le=1.0)] = 0.1
    deepest_um: Annotated[Positive, Field(le=1000.0)] = 100.0

    def noun(self) -> Spall:
        """The spall, SI."""
        return Spall(self.length_per_width, self.depth_per_width, self.deepest_um / UM)


class WheelKeys(FileModel):
    """A wheel of the matrix."""

    name: Name
    defects: tuple[WheelDefectKeys, ...] = ()

    def noun(self) -> TrialWheel:
        """The wheel; its defects stay as written."""
        return TrialWheel(
            self.name, tuple(defect.model_dump(mode="json", exclude_none=True) for defect in self.defects)
        )


class CheckKeys(FileModel):
    """Which runs are repeated in another tier."""

    tier: Tier
    every: Annotated[Count, Field(ge=1)] = Field(description="every how manieth run of the matrix")


class TrialKeys(FileModel):
    """A matrix of scenes that a monitor is put to."""

    trial: Name
    purpose: Text
    scene: Name = Field(
        "smooth_run", description="what every run starts from; its operation a quarter_vehicle"
    )
    tier: Tier = "quasistatic"
    effects: Text | dict[str, Any] | None = Field(
        None, description="as in a scene file; the scene's when not given"
    )
    faults: Annotated[tuple[Fault, ...], Field(min_length=1)] = ("cup", "cone", "roller")
    sizes_mm: Annotated[tuple[Annotated[Positive, Field(le=100.0)], ...], Field(min_length=1)] = Field(
        description="widths of the spalls"
    )
    spall: SpallKeys = SpallKeys()
    speeds_kmh: Annotated[tuple[Annotated[Positive, Field(ge=5.0, le=400.0)], ...], Field(min_length=1)]
    tracks: Annotated[tuple[Name, ...], Field(min_length=1)] = Field(description="kinds of irregularity")
    wheels: Annotated[tuple[WheelKeys, ...], Field(min_length=1)]
    repeats: Repeats = Field(1, description="runs of each combination with a fault")
    healthy_repeats: Repeats = Field(1, description="runs of each combination without")
    revolutions: Annotated[Positive, Field(ge=16.0, le=10_000.0)] = Field(
        40.0, description="of the shaft, a run"
    )
    interval_s: Annotated[Positive, Field(ge=0.1, le=60.0)] = Field(1.0, description="between two analyses")
    seed: Annotated[Count, Field(ge=0)] = 1
    check: CheckKeys | None = Field(None, description="repeat some runs in another tier")

    @model_validator(mode="after")
    def _distinct(self) -> Self:
        for key in ("faults", "sizes_mm", "speeds_kmh", "tracks"):
            values = getattr(self, key)
            if len(set(values)) < len(values):
                raise problem(f"{key} has an entry twice; each must stand once")
        names = [wheel.name for wheel in self.wheels]
        if len(set(names)) < len(names):
            raise problem("wheels has a name twice; each must stand once")
        if self.check is not None and self.check.tier == self.tier:
            raise problem(
                f"check.tier is {self.check.tier!r}, the tier of the matrix itself; it must be another"
            )
        return self

    def noun(self, folder: Path) -> Trial:
        """The trial, SI."""
        return Trial(
            name=self.trial,
            purpose=self.purpose,
            scene=self.scene,
            folder=folder,
            tier=self.tier,
            effects=self.effects,
            faults=self.faults,
            sizes=tuple(size / MM for size in sorted(self.sizes_mm)),
            spall=self.spall.noun(),
            speeds=tuple(speed * KMH for speed in self.speeds_kmh),
            tracks=self.tracks,
            wheels=tuple(wheel.noun() for wheel in self.wheels),
            repeats=self.repeats,
            healthy_repeats=self.healthy_repeats,
            revolutions=self.revolutions,
            interval=self.interval_s,
            seed=self.seed,
            check_tier=self.check.tier if self.check else None,
            check_every=self.check.every if self.check else 1,
        )


def load_trial(name: str | Path, *, tier: str | None = None, seed: int | None = None) -> Trial:
    """Trial of a shipped name or of a file.

    Parameters
    ----------
    name : str or Path
    tier, seed : optional
        Instead of the file's; with another tier the check falls away where it is the same one.

    Raises
    ------
    InputError
        With every mistake in the file and in the scenes that it asks for.
    """
    path = find("trials", str(name))
    data = read_file(path)
    if tier is not None:
        data["tier"] = tier
        if isinstance(data.get("check"), dict) and data["check"].get("tier") == tier:
            del data["check"]
    if seed is not None:
        data["seed"] = seed
    try:
        trial = TrialKeys.model_validate(data).noun(path.parent)
    except ValidationError as error:
        raise InputError(sentences(error, [Origin((), str(path))])) from None
    problems = dict.fromkeys(
        f"{path}: {problem}" for cell in _corners(trial) for problem in _scene_problems(trial, cell)
    )
    if problems:
        raise InputError(list(problems))
    return trial


def _scene_problems(trial: Trial, cell: Cell) -> tuple[str, ...]:
    try:
        trial_scene(trial, cell)
    except InputError as error:
        return tuple(error.problems)
    return ()


def trial_scene(trial: Trial, cell: Cell) -> Scene:
    """Scene of one run.

    Row and place of the spall follow from the run's seed: on the cup within 30 degrees of the middle of the
    load zone, anywhere on the cone or a roller.

    Parameters
    ----------
    trial : Trial
    cell : Cell

    Raises
    ------
    InputError
        With every mistake.
    """
    path = find("scenes", trial.scene, trial.folder)
    data = read_file(path)
    operation = data.get("operation")
    if not isinstance(operation, dict) or operation.get("kind") != "quarter_vehicle":
        raise InputError(
            f"scene {trial.scene}: operation.kind must be 'quarter_vehicle', whose speed a trial sets"
        )
    irregularity = operation.get("irregularity")
    diameter = float(operation.get("wheel_diameter_mm", USUAL_WHEEL_DIAMETER_MM)) / MM
    seed = cell.seed(trial.seed)
    data["operation"] = {
        **operation,
        "irregularity": {**(irregularity if isinstance(irregularity, dict) else {}), "kind": cell.track},
        "speed_profile": [{"time_s": 0, "speed_kmh": cell.speed / KMH}],
        "wheel_defects": list(trial.wheel(cell.wheel).defects),
    }
    data |= {
        "scene": f"{trial.name}, {cell.key}"[:80],
        "tier": cell.tier,
        "duration_s": trial.duration(cell.speed, diameter),
        "seed": seed,
        "defects": [] if cell.fault == HEALTHY else [_spall(trial.spall, cell, seed)],
    }
    if cell.tier == "lumped":  # healthy and faulty runs with the same band
        data["numerics"] = {"steps_per_sample": 1, **data.get("numerics", {})}
    if isinstance(trial.effects, dict) and "preset" not in trial.effects:
        given = data.get("effects")
        data["effects"] = overlay(
            given if isinstance(given, dict) else {"preset": given or "standard"}, trial.effects
        )
    elif trial.effects is not None:
        data["effects"] = trial.effects
    return scene_from_mapping(data, f"scene {trial.scene} as {cell.key}", path.parent)


def _spall(spall: Spall, cell: Cell, seed: int) -> dict[str, Any]:
    random = np.random.default_rng(seed)
    row, roller = int(random.integers(2)), int(random.integers(8))
    reach = _LOAD_ZONE_DEG if cell.fault == "cup" else 180.0
    return {
        "kind": "spall",
        "on": cell.fault,
        "row": row,
        "azimuth_deg": float(random.uniform(-reach, reach)),
        "width_mm": cell.size * MM,
        "depth_um": spall.depth(cell.size) * UM,
        "length_mm": spall.length_per_width * cell.size * MM,
        **({"roller": roller} if cell.fault == "roller" else {}),
    }


def _corners(trial: Trial) -> list[Cell]:
    """Runs among which every entry of the matrix stands once, sizes with every fault."""
    first = trial.cells()[0]
    speed, track, wheel = first.speed, first.track, first.wheel
    tiers = dict.fromkeys(cell.tier for cell in trial.cells())
    corners = [Cell(HEALTHY, 0.0, speed, track, wheel, 0, tier) for tier in tiers]
    corners += [Cell(HEALTHY, 0.0, other, track, wheel, 0, trial.tier) for other in trial.speeds[1:]]
    corners += [Cell(HEALTHY, 0.0, speed, other, wheel, 0, trial.tier) for other in trial.tracks[1:]]
    corners += [Cell(HEALTHY, 0.0, speed, track, other.name, 0, trial.tier) for other in trial.wheels[1:]]
    corners += [
        Cell(fault, size, speed, track, wheel, 0, trial.tier)
        for fault in trial.faults
        for size in (trial.sizes[0], trial.sizes[-1])
    ]
    return list(dict.fromkeys(corners))

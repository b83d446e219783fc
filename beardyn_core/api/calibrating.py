"""Make the scene of one measured axlebox."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.api.making import scene as make_scene
from beardyn_core.api.reading import heard_of, monitor
from beardyn_core.base import interrupts
from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole, file_problems
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.calibration.fitting import FEWEST_RUNS, Fit, Fitted, Fitter, rms
from beardyn_core.calibration.spectra import Hearing, Ride, heard_in, rides_of
from beardyn_core.calibration.twin import Beside, operation_at
from beardyn_core.calibration.unknowns import BY_NAME, UNKNOWNS, Unknown
from beardyn_core.calibration.writing import scene_keys, scene_text
from beardyn_core.choice import scene_from_mapping
from beardyn_core.config.folders import find
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.inference import FEWEST_TURNS, alike, sizes_text
from beardyn_core.record.run import Run
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIER_NAMES
from beardyn_core.study.monitored_recording import HOT_BOX

USUAL_BUDGET = 80
_SHORTEST, _LONGEST = 1.0, 4.0  # stretch, [s]
_TURNS = 1.2 * FEWEST_TURNS  # of the shaft in a stretch
_SAME_RATE = 1e-3
_WITHIN = 2.0  # tolerances, that a band of a good twin is off by at most
_FARTHEST_SPEED = 2.0  # of the recordings from that of the scene, as a ratio: what is heard grows with it


@dataclass(frozen=True, eq=False)
class Calibration:
    """What a calibration has come to."""

    scene: A[Scene, "of the axlebox"]
    text: A[str, "of its file"]
    found: A[Fitted, "values with intervals, heard less twin in each band before and after"]
    absent: A[tuple[str, ...], "what is not fitted as the scene has none of it, in sentences"]
    hearing: A[Hearing, "axes, sampling rate, and the bands compared"]
    speeds: A[tuple[float, ...], "of the shaft at which twins ran, [Hz]"]
    stretches: A[int, "that were heard"]

    @property
    def fits(self) -> tuple[Fit, ...]:
        """What was to be fitted."""
        return self.found.fits

    def __getitem__(self, name: str) -> Fit:
        """Find an unknown by its name."""
        return next(each for each in self.fits if each.unknown.name == name)

    @property
    def residuals(self) -> tuple[float, float]:
        """Root mean square of heard less twin before and after, [dB]."""
        return rms(self.found.before), rms(self.found.after)

    @property
    def sentences(self) -> list[str]:
        """Say everything, a line each."""
        before, after = self.residuals
        within = np.mean(np.abs(self.found.after) <= _WITHIN * self.found.tolerance)
        return [
            *(each.sentence for each in self.fits),
            *self.absent,
            f"heard less twin in twelfths of an octave, root mean square: {before:.1f} dB before, "
            f"{after:.1f} dB after; {100 * within:.0f} % of the bands within {_WITHIN:g} tolerances",
            *(["the search was interrupted: these are the best values so far"] * self.found.interrupted),
        ]


def calibrate(
    runs: Run | Path | str | Sequence[Run | Path | str],
    scene: Scene | Path | str,
    output: Path | str | None = None,
    *,
    fit: Sequence[str] | None = None,
    tier: str = "quasistatic",
    budget: int = USUAL_BUDGET,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
    force: bool = False,
    progress: bool = False,
) -> Calibration:
    """Fit what no drawing tells of an axlebox to its healthy recordings, and write its scene.

    Parameters
    ----------
    runs : Run, Path or sequence of them
        Of one axlebox with a sound bearing.
    scene : Scene or Path
        Of such an axlebox, sound, on its track: what is fitted begins there, the rest stays.
    output : Path, optional
        YAML file to write.
    fit : sequence of str, optional
        Of ``frequency``, ``damping``, ``background``, ``noise``, ``end_play``; by default all that the scene
        has.
    tier : str
        Of the twin.
    budget : int
        Runs of twins at each speed of the recordings, of a second or more.
    bearing, sensor
        See `beardyn_core.monitor`.
    force : bool
        Replace the file if it exists.
    progress : bool
        Say on standard error what is done.

    Returns
    -------
    Calibration
        ``found["frequency"].value`` and ``.interval``; ``.reason`` where a number is left as it was.

    Raises
    ------
    InputError
        Recordings do not fit the scene, a fault is heard in one, or what is to be fitted is not in the scene.
    """
    several = [runs] if isinstance(runs, Run | Path | str) else list(runs)
    base = scene if isinstance(scene, Scene) else find("scenes", str(scene))
    recorded = [each.path if isinstance(each, Run) else Path(each) for each in several]
    inputs = [each for each in (*recorded, base) if isinstance(each, Path)]
    problems = _asked(fit, tier, budget, several)
    if output:
        problems += file_problems("output", Path(output), inputs=inputs, force=force, ending=".yaml")
    if problems:
        raise InputError(problems)
    library("cma", "a calibration", "calibrate")
    twin = make_scene(base, tier=tier)
    heard = [heard_of(each, bearing, sensor) for each in several]
    number = _number_of(twin, heard[0][2], asked=bool(sensor))
    wanted, absent = _unknowns(twin, number, fit)
    hearing, rides = _rides(twin, number, heard)
    say = _say if progress else _nothing
    beside = Beside(twin, hearing, number, rides)
    bases = tuple(float(each.base_of(twin, number) or 0.0) for each in wanted)
    total = budget * len(rides)
    found = Fitter(beside, wanted, bases, budget, lambda what, run: say(f"{run}/{total} twins, {what}")).fit()
    folder = Path(output).parent if output else Path()
    with interrupts.whole():  # what an interrupted search has found is written too
        data = scene_keys(base, twin, found.fits, number, folder)
        if output:
            data["scene"] = Path(output).stem
        made = Calibration(
            scene_from_mapping(data, f"scene {twin.name}", folder),
            "",
            found,
            absent,
            hearing,
            tuple(each.shaft_frequency for each in rides),
            sum(len(each.levels) for each in rides),
        )
        labels = ", ".join(Path(run.label).name for run, _, _ in heard)
        head = f"Scene of one axlebox: {twin.name} fitted to {labels} by `beardyn calibrate`, tier {tier}."
        made = replace(made, text=scene_text(data, [head, *made.sentences]))
        if output:
            with as_a_whole(Path(output), replace=force) as fresh:
                fresh.write_text(made.text, encoding="utf-8")
    return made


def _asked(fit: Sequence[str] | None, tier: str, budget: int, runs: Sequence[object]) -> list[str]:
    """List what is wrong with what is asked for, before anything is read."""
    known = ", ".join(BY_NAME)
    problems = [
        f"fit: {name!r} is no unknown; allowed are {known}" for name in fit or () if name not in BY_NAME
    ]
    problems += ["fit: names nothing; allowed are " + known] if fit is not None and not fit else []
    problems += [] if tier in TIER_NAMES else [f"tier: is {tier!r}; allowed are {', '.join(TIER_NAMES)}"]
    problems += [] if budget >= FEWEST_RUNS else [f"budget: is {budget}; it must be at least {FEWEST_RUNS}"]
    return problems + ([] if runs else ["runs: there is none; give a recording"])


def _number_of(scene: Scene, name: str, asked: bool) -> int:
    """Find the accelerometer of the scene that stands for the one that is heard."""
    names = [each.name for each in scene.sensors]
    if scene.faults:
        raise InputError(
            f"scene {scene.name}: has a fault ({scene.fault_sentences[0]}); calibrate with the sound scene"
        )
    if scene.axleboxes is not None:
        raise InputError(f"scene {scene.name}: has several axleboxes; give the scene of one")
    if asked and len(names) > 1 and name not in names:
        raise InputError(f"scene {scene.name}: has no sensor {name!r}; it has {', '.join(names)}")
    return names.index(name) if name in names else 0


def _unknowns(
    scene: Scene, sensor: int, fit: Sequence[str] | None
) -> tuple[tuple[Unknown, ...], tuple[str, ...]]:
    """Find what is to be fitted, and say what the scene has none of.

    Raises
    ------
    InputError
        It has none of what is asked for, or of anything.
    """
    wanted = [each for each in UNKNOWNS if fit is None or each.name in fit]
    lacking = [each for each in wanted if each.base_of(scene, sensor) is None]
    if fit is not None and lacking:
        raise InputError([f"fit {each.name}: the scene {scene.name} {each.absent}" for each in lacking])
    absent = tuple(f"{each.words}: not fitted, the scene {each.absent}" for each in lacking)
    return tuple(each for each in wanted if each not in lacking), absent


def _rides(
    scene: Scene, sensor: int, heard: list[tuple[Run, Bearing | NamePlate, str]]
) -> tuple[Hearing, tuple[Ride, ...]]:
    """Hear the recordings, and refuse those that are not of such an axlebox."""
    rate, problems, axes, speeds = scene.sensors[sensor].rate, list[str](), set(AXES), list[float]()
    for run, plate, name in heard:
        if not alike(scene.bearing, plate):
            problems.append(
                f"{run.label}: is of {plate.name}, {sizes_text(plate)}; the scene {scene.name} has "
                f"{scene.bearing.name}, {sizes_text(scene.bearing)}"
            )
        signal = run.sensors.get(name, run.vibration)
        if name and name not in run.sensors:
            problems.append(f"{run.label}: has no sensor {name!r}; it has {', '.join(run.sensors)}")
        elif not len(signal) or len(run.shaft) < 2:
            problems.append(f"{run.label}: has no vibration with a shaft angle to calibrate with")
        elif signal.rate < (1.0 - _SAME_RATE) * rate:
            problems.append(
                f"{run.label}: is sampled at {signal.rate:.0f} Hz, the accelerometer of the scene "
                f"{scene.name} at {rate:.0f} Hz; what lies between is not in the signal"
            )
        else:
            measured = np.isfinite(np.asarray(signal.values))
            axes &= {axis for k, axis in enumerate(AXES) if measured[:, k].any()}
            turned = np.unwrap(run.shaft.angle)
            seconds = 1e-9 * float(run.shaft.time_ns[-1] - run.shaft.time_ns[0])
            speeds.append(abs(float(turned[-1] - turned[0])) / (2.0 * np.pi * seconds))
            problems += _too_far(scene, run.label, speeds[-1])
    if not problems and not axes:
        problems.append("the recordings have no axis of vibration in common")
    if problems:
        raise InputError(problems)
    for run, plate, name in heard:
        verdict = monitor(run, bearing=plate, sensor=name)
        if verdict.finding is not None and (verdict.finding.is_fault or verdict.verdict == HOT_BOX):
            problems.append(
                f"{run.label}: the monitor hears a fault ({verdict.finding.reason}); a calibration is by "
                "sound bearings"
            )
    stretch = max(_SHORTEST, _TURNS / max(float(np.median(speeds)), 1e-3))
    hearing = Hearing(tuple(axis for axis in AXES if axis in axes), rate, min(stretch, _LONGEST))
    found = [each for run, _, name in heard for each in heard_in(run, hearing, name)]
    if not found:
        problems.append(
            f"{heard[0][0].label}: has no {hearing.stretch:.2f} s of whole vibration in which the shaft "
            f"turns {FEWEST_TURNS:g} times one way"
        )
    if problems:
        raise InputError(problems)
    return hearing, rides_of(found)


def _too_far(scene: Scene, label: str, frequency: float) -> list[str]:
    """Say why a recording's speed does not fit a scene."""
    course = scene.operation
    if isinstance(course, QuarterVehicleOperation):
        fastest = max(speed for _, speed in course.speed_profile) / (np.pi * course.wheel_diameter)
    elif isinstance(course, ConstantOperation):
        fastest = abs(course.speed) / (2.0 * np.pi)
    else:
        operation_at(scene, frequency)  # refuses it
    if fastest / _FARTHEST_SPEED <= frequency <= _FARTHEST_SPEED * fastest:
        return []
    return [
        f"{label}: its shaft turns {60.0 * frequency:.0f} times a minute, that of the scene {scene.name} "
        f"{60.0 * fastest:.0f} times; give a scene of about this speed, as the background grows with it"
    ]


def _say(text: str) -> None:
    print(f"beardyn: {text}", file=sys.stderr, flush=True)


def _nothing(_text: str) -> None:
    """Tell nothing."""

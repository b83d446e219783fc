"""Make the scene of one measured axlebox."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from beardyn_core.base import interrupts
from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole, file_problems

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.calibration.calibration_result import Calibration
    from beardyn_core.record.run import Run
    from beardyn_core.scene.scene import Scene


def calibrate(
    runs: Run | Path | str | Sequence[Run | Path | str],
    scene: Scene | Path | str,
    output: Path | str | None = None,
    *,
    fit: Sequence[str] | None = None,
    tier: Literal["lumped", "quasistatic", "full"] = "quasistatic",
    budget: int = 80,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
    force: bool = False,
    progress: bool = False,
) -> Calibration:
    """Fit a scene to healthy recordings of one axlebox, write the scene of that axlebox.

    Fit what no drawing shows of an axlebox (natural frequencies and damping of the box, background, noise of
    the accelerometer, end play) to recordings with a healthy bearing: twins run at the speed of the
    recordings, and their spectra are compared. Writes the scene with the values that the recordings
    determine; the rest is reported and left. Needs ``pip install beardyn[calibrate]``.

    Parameters
    ----------
    runs : Run, Path or sequence of them
        Healthy recordings of one axlebox. Or runs.
    scene : Scene or Path
        Healthy scene of such an axlebox: what is fitted begins there, the rest stays.
    output : Path, optional
        Scene to write; default none, it is printed only. It is a YAML file.
    fit : sequence of str, optional
        What is fitted: frequency, damping, background, noise, end_play; default all that the scene has.
    tier : str
        Of the twin. ``lumped``, ``quasistatic`` or ``full``.
    budget : int
        Runs of the twin at each speed of the recordings, of a second or more; at least 42.
    bearing, sensor
        See `beardyn_core.estimate`.
    force : bool
        Replace the file when it exists; default refuse.
    progress : bool
        Print on standard error what is done.

    Returns
    -------
    Calibration
        ``found["frequency"].value`` and ``.interval``; ``.reason`` where a number is left as it was.

    Raises
    ------
    InputError
        Recordings do not fit the scene, one has a fault, or what is to be fitted is not in the scene.
    """
    from beardyn_core.api.making import scene as make_scene
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.calibration.calibration_result import Calibration
    from beardyn_core.calibration.fitting import Fitter
    from beardyn_core.calibration.intake import rides_received, sensor_number, unknowns_of
    from beardyn_core.calibration.twin import Beside
    from beardyn_core.calibration.writing import scene_keys, scene_text
    from beardyn_core.choice import scene_from_mapping
    from beardyn_core.config.folders import find
    from beardyn_core.record.run import Run
    from beardyn_core.scene.scene import Scene

    several = [runs] if isinstance(runs, Run | Path | str) else list(runs)
    base = scene if isinstance(scene, Scene) else find("scenes", str(scene))
    recorded = [each.path if isinstance(each, Run) else Path(each) for each in several]
    inputs = [each for each in (*recorded, base) if isinstance(each, Path)]
    problems = list_request_mistakes(fit, tier, budget, several)
    if output:
        problems += file_problems("output", Path(output), inputs=inputs, force=force, ending=".yaml")
    if problems:
        raise InputError(problems)
    library("cma", "a calibration", "calibrate")
    twin = make_scene(base, tier=tier)
    received = [resolve_source(each, bearing, sensor) for each in several]
    number = sensor_number(twin, received[0][2], asked=bool(sensor))
    wanted, absent = unknowns_of(twin, number, fit)
    reception, rides = rides_received(twin, number, received)
    say = _say if progress else _nothing
    beside = Beside(twin, reception, number, rides)
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
            reception,
            tuple(each.shaft_frequency for each in rides),
            sum(len(each.levels) for each in rides),
        )
        labels = ", ".join(Path(run.label).name for run, _, _ in received)
        head = f"Scene of one axlebox: {twin.name} fitted to {labels} by `beardyn calibrate`, tier {tier}."
        made = replace(made, text=scene_text(data, [head, *made.sentences]))
        if output:
            with as_a_whole(Path(output), replace=force) as fresh:
                fresh.write_text(made.text, encoding="utf-8")
    return made


def list_request_mistakes(
    fit: Sequence[str] | None, tier: str, budget: int, runs: Sequence[object]
) -> list[str]:
    """List what is wrong with what is asked for, before anything is read."""
    from beardyn_core.calibration.fitting import FEWEST_RUNS
    from beardyn_core.calibration.unknowns import BY_NAME
    from beardyn_core.scene.tier import TIER_NAMES

    known = ", ".join(BY_NAME)
    problems = [
        f"fit: {name!r} is no unknown; allowed are {known}" for name in fit or () if name not in BY_NAME
    ]
    problems += ["fit: names nothing; allowed are " + known] if fit is not None and not fit else []
    problems += [] if tier in TIER_NAMES else [f"tier: is {tier!r}; allowed are {', '.join(TIER_NAMES)}"]
    problems += [] if budget >= FEWEST_RUNS else [f"budget: is {budget}; it must be at least {FEWEST_RUNS}"]
    return problems + ([] if runs else ["runs: there is none; give a recording"])


def _say(text: str) -> None:
    print(f"beardyn: {text}", file=sys.stderr, flush=True)


def _nothing(_text: str) -> None:
    """Tell nothing."""

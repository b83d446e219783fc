"""Make the estimators of a bearing: runs are simulated, every set of axes learns from the same ones."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import file_problems, write_whole

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.experiments import Cluster
    from beardyn_core.experiments.loop import Progress, Report
    from beardyn_core.follow.estimator import Estimator
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.population.training_sweep import TrainingSweep

_AXES = "xyz"
_DIGEST = "training"  # key of a card
_TRAINING_S = 100.0  # processor time of an estimator from its runs, [s]
_BOX_S = 150.0  # of the modes of a box


class MadeEstimator(NamedTuple):
    """An estimator and its file."""

    file: Path
    estimator: Estimator
    is_new: bool  # whether it was not there before


def make_estimators(
    bearing: RollerBearing | Path | str | None = None,
    output: Path | str | None = None,
    *,
    scene: Path | str | None = None,
    sensor: str = "",
    like: str = "",
    axes: Sequence[str] = ("xyz", "z"),
    workers: int | None = None,
    force: bool = False,
    progress: bool | Callable[[Progress], None] = False,
) -> tuple[MadeEstimator, ...]:
    """Simulate runs of a bearing in the service of its class, and train estimators on them.

    The sweep of the vehicle class, such as ``freight_axlebox``, is fitted to the bearing: loads by the
    rating, box by the cup. Runs of two tiers are simulated next to the output, where an interrupted call goes
    on; every set of axes learns from the same runs. `estimate` and `follow` find what lies in the folder of
    the user.

    Parameters
    ----------
    bearing : RollerBearing, Path or str, optional
        Shipped bearing, its file, or a recording of it: simulate runs of it and train on them; needed but for
        `scene`.
    output : Path, optional
        File to write; default one in the folder of the user's own estimators. That is
        ``$BEARDYN_DATA_DIR/estimators`` or ``~/.local/share/beardyn/estimators``. Of several sets of axes,
        their letters are added to the name. Needed with `scene`, whose estimators are for one axlebox.
    scene : Path or str, optional
        Scene of one axlebox, such as `calibrate` writes: simulate rides in its box and train on them; default
        boxes of the vehicle class. Its stiffness is varied by 2 %, its damping by 60 %, its end play by 0.03
        mm, about what calibrations of simulated boxes left open; damping by a factor of up to 2.6 in one.
    sensor : str, optional
        Kind of the accelerometer, shipped or a file; default that of the vehicle class.
    like : str, optional
        Sweep of the vehicle class and this kind of bearing, shipped or a file; default that whose bearing is
        most like this one.
    axes : sequence of str
        Sets of axes of the accelerometer, an estimator for each.
    workers : int, optional
        Processes of this machine; default one for each core.
    force : bool
        Replace estimators that exist, and runs of other code; default keep what is there.
    progress : bool or callable
        Print on standard error what is done; or a function that is called after every task of runs.

    Returns
    -------
    tuple of MadeEstimator
        One for each set of axes, also those that were there.

    Raises
    ------
    InputError
        With every mistake, before anything runs.
    """
    from beardyn_core.api.sweeping import Lines, cluster_of
    from beardyn_core.follow import training
    from beardyn_core.follow.estimator_choice import own_folder
    from beardyn_core.population.training_sweep import compose_sweep

    if (bearing is None) == (scene is None):
        raise InputError("bearing, scene: give one of the two")
    if scene is not None and output is None:
        raise InputError("output: is missing; the estimator of one axlebox needs a file of its own")
    whole = _bearing_of_scene(scene) if bearing is None else _whole_bearing(bearing)
    base = own_folder() / _name(whole, sensor) if output is None else Path(output)
    problems = axes_problems(axes)
    files = estimator_files(base, axes, always=output is None)
    try:
        sweep = compose_sweep(whole, sensor=sensor, like=like, scene="" if scene is None else str(scene))
    except InputError as error:
        raise InputError([*problems, *error.problems]) from None
    problems += missing("gmsh", "fitting a box to a bearing", "structure") if sweep.box else []
    there = {} if force else {each: _kept(file, each, sweep) for each, file in files.items()}
    kept = {each: found for each, found in there.items() if found is not None}
    missed = [each for each in files if each not in kept]
    for each in missed:
        if output is not None:
            problems += file_problems("output", files[each], force=force, ending=".npz")
        elif files[each].exists() and not force:
            problems.append(
                f"output: {files[each]} is of another sweep or sensor; take --force to replace it"
            )
    cluster = cluster_of(workers, "", None, None)
    problems += cluster.problems()
    for module in ("zarr", "sklearn"):
        problems += missing(module, "training", "sweep")
    if problems:
        raise InputError(problems)
    made = {each: MadeEstimator(files[each], found, is_new=False) for each, found in kept.items()}
    if missed:
        say = _say if progress else _nothing
        folder = base.with_name(f"{base.stem}_runs")
        folder.mkdir(parents=True, exist_ok=True)
        say(_forecast(sweep, folder, len(missed)))
        tell: Report = progress if callable(progress) else Lines() if progress else _nothing
        sets = _simulate(sweep, folder, cluster, force, tell, say)
        for each in missed:
            say(f"learning from axes {each} of {len(sets[0])} runs, put right by {len(sets[1])}")
            found = training.train(sets[0], calibration=sets[1:], axes=tuple(each))
            found = replace(found, card={**found.card, _DIGEST: sweep.digest})
            found.save(files[each], replace=force)
            made[each] = MadeEstimator(files[each], found, is_new=True)
    return tuple(made[each] for each in files)


def axes_problems(axes: Sequence[str], option: str = "axes") -> list[str]:
    """List what is wrong with sets of axes of an accelerometer."""
    problems = [
        f"{option}: {each!r} is no set of axes; give one or more of x, y and z, each once"
        for each in axes
        if not each or set(each) - set(_AXES) or len(set(each)) < len(each)
    ]
    if not axes or len({frozenset(each) for each in axes}) < len(axes):
        problems.append(f"{option}: {','.join(axes)!r}: give sets of axes, each once, such as xyz,z")
    return problems


def estimator_files(base: Path, axes: Sequence[str], *, always: bool = False) -> dict[str, Path]:
    """Name the file of each set of axes; the axes are in the name where there are several, or `always`."""
    sets = ["".join(sorted(each)) for each in axes]
    if len(sets) == 1 and not always:
        return {sets[0]: base}
    return {each: base.with_name(f"{base.stem}_{each}{base.suffix}") for each in sets}


def _whole_bearing(bearing: RollerBearing | Path | str) -> RollerBearing:
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.config import load_any_bearing, shipped_names

    if isinstance(bearing, RollerBearing):
        return bearing
    if entry := _catalogue_entry(str(bearing)):
        raise InputError(
            f"bearing: {bearing} is a {entry.kind} bearing of the catalogue, bearing data for the monitor; "
            f"estimators are trained for whole ones: {', '.join(shipped_names('bearings'))}, or a file of "
            "your own (of a tapered unit `derive: true` needs five numbers)"
        )
    if Path(bearing).suffix != ".mcap":
        return load_any_bearing(bearing)
    found = resolve_source(bearing, None, "")[1]
    if not isinstance(found, RollerBearing):
        raise InputError(
            f"bearing: {bearing} has bearing data alone, which cannot be simulated; give the file of a whole "
            "bearing"
        )
    return found


def _catalogue_entry(name: str) -> CatalogueEntry | None:
    """Find the line of the catalogue that a name means; ``None`` of a whole bearing, a file and no name."""
    from beardyn_core.config.plates import find_entry

    if Path(name).suffix == ".mcap":
        return None
    try:
        return find_entry(name)
    except InputError:
        return None


def _bearing_of_scene(scene: Path | str | None) -> RollerBearing:
    from beardyn_core.config import read_scene

    assert scene is not None
    return read_scene(scene).scene.bearing


def _name(bearing: RollerBearing, sensor: str) -> str:
    """Name the file of the estimators of a bearing in the folder of the user."""
    parts = [bearing.name, Path(sensor).stem] if sensor else [bearing.name]
    return re.sub(r"[^\w.-]+", "_", "_".join(parts)) + ".npz"


def _kept(file: Path, axes: str, sweep: TrainingSweep) -> Estimator | None:
    """Read the estimator that a call before has made of the same sweep and axes; none of another file."""
    from beardyn_core.follow.estimator import read_estimator

    try:
        found = read_estimator(file)
    except InputError:
        return None
    same = found.card.get(_DIGEST) == sweep.digest and "".join(found.axes) == axes
    return found if same else None


def _simulate(
    sweep: TrainingSweep,
    folder: Path,
    cluster: Cluster,
    force: bool,
    report: Report,
    say: Callable[[str], None],
) -> list[LabelledSet]:
    """Run what the folders of both parts have not yet; gives their sets."""
    import yaml

    from beardyn_core.experiments import EngineError
    from beardyn_core.population.folder import folder_of_set_problems
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.population.request import make_plan
    from beardyn_core.population.sweeping import conduct
    from beardyn_core.population.training_sweep import PARTS

    table = None if sweep.box is None else _fitted_box(sweep, folder, force, say)
    sets = []
    for part in PARTS:
        file, runs = folder / f"{part}.yaml", folder / part
        keys = yaml.safe_dump(sweep.of_part(part, table), sort_keys=False)
        write_whole(file, f"# Made by `beardyn train --bearing`; `beardyn sweep` takes it.\n{keys}")
        plan = make_plan(file, say)
        stale = bool(folder_of_set_problems(runs, plan, force=False))
        try:
            conduct(plan, runs, cluster, force=force and stale, report=report, say=say)
        except EngineError as error:
            raise InputError(str(error)) from error
        sets.append(LabelledSet(runs))
    return sets


def _fitted_box(sweep: TrainingSweep, folder: Path, force: bool, say: Callable[[str], None]) -> Path:
    """Compute the modes of the box that is fitted to the bearing, once."""
    from beardyn_core.structure.build import modes_of
    from beardyn_core.structure.table import table_text

    assert sweep.box is not None
    file = (folder / "box.csv").absolute()
    if force or not file.is_file():
        say(f"modes of the box {sweep.box.name}, fitted to {sweep.bearing.name}: a minute or so")
        write_whole(file, table_text(modes_of(sweep.box, sweep.bearing).modes))
    return file


def _forecast(sweep: TrainingSweep, folder: Path, count: int) -> str:
    """Say what is done and how long it takes."""
    from beardyn_core.population.training_sweep import LEARNT, TRUER

    seconds = sweep.seconds + count * _TRAINING_S + (_BOX_S if sweep.box else 0.0)
    runs = f"{sweep.count(LEARNT)} runs to learn from and {sweep.count(TRUER)} of {TRUER}"
    return (
        f"{sweep.bearing.name} in the service of {sweep.like}: {runs} in {folder}; all of it takes some "
        f"{seconds / 60.0:.0f} min of one core, and the same command goes on where it was"
    )


def _say(text: str) -> None:
    print(f"beardyn: {text}", file=sys.stderr, flush=True)


def _nothing(_now: object) -> None:
    """Tell nothing."""

"""The ladder: a scene over tiers, effects, laminae and steps against a converged reference of itself.

All levels get the same load history and sensor noise, one after the other in one process of the engine, for
they are timed. Runs are kept in the store that is given, from which an interrupted study goes on; the runs of
one level are all of one go. Repeated runs begin a hair apart: `vary_start`.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.kinematics import cage_speed_ratio
from beardyn_core.effects import KinematicCage
from beardyn_core.experiments import Cluster, Engine, ThisProcess, loop
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Store
from beardyn_core.physics.tiers.status import describe
from beardyn_core.rail.build import load_history, load_of_run
from beardyn_core.run import start
from beardyn_core.scene.scene import USUAL_QUANTITIES, Scene
from beardyn_core.study.ladder_levels import Level, LevelList, expected_cost
from beardyn_core.study.ladder_result import Cost, Ladder, LevelResult, errors
from beardyn_core.study.ladder_store import digests_of, resume
from beardyn_core.study.level_run import Attempt, Comparison, Run
from beardyn_core.study.measures import SignalCollector, fault_line_of, outcome
from beardyn_core.twin import Twin

COMPLETE = "complete"
SETTLING_S = 0.4
SHORTEST_COMPARISON_S, FEWEST_CAGE_REVOLUTIONS = 1.2, 4
MOST_WINDOWS = 10
REFERENCE_RUNS, CHEAP_RUNS = 3, 2
# levels that are expected to cost less than this run more than once, [s/s]
CHEAP = 1.5
# the filters' delay: the trends of a run end this much before its last block does, rounded up, [s]
_DELAY = 0.04
_VARIED_END_PLAY, _VARIED_SPEED = 1.0e-9, 1.0e-4


Progress = Callable[[str, float], None]
Runner = Callable[[Scene, Comparison], Run]


def comparison_of(scene: Scene, duration: float | None = None, settling: float | None = None) -> Comparison:
    """Make the load and place the windows.

    Parameters
    ----------
    scene : Scene
    duration, settling : float, optional
        Compared (a second or a few cage revolutions, not longer than the scene), and before that, [s].

    Raises
    ------
    InputError
        When the load cannot be made, as from a measurement that is too short.
    """
    if settling is None:
        settling = min(SETTLING_S, 0.25 * scene.duration)
    if duration is None:
        duration = _usual_duration(scene, max(scene.duration - settling - _DELAY, 0.5 * scene.duration))
    block = Twin.block_ns * 1e-9
    block_count = math.ceil(round((settling + duration + _DELAY) / block, 6))
    load = load_of_run(scene, block_count * block)
    edges, revolutions = window_edges(
        load.time_ns.astype(np.float64) * 1e-9,
        cage_speed_ratio(scene.bearing) * np.abs(load.shaft_speed),
        settling,
        settling + duration,
    )
    return Comparison(scene, load, settling, edges, revolutions, block_count, fault_line_of(scene))


def _usual_duration(scene: Scene, longest: float) -> float:
    """Return a second or a few cage revolutions at the scene's first speed, [s]."""
    probe = load_history(
        scene.operation, scene.mounting, min(0.1, scene.duration), scene.seed, bearing=scene.bearing
    )
    speed = cage_speed_ratio(scene.bearing) * float(np.abs(probe.shaft_speed).mean())
    turns = FEWEST_CAGE_REVOLUTIONS * 2.0 * math.pi / speed if speed > 0.0 else 0.0
    return min(max(SHORTEST_COMPARISON_S, 1.05 * turns), longest)


def window_edges(times: Float, cage_speed: Float, start: float, end: float) -> tuple[tuple[float, ...], int]:
    """Find the ends of equal windows of whole cage revolutions between two times [s], and their revolutions.

    The cage speed is that in pure rolling, [rad/s], shape [sample]. Without a whole revolution there are four
    windows of equal length.
    """
    steps = 0.5 * (cage_speed[1:] + cage_speed[:-1]) * np.diff(times)
    turned = np.concatenate([[0.0], np.cumsum(steps)]) / (2.0 * math.pi)
    first, last = np.interp([start, end], times, turned)
    whole = int(last - first + 1e-9)
    if whole == 0:
        return tuple(np.linspace(start, end, 5).tolist()), 0
    each = math.ceil(whole / MOST_WINDOWS)
    windows = whole // each
    marks = last - each * np.arange(windows, -1, -1)
    return tuple(np.interp(marks, turned, times).tolist()), windows * each


def vary_start(scene: Scene, number: int) -> Scene:
    """Change the start of a scene very slightly, 0 not at all: end play by nm, cage speed by 1e-4."""
    if number == 0:
        return scene
    cage: Any = scene.effects.cage
    if cage is not None and not isinstance(cage, KinematicCage):
        ratio = cage.initial_speed_ratio + _VARIED_SPEED * number
        scene = replace(scene, effects=replace(scene.effects, cage=replace(cage, initial_speed_ratio=ratio)))
    return scene.with_play(scene.play + _VARIED_END_PLAY * number)


def simulate(scene: Scene, comparison: Comparison) -> Run:
    """Run a scene of a level; compiling and starting are not timed."""
    collector = SignalCollector()
    walls: list[float] = []
    warnings, block_s = 0, 1e-9 * Twin.block_ns
    clock = time.perf_counter
    try:
        simulation = start(scene, comparison.block_count * block_s, comparison.load)
        began = clock()
        for block in simulation.blocks(simulation.twin.blocks_at_once):
            count = round((block.end_ns - block.start_ns) / Twin.block_ns)
            walls += count * [(clock() - began) / (count * block_s)]
            warnings |= block.status
            collector.add(block)
            began = clock()
    except ValidityError as error:
        return Run(None, np.array(walls), str(error))
    settled = math.ceil(comparison.settling / block_s)
    status = f"{COMPLETE}, but {describe(warnings)}" if warnings else COMPLETE
    found = outcome(collector.signals(), comparison.edges, comparison.fault_line)
    return Run(found, np.array(walls[min(settled, len(walls) - 1) :]), status)


def compile_levels(
    comparison: Comparison, levels: LevelList, progress: Progress = lambda _name, _count: None
) -> None:
    """Compile the kernels of all levels, or load them from the cache, before anything is timed.

    Before every level ``progress`` gets the one that is next, and that one more (0 at first) is ready.
    """
    ready = set()
    for number, level in enumerate((levels.reference, *levels.levels)):
        progress(level.name, min(number, 1))
        kernels = (level.tier, level.effects)
        if kernels not in ready:
            Twin(level.applied(comparison.scene)).warm()
            ready.add(kernels)


def repeats_of(level: Level, least: int = 1) -> int:
    """Say how often a level is run."""
    return max(CHEAP_RUNS if expected_cost(level) <= CHEAP else 1, least)


def expected_wall(levels: LevelList, comparison: Comparison) -> float:
    """Return the wall time to expect of a ladder, for the time left, [s]."""
    return sum(_expected_seconds(attempt, comparison) for attempt in attempts(levels))


def attempts(levels: LevelList, reference_runs: int = REFERENCE_RUNS, least: int = 1) -> list[Attempt]:
    """List all runs of a ladder, the reference first, then the cheapest level first."""
    repeats = [
        (levels.reference, reference_runs),
        *((level, repeats_of(level, least)) for level in levels.levels),
    ]
    return [
        Attempt(place, level, number)
        for place, (level, count) in enumerate(repeats)
        for number in range(count)
    ]


def _expected_seconds(attempt: Attempt, comparison: Comparison) -> float:
    return expected_cost(attempt.level) * comparison.block_count * Twin.block_ns * 1e-9


def climb(
    comparison: Comparison,
    levels: LevelList,
    accuracy: float,
    asked: tuple[str, ...] = USUAL_QUANTITIES,
    progress: Progress = lambda _name, _wall: None,
    runner: Runner | None = None,
    reference_runs: int = REFERENCE_RUNS,
    least_runs: int = 1,
    store: Store[Run] | None = None,
) -> Ladder:
    """Run all levels, the reference first, then the least costly first.

    Parameters
    ----------
    comparison : Comparison
    levels : LevelList
    accuracy : float
        A share; what levels are judged by.
    asked : tuple of str
        Quantities it is asked of.
    progress : callable, optional
        Called with the next level, and the wall time that was expected of the run before, 0 at first, [s].
    runner : callable, optional
        Runs one scene in this process; when left out, `simulate` does in a process of the engine.
    reference_runs : int
        Two or more.
    least_runs : int
        Of every other level; usual are two of those that are cheap, and one of the others.
    store : Store, optional
        That of `ladder_store.store_of`. It keeps each run as it ends, and levels that are whole in it are not
        run again.

    Returns
    -------
    Ladder
        After an interrupt with what was done by then.

    Raises
    ------
    KeyboardInterrupt
        When nothing can be judged yet: before two runs of the reference were done.
    ValidityError
        When the reference leaves the model's validity.
    """
    todo = attempts(levels, reference_runs, least_runs)
    plan = Plan[Attempt, Run](
        {f"{each.place}, run {each.number}": each for each in todo},
        partial(_run_attempts, runner=simulate if runner is None else runner),
        comparison,
        lost=lambda _, killed: Run(None, np.empty(0), f"{killed} processes died of it"),
        has_failed=lambda run: run.outcome is None,
    )
    if store is not None and store.path is not None:
        plan = resume(replace(plan, digests=digests_of(plan.items, comparison)), store)
    done: list[list[Run]] = [[] for _ in (levels.reference, *levels.levels)]
    interrupted = False
    waiting = [plan.items[key] for key in plan.missing]

    def take(key: str, run: Run) -> None:
        attempt = plan.items[key]
        if attempt.place == 0 and run.outcome is None:
            raise ValidityError(f"the reference cannot be computed: {run.status}")
        done[attempt.place].append(run)

    def report(now: loop.Progress[Run]) -> None:
        for key, run in now.latest.items():
            take(key, run)
        before = sum((_expected_seconds(plan.items[key], comparison) for key in now.latest), 0.0)
        if waiting:
            progress(waiting[min(now.here, len(waiting) - 1)].level.name, before)

    for key, run in plan.kept.items():
        take(key, run)
    opened = nullcontext() if store is None else store.opened(plan)
    here = runner is not None or not waiting
    try:
        with opened, nullcontext(ThisProcess()) if here else Engine(Cluster(workers=1)) as engine:
            loop.run_plan(plan, engine, store, report)
    except KeyboardInterrupt:
        if len(done[0]) < 2:
            raise
        interrupted = True
    truth = done[0]
    rows = [
        _result(level, runs, truth)
        for level, runs in zip(levels.levels, done[1:], strict=True)
        if len(runs) == repeats_of(level, least_runs)
    ]
    reference = _result(levels.reference, truth, truth)
    return Ladder(
        scene=comparison.scene.name,
        purpose=comparison.scene.purpose,
        accuracy=accuracy,
        asked=asked,
        settling=comparison.settling,
        edges=comparison.edges,
        revolutions=comparison.revolutions,
        fault_line=comparison.fault_line,
        reference=replace(reference, errors=_result(levels.reference, truth[:1], truth).errors),
        neighbour=next((row for row in rows if row.level == levels.neighbour), None),
        rows=tuple(rows),
        interrupted=interrupted,
    )


def _run_attempts(items: Sequence[Attempt], comparison: Comparison, runner: Runner) -> list[Run]:
    """Do some runs in this process."""
    return [
        runner(vary_start(each.level.applied(comparison.scene), each.number), comparison) for each in items
    ]


def _result(level: Level, runs: list[Run], truth: list[Run]) -> LevelResult:
    walls = np.concatenate([run.walls for run in runs])
    lower, median, upper = np.quantile(walls, (0.25, 0.5, 0.75)) if len(walls) else np.full(3, np.nan)
    cost = Cost(float(median), float(lower), float(upper))
    outcomes = [run.outcome for run in runs if run.outcome is not None]
    reference = [run.outcome for run in truth if run.outcome is not None]
    status = next((run.status for run in runs if run.status != COMPLETE), COMPLETE)
    if len(outcomes) < len(runs):
        status = next(run.status for run in runs if run.outcome is None)
        return LevelResult(level, len(runs), cost, (), (), status)
    values = tuple(np.mean(parts, axis=0) for parts in zip(*(found.whole for found in outcomes), strict=True))
    return LevelResult(level, len(runs), cost, errors(outcomes, reference), values, status)

"""Conduct a sweep: rows to the workers, what comes back to the folder, and the set closed at the end."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import held_back, whole
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.experiments.loop import Report, run_plan
from beardyn_core.experiments.plan import Plan
from beardyn_core.population.batch import FAILED, Made, checked_batch, run_batch
from beardyn_core.population.draw import Row, rows_of
from beardyn_core.population.features import NAMES, VERDICT
from beardyn_core.population.finalizing import close_set
from beardyn_core.population.folder import SetStore, begin, folder_of_set_problems
from beardyn_core.population.sweep_scenes import CHECKED_HERE, SweepScenes
from beardyn_core.study.compiling import is_compiled

_CHECKED_AT_ONCE = 256


@dataclass(frozen=True)
class Swept:
    """What a sweep has made."""

    folder: Path
    total: A[int, "runs of the whole set"]
    done: A[int, "runs that there are"]
    failed: A[int, "runs among them that left the model's validity"]
    here: A[int, "runs of this go"]
    seconds: A[float, "of this go, [s]"]
    difficulty: A[dict[str, Any] | None, "see `population.difficulty.difficulty_of`"] = None

    @property
    def complete(self) -> bool:
        """Whether all runs are there."""
        return self.done == self.total


def conduct(
    scenes: SweepScenes,
    folder: Path,
    cluster: Cluster,
    *,
    force: bool = False,
    report: Report = lambda _: None,
    say: Callable[[str], None] = lambda _: None,
) -> Swept:
    """Run what the folder has not yet, and close the set.

    Parameters
    ----------
    scenes : SweepScenes
    folder : Path
        Of the set: made, or taken up where it was.
    cluster : Cluster
    force : bool
        Start over in a folder that holds a set.
    report : callable
        Called after every task.
    say : callable
        Called when workers and schedulers come and go.

    Raises
    ------
    InputError
        The folder cannot take the runs, a scene of them is wrong, or a worker has other code.
    EngineError
        The workers cannot be reached.
    """
    if problems := folder_of_set_problems(folder, scenes, force=force):
        raise InputError(problems)
    rows = rows_of(scenes.sweep)
    about = begin(folder, scenes, fresh=force)
    begun = time.monotonic()
    store = SetStore(folder, about)
    plan = store.resume(plan_of(scenes, rows))
    with store.opened(plan):
        done: Mapping[str, dict[str, Any]] = plan.kept
        if plan.missing:
            first = [plan.items[key] for key in plan.missing[: plan.together]]
            if not cluster.scheduler and not all(is_compiled(scenes.scene(row)) for row in first):
                say(
                    "the kernels of these runs are compiled first, once on this machine: a minute, or several"
                )
            end = math.inf if scenes.sweep.hours is None else begun + 3600.0 * scenes.sweep.hours
            with held_back(), Engine(cluster, say) as engine:
                _check(engine, scenes, rows)
                done = run_plan(plan, engine, store, report, end)
        about["wall_s"] = round(about.get("wall_s", 0.0) + time.monotonic() - begun, 1)
        with whole():
            close_set(folder, scenes, about, {int(key): made for key, made in done.items()}, cluster)
    failed = sum(map(plan.has_failed, done.values()))
    here = len(done) - len(plan.kept)
    took = time.monotonic() - begun
    return Swept(folder, len(rows), len(done), failed, here, took, about.get("difficulty"))


def plan_of(scenes: SweepScenes, rows: Sequence[Row]) -> Plan[Row, Any]:
    """Plan the runs of a sweep: those of a task lie in one file of signals.

    What is kept of a run, which `run_batch` gives as `Made`, is its row of the journal. The folder answers
    for its request and its code, which are those of all its runs.
    """
    items = {str(row.run): row for row in rows}
    return Plan(
        items,
        run_batch,
        scenes,
        dict.fromkeys(items, ""),
        together=scenes.sweep.runs_per_task,
        lost=_give_up,
        has_failed=lambda made: bool(made["labels"]["status"] == FAILED),
    )


def _check(engine: Engine, scenes: SweepScenes, rows: Sequence[Row]) -> None:
    """Make the scenes of runs that have not been checked here, on the workers, before any of them runs."""
    if len(rows) <= CHECKED_HERE:
        return
    parts = [tuple(rows[first : first + _CHECKED_AT_ONCE]) for first in range(0, len(rows), _CHECKED_AT_ONCE)]
    problems = [
        problem for ended in engine.run(checked_batch, parts, scenes) for problem in ended.value or ()
    ]
    if problems:
        raise InputError(list(dict.fromkeys(problems)))


def _give_up(row: Row, killed: int) -> Made:
    """Make a labelled row of a run that kills whatever process computes it."""
    reason = (
        f"{killed} processes died while they computed this run, one after the other: out of memory, or "
        "a crash; it was not tried again"
    )
    labels = {"run": row.run, "status": FAILED, "reason": reason, "bearing_id": "", **row.drawn}
    features = {**dict.fromkeys(NAMES, float("nan")), VERDICT: ""}
    return Made(row.run, labels, features, {}, 0.0)

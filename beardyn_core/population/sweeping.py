"""Conduct a sweep: rows to the workers, what comes back to the folder, and the set closed at the end."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import held_back, whole
from beardyn_core.experiments import Cluster, Ended, Engine
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.population.batch import FAILED, Batch, Made, checked_batch, run_batch
from beardyn_core.population.draw import Row, rows_of
from beardyn_core.population.features import NAMES
from beardyn_core.population.finalizing import close_set
from beardyn_core.population.folder import (
    ABOUT,
    Journal,
    begin,
    done_rows,
    folder_of_set_problems,
    numbers_missing,
    write_about,
)
from beardyn_core.population.plan import CHECKED_HERE, Plan
from beardyn_core.population.store import SignalStore
from beardyn_core.study.compiling import is_compiled

_CHECKED_AT_ONCE = 256


@dataclass(frozen=True)
class Progress:
    """How far a sweep is."""

    done: A[int, "runs, those of an earlier go included"]
    total: int
    failed: A[int, "runs among them that left the model's validity"]
    here: A[int, "runs of this go"]
    seconds: A[float, "since the first run of this go began, [s]"]
    workers: A[int, "that are there"]
    dashboard: A[str, "address of Dask's own page"]

    @property
    def rate(self) -> float:
        """Runs a second, of this go."""
        return self.here / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def remaining(self) -> float:
        """Time to the end, [s]; infinite before the first run is done."""
        return (self.total - self.done) / self.rate if self.here else float("inf")


@dataclass(frozen=True)
class Swept:
    """What a sweep has made."""

    folder: Path
    total: A[int, "runs of the whole set"]
    done: A[int, "runs that there are"]
    failed: A[int, "runs among them that left the model's validity"]
    here: A[int, "runs of this go"]
    seconds: A[float, "of this go, [s]"]

    @property
    def complete(self) -> bool:
        """Whether all runs are there."""
        return self.done == self.total


Report = Callable[[Progress], None]


def conduct(
    plan: Plan,
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
    plan : Plan
    folder : Path
        Of the set: made, or taken up where it was.
    cluster : Cluster
    force : bool
        Start over in a folder that holds a set.
    report : callable
        Told after every task.
    say : callable
        Told of workers and schedulers that come and go.

    Raises
    ------
    InputError
        The folder cannot take the runs, a scene of them is wrong, or a worker has other code.
    EngineError
        The workers cannot be reached.
    """
    if problems := folder_of_set_problems(folder, plan, force=force):
        raise InputError(problems)
    rows = rows_of(plan.sweep)
    about = begin(folder, plan, fresh=force)
    journal = Journal(folder)
    try:
        done = done_rows(folder)
        missing = [rows[run] for run in numbers_missing(len(rows), done)]
        begun = time.monotonic()
        here = _Go(plan, folder, journal, about, done, report)
        if missing:
            store = SignalStore(folder, len(rows), plan.sweep.runs_per_task)
            first = missing[: plan.sweep.runs_per_task]
            if not cluster.scheduler and not all(is_compiled(plan.scene(row)) for row in first):
                say(
                    "the kernels of these runs are compiled first, once on this machine: a minute, or several"
                )
            with held_back(), Engine(cluster, say) as engine:
                _check(engine, plan, rows)
                here.run(engine, store, missing)
        about["wall_s"] = round(about.get("wall_s", 0.0) + time.monotonic() - begun, 1)
        with whole():
            close_set(folder, plan, about, done, cluster)
    finally:
        journal.close()
    failed = sum(made["labels"]["status"] == FAILED for made in done.values())
    return Swept(folder, len(rows), len(done), failed, here.count, time.monotonic() - begun)


class _Go:
    """One go at the runs that are missing."""

    def __init__(
        self,
        plan: Plan,
        folder: Path,
        journal: Journal,
        about: dict[str, Any],
        done: dict[int, dict[str, Any]],
        report: Report,
    ) -> None:
        self._plan, self._folder, self._journal, self._about = plan, folder, journal, about
        self._done, self._report = done, report
        self.count = 0
        self._failed = sum(made["labels"]["status"] == FAILED for made in done.values())
        self._begun = time.monotonic()

    def run(self, engine: Engine, store: SignalStore, missing: Sequence[Row]) -> None:
        """Run rows until all are done or the time is over."""
        self._tell(engine)
        alone: list[Row] = []
        tasks = self._until_the_time_is_over(self._tasks(missing))
        for ended in engine.run(run_batch, tasks, self._plan):
            if ended.killed and len(ended.task) > 1:
                alone += ended.task  # which of them it was shows when each is by itself
                continue
            self._keep(engine, store, ended)
        single = self._until_the_time_is_over((row,) for row in alone)
        for ended in engine.run(run_batch, single, self._plan):
            self._keep(engine, store, ended)

    def _tasks(self, missing: Sequence[Row]) -> Iterator[tuple[Row, ...]]:
        """Put rows together that lie in one file of signals."""
        size = self._plan.sweep.runs_per_task
        for _, together in groupby(missing, key=lambda row: row.run // size):
            yield tuple(together)

    def _until_the_time_is_over(self, tasks: Iterator[tuple[Row, ...]]) -> Iterator[tuple[Row, ...]]:
        hours = self._plan.sweep.hours
        for task in tasks:
            if hours is not None and time.monotonic() - self._begun > 3600.0 * hours:
                return
            yield task

    def _keep(self, engine: Engine, store: SignalStore, ended: Ended[tuple[Row, ...]]) -> None:
        batch: Batch = ended.value if ended.value is not None else _given_up(ended, self._about)
        self._same_code(batch)
        with whole():
            problems = store.write(batch)
            if problems:
                raise InputError([f"{self._folder}: {problem}, unlike the others" for problem in problems])
            for made in self._journal.add(batch):
                self._done[made["labels"]["run"]] = made
                self._failed += made["labels"]["status"] == FAILED
                self.count += 1
            self._tell(engine)  # before Ctrl-C is answered: it says how many are done

    def _same_code(self, batch: Batch) -> None:
        """Refuse a worker whose bits would be others."""
        code, _, lanes = batch.code.partition("-")
        known = self._about.setdefault("lanes", lanes)
        if code != simulator_digest():
            raise InputError(
                f"worker {batch.worker}: its beardyn is another one (digest {code}, here "
                f"{simulator_digest()}); install the same version on every machine"
            )
        if lanes != known:
            raise InputError(
                f"worker {batch.worker}: its processor takes {lanes} rollers at once, the runs so far were "
                f"made {known} at once; their last bits would differ: use machines of one kind"
            )
        if known == lanes and self.count == 0:
            write_about(self._folder, self._about)

    def _tell(self, engine: Engine) -> None:
        self._report(
            Progress(
                len(self._done),
                self._plan.sweep.run_count,
                self._failed,
                self.count,
                time.monotonic() - self._begun,
                engine.worker_count(),
                engine.dashboard,
            )
        )


def _check(engine: Engine, plan: Plan, rows: Sequence[Row]) -> None:
    """Make the scenes of runs that have not been checked here, on the workers, before any of them runs."""
    if len(rows) <= CHECKED_HERE:
        return
    parts = [tuple(rows[first : first + _CHECKED_AT_ONCE]) for first in range(0, len(rows), _CHECKED_AT_ONCE)]
    problems = [problem for ended in engine.run(checked_batch, parts, plan) for problem in ended.value or ()]
    if problems:
        raise InputError(list(dict.fromkeys(problems)))


def _given_up(ended: Ended[tuple[Row, ...]], about: dict[str, Any]) -> Batch:
    """Make a labelled row of a run that kills whatever process computes it."""
    reason = (
        f"{ended.killed} processes died while they computed this run, one after the other: out of memory, or "
        "a crash; it was not tried again"
    )
    (row,) = ended.task
    labels = {"run": row.run, "status": FAILED, "reason": reason, "bearing_id": "", **row.drawn}
    made = Made(row.run, labels, dict.fromkeys(NAMES, float("nan")), {}, 0.0)
    code = f"{simulator_digest()}-{about.get('lanes', '')}"
    return Batch((made,), {}, {}, code, "none")


__all__ = ["ABOUT", "Progress", "Swept", "conduct"]

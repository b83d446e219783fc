"""The one loop over a set of runs: tasks to the engine, what comes back to the store, progress, losses."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated as A
from typing import Any, Generic

from beardyn_core.base.interrupts import whole
from beardyn_core.experiments.cluster import Cluster
from beardyn_core.experiments.engine import Ended, Engine, ThisProcess
from beardyn_core.experiments.plan import Item, Plan, Result, Task, do_task
from beardyn_core.experiments.store import Entry, Store


@dataclass(frozen=True)
class Progress(Generic[Result]):
    """How far a set of runs is."""

    done: A[int, "runs, those of an earlier go included"]
    total: int
    failed: A[int, "failures among them"]
    here: A[int, "runs of this go"]
    seconds: A[float, "since this go began, [s]"]
    workers: A[int, "that are there"]
    dashboard: A[str, "address of Dask's own page"]
    latest: A[Mapping[str, Result], "what has come last, by key; empty before the first"] = field(
        default_factory=dict
    )

    @property
    def rate(self) -> float:
        """Runs a second, of this go."""
        return self.here / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def remaining(self) -> float:
        """Time to the end, [s]; infinite before the first run is done."""
        return (self.total - self.done) / self.rate if self.here else float("inf")


Report = Callable[[Progress[Any]], None]


def run_plan(
    plan: Plan[Item, Result],
    engine: Engine | ThisProcess,
    store: Store[Any] | None = None,
    report: Report = lambda _: None,
    until: float = math.inf,
) -> dict[str, Any]:
    """Do the runs of a plan that are missing, and keep what each task gives as it comes.

    Parameters
    ----------
    plan : Plan
    engine : Engine or ThisProcess
        Opened.
    store : Store, optional
        Opened. A task is in it whole or not at all, whatever ends this.
    report : callable, optional
        Called before the first task, and after every one once its results are kept.
    until : float, optional
        After which no further task begins, as `time.monotonic` counts, [s].

    Returns
    -------
    dict
        Results as they are kept, by key in the order of the plan, those of an earlier go included.
    """
    go = _Go(plan, engine, store, report)
    go.tell({})
    alone: list[str] = []
    for ended in engine.run(do_task, _until(plan.tasks(go.done), until), plan.work, plan.request):
        if ended.killed and len(ended.task.keys) > 1:
            alone += ended.task.keys  # which of them it was shows when each is by itself
        else:
            go.end(ended)
    single = (plan.task_of((key,)) for key in alone)
    for ended in engine.run(do_task, _until(single, until), plan.work, plan.request):
        go.end(ended)
    return {key: go.done[key] for key in plan.items if key in go.done}


class _Go:
    """One go at the runs that are missing."""

    def __init__(
        self, plan: Plan[Any, Any], engine: Engine | ThisProcess, store: Store[Any] | None, report: Report
    ) -> None:
        self._plan, self._engine, self._store, self._report = plan, engine, store, report
        self.done: dict[str, Any] = dict(plan.kept)
        self._failed = sum(map(plan.has_failed, self.done.values()))
        self._here = 0
        self._begun = time.monotonic()

    def end(self, ended: Ended[Task[Any]]) -> None:
        """Keep what a task has given, or what its loss means."""
        plan, task = self._plan, ended.task
        results = [plan.lost(task.items[0], ended.killed)] if ended.killed else ended.value
        found = [
            Entry(key, plan.digests.get(key, ""), result)
            for key, result in zip(task.keys, results, strict=True)
        ]
        with whole():
            if self._store is not None and (plan.keeps_lost or not ended.killed):
                found = self._store.add(found)
            latest = {each.key: each.result for each in found}
            self.done |= latest
            self._failed += sum(map(plan.has_failed, latest.values()))
            self._here += len(latest)
            self.tell(latest)  # before Ctrl-C is answered: it says how many are done

    def tell(self, latest: Mapping[str, Any]) -> None:
        """Report how far it is."""
        self._report(
            Progress(
                len(self.done),
                len(self._plan.items),
                self._failed,
                self._here,
                time.monotonic() - self._begun,
                self._engine.worker_count(),
                self._engine.dashboard,
                latest,
            )
        )


def _until(tasks: Iterator[Task[Item]], end: float) -> Iterator[Task[Item]]:
    """Give tasks until their time is over."""
    for task in tasks:
        if time.monotonic() > end:
            return
        yield task


def all_of(
    function: Callable[..., Result], items: Sequence[Item], *arguments: Any, workers: int = 1
) -> list[Result]:
    """Call ``function(item, *arguments)`` for every item on processes of this machine; give values in order.

    Raises
    ------
    EngineError
        An item has killed its processes.
    """
    plan: Plan[Item, Result] = Plan(
        {str(number): item for number, item in enumerate(items)}, _call, (function, arguments)
    )
    with Engine(Cluster(workers=workers)) as engine:
        return list(run_plan(plan, engine).values())


def _call(items: Sequence[Item], request: tuple[Callable[..., Result], tuple[Any, ...]]) -> list[Result]:
    function, arguments = request
    return [function(item, *arguments) for item in items]

"""Conducting a trial: all runs of the matrix on several processes, each saved as it ends, resumable."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import trial_scene, with_choices
from beardyn_core.config import scene_text
from beardyn_core.config.content import files_of
from beardyn_core.experiments import Cluster, Engine, ThisProcess, loop
from beardyn_core.experiments.code_digest import monitor_digest, simulator_digest
from beardyn_core.experiments.plan import Plan
from beardyn_core.experiments.store import Entry, Layout, Store, differing
from beardyn_core.monitor.chain import FAULTS, MonitorResult, MonitorSettings, algorithm_named
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import Cell, Trial
from beardyn_core.study.monitored_recording import WAITING, Finding, conclude
from beardyn_core.twin import Twin

VALID = "complete"


@dataclass(frozen=True)
class TrialRun:
    """Result of one run."""

    key: A[str, "of its cell"]
    digest: A[str, "of all that the run depends on: scene, monitor, interval"]
    verdict: A[str, "the most frequent one of its analyses; ``waiting`` when there never was one"]
    analyses: A[int, "analyses with a verdict"]
    alarms: A[int, "those among them that called a fault of whatever part"]
    scores: A[tuple[float, ...], "of cup, cone and roller, medians over the analyses, [dB]"]
    threshold: A[float, "of the part that led, median, [dB]"]
    shaft_frequency: A[float, "[Hz]"]
    status: A[str, "``complete``, or why the run or its monitor did not come to the end"]
    wall: A[float, "simulating and monitoring, [s]"]
    called: A[tuple[str, ...], "the sentence and the band of every analysis that called a fault"] = ()

    @property
    def complete(self) -> bool:
        """Whether the run came to its end."""
        return self.status == VALID

    @classmethod
    def from_json(cls, found: dict[str, Any]) -> TrialRun:
        """Run of such an object."""
        return cls(**{**found, "scores": tuple(found["scores"]), "called": tuple(found.get("called", ()))})


def run_digest(scene: Scene, trial: Trial, code: str) -> str:
    """Hash all that a run depends on: scene with the files it names, interval, digest of the code."""
    digest = hashlib.sha256(f"{scene_text(scene)}\n{trial.interval}\n{code}".encode())
    for path in files_of(scene):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def conduct_run(trial: Trial, cell: Cell, algorithm: str, digest: str) -> TrialRun:
    """Simulate a run next to a monitor, ``module:function`` or '' for ours; the digest goes to its result."""
    began = time.perf_counter()
    scene = trial_scene(trial, cell)
    settings, chosen = MonitorSettings(interval=trial.interval), algorithm_named(algorithm)
    orders, count = fault_frequencies(scene.bearing), scene.bearing.roller_count
    monitor = Monitor(orders, count, settings=settings, algorithm=chosen)
    try:
        results, status = results_over(scene, monitor)
    except InputError as error:  # of the monitor: the other runs go on
        results, status = [], "; ".join(error.problems)
    judged = [result for result in results if result.verdict != WAITING]
    return TrialRun(
        key=cell.key,
        digest=digest,
        verdict=conclude([Finding.of(result) for result in results]).verdict,
        analyses=len(judged),
        alarms=sum(result.verdict in FAULTS for result in judged),
        scores=tuple(_middle([result.scores[part] for result in judged]) for part in range(len(FAULTS))),
        threshold=_middle([result.threshold for result in judged]),
        shaft_frequency=_middle([result.shaft_frequency for result in judged]),
        status=status,
        wall=time.perf_counter() - began,
        called=tuple(
            f"{result.reason}, in {result.band[0]:.0f} to {result.band[1]:.0f} Hz"
            for result in judged
            if result.verdict in FAULTS
        ),
    )


def results_over(scene: Scene, monitor: Monitor) -> tuple[list[MonitorResult], str]:
    """Simulate a scene with a monitor next to it: its results, and how the run ended."""
    results: list[MonitorResult] = []
    try:
        results.extend(run_monitor(monitor, map(MonitorInput.of_block, blocks(scene))))
    except ValidityError as error:  # the results up to there count
        return results, str(error)
    # the last word, after all revolutions
    return [*results, monitor.result()], VALID


def _middle(values: list[float]) -> float:
    """Compute the median of the finite values; NaN without any."""
    finite = sorted(value for value in values if isfinite(value))
    return finite[len(finite) // 2] if finite else float("nan")


RUNS_FILE = "runs.jsonl"
_NOT_OF_THE_RUNS = ("purpose", "folder", "choices")  # fields of a trial that no run depends on

Progress = Callable[[TrialRun], None]
LINES = Layout[TrialRun](
    lambda each: asdict(each.result),
    lambda row: Entry(row["key"], row["digest"], TrialRun.from_json(row)),
)


@dataclass(frozen=True)
class TrialRequest:
    """What all runs of a trial have in common."""

    trial: A[Trial, "with what its runs are computed with"]
    algorithm: A[str, "``module:function``, '' for ours"]
    digests: A[dict[str, str], "of every run, by the key of its cell"]


def plan_of(
    trial: Trial, algorithm: str, folder: Path | None, *, force: bool = False
) -> Plan[Cell, TrialRun]:
    """Plan the runs that a folder does not hold yet; ``force``: it starts over, whatever it holds.

    The algorithm is ``module:function``, '' for ours.

    Raises
    ------
    InputError
        There is no such algorithm, or the folder holds the runs of another trial or monitor.
    """
    algorithm_named(algorithm)
    trial = with_choices(trial)
    code = f"{simulator_digest()} {monitor_digest(algorithm)}"
    cells = {cell.key: cell for cell in trial.cells()}
    digests = {key: run_digest(trial_scene(trial, cell), trial, code) for key, cell in cells.items()}
    # long ones first, so that all processes end at about the same time
    order = sorted(cells, key=lambda key: (not cells[key].checks, cells[key].speed))
    plan = Plan[Cell, TrialRun](
        cells,
        conduct_cells,
        TrialRequest(trial, algorithm, digests),
        digests,
        tuple(order),
        lost=_refuse_loss,
        has_failed=lambda run: not run.complete,
        fresh=folder is None or force,
    )
    if plan.fresh:
        return plan
    store = store_of(plan, folder)
    if problems := _other_trial(store, plan):
        raise InputError(problems)
    return store.resume(plan)


def store_of(plan: Plan[Cell, TrialRun], folder: Path | None) -> Store[TrialRun]:
    """Give the store of a trial's runs; its first line identifies the trial."""
    about = identity(plan.request.trial, plan.request.algorithm)
    return Store(None if folder is None else folder / RUNS_FILE, LINES, about)


def identity(trial: Trial, algorithm: str) -> dict[str, Any]:
    """Describe a trial as the first line of its file of runs does: matrix and monitor."""
    fields = {name: value for name, value in asdict(trial).items() if name not in _NOT_OF_THE_RUNS}
    described: dict[str, Any] = json.loads(json.dumps({**fields, "monitor": algorithm}))
    return described


def read_runs(path: Path) -> list[TrialRun]:
    """Read the runs in a file of JSON lines, if it exists; a line that was cut off is ignored."""
    return [each.result for each in Store(path, LINES).entries()]


def _other_trial(store: Store[TrialRun], plan: Plan[Cell, TrialRun]) -> list[str]:
    """Say why the runs in a folder cannot be continued: another trial, or being written."""
    path = store.path
    assert path is not None
    if store.is_busy:
        return [f"{path}: another trial is writing this file; wait for its end or give another folder"]
    mine, about, earlier = (
        identity(plan.request.trial, plan.request.algorithm),
        store.described,
        store.entries(),
    )
    if about is not None:
        what = "; ".join(
            f"{name} is {json.dumps(about.get(name))} there and {json.dumps(mine.get(name))} here"
            for name in differing(mine, about)
        )
    elif not earlier and path.is_file() and path.stat().st_size:
        return [f"{path}: holds no runs of a trial; give another folder, or --force to replace the file"]
    else:  # a folder of an earlier version says nothing about itself
        strange = next((each.key for each in earlier if each.key not in plan.items), None)
        what = "" if strange is None else f"it has a run {strange!r} that this trial has not"
    if not what:
        return []
    return [
        f"{path}: its {len(earlier)} runs are of another trial or monitor: {what}; "
        "give another folder, or --force to start over and lose them"
    ]


def _refuse_loss(cell: Cell, killed: int) -> TrialRun:
    raise InputError(
        f"{cell.key}: {killed} processes died while they computed this run, out of memory or by a crash; "
        "the runs before are kept"
    )


def warm(trial: Trial) -> None:
    """Compile the kernels of the runs one after the other, so that all processes find them in the cache."""
    for cell in {(cell.tier, cell.fault): cell for cell in trial.cells()}.values():
        Twin(trial_scene(trial, cell)).warm()


def conduct(plan: Plan[Cell, TrialRun], folder: Path | None, jobs: int, progress: Progress) -> list[TrialRun]:
    """Simulate the missing runs, save each as it ends; return all in the order of the matrix.

    Parameters
    ----------
    plan : Plan
    folder : Path or None
        Its ``runs.jsonl`` gets a line for every run.
    jobs : int
        Processes.
    progress : callable
        Called with every run that ends.
    """
    if not plan.missing and not plan.fresh:
        return [plan.kept[key] for key in plan.items]

    def report(now: loop.Progress[TrialRun]) -> None:
        for run in now.latest.values():
            progress(run)

    store = store_of(plan, folder)
    here = jobs == 1 or not plan.missing
    with store.opened(plan), nullcontext(ThisProcess()) if here else Engine(Cluster(workers=jobs)) as engine:
        runs = loop.run_plan(plan, engine, store, report)
        store.tidy(plan)
    return list(runs.values())


def conduct_cells(cells: Sequence[Cell], request: TrialRequest) -> list[TrialRun]:
    """Conduct some runs in this process."""
    return [conduct_run(request.trial, cell, request.algorithm, request.digests[cell.key]) for cell in cells]

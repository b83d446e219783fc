"""A trial conducted: every run of the matrix on several processes, kept as it ends, and taken up again."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from beardyn_core.choice import trial_scene
from beardyn_core.observe.chain import algorithm_named
from beardyn_core.scene.trial import Cell, Trial
from beardyn_core.study.trial_run import TrialRun, conduct_run, monitor_digest, run_digest
from beardyn_core.twin import Twin

RUNS_FILE = "runs.jsonl"

Progress = Callable[[TrialRun], None]


@dataclass(frozen=True)
class Plan:
    """What is to be run.

    Parameters
    ----------
    trial : Trial
    algorithm : str
        ``module:function``, '' for ours.
    digests : dict
        Of every run, by the key of its cell.
    kept : dict of TrialRun
        Runs of an earlier go whose digest is still the same, by key.
    """

    trial: Trial
    algorithm: str
    digests: dict[str, str]
    kept: dict[str, TrialRun]

    @property
    def missing(self) -> tuple[Cell, ...]:
        """Cells still to be run, long ones first so that no process is left alone with one."""
        cells = [cell for cell in self.trial.cells() if cell.key not in self.kept]
        return tuple(sorted(cells, key=lambda cell: (not cell.checks, cell.speed)))


def plan_of(trial: Trial, algorithm: str, folder: Path | None) -> Plan:
    """What is to be run, after what a folder already holds.

    Parameters
    ----------
    trial : Trial
    algorithm : str
        ``module:function``, '' for ours; raises `InputError` when there is none.
    folder : Path or None
        Where runs are kept.
    """
    algorithm_named(algorithm)
    monitor = monitor_digest(algorithm)
    digests = {cell.key: run_digest(trial_scene(trial, cell), trial, monitor) for cell in trial.cells()}
    earlier = read_runs(folder / RUNS_FILE) if folder is not None else []
    kept = {run.key: run for run in earlier if digests.get(run.key) == run.digest}
    return Plan(trial, algorithm, digests, kept)


def read_runs(path: Path) -> list[TrialRun]:
    """Runs in a file of JSON lines; a line that was cut off is passed over.

    Parameters
    ----------
    path : Path
        Need not exist.
    """
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return [run for run in map(_run_of, lines) if run is not None]


def _run_of(line: str) -> TrialRun | None:
    try:
        return TrialRun.from_json(json.loads(line))
    except (ValueError, TypeError, KeyError):
        return None


def warm(trial: Trial) -> None:
    """Compile what the runs need, one after the other, so that the processes find it."""
    for cell in {(cell.tier, cell.fault): cell for cell in trial.cells()}.values():
        Twin(trial_scene(trial, cell)).warm()


def conduct(plan: Plan, folder: Path | None, jobs: int, progress: Progress) -> list[TrialRun]:
    """Run what is missing and keep each run as it ends.

    Parameters
    ----------
    plan : Plan
    folder : Path or None
        Its ``runs.jsonl`` gets a line for every run.
    jobs : int
        Processes.
    progress : callable
        Told of every run that ends.

    Returns
    -------
    list of TrialRun
        In the order of the matrix; those there are, when interrupted by `KeyboardInterrupt`.
    """
    runs = dict(plan.kept)
    missing = plan.missing
    keep = _Keeper(folder, runs.values())
    try:
        if jobs == 1:
            for cell in missing:
                run = conduct_run(plan.trial, cell, plan.algorithm, plan.digests[cell.key])
                runs[run.key] = keep(run)
                progress(run)
        elif missing:
            with ProcessPoolExecutor(jobs, get_context("spawn"), _quiet_worker, (os.getcwd(),)) as pool:
                _gather(pool, plan, missing, runs, keep, progress)
    finally:
        keep.close()
    return [runs[cell.key] for cell in plan.trial.cells() if cell.key in runs]


def _gather(
    pool: ProcessPoolExecutor,
    plan: Plan,
    missing: Sequence[Cell],
    runs: dict[str, TrialRun],
    keep: _Keeper,
    progress: Progress,
) -> None:
    waiting = {
        pool.submit(conduct_run, plan.trial, cell, plan.algorithm, plan.digests[cell.key]) for cell in missing
    }
    try:
        while waiting:
            done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                run = future.result()
                runs[run.key] = keep(run)
                progress(run)
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        raise


class _Keeper:
    """Writes runs to the folder as they end."""

    def __init__(self, folder: Path | None, earlier: Iterable[TrialRun]) -> None:
        self._file = None
        if folder is not None:
            path = folder / RUNS_FILE
            # what is out of date or was cut off goes
            lines = [json.dumps(run.to_json()) + "\n" for run in earlier]
            fresh = path.with_suffix(".new")
            fresh.write_text("".join(lines), encoding="utf-8")
            fresh.replace(path)
            self._file = path.open("a", encoding="utf-8")

    def __call__(self, run: TrialRun) -> TrialRun:
        if self._file is not None:
            self._file.write(json.dumps(run.to_json()) + "\n")
            self._file.flush()
        return run

    def close(self) -> None:
        if self._file is not None:
            self._file.close()


def _quiet_worker(folder: str) -> None:
    """A process ends with its parent, without a word, and works in its folder with one thread."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.chdir(folder)

"""Conducting a trial: all runs of the matrix on several processes, each saved as it ends, resumable."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Annotated as A
from typing import Any, BinaryIO

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.outputs import is_being_written, open_to_append, write_whole
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import trial_scene, with_choices
from beardyn_core.config import scene_text
from beardyn_core.config.content import files_of
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.experiments.code_digest import monitor_digest, simulator_digest
from beardyn_core.monitor.chain import FAULTS, MonitorResult, MonitorSettings, algorithm_named
from beardyn_core.monitor.streaming import Monitor, MonitorInput, listen
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
    """Simulate a run beside a monitor, ``module:function`` or '' for ours; the digest goes to its result."""
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
    """Simulate a scene with a monitor beside it: its results, and how the run ended."""
    results: list[MonitorResult] = []
    try:
        results.extend(listen(monitor, map(MonitorInput.of_block, blocks(scene))))
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


@dataclass(frozen=True)
class Plan:
    """Runs of a trial that are done, outdated or still to do."""

    trial: A[Trial, "with what its runs are computed with"]
    algorithm: A[str, "``module:function``, '' for ours"]
    digests: A[dict[str, str], "of every run, by the key of its cell"]
    kept: A[dict[str, TrialRun], "runs of an earlier go whose digest is still the same, by key"]
    outdated: A[int, "runs of an earlier go, of other code or files; kept until they are run again"] = 0
    fresh: A[bool, "whether the folder starts over"] = False

    @property
    def missing(self) -> tuple[Cell, ...]:
        """Cells still to be run, long ones first so that all processes end at about the same time."""
        cells = [cell for cell in self.trial.cells() if cell.key not in self.kept]
        return tuple(sorted(cells, key=lambda cell: (not cell.checks, cell.speed)))


def plan_of(trial: Trial, algorithm: str, folder: Path | None, *, force: bool = False) -> Plan:
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
    digests = {cell.key: run_digest(trial_scene(trial, cell), trial, code) for cell in trial.cells()}
    if folder is None or force:
        return Plan(trial, algorithm, digests, {}, fresh=True)
    path = folder / RUNS_FILE
    earlier = read_runs(path)
    if problems := _other_trial(path, earlier, identity(trial, algorithm), digests):
        raise InputError(problems)
    kept = {run.key: run for run in earlier if digests.get(run.key) == run.digest}
    outdated = {run.key for run in earlier} - set(kept)
    return Plan(trial, algorithm, digests, kept, len(outdated))


def identity(trial: Trial, algorithm: str) -> dict[str, Any]:
    """Describe a trial as the first line of its file of runs does: matrix and monitor."""
    fields = {name: value for name, value in asdict(trial).items() if name not in _NOT_OF_THE_RUNS}
    described: dict[str, Any] = json.loads(json.dumps({**fields, "monitor": algorithm}))
    return described


def read_runs(path: Path) -> list[TrialRun]:
    """Read the runs in a file of JSON lines, if it exists; a line that was cut off is ignored."""
    found = []
    for content in _lines(path):
        with suppress(ValueError, TypeError, KeyError):
            found.append(TrialRun.from_json(content))
    return found


def _lines(path: Path) -> list[dict[str, Any]]:
    if not path.is_file():
        return []
    found = []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        with suppress(ValueError):
            found.append(json.loads(line))
    return [content for content in found if isinstance(content, dict)]


def _other_trial(
    path: Path, earlier: Sequence[TrialRun], mine: dict[str, Any], digests: dict[str, str]
) -> list[str]:
    """Say why the runs in a folder cannot be continued: another trial, or being written."""
    if is_being_written(path):
        return [f"{path}: another trial is writing this file; wait for its end or give another folder"]
    about = next((line["of"] for line in _lines(path) if isinstance(line.get("of"), dict)), None)
    if about is not None:
        names = dict.fromkeys([*mine, *about])
        different = [name for name in names if mine.get(name) != about.get(name)]
        what = "; ".join(
            f"{name} is {json.dumps(about.get(name))} there and {json.dumps(mine.get(name))} here"
            for name in different
        )
    elif not earlier and path.is_file() and path.stat().st_size:
        return [f"{path}: holds no runs of a trial; give another folder, or --force to replace the file"]
    else:  # a folder of an earlier version says nothing about itself
        strange = next((run.key for run in earlier if run.key not in digests), None)
        what = "" if strange is None else f"it has a run {strange!r} that this trial has not"
    if not what:
        return []
    return [
        f"{path}: its {len(earlier)} runs are of another trial or monitor: {what}; "
        "give another folder, or --force to start over and lose them"
    ]


def warm(trial: Trial) -> None:
    """Compile the kernels of the runs one after the other, so that all processes find them in the cache."""
    for cell in {(cell.tier, cell.fault): cell for cell in trial.cells()}.values():
        Twin(trial_scene(trial, cell)).warm()


def conduct(plan: Plan, folder: Path | None, jobs: int, progress: Progress) -> list[TrialRun]:
    """Simulate the missing runs, save each as it ends; return all in the order of the matrix.

    Parameters
    ----------
    plan : Plan
    folder : Path or None
        Its ``runs.jsonl`` gets a line for every run.
    jobs : int
        Processes.
    progress : callable
        Told of every run that ends.
    """
    runs = dict(plan.kept)
    if plan.missing or plan.fresh:
        keep = _Keeper(plan, folder)
        try:
            with closing(_in_turn(plan) if jobs == 1 else _at_once(plan, jobs)) as ended:
                for run in ended:
                    runs[run.key] = keep(run)
                    progress(run)
            keep.tidy(runs)
        finally:
            keep.close()
    return [runs[cell.key] for cell in plan.trial.cells() if cell.key in runs]


def _in_turn(plan: Plan) -> Generator[TrialRun, None, None]:
    for cell in plan.missing:
        yield conduct_run(plan.trial, cell, plan.algorithm, plan.digests[cell.key])


def _at_once(plan: Plan, jobs: int) -> Generator[TrialRun, None, None]:
    """Conduct runs on several processes, which end with the first failure or interrupt."""
    if not plan.missing:
        return
    with Engine(Cluster(workers=jobs)) as engine:
        for ended in engine.run(_conducted, plan.missing, plan.trial, plan.algorithm, plan.digests):
            if ended.killed:
                raise InputError(
                    f"{ended.task.key}: {ended.killed} processes died while they computed this run, out of "
                    "memory or by a crash; the runs before are kept"
                )
            yield ended.value


def _conducted(cell: Cell, trial: Trial, algorithm: str, digests: dict[str, str]) -> TrialRun:
    """Conduct a run in a process of the engine."""
    return conduct_run(trial, cell, algorithm, digests[cell.key])


class _Keeper:
    """Appends runs to the file in the folder as they end; its first line identifies the trial."""

    def __init__(self, plan: Plan, folder: Path | None) -> None:
        self._plan = plan
        self._about = json.dumps({"of": identity(plan.trial, plan.algorithm)}) + "\n"
        self._path = None if folder is None else folder / RUNS_FILE
        self._kept = len(plan.kept)
        self._file: BinaryIO | None = None
        if self._path is not None:
            with self._disk():
                self._file = open_to_append(self._path, empty=plan.fresh)
                if self._file.tell() == 0 or not any("of" in line for line in _lines(self._path)):
                    self._write(self._about)

    def __call__(self, run: TrialRun) -> TrialRun:
        if self._file is not None:
            with self._disk():
                self._write(json.dumps(asdict(run)) + "\n")
        self._kept += 1
        return run

    def tidy(self, runs: dict[str, TrialRun]) -> None:
        """Drop the outdated runs, now that each of them has been run again."""
        if self._path is not None and self._plan.outdated:
            lines = [json.dumps(asdict(runs[cell.key])) + "\n" for cell in self._plan.trial.cells()]
            with self._disk():
                write_whole(self._path, "".join([self._about, *lines]))

    def close(self) -> None:
        """Close the file, which unlocks it."""
        if self._file is not None:
            self._file.close()

    def _write(self, line: str) -> None:
        assert self._file is not None
        rest = line.encode()
        while rest:  # a disk that is nearly full takes a part
            rest = rest[self._file.write(rest) :]

    @contextmanager
    def _disk(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise InputError(
                f"{self._path}: cannot be written: {error.strerror or error}; the {self._kept} runs before "
                "are kept, and the same command goes on from there"
            ) from error

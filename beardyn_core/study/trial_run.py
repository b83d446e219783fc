"""One run of a trial: a scene simulated with a monitor beside it, and the result."""

from __future__ import annotations

import hashlib
import time
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import trial_scene
from beardyn_core.config import scene_text
from beardyn_core.errors import InputError, ValidityError
from beardyn_core.observe.chain import FAULTS, MonitorResult, MonitorSettings, algorithm_named
from beardyn_core.observe.monitoring import Monitor, MonitorInput, listen
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import Cell, Trial
from beardyn_core.study.finding import WAITING, Finding, conclude

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
    status: A[str, "``complete``, or how the run left the model's validity"]
    wall: A[float, "simulating and monitoring, [s]"]

    @property
    def complete(self) -> bool:
        """Whether the run came to its end inside the model's validity."""
        return self.status == VALID

    @classmethod
    def from_json(cls, found: dict[str, Any]) -> TrialRun:
        """Run of such an object."""
        return cls(**{**found, "scores": tuple(found["scores"])})


def run_digest(scene: Scene, trial: Trial, code: str) -> str:
    """Hash all that a run depends on: scene with the files it names, interval, digest of the code."""
    digest = hashlib.sha256(f"{scene_text(scene)}\n{trial.interval}\n{code}".encode())
    for owner in (scene.operation, getattr(scene.operation, "irregularity", None)):
        if (path := getattr(owner, "path", None)) is not None:
            digest.update(Path(path).read_bytes())
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
    except InputError as error:
        raise InputError([f"{cell.key}: {problem}" for problem in error.problems]) from error
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

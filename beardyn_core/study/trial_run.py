"""One run of a trial: a scene simulated with a monitor beside it, and what came of it."""

from __future__ import annotations

import hashlib
import time
from dataclasses import asdict, dataclass
from math import ceil, isfinite
from pathlib import Path
from typing import Any

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.config import trial_scene
from beardyn_core.errors import InputError, ValidityError
from beardyn_core.observe.chain import FAULTS, MonitorResult, MonitorSettings, algorithm_named
from beardyn_core.observe.monitoring import Monitor
from beardyn_core.rail.build import load_history
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import Cell, Trial
from beardyn_core.study.finding import WAITING, Finding, conclude
from beardyn_core.twin import Twin

VALID = "complete"


@dataclass(frozen=True)
class TrialRun:
    """What came of one run.

    Parameters
    ----------
    key : str
        Of its cell.
    digest : str
        Of all that the run depends on: scene, monitor, interval.
    verdict : str
        The most frequent one of its analyses; ``waiting`` when there never was one.
    analyses : int
        Analyses with a verdict.
    alarms : int
        Those among them that called a fault of whatever part.
    scores : tuple of 3 floats
        Of cup, cone and roller, medians over the analyses, [dB].
    threshold : float
        Of the part that led, median, [dB].
    shaft_frequency : float
        [Hz].
    status : str
        ``complete``, or how the run left the model's validity.
    wall : float
        Simulating and monitoring, [s].
    """

    key: str
    digest: str
    verdict: str
    analyses: int
    alarms: int
    scores: tuple[float, ...]
    threshold: float
    shaft_frequency: float
    status: str
    wall: float

    @property
    def complete(self) -> bool:
        """Whether the run came to its end inside the model's validity."""
        return self.status == VALID

    def to_json(self) -> dict[str, Any]:
        """As an object of a JSON line."""
        return asdict(self)

    @classmethod
    def from_json(cls, found: dict[str, Any]) -> TrialRun:
        """Run of such an object."""
        return cls(**{**found, "scores": tuple(found["scores"])})


def run_digest(scene: Scene, trial: Trial, code: str) -> str:
    """Hash all that a run depends on: its scene with the files it names, the interval, the code.

    Parameters
    ----------
    scene : Scene
    trial : Trial
    code : str
        Digest of simulator and monitor.
    """
    digest = hashlib.sha256(f"{scene.source_text}\n{trial.interval}\n{code}".encode())
    irregularity = getattr(scene.operation, "irregularity", None)
    for owner in (scene.operation, irregularity):
        path = getattr(owner, "path", None)
        if path is not None:
            digest.update(Path(path).read_bytes())
    return digest.hexdigest()[:16]


def conduct_run(trial: Trial, cell: Cell, algorithm: str, digest: str) -> TrialRun:
    """Simulate a run with the monitor beside it.

    Parameters
    ----------
    trial : Trial
    cell : Cell
    algorithm : str
        ``module:function``, '' for ours.
    digest : str
        Kept with the result.
    """
    began = time.perf_counter()
    scene = trial_scene(trial, cell)
    settings = MonitorSettings(interval=trial.interval)
    monitor = Monitor(
        fault_frequencies(scene.bearing),
        scene.bearing.roller_count,
        settings=settings,
        algorithm=algorithm_named(algorithm),
    )
    try:
        results, status = listen(scene, monitor)
    except InputError as error:
        raise InputError([f"{cell.key}: {problem}" for problem in error.problems]) from error
    findings = [Finding.of(result) for result in results]
    judged = [result for result in results if result.verdict != WAITING]
    conclusion = conclude(findings)
    return TrialRun(
        key=cell.key,
        digest=digest,
        verdict=conclusion.verdict,
        analyses=len(judged),
        alarms=sum(result.verdict in FAULTS for result in judged),
        scores=tuple(_middle([result.scores[part] for result in judged]) for part in range(len(FAULTS))),
        threshold=_middle([result.threshold for result in judged]),
        shaft_frequency=_middle([result.shaft_frequency for result in judged]),
        status=status,
        wall=time.perf_counter() - began,
    )


def listen(scene: Scene, monitor: Monitor) -> tuple[list[MonitorResult], str]:
    """Run a scene with a monitor beside it: what the monitor says, and how the scene ended.

    Parameters
    ----------
    scene : Scene
    monitor : Monitor
    """
    twin = Twin(scene)
    blocks = max(1, ceil(scene.duration * 1e9 / twin.block_ns - 1e-6))
    results = []
    try:
        twin.start(load_history(scene.operation, scene.mounting, blocks * twin.block_ns * 1e-9, scene.seed))
        for _ in range(blocks):
            block = twin.advance()
            monitor.push_vibration(block.waveform_time_ns, block.acceleration[0])
            monitor.push_shaft(block.trend_time_ns, block.shaft_angle)
            monitor.push_load(block.trend_time_ns, block.load[:, 2])
            result = monitor.update()
            results += [] if result is None else [result]
    except ValidityError as error:
        return results, str(error)
    # the last word, after all revolutions
    return [*results, monitor.result()], VALID


def _middle(values: list[float]) -> float:
    """Median of the finite ones, NaN without."""
    finite = sorted(value for value in values if isfinite(value))
    return finite[len(finite) // 2] if finite else float("nan")

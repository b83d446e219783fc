"""One bearing as a monitor has judged it: all results, the verdict, and the signals behind it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.measured.about import USUAL_LABEL, Mounted, beside_others, mounted_in
from beardyn_core.measured.in_memory import run_of
from beardyn_core.measured.stated_speed import recorded_uncertainty, uncertainty_of
from beardyn_core.measured.survey import Survey
from beardyn_core.measured.watching import watch
from beardyn_core.monitor.chain import REFERENCE, Algorithm, MonitorResult, MonitorSettings
from beardyn_core.monitor.severity import Severity
from beardyn_core.record.run import Run
from beardyn_core.study.monitored_recording import (
    NOT_DIAGNOSABLE,
    WAITING,
    Conclusion,
    Finding,
    conclude,
    results_of,
)

FROM_SCENE, FROM_RECORDING, FROM_USER = "scene in the recording", "recording", "user"


@dataclass
class BearingResults:
    """Findings of one bearing, and the latest result of each verdict with its spectrum."""

    findings: list[Finding] = field(default_factory=list)
    latest: dict[str, MonitorResult] = field(default_factory=dict)

    def add(self, result: MonitorResult) -> None:
        """Keep a result."""
        self.findings.append(Finding.of(result))
        self.latest[result.verdict] = result

    @property
    def concluded(self) -> MonitorResult | None:
        """The latest result of the most frequent verdict."""
        return self.latest.get(conclude(self.findings).verdict)


@dataclass(frozen=True)
class Inspection:
    """One bearing as a monitor has judged it."""

    mounted: Mounted
    bearing_from: A[str, "who names the bearing: `FROM_SCENE`, `FROM_RECORDING` or `FROM_USER`"]
    settings: MonitorSettings
    results: BearingResults
    read: A[Callable[[], Run], "gives the signals; those of measured files are read only when asked for"]

    @cached_property
    def run(self) -> Run:
        """The signals."""
        return self.read()

    @property
    def conclusion(self) -> Conclusion:
        """All findings, summed up."""
        return conclude(self.results.findings)

    @property
    def verdict(self) -> str:
        """The verdict; a signal that ends without an analysis is not diagnosable."""
        verdict = self.conclusion.verdict
        return NOT_DIAGNOSABLE if verdict == WAITING else verdict

    @property
    def reason(self) -> str:
        """The verdict in a sentence of the monitor."""
        finding = self.conclusion.finding
        if finding is not None and finding.verdict != WAITING:
            return finding.reason
        findings = self.results.findings
        return findings[-1].reason if findings else "the signal is shorter than the first analysis needs"

    @cached_property
    def severity(self) -> Severity | None:
        """How wide the spall is; ``None`` where no part was called."""
        finding = self.conclusion.finding
        if finding is None or not finding.stage:
            return None
        width, low, high = finding.spall_width, finding.spall_width_low, finding.spall_width_high
        return Severity(finding.stage, width, low, high, finding.stage_reason)


def hidden_parts(plate: NamePlate, findings: Sequence[Finding]) -> list[str]:
    """List the parts that no analysis has judged although their orders are known."""
    judged = [each.not_judged for each in findings if each.verdict != WAITING]
    hidden = [part for part in (judged[-1] if judged else ()) if all(part in each for each in judged)]
    return [part for part in hidden if part not in plate.cannot_tell]


def recorded_plate(run: Run, *, lenient: bool = False) -> NamePlate | None:
    """Read the bearing data of the scene in a recording; ``None`` where there is no scene.

    Parameters
    ----------
    lenient : bool
        Whether a scene that cannot be read counts as none, because another bearing was named.
    """
    from beardyn_core.choice import scene_from_text

    with suppress(InputError) if lenient else nullcontext():
        if run.scene_text:
            return NamePlate.of(scene_from_text(run.scene_text, run.label).bearing)
    return None


def inspect_run(
    run: Run,
    given: Sequence[Mounted] = (),
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
    *,
    sensor: str = "",
) -> list[Inspection]:
    """Let a monitor analyse the signals of one axlebox, once for each bearing on its shaft.

    Parameters
    ----------
    given : sequence of Mounted
        Bearings that were named; by default those of the recording.
    settings : MonitorSettings, optional
        By default with the uncertainty of the speed that the recording states.
    sensor : str
        Accelerometer to take; by default the one of the bearing, or the first.

    Raises
    ------
    InputError
        The recording does not name its bearing, or has no speed.
    """
    recorded = recorded_plate(run, lenient=bool(given))
    known = mounted_in(run.measured, run.label)
    bearings, bearing_from = tuple(given) or known, FROM_USER if given else FROM_RECORDING
    if not bearings and recorded is not None:
        bearings, bearing_from = (Mounted(USUAL_LABEL, recorded),), FROM_SCENE
    problems = [] if bearings else [f"{run.label}: does not name its bearing; give --bearing"]
    if run.measured and len(run.vibration) and not len(run.shaft):
        problems.append(
            f"{run.label}: has no speed of the shaft, and a monitor needs it; import the measured file "
            "again, or read it, with one of --speed-rpm, --speed-kmh, --speed-channel, --tacho-channel, "
            "--speed-range-rpm"
        )
    if problems:
        raise InputError(problems)
    bearings = tuple(replace(each, sensor=sensor or each.sensor) for each in bearings)
    settings = settings or MonitorSettings(speed_uncertainty=recorded_uncertainty(run.measured))
    found = []
    for each in bearings:
        own, results = beside_others(settings, each, bearings), BearingResults()
        for result in results_of(run, each.plate, algorithm, own, each.sensor):
            results.add(result)
        found.append(Inspection(each, bearing_from, own, results, lambda: run))
    return found


def inspect_boxes(
    recording: Run, inspect: Callable[[Run], list[Inspection]], *, alone: bool = False
) -> list[Inspection]:
    """Inspect every axlebox of a recording, whose bearings are then called by its name too.

    Parameters
    ----------
    inspect : callable
        Inspects the run of one axlebox.
    alone : bool
        Whether only the axlebox that was read is wanted.
    """
    if alone or len(recording.boxes) == 1:
        return inspect(recording)
    found = []
    for name, run in recording.boxes.items():
        for each in inspect(run):
            own = each.mounted.label
            label = name if own == USUAL_LABEL else f"{name} {own}"
            found.append(replace(each, mounted=replace(each.mounted, label=label)))
    return found


def inspect_measured(
    measured: Survey,
    bearings: Sequence[Mounted],
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
    warnings: list[str] | None = None,
) -> list[Inspection]:
    """Let a monitor analyse measured files block by block, once for each bearing on the shaft.

    What was found on the way is added to the ``warnings`` at the end.
    """
    settings = settings or MonitorSettings(speed_uncertainty=uncertainty_of(measured))
    results = {each: BearingResults() for each in bearings}
    for mounted, result in watch(measured, bearings, algorithm, settings, warnings):
        results[mounted].add(result)
    kept: list[Run] = []

    def read() -> Run:
        if not kept:
            kept.append(run_of(measured, bearings))
        return kept[0]

    return [
        Inspection(each, FROM_USER, beside_others(settings, each, bearings), found, read)
        for each, found in results.items()
    ]

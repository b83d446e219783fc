"""Results of a monitor, and the monitor next to a recording that is being made or over a finished one."""

from __future__ import annotations

from collections import Counter, defaultdict, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from math import isfinite, nan
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.measured.stated_speed import recorded_uncertainty
from beardyn_core.monitor.chain import REFERENCE, Algorithm, MonitorResult, MonitorSettings
from beardyn_core.monitor.chain.ambiguity import CAGE
from beardyn_core.monitor.severity import Severity
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import Diagnostic, encode_diagnostics
from beardyn_core.record.plot_values import MONITOR, Bounded, ValueEncoder, code_of
from beardyn_core.record.run import Run
from beardyn_core.record.sinks import McapSink
from beardyn_core.record.topics import FRAME
from beardyn_core.sensors.block import Block

WAITING, HEALTHY, NOT_DIAGNOSABLE = "waiting", "healthy", "not_diagnosable"
UNEXPLAINED, HOT_BOX = "unexplained", "hot_box"
FAULT_SYMBOLS = {"cup": "BPFO", "cone": "BPFI", "roller": "2 BSF"}
SPALL_FIELDS = ("stage", "stage_reason", "spall_width", "spall_width_low", "spall_width_high")
_AS_FOUND = ("confidence", "signal_to_background", "threshold", "shaft_frequency", "rms", "kurtosis", "crest")
_TEXTS = ("stage", "stage_reason")
_PARTS = ("not_judged", "also_fits")
_SPEED_MISSING = (
    "; a monitor needs the speed of the shaft: speed_rpm, speed_kmh with wheel_diameter_mm, speed_channel, "
    "tacho_channel, or speed_range_rpm to find it in the vibration"
)
_LATEST = 25  # findings of a verdict of which one stands for the size of the spall
_SIZED = 3  # one of so many of them must have a width, at least
# from the best to the worst
_ORDER = (HEALTHY, WAITING, NOT_DIAGNOSABLE, UNEXPLAINED, *FAULT_SYMBOLS, HOT_BOX)
EXIT_CODES = {HEALTHY: 0, WAITING: 10, NOT_DIAGNOSABLE: 10, UNEXPLAINED: 11} | dict.fromkeys(
    (*FAULT_SYMBOLS, HOT_BOX), 12
)


@dataclass(frozen=True)
class Finding:
    """One result of the monitor, without its spectrum."""

    verdict: A[str, "one of `beardyn_core.monitor.chain.VERDICTS`"]
    reason: A[str, "the verdict in a sentence"]
    time: A[float, "simulated time of the last sample analysed, [s]"]
    confidence: A[float, "probability that the verdict is right; NaN of one that cannot tell, [-]"] = nan
    found_frequency: A[float, "line found; NaN without a fault, [Hz]"] = nan
    expected_frequency: A[float, "the same from bearing data, [Hz]"] = nan
    found_order: A[float, "line found, per shaft revolution, [-]"] = nan
    expected_order: A[float, "the same from bearing data, [-]"] = nan
    signal_to_background: A[float, "of the fundamental line; without a fault of the strongest, [dB]"] = nan
    fitting_shaft_frequency: A[
        float, "speed at which the line or the comb found is that of a part without slip, [Hz]"
    ] = nan
    comb_frequency: A[float, "of strikes that fit no part at the stated speed, [Hz]"] = nan
    comb_order: A[float, "the same per shaft revolution, [-]"] = nan
    comb_strikes: A[float, "what these strikes make of the mean power, [-]"] = nan
    score: A[float, "what the alarm threshold is compared with, [dB]"] = 0.0
    shaft_frequency: A[float, "[Hz]"] = nan
    load: A[float, "mean vertical load, [N]"] = nan
    rms: A[float, "of the band-passed vibration, [m/s^2]"] = nan
    kurtosis: A[float, "of the band-passed vibration, [-]"] = nan
    crest: A[float, "of the band-passed vibration, [-]"] = nan
    threshold: A[float, "score from which a fault is called, [dB]"] = nan
    band_low: A[float, "lower end of the band of the envelope, [Hz]"] = nan
    band_high: A[float, "upper end, [Hz]"] = nan
    rms_rise: A[float, "over earlier results at a like speed, [dB]"] = nan
    temperature: A[float, "of the axlebox, [K]"] = nan
    spall_width: A[float, "in rolling direction; NaN where it cannot be measured, [m]"] = nan
    spall_width_low: A[
        float, "lower end of its 95 % interval, also where only the least width is known, [m]"
    ] = nan
    spall_width_high: A[float, "upper end, [m]"] = nan
    stage: A[str, "``incipient``, ``developed``, ``severe``, ``not measurable``; '' without a fault"] = ""
    stage_reason: A[str, "size and stage in a sentence, or why they cannot be given"] = ""
    not_judged: A[
        tuple[str, ...],
        "parts whose order is not known, or whose lines are multiples of the shaft's",
    ] = ()
    also_fits: A[
        tuple[str, ...],
        "other parts that explain the lines of the one that is named as well; ``cage`` where strikes come "
        "and go with it",
    ] = ()

    @classmethod
    def of(cls, result: MonitorResult) -> Finding:
        """Make the finding of a monitor's result."""
        fundamental = [line.level for line in result.lines if line.expected_order == result.expected_order]
        named = {member.name for member in fields(result)} & {member.name for member in fields(cls)}
        spall = result.severity or Severity("", nan, nan, nan, "")
        return cls(
            **{name: getattr(result, name) for name in named},
            stage=spall.grade,
            stage_reason=spall.reason,
            spall_width=spall.width,
            spall_width_low=spall.low,
            spall_width_high=spall.high,
            time=result.end_ns * 1e-9,
            found_frequency=result.fault_frequency,
            found_order=result.fault_order,
            signal_to_background=fundamental[0] if fundamental else result.strongest_level,
            band_low=result.band[0],
            band_high=result.band[1],
        )

    @property
    def is_fault(self) -> bool:
        """Whether a fault is called."""
        return self.verdict in FAULT_SYMBOLS

    @property
    def symbol(self) -> str:
        """``BPFO``, ``BPFI``, ``2 BSF``, or ``FTF`` where the cage alone shows it; '' without a fault."""
        return "FTF" if CAGE in self.also_fits else FAULT_SYMBOLS.get(self.verdict, "")

    @property
    def deviation(self) -> float:
        """Frequency found against bearing data, relative, [-]."""
        return self.found_order / self.expected_order - 1.0

    def to_diagnostic(self, name: str, extra: Sequence[tuple[str, str]] = ()) -> Diagnostic:
        """Write as a status of ``monitor/result``: a hot box is an error, all but healthy a warning."""
        values = [(field, getattr(self, field)) for field in ("verdict", *_TEXTS)]
        for field in _numbers():
            number = float(getattr(self, field))
            values.append((field, f"{number:.9g}" if isfinite(number) else "nan"))
        values += [(field, " ".join(getattr(self, field))) for field in _PARTS]
        level = 2 if self.verdict == HOT_BOX else int(self.verdict not in (HEALTHY, WAITING))
        return Diagnostic(name, level, self.reason, (*values, *extra))

    def to_values(self) -> Mapping[str, Bounded]:
        """Give the numbers of ``values/<name>`` by their names; see `record.plot_values`."""
        return {
            **{name: Bounded(getattr(self, name)) for name in _AS_FOUND},
            "verdict": Bounded(code_of(self.verdict)),
            "fault_frequency": Bounded(self.found_frequency),
            # nothing is scored while there is not enough signal: the field then has its default, 0
            "score": Bounded(nan if self.verdict == WAITING else self.score),
            "spall_width": Bounded(self.spall_width, self.spall_width_low, self.spall_width_high),
        }

    @classmethod
    def from_diagnostic(cls, status: Diagnostic) -> Finding | None:
        """Read a finding from a status; ``None`` when the status is no finding."""
        verdict = status.value("verdict")
        if verdict is None:
            return None
        values: dict[str, Any] = {name: status.value(name) or "" for name in _TEXTS}
        values |= {name: float(status.value(name) or "nan") for name in _numbers()}
        values |= {name: tuple((status.value(name) or "").split()) for name in _PARTS}
        return cls(verdict, status.message, **values)


def _numbers() -> list[str]:
    """List the fields of a finding that are numbers."""
    texts = ("verdict", "reason", *_PARTS, *_TEXTS)
    return [member.name for member in fields(Finding) if member.name not in texts]


@dataclass(frozen=True)
class Conclusion:
    """Results of a monitor over a whole run, summed up."""

    finding: A[
        Finding | None,
        "latest of the most frequent verdict, with the spall of middle width and the confidence of the run: "
        "the mean over all analyses, 0 of one with another verdict; ``None``: never enough signal",
    ]
    agreeing: A[int, "results with that verdict"]
    analyses: A[int, "results at all"]

    @property
    def verdict(self) -> str:
        """Most frequent verdict; ``waiting`` without any."""
        return self.finding.verdict if self.finding else WAITING


class Tally:
    """Findings of a run summed up as they come, however many.

    Attributes
    ----------
    latest : Finding or None
        The last one.
    analyses : int
        All of them, those without enough signal included.
    """

    def __init__(self) -> None:
        self.latest: Finding | None = None
        self.analyses = 0
        self._counts: Counter[str] = Counter()
        self._confidences: dict[str, float] = defaultdict(float)  # sums of those that are known
        self._confident: Counter[str] = Counter()
        self._faults: dict[str, deque[Finding]] = defaultdict(lambda: deque(maxlen=_LATEST))
        self._last: dict[str, Finding] = {}  # the one that came last at the end

    def add(self, finding: Finding) -> None:
        """Count a finding."""
        self.latest = finding
        self.analyses += 1
        if finding.verdict != WAITING:
            self._counts[finding.verdict] += 1
            self._last.pop(finding.verdict, None)
            self._last[finding.verdict] = finding
            if isfinite(finding.confidence):
                self._confidences[finding.verdict] += finding.confidence
                self._confident[finding.verdict] += 1
            if finding.is_fault:
                self._faults[finding.verdict].append(finding)

    def conclusion(self) -> Conclusion:
        """Find the most frequent verdict, of equally frequent ones the later, which has seen more.

        Results before there was enough signal do not count. Healthy is said only where at least half of the
        results are: a comb that strikes in more of them is there, whatever it was called each time.
        """
        if not self._counts:
            return Conclusion(None, 0, 0)
        total = self._counts.total()
        others = {name: count for name, count in self._counts.items() if name != HEALTHY}
        counts = self._counts if 2 * self._counts[HEALTHY] >= total else others
        agreeing = max(counts.values())
        verdict = [name for name in self._last if counts.get(name) == agreeing][-1]
        # an analysis that says something else, or that it cannot tell, does not support the verdict
        confidence = self._confidences[verdict] / total if self._confident[verdict] else nan
        return Conclusion(
            self._with_spall(replace(self._last[verdict], confidence=confidence)), agreeing, total
        )

    def _with_spall(self, finding: Finding) -> Finding:
        """Give a finding the spall of middle width, where enough analyses of late have one and agree."""
        latest = self._faults[finding.verdict] if finding.is_fault else ()
        measured = [each for each in latest if isfinite(each.spall_width)]
        middle = sorted(measured, key=lambda each: each.spall_width)[len(measured) // 2 :][:1]
        agreeing = sum(
            each.spall_width_low <= other.spall_width <= each.spall_width_high
            for each in middle
            for other in measured
        )
        if middle and _SIZED * len(measured) >= len(latest) and 2 * agreeing > len(measured):
            chosen = middle[0]
        else:
            chosen = next((each for each in reversed(latest) if not isfinite(each.spall_width)), finding)
        return replace(finding, **{name: getattr(chosen, name) for name in SPALL_FIELDS})


def worst(verdicts: Iterable[str]) -> str:
    """Choose the worst of several verdicts: a hot box, a faulty part, unexplained strikes, none at all."""
    return max(verdicts, key=rank_of)


def rank_of(verdict: str) -> int:
    """Give the place of a verdict from the best, 0, to the worst."""
    return _ORDER.index(verdict)


def conclude(findings: Iterable[Finding]) -> Conclusion:
    """Sum up the findings of a run; see `Tally.conclusion`."""
    tally = Tally()
    for finding in findings:
        tally.add(finding)
    return tally.conclusion()


MONITOR_STATUS = "axlebox/monitor"


class MonitoredRecording(McapSink):
    """MCAP sink that passes vibration, shaft and load to a monitor and records its results.

    Parameters
    ----------
    path : Path
    bearing : RollerBearing
        What the bearing data say; the monitor gets nothing else of the scene.
    on_finding : callable, optional
        Called with every result.
    replace : bool
        Whether an existing file is replaced.
    """

    def __init__(
        self,
        path: object,
        bearing: RollerBearing,
        on_finding: Callable[[Finding], None] | None = None,
        *,
        replace: bool = False,
    ) -> None:
        super().__init__(str(path), replace=replace)
        self._bearing = bearing
        self._on_finding = on_finding
        self.findings: list[Finding] = []

    def open(self, run: RunDescription) -> None:
        """Create the file and a fresh monitor."""
        super().open(run)
        orders, count = fault_frequencies(self._bearing), self._bearing.roller_count
        plate = NamePlate.of(self._bearing)
        self._monitor = Monitor(orders, count, run.sensor_rates[0], bearing=plate)
        self._values = ValueEncoder(MONITOR, FRAME)
        self.findings = []

    def write(self, block: Block) -> None:
        """Append a block, and a result when one is due."""
        super().write(block)
        result = self._monitor.take(MonitorInput.of_block(block))
        if result is None:
            return
        finding = Finding.of(result)
        self.findings.append(finding)
        message = encode_diagnostics(result.end_ns, FRAME, [finding.to_diagnostic(MONITOR_STATUS)])
        writer = self._open_writer()
        for name, cdr in self._values.encode(result.end_ns, finding.to_values()):
            writer.add(name, result.end_ns, cdr)
        writer.add("monitor/result", result.end_ns, message)
        if self._on_finding is not None:
            self._on_finding(finding)


def results_of(
    run: Run,
    bearing: RollerBearing | NamePlate,
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
    sensor: str = "",
) -> Iterator[MonitorResult]:
    """Let a monitor, ours or another, analyse a finished run, as it would have done next to it.

    The bearing is what the bearing data say; the sensor is the first one by default. By default the speed is
    as uncertain as a measured run says.

    Raises
    ------
    InputError
        When there is no vibration or no shaft in the recording, or no such sensor.
    """
    if not len(run.vibration) or not len(run.shaft):
        missing = _SPEED_MISSING if run.measured and len(run.vibration) else ""
        raise InputError(f"{run.label}: has no vibration with a shaft angle to judge{missing}")
    settings = settings or MonitorSettings(speed_uncertainty=recorded_uncertainty(run.measured))
    plate = bearing if isinstance(bearing, NamePlate) else NamePlate.of(bearing)
    monitor = Monitor(
        bearing.frequencies, bearing.roller_count, settings=settings, algorithm=algorithm, bearing=plate
    )
    yield from run_monitor(monitor, run.monitor_inputs(sensor))


def findings_of(
    run: Run,
    bearing: RollerBearing | NamePlate,
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
    sensor: str = "",
) -> list[Finding]:
    """Give the findings of `results_of`."""
    return [Finding.of(result) for result in results_of(run, bearing, algorithm, settings, sensor)]

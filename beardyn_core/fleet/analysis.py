"""One recording through the monitor: verdict, size, levels, and the evidence behind an alarm."""

from __future__ import annotations

import io
import warnings
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from math import nan
from pathlib import Path
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.fleet.identity import FleetRecording
from beardyn_core.follow.growth import NORMAL_90

if TYPE_CHECKING:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.follow.estimator import Estimator
    from beardyn_core.record.arrays import Signal
    from beardyn_core.record.run import Run
    from beardyn_core.study.inspection import Inspection

SHIPPED, NO_ESTIMATOR = "shipped", "none"
_NORMAL_95 = 1.96  # standard deviations on either side of the middle that hold 95 %
_ANALYSES = 6  # of a recording, about: many recordings count more than many analyses of one
_LONGEST_LEVEL_S = 10.0  # of a piece whose levels are computed
_LEAST_LEVEL_S = 0.05
_TURNS = 3.0  # of the shaft in the excerpt
_BINS = 600  # of the whole record
_FLOOR_OF_BAND = 500.0  # [Hz], where the monitor gives no band
_LAST_HARMONIC = 5.5  # of the line that was found, up to which the spectrum is kept
_LEAST_ORDERS = 12.0


@dataclass(frozen=True)
class Analysis:
    """What the store keeps of a recording: no waveform."""

    verdict: A[str, "one of `beardyn_core.monitor.chain.VERDICTS`"]
    reason: A[str, "the verdict in a sentence"]
    bearing_name: A[str, "from its data"]
    confidence: A[float, "probability that the verdict is right, NaN unknown, [-]"] = nan
    agreeing: A[int, "analyses with that verdict"] = 0
    analyses: A[int, "analyses at all"] = 0
    stage: A[str, "of the spall; '' without a fault"] = ""
    stage_reason: A[str, "size and stage in a sentence"] = ""
    width: A[float, "of the spall, NaN where not measurable, [m]"] = nan
    width_low: A[float, "lower end of its interval: 95 % of the monitor, 90 % of an estimator, [m]"] = nan
    width_high: A[float, "upper end, [m]"] = nan
    width_from: A[str, "``monitor`` or ``estimator``; '' without a width"] = ""
    also_fits: A[tuple[str, ...], "other parts that explain the lines as well"] = ()
    shaft_frequency: A[float, "[Hz]"] = nan
    temperature: A[float, "of the axlebox, [K]"] = nan
    axes: A[tuple[str, ...], "that were measured"] = ()
    levels: A[Float, "in the bands of the trend, shape [axis, band], [dB re 1 m/s^2]"] = field(
        default_factory=lambda: np.empty((0, 0))
    )
    duration: A[float, "[s]"] = nan
    estimate: A[dict[str, Any], "of the estimator, as JSON; empty without"] = field(default_factory=dict)
    assumed: A[tuple[str, ...], "how the file was understood, and warnings"] = ()
    evidence: A[bytes, "spectrum and waveform behind a verdict that is not healthy; see `read_evidence`"] = (
        b""
    )

    @property
    def width_deviation(self) -> float:
        """Standard deviation of the width, NaN without a width, [m]."""
        held = NORMAL_90 if self.width_from == "estimator" else _NORMAL_95
        return 0.5 * (self.width_high - self.width_low) / held if np.isfinite(self.width) else nan

    @property
    def width_ends(self) -> tuple[float, float]:
        """Ends of the 95 % interval of the width, whatever measured it, NaN without a width, [m]."""
        if not np.isfinite(self.width):
            return nan, nan
        wider = _NORMAL_95 / NORMAL_90 if self.width_from == "estimator" else 1.0
        low = self.width - wider * (self.width - self.width_low)
        return max(low, 0.0), self.width + wider * (self.width_high - self.width)


@dataclass(frozen=True)
class Evidence:
    """What a page shows of an alarm."""

    order: A[Float, "of the envelope spectrum, shape [line], per shaft revolution"]
    level: A[Float, "over the background, shape [line], [dB]"]
    verdict: str
    fault_order: A[float, "found, NaN without, [-]"]
    comb_order: A[float, "of strikes that fit no part, NaN without, [-]"]
    also_fits: tuple[str, ...]
    orders: A[tuple[float, float, float, float], "BPFO, BPFI, BSF, FTF from bearing data, [-]"]
    axis: A[str, "of the waveforms"]
    record: A[Float, "lowest and highest of each piece of the record, shape [2, piece], [m/s^2]"]
    duration: A[float, "of the record, [s]"]
    excerpt: A[Float, "three turns in the band that was judged, shape [sample], [m/s^2]"]
    rate: A[float, "of the excerpt, [Hz]"]
    band: A[tuple[float, float], "[Hz]"]


def analyse(recording: FleetRecording, estimator: str = SHIPPED) -> Analysis:
    """Analyse a recording.

    Parameters
    ----------
    recording : FleetRecording
    estimator : str
        `SHIPPED`: one of the user or a shipped one for the bearing, where there is one;
        `NO_ESTIMATOR`; or a file.

    Raises
    ------
    InputError
        The file cannot be read, or does not say what a monitor needs.
    """
    from beardyn_core.measured.stated_speed import recorded_uncertainty
    from beardyn_core.measured.survey import DEAD
    from beardyn_core.monitor.chain import MonitorSettings
    from beardyn_core.monitor.streaming import measured_axes
    from beardyn_core.study.inspection import inspect_run
    from beardyn_core.study.report_page.identity import measured_names, shaft_frequency, signal_of

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            run, given = _read(recording)
        except InputError as error:
            if not all(each.endswith(DEAD) for each in error.problems):
                raise
            return Analysis("not_diagnosable", DEAD, recording.bearing)  # what there is to know of the sensor
        settings = MonitorSettings(
            speed_uncertainty=recorded_uncertainty(run.measured),
            interval=max(MonitorSettings().interval, run.duration / _ANALYSES),
        )
        found = inspect_run(run, given, settings=settings, sensor=recording.sensor)
    if len(found) != 1:
        labels = ", ".join(each.mounted.label for each in found)
        raise InputError(f"{recording.path}: has the bearings {labels}; a fleet takes one bearing an axlebox")
    inspection = found[0]
    conclusion, finding = inspection.conclusion, inspection.conclusion.finding
    signal = signal_of(inspection)
    plate = inspection.mounted.plate
    analysis = Analysis(
        inspection.verdict,
        inspection.reason,
        plate.name,
        shaft_frequency=shaft_frequency(run),
        temperature=_temperature(run, recording),
        axes=tuple(each[-1] for each in measured_names(signal)),
        levels=_levels(measured_axes(signal.values), signal.rate),
        duration=run.duration,
        assumed=_assumed(run, recording, [str(each.message) for each in caught]),
    )
    if finding is not None:
        analysis = replace(
            analysis,
            confidence=finding.confidence,
            agreeing=conclusion.agreeing,
            analyses=conclusion.analyses,
            stage=finding.stage,
            stage_reason=finding.stage_reason,
            width=finding.spall_width,
            width_low=finding.spall_width_low,
            width_high=finding.spall_width_high,
            width_from="monitor" if np.isfinite(finding.spall_width) else "",
            also_fits=finding.also_fits,
        )
    if inspection.verdict not in ("healthy", "not_diagnosable"):
        analysis = replace(analysis, evidence=_evidence_of(inspection, signal))
    return _with_estimate(analysis, run, plate, recording, estimator)


def _assumed(run: Run, recording: FleetRecording, told: list[str]) -> tuple[str, ...]:
    """List how the file was understood, and warnings, without its folder."""
    found = [*(run.measured.get("understood") or []), *(run.measured.get("warnings") or []), *told]
    if run.problem:
        found.append(f"not whole: {run.problem}")
    return tuple(dict.fromkeys(each.replace(str(recording.path), recording.path.name) for each in found))


def _read(recording: FleetRecording) -> tuple[Run, tuple[Any, ...]]:
    """Read the signals, and which bearing was named."""
    from beardyn_core.config import load_plate
    from beardyn_core.measured.about import USUAL_LABEL, Mounted
    from beardyn_core.measured.found_speed import with_found_speed
    from beardyn_core.measured.in_memory import run_of
    from beardyn_core.measured.options import Reading
    from beardyn_core.measured.survey import survey
    from beardyn_core.record.other_messages import is_recording
    from beardyn_core.record.reading import read_run

    path = recording.path
    mounted = (
        (Mounted(USUAL_LABEL, load_plate(recording.bearing), recording.sensor),) if recording.bearing else ()
    )
    if is_recording(path) and "channels" not in recording.reading:
        if recording.reading:
            raise InputError(
                f"{path}: is a recording, which is taken as it is; leave {', '.join(recording.reading)} out"
            )
        run = read_run(path, recording.source_box or None)
        if not recording.source_box and len(run.boxes) > 1:
            raise InputError(f"{path}: has the axleboxes {', '.join(run.boxes)}; name one in source_box")
        return run, mounted
    if not mounted:
        raise InputError(f"{path}: nothing names its bearing; give bearing in the manifest, or --bearing")
    measured = with_found_speed(survey([path], Reading.of(**recording.reading), needs_speed=True), mounted)
    return run_of(measured, mounted), mounted


def _temperature(run: Run, recording: FleetRecording) -> float:
    """Take the temperature that was stated, or the last one of the recording, [K]."""
    if np.isfinite(recording.temperature) or not len(run.temperature):
        return recording.temperature
    column = run.temperature.components.index("axlebox")
    return float(run.temperature.values[-1, column])


def _levels(signal: Float, rate: float) -> Float:
    """Compute the levels, the median over pieces of 10 s, shape [axis, band], [dB]."""
    from beardyn_core.monitor.trend import record_levels

    count = max(1, round(len(signal) / (rate * _LONGEST_LEVEL_S)))
    pieces = [each for each in np.array_split(signal, count) if len(each) >= _LEAST_LEVEL_S * rate]
    if not pieces:
        return np.empty((0, 0))
    return np.asarray(np.median([record_levels(each, rate) for each in pieces], axis=0), np.float64)


def _evidence_of(inspection: Inspection, signal: Signal) -> bytes:
    """Gather what a page shows of this verdict, small."""
    from beardyn_core.study.report_page.identity import loudest_axis, shaft_frequency

    result = inspection.results.concluded
    if result is None or len(signal) < 2:
        return b""
    axis, values = loudest_axis(signal)
    rate, hertz = float(signal.rate), shaft_frequency(inspection.run)
    edges = np.linspace(0, len(values), min(_BINS, len(values)) + 1).astype(int)[:-1]
    band = result.band if np.isfinite(result.band[0]) else (_FLOOR_OF_BAND, 0.45 * rate)
    count = min(len(values), round(_TURNS * rate / hertz)) if hertz > 0.0 else len(values)
    begin = (len(values) - count) // 2
    lines, frequency = np.fft.rfft(values), np.fft.rfftfreq(len(values), 1.0 / rate)
    lines[(frequency < band[0]) | (frequency > band[1])] = 0.0
    excerpt = np.fft.irfft(lines, len(values))[begin : begin + count]
    order = level = np.empty(0)
    if result.spectrum is not None:
        found = np.nan_to_num([result.fault_order, result.comb_order])
        kept = result.spectrum.order <= max(_LEAST_ORDERS, _LAST_HARMONIC * float(found.max()))
        order, level = result.spectrum.order[kept], result.spectrum.level[kept]
    plate = inspection.mounted.plate
    file = io.BytesIO()
    np.savez_compressed(
        file,
        order=order.astype(np.float32),
        level=level.astype(np.float16),
        verdict=result.verdict,
        found=np.array([result.fault_order, result.comb_order]),
        also_fits=" ".join(result.also_fits),
        orders=np.array(
            [plate.frequencies.bpfo, plate.frequencies.bpfi, plate.frequencies.bsf, plate.frequencies.ftf]
        ),
        axis=axis,
        record=np.array([np.minimum.reduceat(values, edges), np.maximum.reduceat(values, edges)], np.float32),
        excerpt=excerpt.astype(np.float32),
        numbers=np.array([len(values) / rate, rate, *band]),
    )
    return file.getvalue()


def read_evidence(blob: bytes) -> Evidence | None:
    """Read what `Analysis.evidence` holds; ``None`` where it is empty."""
    if not blob:
        return None
    with np.load(io.BytesIO(blob), allow_pickle=False) as held:
        duration, rate, low, high = held["numbers"].tolist()
        fault_order, comb_order = held["found"].tolist()
        bpfo, bpfi, bsf, ftf = held["orders"].tolist()
        return Evidence(
            held["order"].astype(np.float64), held["level"].astype(np.float64), str(held["verdict"]),
            fault_order, comb_order, tuple(str(held["also_fits"]).split()), (bpfo, bpfi, bsf, ftf),
            str(held["axis"]), held["record"].astype(np.float64), duration,
            held["excerpt"].astype(np.float64), rate, (low, high),
        )  # fmt: skip


@cache
def _estimators(name: str) -> tuple[Estimator, ...]:
    """Read estimators once a process."""
    from beardyn_core.follow.estimator import read_estimator
    from beardyn_core.follow.estimator_choice import readable_estimators

    return tuple(readable_estimators()) if name == SHIPPED else (read_estimator(Path(name)),)


def _with_estimate(
    analysis: Analysis, run: Run, plate: NamePlate, recording: FleetRecording, name: str
) -> Analysis:
    """Add what an estimator says, and its width, or the least of it, where the monitor has none.

    What it refuses is a note.
    """
    from beardyn_core.follow.estimate_json import estimates_object
    from beardyn_core.follow.estimator_choice import estimator_for
    from beardyn_core.follow.inference import doubt_of, estimates_of, measured_axes

    known = () if name == NO_ESTIMATOR else _estimators(name)
    if all(doubt_of(each, plate) for each in known):
        return analysis
    try:
        estimator = estimator_for(plate, measured_axes(run, recording.sensor), known=known)
        found = estimates_of(run, estimator, plate, recording.sensor)
    except InputError as error:
        note = f"no estimate: {'; '.join(error.problems)}".replace(str(recording.path), recording.path.name)
        return replace(analysis, assumed=(*analysis.assumed, note))
    analysis = replace(analysis, estimate=estimates_object(found))
    called = analysis.verdict in ("cup", "cone", "roller")
    width = next((each for each in found.quantities if each.quantity.name == "width"), None)
    agrees = found.part is not None and found.part.condition == analysis.verdict
    if not called or analysis.width_from or not agrees or width is None:
        return analysis
    if np.isfinite(width.at_least):  # which of a spall too wide for the monitor is all that is known
        reason = "; ".join(filter(None, [analysis.stage_reason, f"estimator: {width.reason}"]))
        return replace(analysis, width_low=float(width.at_least), width_from="estimator", stage_reason=reason)
    if not np.isfinite(width.value):
        return analysis
    low, high = width.intervals[-1]
    return replace(
        analysis,
        width=float(width.value),
        width_low=float(low),
        width_high=float(high),
        width_from="estimator",
    )


def analysis_numbers(analysis: Analysis) -> dict[str, Any]:
    """List the fields of an analysis that are kept as JSON."""
    held = asdict(replace(analysis, evidence=b"", levels=np.empty((0, 0))))
    return {key: held[key] for key in ("axes", "also_fits", "estimate", "assumed", "agreeing", "analyses")}

"""Content of a recording, in words and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.factors import SYMBOLS
from beardyn_core.choice.rule import shorten_summary
from beardyn_core.record.arrays import decoding_checked
from beardyn_core.record.bag_scanning import BagScan
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import COMPLETE
from beardyn_core.record.plot_values import BY_TOPIC
from beardyn_core.record.published import (
    MissingMessages,
    kept_pace,
    last_published,
    missing_messages,
    missing_sentence,
    published_before,
)
from beardyn_core.record.reading import namespace_in, read_with_times
from beardyn_core.record.run import Run
from beardyn_core.record.run_summary import chosen_for, collect_diagnostic, recorded_budget
from beardyn_core.record.stamp_offset import StampOffset, earliest_stamp
from beardyn_core.record.topics import relative_name
from beardyn_core.scene.defect import defect_from
from beardyn_core.sensors.labels import HEALTHY
from beardyn_core.sensors.summary import TorqueBudget

SAMPLE_RANGE = 1 << 32
# Topics written by others, or once: their times are not those of the twin's signals.
NOT_OF_THE_TWIN = (
    *("/load/blocks", "/load/consumed", "/load/wrench", "/load/shaft"),
    *("/monitor/result", "/truth", "/diagnostics", "/vibration_samples"),
    *(f"/{name}" for name in BY_TOPIC),
)


@dataclass(frozen=True)
class TopicCount:
    """One topic of a file."""

    name: str
    type: str
    count: A[int, "messages"]
    rate: A[
        float | None, "from the first message to the last, without leaps, [1/s]; ``None`` without such a span"
    ]


@dataclass(frozen=True)
class Gap:
    """Samples that are not in the file."""

    topic: str
    time: A[float, "of the last sample before the gap, [s]"]
    missing: int


@dataclass(frozen=True)
class Report:
    """Content of a recording."""

    path: str
    size_bytes: int
    usable_bytes: int
    complete: A[bool, "the file was closed properly"]
    problem: A[str, "where and why reading stopped"]
    status: A[str | None, "how the run ended: ``complete`` as asked, ``None`` not known"]
    begin: A[float, "first log time of the twin's messages, [s]: a live load stream runs ahead of it"]
    end: A[float, "last log time, [s]"]
    topics: tuple[TopicCount, ...]
    attachments: A[Mapping[str, int], "name to bytes"]
    gaps: tuple[Gap, ...]
    scene: str | None
    bearing: str | None
    chosen: A[str | None, "what its effects were chosen for; ``None`` where they were named"]
    faults: list[Any]
    fault_frequencies_per_rev: Mapping[str, float]
    mean_shaft_speed: A[float | None, "[rad/s]"]
    real_time_factor: A[float | None, "mean"]
    pace: A[float | None, "simulated over wall time of the whole run; ``None``: none was asked for"]
    late_blocks: A[int | None, "published more than 40 ms after they were due; ``None``: not known"]
    energy_residual: A[float | None, "last value"]
    budget: A[TorqueBudget | None, "losses by source after the start has settled, if the recording has them"]
    monitor: A[str | None, "last verdict of the monitor"]
    sensor_rates_Hz: A[Mapping[str, float], "accelerometers by name"]
    missing_messages: A[
        tuple[MissingMessages, ...] | None,
        "topics of which the twin has published more than is recorded; ``None``: it had no last word",
    ]
    malformed_messages: A[Mapping[str, int], "left out because they are not what their topic promises"]
    boxes: A[Mapping[str, str], "condition of every axlebox by name; empty for a recording of one"]
    measured: A[Mapping[str, Any], "files, channels, units and speed of what was measured; empty: simulated"]

    def to_json(self) -> dict[str, Any]:
        """Give the content as a mapping for JSON."""
        content = asdict(replace(self, budget=None))
        del content["budget"]
        return {**content, "torque_budget": None if self.budget is None else self.budget.to_json()}

    def to_text(self) -> str:
        """Write the content for a terminal."""
        return "\n".join(_lines(self))


def report(path: Path | str, box: str | None = None) -> Report:
    """Read a recording, also a cut-off one, and report its content.

    Parameters
    ----------
    box : str, optional
        Axlebox of several that what is said of a scene is about; by default the first.

    Raises
    ------
    InputError
        The file is absent, not MCAP, or holds not one usable message.
    """
    run, scan, times = read_with_times(path, box)
    with decoding_checked(scan.path):
        return _report(scan, run, times)


def _report(scan: McapScan | BagScan, run: Run, times: Mapping[tuple[str, str], list[int]]) -> Report:
    """Report a file; `times` are the log times of each topic and its type, [ns]."""
    # of everything when the twin has said nothing
    own = [each for (topic, _), each in times.items() if not topic.endswith(NOT_OF_THE_TWIN)]
    own = own or list(times.values())
    description, speed = run.description, run.shaft.speed
    factors, residuals = (
        collect_diagnostic(run, "real_time_factor"),
        collect_diagnostic(run, "energy_residual"),
    )
    statuses = (each for _, told in run.diagnostics for each in told)
    space = namespace_in(name for name, _ in times)
    pace, late = kept_pace(statuses, space)
    offset = StampOffset(run.source_time, earliest_stamp(run.truth))
    return Report(
        path=str(scan.path),
        size_bytes=scan.size_bytes,
        usable_bytes=scan.usable_bytes,
        complete=scan.complete,
        problem=scan.problem,
        status=run.status,
        begin=min(map(min, own)) * 1e-9,
        end=max(map(max, own)) * 1e-9,
        topics=tuple(
            TopicCount(name, its_type, len(each), _rate(each, offset if _is_of_twin(name, space) else None))
            for (name, its_type), each in sorted(times.items())
        ),
        attachments={name: len(data) for name, data in scan.attachments.items()},
        gaps=gaps(run),
        scene=description.scene if description else None,
        bearing=description.shape.name if description else None,
        chosen=chosen_for(run.truth),
        faults=[asdict(defect) for defect in description.defects] if description else [],
        fault_frequencies_per_rev=description.shape.fault_frequencies if description else {},
        mean_shaft_speed=float(speed.mean()) if len(speed) else None,
        real_time_factor=float(np.mean(factors)) if factors else None,
        pace=pace,
        late_blocks=late,
        energy_residual=residuals[-1] if residuals else None,
        budget=recorded_budget(run),
        monitor=run.results[-1][1][0].message if run.results and run.results[-1][1] else None,
        sensor_rates_Hz=dict(zip(description.sensor_names, description.sensor_rates, strict=True))
        if description
        else {name: signal.rate for name, signal in run.sensors.items()}
        if run.measured
        else {},
        missing_messages=_missing(run, times),
        malformed_messages=run.malformed,
        boxes={name: str(each.truth.get("condition", "not known")) for name, each in run.boxes.items()}
        if len(run.boxes) > 1
        else {},
        measured=run.measured,
    )


def _missing(run: Run, times: Mapping[tuple[str, str], list[int]]) -> tuple[MissingMessages, ...] | None:
    """Compare what is recorded with what the twin says in its last word."""
    namespace = namespace_in(topic for topic, _ in times)
    published = last_published((each for _, statuses in run.diagnostics for each in statuses), namespace)
    if published is None:
        return None
    recorded = {relative_name(topic, namespace): len(each) for (topic, _), each in times.items()}
    for name, count in run.malformed.items():
        recorded[name] -= count
    ahead_ns = StampOffset(run.source_time, earliest_stamp(run.truth)).first_ns or 0
    first = {relative_name(topic, namespace): min(each) - ahead_ns for (topic, _), each in times.items()}
    before = published_before(first, len(run.temperature.components))
    return tuple(missing_messages(published, recorded, before))


def _is_of_twin(name: str, namespace: str) -> bool:
    """Tell a topic of the twin of a namespace, whose stamps leap with it, from one that goes on meanwhile."""
    return name.startswith(f"{namespace}/") and not name.endswith(NOT_OF_THE_TWIN)


def _rate(times: list[int], offset: StampOffset | None) -> float | None:
    begin, end = min(times), max(times)
    span = end - begin - (0 if offset is None else offset.leapt(begin, end))
    return (len(times) - 1) * 1e9 / span if span > 0 else None


def gaps(run: Run) -> tuple[Gap, ...]:
    """Find every place where samples of a stream are missing, by running index or, without one, by time."""
    found: list[Gap] = []
    offset = StampOffset(run.source_time, earliest_stamp(run.truth))
    for name, samples in (("force_waveform", run.force_waveform), *run.sensor_topics.items()):
        found += _index_gaps(name, samples.sample, samples.time_ns)
    found += _index_gaps("bodies", run.bodies.sample, run.bodies.time_ns)
    found += _index_gaps("load/blocks", run.load.sample, run.load.time_ns)
    for name, times in (
        ("force", run.force.time_ns),
        ("imu", run.specific_force.time_ns),
        ("shaft", run.shaft.time_ns),
        ("joint_states", run.cages.time_ns),
    ):
        found += _time_gaps(name, times, offset)
    return tuple(found)


def _index_gaps(name: str, sample: NDArray[np.int64], time_ns: NDArray[np.int64]) -> list[Gap]:
    step = np.mod(np.diff(sample), SAMPLE_RANGE)
    return [Gap(name, float(time_ns[i] * 1e-9), int(step[i] - 1)) for i in np.flatnonzero(step != 1)]


def _time_gaps(name: str, time_ns: NDArray[np.int64], offset: StampOffset) -> list[Gap]:
    step = np.diff(time_ns)
    if not len(step):
        return []
    regular = max(int(np.median(step)), 1)
    found = []
    for i in np.flatnonzero(step > 1.5 * regular).tolist():
        missing = offset.count_missing(int(time_ns[i]), int(time_ns[i + 1]), regular)
        if missing:
            found.append(Gap(name, float(time_ns[i] * 1e-9), missing))
    return found


def _lines(r: Report) -> list[str]:
    lines = [f"{r.path}: {r.size_bytes / 1e6:.2f} MB, {r.begin:.3f} s to {r.end:.3f} s"]
    ending = "" if r.status in (None, COMPLETE) else f"; the run ended: {r.status}"
    lines += [f"closed properly{ending}" if r.complete else r.problem, ""]
    lines += _measured_lines(r.measured)
    if r.boxes:
        sound = sum(each == HEALTHY for each in r.boxes.values())
        others = "; ".join(f"{name}: {each}" for name, each in r.boxes.items() if each != HEALTHY)
        lines.append(f"boxes    {len(r.boxes)}, {sound} healthy; {others or 'none faulty'}")
        lines.append(f"         of the one that --box names, or the first, {next(iter(r.boxes))}:")
    if r.scene is not None:
        lines.append(f"scene    {r.scene}, bearing {r.bearing}")
        if r.chosen is not None:
            lines.append(f"accuracy {shorten_summary(r.chosen)}")
        faults = [defect_from(fault).described() for fault in r.faults]
        lines.append(f"faults   {'; '.join(faults) or 'none'}")
    if r.sensor_rates_Hz:
        each = (f"{name} at {rate / 1e3:g} kHz" for name, rate in r.sensor_rates_Hz.items())
        lines.append(f"sensors  {', '.join(each)}")
    if r.mean_shaft_speed is not None:
        hertz = r.mean_shaft_speed / (2.0 * np.pi)
        lines.append(f"shaft    {hertz * 60.0:.1f} rpm on average")
        if r.fault_frequencies_per_rev:
            entries = (
                f"{name} {per_rev:.4f}/rev = {per_rev * hertz:.2f} Hz"
                for name, per_rev in r.fault_frequencies_per_rev.items()
            )
            lines.append("         " + ", ".join(entries))
    if r.real_time_factor is not None:
        lines.append(f"computed at {r.real_time_factor:.2f} x real time on average")
    if r.pace is not None:
        late = "" if r.late_blocks is None else f"; late blocks: {r.late_blocks}"
        lines.append(f"pace     {r.pace:.4f} simulated seconds in a second of wall time{late}")
    if r.energy_residual is not None:
        lines.append(f"energy residual {r.energy_residual:.2e}")
    if r.budget is not None:
        lines += ["", *r.budget.lines(), ""]
    if r.monitor is not None:
        lines.append(f"monitor  {r.monitor}")
    lines += ["", f"{'topic':32}{'messages':>10}{'per s':>9}  type"]
    lines += [
        f"{t.name:32}{t.count:>10}{'-' if t.rate is None else f'{t.rate:.1f}':>9}  {t.type}" for t in r.topics
    ]
    lines.append("")
    if r.attachments:
        lines.append("attached " + ", ".join(f"{name} ({size} B)" for name, size in r.attachments.items()))
    if r.missing_messages:
        lines.append(missing_sentence(r.missing_messages))
    elif not r.gaps:
        lines.append("no samples missing")
    if r.gaps:
        lines.append(f"{len(r.gaps)} gaps:")
    lines += [f"  {gap.topic}: {gap.missing} samples after {gap.time:.4f} s" for gap in r.gaps[:20]]
    if len(r.gaps) > 20:
        lines.append(f"  ... and {len(r.gaps) - 20} more")
    if r.malformed_messages:
        counts = ", ".join(f"{name} {count}" for name, count in r.malformed_messages.items())
        lines.append(f"malformed messages, left out: {counts}")
    return lines


def _measured_lines(measured: Mapping[str, Any]) -> list[str]:
    """Describe what was measured, and how its files were understood."""
    if not measured:
        return []
    lines = [f"measured {sentence}" for sentence in measured.get("understood", ())]
    for label, plate in measured.get("bearings", {}).items():
        lines.append(f"{label:8} {plate.get('name')}: {_bearing_text(plate)}")
    return lines


def _bearing_text(plate: Mapping[str, Any]) -> str:
    """Describe recorded bearing data: inner dimensions, or maker's factors."""
    diameter, pitch = plate.get("roller_diameter_m"), plate.get("pitch_diameter_m")
    sizes = (
        []
        if diameter is None or pitch is None
        else [f"{1e3 * diameter:g} mm on a circle of {1e3 * pitch:g} mm"]
    )
    count = plate.get("roller_count")
    known = [f"{count} rolling elements{' of ' + sizes[0] if sizes else ''}"] if count else []
    known += [f"{name.upper()} {plate[name]:g}" for name in SYMBOLS if plate.get(name) is not None]
    return ", ".join(known)

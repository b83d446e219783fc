"""Which bearing, which files, when, how fast: rows of a page, with their sources where they can be wrong."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from math import isfinite, nan, pi
from typing import Any

import numpy as np

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.measured.about import USUAL_LABEL
from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.record.arrays import Signal
from beardyn_core.record.mcap_writing import COMPLETE
from beardyn_core.record.reporting import gaps
from beardyn_core.record.run import Run
from beardyn_core.scene.scene import Scene
from beardyn_core.study.inspection import FROM_RECORDING, FROM_SCENE, Inspection

NOT_STATED = "not stated"
_DATED = 10**17  # [ns]: a time stamp beyond it is a date since 1970, of 1973 or later
OF_THE_RECORD = ("Kind of record", "Train, vehicle", "Files", "Date of the record", "State of the file")
"""Rows that all axleboxes of a recording share."""
_NAMED_FILES = 4  # of more files the first and the last are named


def identity_rows(
    inspection: Inspection, *, train: str = "", axlebox: str = "", scene: Scene | None = None
) -> tuple[tuple[str, str], ...]:
    """Write the rows.

    Parameters
    ----------
    train, axlebox : str
        As a person named them; else what the recording says.
    scene : Scene, optional
        Of a simulated recording.
    """
    run, plate = inspection.run, inspection.mounted.plate
    signal = signal_of(inspection)
    rows = {
        "Kind of record": _kind(run),
        "Train, vehicle": train or _vehicle(run, scene),
        "Axlebox": axlebox or run.box or _axlebox(inspection),
        "Bearing": ": ".join(each for each in (plate.name, plate.description) if each),
        "Bearing data": _bearing_data(plate),
        "Files": files_in_words(file_names(run)),
        "Date of the record": record_date(run) or NOT_STATED,
        "Shaft speed": _speed(inspection, scene),
        "Speed is from": f"{speed_source(inspection)}, {_uncertainty(inspection)}",
        "Duration": f"{_seconds(signal):.4g} s, {_revolutions(run):.0f} revolutions",
        "Sampling": f"{signal.rate:g} Hz, axes {', '.join(measured_names(signal))}, in m/s²",
        "Accelerometer": inspection.mounted.sensor or next(iter(run.sensors), NOT_STATED),
        "State of the file": _state(run),
    }
    return tuple(rows.items())


def signal_of(inspection: Inspection) -> Signal:
    """Take the vibration that was judged."""
    run, sensor = inspection.run, inspection.mounted.sensor
    return run.sensors[sensor] if sensor else run.vibration


def measured_names(signal: Signal) -> tuple[str, ...]:
    """Name the axes that were measured: those of the others are NaN."""
    if not len(signal):
        return signal.components
    there = [bool(each) for each in np.isfinite(signal.values[0])]
    return tuple(name[-1] for name, is_there in zip(signal.components, there, strict=True) if is_there)


def loudest_axis(signal: Signal) -> tuple[str, np.ndarray[Any, np.dtype[np.float64]]]:
    """Choose the axis that varies most; its name and its values without their mean, [m/s^2]."""
    values = measured_axes(signal.values)
    column = int(np.argmax(values.std(axis=0)))
    one = values[:, column]
    return measured_names(signal)[column], one - one.mean()


def file_names(run: Run) -> list[str]:
    """List the files of a run, those that were measured behind the recording that they were imported to."""
    files = fact_of(run.measured, "files", list)
    named = [name for each in files if (name := fact_of(each, "name", str))]
    own = "" if run.path is None else run.path.name
    if not named:
        return [own or "run in memory"]
    return named if own in named else [own, *named]


def files_in_words(names: list[str]) -> str:
    """Name the files, of many the first and the last."""
    if len(names) <= _NAMED_FILES:
        return ", ".join(names)
    return f"{names[0]} to {names[-1]}, {len(names)} files"


def record_date(run: Run, number: int = 0) -> str:
    """Read the date of a record by the clock of its file; empty where the file does not know."""
    files = fact_of(run.measured, "files", list)
    if number < len(files) and (date := fact_of(files[number], "date", str)):
        return f"{date}, clock of the file"
    stamps = run.vibration.time_ns
    if not number and len(stamps) and int(stamps[0]) > _DATED:
        return f"{datetime.fromtimestamp(int(stamps[0]) * 1e-9, UTC):%Y-%m-%d %H:%M:%S} UTC"
    return ""


def shaft_frequency(run: Run) -> float:
    """Mean frequency of the shaft, NaN without, [Hz]."""
    speed = run.shaft.speed
    return float(np.abs(speed).mean()) / (2.0 * pi) if len(speed) else nan


def speed_source(inspection: Inspection) -> str:
    """Say where the speed comes from."""
    run = inspection.run
    speed = fact_of(run.measured, "speed", dict)
    channel = speed.get("channel")
    words = {
        "constant": "a constant speed that was stated",
        "channel": f"channel {channel}",
        "tacho": f"tachometer {channel}",
        "vibration": "the vibration itself",
    }
    if run.measured:
        return words.get(str(speed.get("from")), NOT_STATED)
    return "the shaft angle in the recording" if len(run.shaft) else NOT_STATED


def bearing_source(inspection: Inspection) -> str:
    """Say who names the bearing."""
    who = {
        FROM_SCENE: "the scene in the recording",
        FROM_RECORDING: "the recording, as it was imported",
    }
    return who.get(inspection.bearing_from, "named for this page")


def fact_of(facts: Any, key: str, kind: type) -> Any:
    """Take what a file says of itself, which may be damaged: then it is empty, or 0."""
    value = facts.get(key) if isinstance(facts, Mapping) else None
    return value if isinstance(value, kind) else kind()


def _kind(run: Run) -> str:
    if run.measured:
        return "measured"
    scene = "" if run.description is None else f", scene {run.description.scene}"
    return f"SIMULATED{scene}: not of a real train"


def _vehicle(run: Run, scene: Scene | None) -> str:
    vehicle = getattr(getattr(scene, "operation", None), "vehicle", None)
    if vehicle is not None:
        return str(vehicle.name)
    return NOT_STATED if run.measured or scene is None else "none, a simulated bearing"


def _axlebox(inspection: Inspection) -> str:
    label = inspection.mounted.label
    return NOT_STATED if label == USUAL_LABEL else label


def _bearing_data(plate: NamePlate) -> str:
    orders = plate.frequencies
    symbols = {"BPFO": orders.bpfo, "BPFI": orders.bpfi, "2 BSF": 2.0 * orders.bsf, "FTF": orders.ftf}
    known = ", ".join(f"{name} {order:.3f}" for name, order in symbols.items() if isfinite(order))
    count = f"{plate.roller_count} rolling elements in a row, " if plate.roller_count else ""
    return f"{count}{known} per revolution"


def _speed(inspection: Inspection, scene: Scene | None) -> str:
    run = inspection.run
    hertz = shaft_frequency(run)
    if not isfinite(hertz):
        return NOT_STATED
    low, high = (float(each) * 30.0 / pi for each in np.quantile(np.abs(run.shaft.speed), (0.01, 0.99)))
    words = f"{60.0 * hertz:.1f} rpm ({hertz:.2f} Hz)"
    if high - low > 0.01 * high:
        words = f"{low:.0f} to {high:.0f} rpm, mean {words}"
    diameter = fact_of(run.truth, "wheel_diameter_m", float)
    return f"{words}, {3.6 * pi * diameter * hertz:.0f} km/h" if diameter else words


def _uncertainty(inspection: Inspection) -> str:
    uncertainty = inspection.settings.speed_uncertainty
    return f"uncertain by {100.0 * uncertainty:.2g} %" if uncertainty else "taken as exact"


def _seconds(signal: Signal) -> float:
    return float(signal.time_ns[-1] - signal.time_ns[0]) * 1e-9 if len(signal) else 0.0


def _revolutions(run: Run) -> float:
    angle = np.unwrap(run.shaft.angle) if len(run.shaft) else np.zeros(1)
    return float(np.abs(np.diff(angle)).sum()) / (2.0 * pi)


def _state(run: Run) -> str:
    lost = sum(gap.missing for gap in gaps(run))
    missing = f"; {lost} samples are missing in it" if lost else ""
    if run.problem or not run.complete:
        return f"NOT WHOLE: {run.problem or 'the file was not closed'}{missing}"
    if run.status not in (None, COMPLETE):
        return f"the run ended: {run.status}{missing}"
    return f"whole{missing}"

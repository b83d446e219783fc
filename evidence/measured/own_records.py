"""Recordings of one's own train, listed in a table: read by the product's import, every mistake at once.

Columns of the table (CSV): ``file`` (relative to the table), ``condition`` (`CONDITIONS`), ``bearing`` (name
or file of bearing data), ``rpm``, or ``speed_kmh`` and ``wheel_diameter_mm``, ``unit`` and ``channel``; the
last two may be empty where the file says them.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_plate
from evidence.measured.texture_quantities import WINDOW, Texture, measure
from evidence.measured.twin_runs import VERTICAL, fault_order

CONDITIONS = {"healthy": "", "cup": "cup", "cone": "cone", "roller": "roller"}
NEEDED = ("file", "condition", "bearing")
SPEEDS = ("rpm", "speed_kmh", "wheel_diameter_mm")
COLUMNS = (*NEEDED, *SPEEDS, "unit", "channel")


@dataclass(frozen=True)
class OwnRecord:
    """One row of the table."""

    path: Path
    part: A[str, "faulty part, '' when healthy"]
    plate: NamePlate
    options: A[Mapping[str, Any], "how `bd.read_measured` is to read it"]


def measure_table(table: Path) -> list[tuple[OwnRecord, Texture]]:
    """Read and measure every recording of a table.

    Raises
    ------
    InputError
        With every mistake of the table and of the files.
    """
    problems: list[str] = []
    found = []
    for row, cells in _rows(table, problems):
        mistakes: list[str] = []
        record = _record(table.parent, cells, mistakes)
        if record is not None and not mistakes:
            try:
                found.append((record, measure_record(record)))
            except InputError as error:
                mistakes += error.problems
        problems += [f"{table}, row {row}: {mistake}" for mistake in mistakes]
    if problems:
        raise InputError(problems)
    return found


def measure_record(record: OwnRecord) -> Texture:
    """Read a recording and measure its vertical axis, or its only one."""
    run = bd.read_measured(record.path, bearing=record.plate, **record.options)
    vibration, shaft = run.vibration, run.shaft
    axes = np.asarray(np.isfinite(vibration.values).all(axis=0))
    axis = VERTICAL if axes[VERTICAL] else int(np.argmax(axes))
    angle = np.interp(vibration.time_ns, shaft.time_ns, shaft.angle)
    turning = np.flatnonzero(np.diff(angle) > 0.0)
    kept = slice(int(turning[0]), int(turning[-1]) + 2) if len(turning) else slice(0, 0)
    turned = np.ptp(angle[kept]) / (2.0 * math.pi) if len(turning) else 0.0
    if turned < WINDOW:
        raise InputError(f"{record.path}: the shaft turns {turned:.1f} times; at least {WINDOW:g} are needed")
    order = fault_order(record.plate.frequencies, record.part)
    return measure(vibration.values[kept, axis], vibration.rate, angle[kept], order)


def _rows(table: Path, problems: list[str]) -> Iterator[tuple[int, dict[str, str]]]:
    """Give the rows with their numbers, the heading being row 1."""
    try:
        with table.open(newline="", encoding="utf-8-sig") as stream:
            reader = csv.DictReader(stream)
            rows = list(reader)
            names = [name.strip() for name in reader.fieldnames or ()]
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{table}: cannot be read: {error}") from None
    allowed = f"columns are {', '.join(COLUMNS)}"
    problems += [f"{table}: {name} is no column; {allowed}" for name in names if name not in COLUMNS]
    missing = [name for name in NEEDED if name not in names]
    problems += [f"{table}: the column {name} is missing; {allowed}" for name in missing]
    if not rows:
        problems.append(f"{table}: has no rows")
    if missing:
        return
    for number, row in enumerate(rows, 2):
        yield number, {str(name).strip(): str(cell or "").strip() for name, cell in row.items()}


def _record(folder: Path, cells: Mapping[str, str], mistakes: list[str]) -> OwnRecord | None:
    """Make a record of the cells of a row, and list what is wrong with them."""
    path = folder / cells["file"]
    if not path.is_file():
        mistakes.append(f"file is {cells['file']!r}; there is no such file in {folder}")
    part = CONDITIONS.get(cells["condition"])
    if part is None:
        mistakes.append(f"condition is {cells['condition']!r}; it must be one of {', '.join(CONDITIONS)}")
    plate = None
    try:
        plate = load_plate(cells["bearing"])
    except InputError as error:
        mistakes += [f"bearing is {cells['bearing']!r}: {problem}" for problem in error.problems]
    options: dict[str, Any] = _speed(cells, mistakes)
    if cells.get("unit"):
        options["unit"] = cells["unit"]
    if cells.get("channel"):
        options["channels"] = [f"z={cells['channel']}"]
    return None if plate is None or part is None else OwnRecord(path, part, plate, options)


def _speed(cells: Mapping[str, str], mistakes: list[str]) -> dict[str, Any]:
    """Read the speed of the shaft, or of the train with the diameter of its wheels."""
    given: dict[str, float] = {}
    for name in SPEEDS:
        text = cells.get(name, "")
        try:
            number = float(text) if text else math.nan
        except ValueError:
            number = -1.0
        if text and not 0.0 < number < math.inf:
            mistakes.append(f"{name} is {text!r}; it must be a number above 0")
        elif text:
            given[name] = number
    if "rpm" in given and "speed_kmh" in given:
        mistakes.append("rpm and speed_kmh are both given; give one of them")
    wanted = [name for name in SPEEDS if cells.get(name, "")]
    if "rpm" not in wanted and not {"speed_kmh", "wheel_diameter_mm"} <= set(wanted):
        mistakes.append("the speed is missing; give rpm, or speed_kmh and wheel_diameter_mm")
    if "rpm" in given:
        return {"speed_rpm": given["rpm"]}
    return dict(given)

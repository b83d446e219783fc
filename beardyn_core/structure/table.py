"""The text file of the modes of a box: a head in YAML, then a line for each mode.

The head stands behind ``#`` and has name, description, the bearing with the dimensions of its cup, mass,
centre, inertia, the number of free modes, the seats with their positions and which of them are the
suspension's; of a box that was meshed also a digest of what was. The columns are ``frequency_Hz``,
``damping_ratio``, then for each row, ``inboard`` and ``outboard``, and each field, ``radial``, ``tangential``
and ``axial``, the series around the raceway: ``inboard_radial_mean``, ``inboard_radial_cos1`` ...
``inboard_radial_sin8``; then ``NAME_x``, ``NAME_y`` and ``NAME_z`` of each seat. Shapes have unit modal mass,
[1/sqrt(kg)]. Columns of the raceway that are left out are zero.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, separator_problem
from beardyn_core.base.inputs import text_of_file
from beardyn_core.base.outputs import note_read
from beardyn_core.structure.cup import DIMENSIONS, Cup
from beardyn_core.structure.modes import FIELDS, WAVES, Modes

ROWS = ("inboard", "outboard")
AXES = ("x", "y", "z")
SERIES = ("mean", *(f"cos{n}" for n in range(1, WAVES + 1)), *(f"sin{n}" for n in range(1, WAVES + 1)))
RACEWAY_COLUMNS = tuple(f"{row}_{field}_{term}" for row in ROWS for field in FIELDS for term in SERIES)
_DIGITS = 5
_OF_EARLIER_VERSIONS = {
    "bearing": "tables of earlier versions lack it: make the table again with `beardyn structure`, or add "
    "the bearing whose cup is in the box, such as `# bearing: HS130x230`",
    "cup_mm": "make the table again with `beardyn structure`, or add the dimensions of that cup, such as "
    "`# cup_mm: {outer_diameter: 230, width: 160, raceway_diameter: 211.253, row_spacing: 75}`",
}


def table_text(modes: Modes) -> str:
    """Write modes as the text of their file."""
    head = {
        "name": modes.name,
        "description": modes.description,
        "bearing": modes.cup.bearing,
        "cup_mm": {name: _short(1e3 * getattr(modes.cup, name)) for name in DIMENSIONS},
        "mass_kg": _short(modes.mass),
        "centre_mm": [_short(1e3 * each) for each in modes.centre],
        "inertia_kg_m2": [_short(each) for each in modes.inertia],
        "products_kg_m2": [_short(each) for each in modes.products],
        "free_modes": modes.free_count,
        "suspension": list(modes.suspension),
        **({"made_from": modes.made_from} if modes.made_from else {}),
        "seats_mm": {name: [_short(1e3 * each) for each in place] for name, place in modes.places.items()},
    }
    text = io.StringIO()
    for line in yaml.safe_dump(head, sort_keys=False, width=100, allow_unicode=True).splitlines():
        text.write(f"# {line}\n")
    writer = csv.writer(text, lineterminator="\n")
    seats = [f"{name}_{axis}" for name in modes.seats for axis in AXES]
    writer.writerow(["frequency_Hz", "damping_ratio", *RACEWAY_COLUMNS, *seats])
    reads = modes.reads.T
    largest = np.abs(reads).max(initial=0.0)
    for frequency, damping, shape in zip(modes.frequency, modes.damping_ratio, reads, strict=True):
        # what rounding has left of a zero stays out of the file
        shown = np.where(np.abs(shape) < 10.0**-_DIGITS * largest, 0.0, shape)
        writer.writerow([_text(each) for each in (frequency, damping, *shown)])
    return text.getvalue()


def read_table(path: Path | str) -> Modes:
    """Read the modes of a file.

    Raises
    ------
    InputError
        With every mistake in the file.
    """
    return modes_of_text(table_text_of(path), str(path))


def table_text_of(path: Path | str) -> str:
    """Read the text of a table, mistakes and all; raises `InputError` where there is none."""
    note_read(path)
    try:
        return text_of_file(Path(path))
    except UnicodeDecodeError:
        raise InputError(
            f"{path}: the file is not UTF-8 text; give a table that `beardyn structure` wrote"
        ) from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from error


def modes_of_text(text: str, label: str) -> Modes:
    """Read the modes of a text; see `read_table`."""
    lines = text.splitlines()
    begin = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
    try:
        head = yaml.safe_load("\n".join(line.removeprefix("#").removeprefix(" ") for line in lines[:begin]))
    except (yaml.YAMLError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise InputError(f"{label}: the head is no YAML: {' '.join(str(error).split())}") from error
    if not isinstance(head, dict):
        raise InputError(f"{label}: the head is missing; lines with # in front give name, mass_kg and so on")
    if problem := separator_problem(lines[begin] if begin < len(lines) else ""):
        raise InputError(f"{label}: {problem}")
    names, numbers, found = _numbers(lines[begin:], begin)
    problems = [f"{label}: {each}" for each in _head_problems(head, len(numbers))]
    problems += [f"{label}: {each}" for each in found]
    seats = [str(name) for name in head["seats_mm"]] if isinstance(head.get("seats_mm"), dict) else []
    problems += [f"{label}: {each}" for each in _column_problems(names, seats)]
    if problems:
        raise InputError(problems)
    count = len(numbers)
    column = {name: numbers[:, i] for i, name in enumerate(names)}
    zero = np.zeros(count)
    raceway = np.stack([column.get(name, zero) for name in RACEWAY_COLUMNS], axis=1)
    order = np.argsort(column["frequency_Hz"], kind="stable")
    free = int(head.get("free_modes", count))
    return Modes(
        str(head["name"]),
        str(head.get("description", "")),
        column["frequency_Hz"][order],
        column["damping_ratio"][order],
        raceway.reshape(count, len(ROWS), len(FIELDS), len(SERIES))[order],
        {name: np.stack([column[f"{name}_{axis}"] for axis in AXES], axis=1)[order] for name in seats},
        {name: _vector(head["seats_mm"][name], 1e-3) for name in seats},
        float(head["mass_kg"]),
        _vector(head.get("centre_mm", (0, 0, 0)), 1e-3),
        _vector(head["inertia_kg_m2"], 1.0),
        free,
        Cup(str(head["bearing"]), **{name: 1e-3 * float(head["cup_mm"][name]) for name in DIMENSIONS}),
        _vector(head.get("products_kg_m2", (0, 0, 0)), 1.0),
        tuple(map(str, head.get("suspension", ()))),
        str(head.get("made_from", "")),
    )


def _head_problems(head: dict[str, Any], count: int) -> Iterator[str]:
    wanted = {"name", "bearing", "cup_mm", "mass_kg", "inertia_kg_m2", "seats_mm"}
    known = wanted | {"description", "centre_mm", "products_kg_m2", "free_modes", "suspension", "made_from"}
    for key in sorted(wanted - head.keys()):
        remedy = f"; {_OF_EARLIER_VERSIONS[key]}" if key in _OF_EARLIER_VERSIONS else ""
        yield f"the head lacks {key}; it has {', '.join(sorted(map(str, head)))}{remedy}"
    for key in sorted(map(str, head.keys() - known)):
        yield f"the head has {key!r}; allowed are {', '.join(sorted(known))}"
    if "mass_kg" in head and not (_is_number(head["mass_kg"]) and head["mass_kg"] > 0):
        yield f"mass_kg is {head['mass_kg']!r}; it must be a number greater than 0"
    free = head.get("free_modes", 0)
    if not isinstance(free, int) or isinstance(free, bool) or not 0 <= free <= count:
        yield f"free_modes is {free!r}; it must be a whole number from 0 to the {count} modes of the file"
    for key in ("centre_mm", "inertia_kg_m2", "products_kg_m2"):
        if key in head and not _is_vector(head[key]):
            order = "xy, xz, yz" if key == "products_kg_m2" else "along x, y, z"
            yield f"{key} is {head[key]!r}; it must be three numbers, {order}"
    if _is_vector(head.get("inertia_kg_m2")) and min(head["inertia_kg_m2"]) <= 0:
        yield f"inertia_kg_m2 is {head['inertia_kg_m2']!r}; its numbers must be greater than 0"
    cup = head.get("cup_mm", {})
    if "cup_mm" in head and not (
        isinstance(cup, dict)
        and sorted(map(str, cup)) == sorted(DIMENSIONS)
        and all(_is_number(each) and each > 0 for each in cup.values())
    ):
        yield f"cup_mm is {cup!r}; it must be {', '.join(DIMENSIONS)} of the bearing, each greater than 0"
    seats, springs = head.get("seats_mm", {}), head.get("suspension", [])
    if not isinstance(springs, list) or not all(
        isinstance(seats, dict) and each in seats for each in springs
    ):
        yield f"suspension is {springs!r}; it must be a list of names of seats_mm"
    if not isinstance(seats, dict):
        yield f"seats_mm is {seats!r}; it must be names with three numbers each"
    else:
        for name, place in seats.items():
            if not _is_vector(place):
                yield f"seats_mm.{name} is {place!r}; it must be three numbers, along x, y, z"


def _column_problems(names: list[str], seats: list[str]) -> Iterator[str]:
    wanted = ["frequency_Hz", "damping_ratio", *(f"{name}_{axis}" for name in seats for axis in AXES)]
    for name in wanted:
        if name not in names:
            yield f"the column {name} is missing"
    for name in sorted(set(names) - set(wanted) - set(RACEWAY_COLUMNS)):
        first, last = RACEWAY_COLUMNS[0], RACEWAY_COLUMNS[-1]
        yield f"the column {name!r} is unknown; the raceways have {first} ... {last}"
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"the column {name} is there {names.count(name)} times"


def _numbers(lines: list[str], before: int) -> tuple[list[str], Float, list[str]]:
    """Read column names and numbers; gives the mistakes last."""
    numbers = [before + i for i, line in enumerate(lines, start=1) if line.strip()]
    rows = list(csv.reader(line for line in lines if line.strip()))
    if len(rows) < 2 or len(rows) != len(numbers):
        return rows[0] if rows else [], np.zeros((0, 0)), ["there are no lines with a mode each"]
    names, problems = [name.strip() for name in rows[0]], []
    found = np.full((len(rows) - 1, len(names)), np.nan)
    for i, row in enumerate(rows[1:]):
        line = numbers[i + 1]
        if len(row) != len(names):
            problems.append(f"line {line} has {len(row)} numbers; there are {len(names)} columns")
            continue
        for j, text in enumerate(row):
            try:
                found[i, j] = float(text)
            except ValueError:
                problems.append(f"line {line}, {names[j]}: {text!r} is no number")
                continue
            if not np.isfinite(found[i, j]):
                problems.append(f"line {line}, {names[j]}: {text} is not finite")
            elif names[j] == "frequency_Hz" and found[i, j] <= 0.0:
                problems.append(f"line {line}: frequency_Hz is {text}; rigid motion is no mode, leave it out")
            elif names[j] == "damping_ratio" and not 0.0 <= found[i, j] < 1.0:
                problems.append(f"line {line}: damping_ratio is {text}; it must be at least 0 and below 1")
    return names, found, problems


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and bool(np.isfinite(value))


def _is_vector(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(_is_number(each) for each in value)


def _vector(value: Any, scale: float) -> tuple[float, float, float]:
    x, y, z = (scale * float(each) for each in value)
    return x, y, z


def _short(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}") + 0.0


def _text(value: float) -> str:
    return f"{value:.{_DIGITS}g}"

"""Tables of numbers in CSV text: columns named with their unit, and every mistake reported at once."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, separator_problem
from beardyn_core.base.inputs import size_of_file
from beardyn_core.base.outputs import note_read

Rows = list[list[str]]

_SHOWN = 5


@dataclass(frozen=True)
class Column:
    """One column."""

    name: A[str, "as in the header; ends in the unit"]
    unit: A[str, "as a row of units may give it"]
    needed: bool = True


@dataclass(frozen=True)
class Layout:
    """Columns that a file may have."""

    what: A[str, "what it is a file of, for the sentences"]
    columns: tuple[Column, ...]
    ascending: A[str, "column that must increase from row to row"]
    gap: A[
        tuple[float, float] | None,
        "a step of that column is a gap when it is longer than the first times the usual step and longer "
        "than the second",
    ] = None
    one_of: A[tuple[tuple[str, ...], ...], "of each of these groups exactly one column must be there"] = ()
    positive: A[bool, "whether all numbers must be above zero"] = False

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all columns that may be present."""
        return tuple(column.name for column in self.columns)


def read_table(path: Path, layout: Layout) -> dict[str, Float]:
    """Read and check the columns that are in a file.

    The first line names the columns; a second one may give their units, the same as in the names. Lines
    that begin with ``#`` are comments.

    Raises
    ------
    InputError
        With everything that is wrong with the file, each with its line numbers.
    """
    path = Path(path)
    note_read(path)
    names, lines, rows = _read_rows(path, layout)
    problems = _header_problems(path, names, layout)
    units = [] if not rows or any(map(_is_number, rows[0])) else [cell.strip(" []()") for cell in rows[0]]
    if units:
        problems += _unit_problems(path, lines[0], names, units, layout)
        lines, rows = lines[1:], rows[1:]
    if not rows:
        problems.append(f"{path}: no rows after the header; at least two are needed")
    elif len(rows) == 1:
        problems.append(f"{path}: only one row; at least two are needed")
    if ragged := [line for line, row in zip(lines, rows, strict=True) if len(row) != len(names)]:
        problems.append(f"{path}, {line_list(ragged)}: not {len(names)} values as in the header")
    whole = [index for index, row in enumerate(rows) if len(row) == len(names)]
    found = {}
    for name in layout.names:
        if name in names:
            at = names.index(name)
            cells = [rows[index][at] for index in whole]
            found[name], bad = _numbers(path, name, [lines[index] for index in whole], cells, layout.positive)
            problems += bad
    if layout.ascending in found:
        problems += order_problems(
            path, layout, found[layout.ascending], lambda at: line_list([lines[whole[i]] for i in at])
        )
    if problems:
        raise InputError(problems)
    return found


def _read_rows(path: Path, layout: Layout) -> tuple[list[str], list[int], Rows]:
    lines: list[int] = []
    rows: Rows = []
    try:
        size_of_file(path)
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            for row in reader:
                if row and not row[0].lstrip().startswith("#"):
                    lines.append(reader.line_num)
                    rows.append(row)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; give the path of a CSV file of {layout.what}") from None
    except UnicodeDecodeError:
        if is_spreadsheet(path):
            raise InputError(
                f"{path}: is a spreadsheet, not CSV text; save its sheet as CSV, commas between the columns"
            ) from None
        raise InputError(f"{path}: the file is not UTF-8 text; save it as UTF-8") from None
    except (OSError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{path}: cannot be read as CSV text: {reason}") from None
    if rows and (problem := separator_problem(",".join(rows[0]))):
        raise InputError(f"{path}: {problem}")
    if not rows:
        raise InputError(
            f"{path}: the file is empty; the first line must name columns: {', '.join(layout.names)}"
        )
    return [name.strip() for name in rows[0]], lines[1:], rows[1:]


def is_spreadsheet(path: Path) -> bool:
    """Tell whether a file is of a spreadsheet program: a ZIP archive or an OLE document."""
    with path.open("rb") as file:
        return file.read(4) in (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")


def _header_problems(path: Path, names: list[str], layout: Layout) -> list[str]:
    allowed = f"allowed are {', '.join(layout.names)}"
    problems = []
    for name in dict.fromkeys(names):
        if name in layout.names:
            continue
        stem = name.rsplit("_", 1)[0]
        meant = [known for known in layout.names if stem in (known, known.rsplit("_", 1)[0])]
        hint = f"did you mean {' or '.join(meant)}? " if meant and len(stem) > 1 else ""
        problems.append(f"{path}: unknown column {name!r}; {hint}{allowed}")
    problems += [f"{path}: column {name!r} appears twice" for name in layout.names if names.count(name) > 1]
    problems += [
        f"{path}: column {column.name!r} is missing; {allowed}"
        for column in layout.columns
        if column.needed and column.name not in names
    ]
    for group in layout.one_of:
        present = [name for name in group if name in names]
        if len(present) != 1:
            few = "none of these columns is" if not present else f"both {' and '.join(present)} are"
            problems.append(f"{path}: {few} there; give exactly one of {', '.join(group)}")
    return problems


def _unit_problems(path: Path, line: int, names: list[str], units: list[str], layout: Layout) -> list[str]:
    expected = {column.name: column.unit for column in layout.columns}
    return [
        f"{path}, line {line}: the row of units has {unit!r} for {name}; the numbers must be in "
        f"{expected[name]!r}, by the name of the column"
        for name, unit in zip(names, units, strict=False)
        if name in expected and unit != expected[name]
    ]


def _numbers(
    path: Path, name: str, lines: list[int], cells: list[str], positive: bool
) -> tuple[Float, list[str]]:
    """Read the numbers of a column, NaN where there is none, and report mistakes."""
    problems = []
    try:
        values = np.array(cells, dtype=np.float64)
        words: list[int] = []
    except ValueError:
        words = [index for index, cell in enumerate(cells) if not _is_number(cell)]
        values = np.array([float(cell) if _is_number(cell) else np.nan for cell in cells])
        found = line_list([lines[index] for index in words])
        problems.append(f"{path}, {found}: {name} is {cells[words[0]]!r}; it must be a number")
    reported = np.zeros(len(values), dtype=bool)
    reported[words] = True
    wild = np.flatnonzero(~np.isfinite(values) & ~reported)
    if len(wild):
        found = line_list([lines[index] for index in wild])
        problems.append(f"{path}, {found}: {name} is {values[wild[0]]}; every value must be finite")
    low = np.flatnonzero((values <= 0.0) & positive)
    if len(low):
        found = line_list([lines[index] for index in low])
        problems.append(f"{path}, {found}: {name} is {values[low[0]]:g}; it must be more than 0")
    return values, problems


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def order_problems(
    path: Path, layout: Layout, values: Float, where: Callable[[NDArray[np.intp]], str]
) -> list[str]:
    """Write sentences about an ascending column: rows that do not increase, and gaps.

    Rows without a number, NaN, are passed over; `where` gives words for a list of row indices.
    """
    known = np.flatnonzero(np.isfinite(values))
    if len(known) < 2:
        return []
    step = np.diff(values[known])
    problems = []
    backward = np.flatnonzero(step <= 0.0)
    if len(backward):
        problems.append(
            f"{path}, {where(known[backward + 1])}: {layout.ascending} does not increase; rows must be in "
            f"ascending order, none twice"
        )
    usual = float(np.median(step[step > 0.0])) if (step > 0.0).any() else np.inf
    if layout.gap is not None:
        unit = next(column.unit for column in layout.columns if column.name == layout.ascending)
        gaps = np.flatnonzero((step > layout.gap[0] * usual) & (step > layout.gap[1]))
        if len(gaps):
            problems.append(
                f"{path}, {where(known[gaps + 1])}: {layout.ascending} jumps by {step[gaps[0]]:g} {unit} "
                f"where the usual step is {usual:g} {unit}; fill the gap or split the file"
            )
    return problems


def line_list(lines: list[int]) -> str:
    """Write line numbers in words, the first few of many."""
    shown = ", ".join(str(line) for line in lines[:_SHOWN])
    more = f" and {len(lines) - _SHOWN} more" if len(lines) > _SHOWN else ""
    return f"line{'s' if len(lines) > 1 else ''} {shown}{more}"

"""CSV and other tables in text, read in blocks with NumPy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.claimed_rate import claims_in
from beardyn_core.measured.claimed_start import start_in
from beardyn_core.measured.moments import moments_in_ns
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Held
from beardyn_core.measured.text_table import (
    TextTable,
    detect_table,
    has_no_value,
    is_comment,
)

_CHARACTERS = 1 << 22  # in memory at a time
_SHOWN = 3
_LONGEST_LINE = 1 << 20


class _Table(Held):
    path: Path
    table: TextTable

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of columns from the beginning, shape [sample, channel]; NaN where none is read."""
        table = self.table
        wanted = [table.names.index(name) for name in names]
        self.origins.clear()
        self.problems.clear()
        bad: list[tuple[int, str]] = []
        empty = _EmptyLines()
        for line, text in self._texts():
            rows = text.splitlines()
            if len(table.names) == 1:
                empty.take(rows, line)
            if all(not row.strip() or is_comment(row) for row in rows):
                continue
            quick = None if table.moments & set(wanted) else _quick(text, rows, table, wanted)
            yield _slow(rows, line, table, wanted, self.origins, bad) if quick is None else quick
        bad += [(line, "is empty, where a number belongs") for line in empty.lost]
        if bad:
            shown = "; ".join(f"line {line + 1}: {what}" for line, what in bad[:_SHOWN])
            more = f"; and {len(bad) - _SHOWN} lines more" if len(bad) > _SHOWN else ""
            self.problems.append(f"{self.path}: {shown}{more}")

    def _texts(self) -> Iterator[tuple[int, str]]:
        """Give the numbers as text of whole lines, each with the number of its first line from 0."""
        line, rest = self.table.first_line, ""
        with self.path.open(encoding=self.table.encoding, errors="replace", newline=None) as file:
            for _ in range(line):
                file.readline(_LONGEST_LINE)
            while text := file.read(_CHARACTERS):
                text = rest + text
                end = text.rfind("\n") + 1
                if not end and len(text) > _LONGEST_LINE:
                    raise InputError(f"{self.path}: line {line + 1} does not end; it is no table in text")
                whole, rest = text[:end], text[end:]
                if whole:
                    yield line, whole
                    line += whole.count("\n")
        if rest.strip():
            yield line, rest


class _EmptyLines:
    """Lines of an only column without its value, from the first number to the last.

    One behind every number is an end of line that was written twice, and no value.
    """

    def __init__(self) -> None:
        self._waiting: list[int] = []  # for a number behind them
        self._lost: list[int] = []
        self._begun, self._one_behind_each = False, True

    def take(self, rows: list[str], line: int) -> None:
        """Look at the next rows; the first is that of a line from 0."""
        if not self._waiting and all(map(str.strip, rows)):  # the usual case
            self._one_behind_each &= not self._begun and len(rows) == 1
            self._begun = True
            return
        for number, row in enumerate(rows, start=line):
            if not row.strip():
                self._waiting.append(number)
            elif not is_comment(row):
                self._one_behind_each &= not self._begun or len(self._waiting) == 1
                self._lost += self._waiting if self._begun else []
                self._waiting.clear()
                self._begun = True

    @property
    def lost(self) -> list[int]:
        """Lines in which a number is missing, from 0."""
        return [] if self._one_behind_each else self._lost


def _quick(text: str, rows: list[str], table: TextTable, wanted: list[int]) -> Float | None:
    """Read rows that all are as they should be; None when one is not."""
    marks = tuple(mark for mark in "#%" if mark in text)
    quoted = '"' in text
    if marks and (quoted or any(map(has_no_value, rows))):  # NumPy knows comments or quotes
        return None
    if table.decimal == ",":
        rows = text.replace(",", ".").splitlines()
    every = table.separator is None  # then only all columns show that none is too many
    if every and table.moments:
        return None
    try:
        block = np.loadtxt(
            rows,
            np.float64,
            delimiter=table.separator,
            usecols=None if every else wanted,
            ndmin=2,
            comments=marks or None,
            quotechar='"' if quoted else None,
        )
    except (ValueError, IndexError):
        return None
    width = len(table.names)
    if table.separator is None:
        return block[:, wanted] if block.shape[1] == width else None
    between = text.count(table.separator)
    return block if between in (len(block) * (width - 1), len(block) * width) else None


def _slow(
    rows: list[str], line: int, table: TextTable, wanted: list[int], origins: dict[str, int],
    bad: list[tuple[int, str]],
) -> Float:  # fmt: skip
    """Read rows one by one and note those that are wrong."""
    width, out = len(table.names), []
    moments: dict[int, list[str]] = {k: [] for k in wanted if k in table.moments}
    for number, row in enumerate(rows):
        if not row.strip() or is_comment(row):
            continue
        cells, values = table.cells(row), []
        if len(cells) != width:
            bad.append((line + number, f"has {len(cells)} values where {width} belong"))
            continue
        for k in wanted:
            cell = cells[k]
            if k in table.moments:
                moments[k].append(cell)
                values.append(0.0)
                continue
            try:
                plain = cell.replace(",", ".") if table.decimal == "," else cell
                values.append(float(plain.upper().replace("D", "E")))  # Fortran writes 1.5D+00
            except ValueError:
                hint = "; is the decimal sign a comma? --decimal comma" if "," in cell else ""
                bad.append((line + number, f"{table.names[k]} is {cell!r}, which is no number{hint}"))
                values.append(np.nan)
        out.append(values)
    block = np.array(out, np.float64).reshape(-1, len(wanted))
    for k, cells in moments.items():
        try:
            if cells:
                stamps = moments_in_ns(cells)
                origin = origins.setdefault(table.names[k], int(stamps[0]))
                block[:, wanted.index(k)] = (stamps - origin) * 1e-9
        except ValueError:
            bad.append((line, f"{table.names[k]} has something that is no date with a time"))
    return block


def open_file(path: Path, reading: Reading) -> Held:
    """Find out how a table is written and list its columns, those without a name by number from 1."""
    table = detect_table(path, reading)
    numbers = {}
    for key, value in table.facts.items():
        try:
            numbers[key] = float(value.split()[0].replace(",", "."))
        except (ValueError, IndexError):
            continue
    claims, start = tuple(claims_in(table.facts)), start_in(table.facts)
    channels = tuple(
        Channel(name, "", None, unit, claims, start, is_time=k in table.moments)
        for k, (name, unit) in enumerate(zip(table.names, table.units, strict=True))
    )
    found = _Table(channels, {}, numbers, table.facts, notes=(table.sentence(),))
    found.path, found.table = path, table
    return found

"""Separator, decimal sign, header and units of a table in text, found out from its beginning.

A separator fits when every line of numbers has the same number of cells, each a number or a moment. Where two
fit that mean different numbers, the file is refused with both readings.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.measured.claimed_rate import claims_in
from beardyn_core.measured.moments import is_moment
from beardyn_core.measured.options import DECIMALS, SEPARATORS, Reading
from beardyn_core.measured.units import ACCELERATION, ROTATION, TIME, TRAVEL, split_unit, usual

HEAD_BYTES = 1 << 16
_COMMENT = "#%"
_OPTIONAL_COLUMNS = ("\t", ";")  # separators of programs that name columns which no row has
_SHOWN = 60  # characters of a line
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?|[-+]?(?:nan|inf|infinity)", re.IGNORECASE)
_SPACED_UNIT = re.compile(r"(?<=[^\s\])])\s+([\[(][^\])]*[\])])")
# what spreadsheets write for a value that there is not, in the languages of their users; no comment
_NO_VALUE = re.compile(
    r"""\s*"?\#(?:N/[A-Z]|NV|NA|¡?(?:DIV/0|VALUE|WERT|VALEUR|VALORE?|REF|BEZUG|NUM|ZAHL|NOMBRE|NULL?|NULO|SPILL"""
    r"""|CALC)!|¿?(?:NAME|NOM|NOMBRE|NOME)\?)(?![^\s,;|"])"""
)


@dataclass(frozen=True)
class TextTable:
    """How a table is written."""

    encoding: str
    separator: A[str | None, "None: white space"]
    decimal: str
    names: A[tuple[str, ...], "of the columns"]
    units: A[tuple[str, ...], "of the columns, empty where none is stated"]
    moments: A[frozenset[int], "columns of dates with times"]
    first_line: A[int, "that has numbers, from 0"]
    facts: A[dict[str, str], "lines ``key: value`` above the header"]
    named: A[bool, "whether a line of the file names the columns"]

    def sentence(self) -> str:
        """Say how the table was understood."""
        separators = {value: word for word, value in SEPARATORS.items()}
        signs = {value: word for word, value in DECIMALS.items()}
        lines = "line 1 names" if self.first_line == 1 else f"line {self.first_line} and above name"
        names = f"{lines} them" if self.named else "no line names them"
        count = len(self.names)
        columns = f"{count} columns, {separators[self.separator]} between" if count > 1 else "1 column"
        return (
            f"{columns}, decimal {signs[self.decimal]}; {names}; numbers begin in line {self.first_line + 1}"
        )

    def cells(self, line: str) -> list[str]:
        """Split a line; a separator behind its last cell begins no other."""
        cells = _cells(line, self.separator)
        return cells[:-1] if len(cells) == len(self.names) + 1 and not cells[-1] else cells


def is_comment(line: str) -> bool:
    """Tell whether a line that is not empty is no row."""
    return line.lstrip()[0] in _COMMENT and not has_no_value(line)


def has_no_value(text: str) -> bool:
    """Tell whether a line or cell begins with a value that a spreadsheet has not: ``#N/A``, ``#DIV/0!``."""
    return _NO_VALUE.match(text) is not None


def encoding_of(head: bytes) -> str:
    """Tell the encoding of a text by its beginning."""
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    try:
        head[: len(head) - 4].decode("utf-8")
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8-sig"


def detect_table(path: Path, reading: Reading) -> TextTable:
    """Find out how a table is written.

    Raises
    ------
    InputError
        It has no lines of numbers, or can be read in two ways that differ.
    """
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
        whole = not file.read(1)
    encoding = encoding_of(head)
    lines = head.decode(encoding, errors="replace").splitlines()
    if not whole and len(lines) > 1:
        lines.pop()  # cut in the middle
    separators = [SEPARATORS[reading.separator]] if reading.separator else list(_likely(lines))
    decimals = [DECIMALS[reading.decimal]] if reading.decimal else [".", ","]
    found = [
        fit
        for separator in separators
        for decimal in decimals
        if separator != decimal and (fit := _fit(lines, separator, decimal)) is not None
    ]
    if not found:
        asked = " ".join(
            f"--{k} {v}" for k, v in (("separator", reading.separator), ("decimal", reading.decimal)) if v
        )
        seen = f"; line {len(lines)} is {lines[-1].strip()[:_SHOWN]!r}" if lines else ""
        raise InputError(
            f"{path}: has no lines of numbers in columns{f' with {asked}' if asked else ''}; a table in "
            "text has comma, semicolon, tab, bar or space between its columns, decimal point or comma and "
            f"nothing between thousands, and dates like 2026-01-31 12:00:00.5{seen}"
        )
    best = _best(found)
    if best is None:
        one, other = found[0], next(each for each in found if each.separator != found[0].separator)
        raise InputError(
            f"{path}: line {one.first + 1} is {lines[one.first].strip()!r}, which may be "
            f"{len(one.sample)} columns with commas between or {len(other.sample)} with a decimal comma; "
            "give --separator comma or --decimal comma"
        )
    return _table(lines, best, encoding)


@dataclass(frozen=True)
class _Fit:
    separator: str | None
    decimal: str
    first: int  # line of the first numbers
    sample: list[str]  # its cells
    moments: frozenset[int]
    count: int  # lines that fit
    whole: bool  # all numbers are whole, so the decimal sign has not been seen


def _likely(lines: list[str]) -> list[str | None]:
    text = "\n".join(lines)
    return [each for each in (";", "\t", "|", ",", None) if each is None or each in text] or [None]


def _split(line: str, separator: str | None) -> list[str]:
    cells = _cells(line, separator)
    return cells[:-1] if separator is not None and len(cells) > 1 and not cells[-1] else cells


def _cells(line: str, separator: str | None) -> list[str]:
    return [cell.strip().strip('"').strip() for cell in line.strip("\r\n").split(separator)]


def _kind(cell: str, decimal: str) -> str:
    plain = cell.replace(",", ".") if decimal == "," and "." not in cell else cell
    if _NUMBER.fullmatch(plain) and (decimal == "." or "." not in cell):
        return "number"
    return "moment" if is_moment(cell) else ""


def _fit(lines: list[str], separator: str | None, decimal: str) -> _Fit | None:
    """Fit a separator and a decimal sign to the lines; None when too few are rows of numbers."""
    rows = []
    for number, line in enumerate(lines):
        if not line.strip() or is_comment(line):
            continue
        cells = _split(line, separator)
        kinds = [_kind(cell, decimal) for cell in cells]
        if all(kinds) and "number" in kinds:
            rows.append((number, cells, kinds))
    if not rows:
        return None
    width = Counter(len(cells) for _, cells, _ in rows).most_common(1)[0][0]
    first, cells, kinds = next(row for row in rows if len(row[1]) == width)
    # behind the first row of numbers all are rows of numbers, but for a few that are damaged
    after = [line for line in lines[first:] if line.strip() and not is_comment(line)]
    fitting = sum(len(each) == width for _, each, _ in rows)
    if fitting < 0.5 * len(after):
        return None
    while first > 0 and _lacks_a_value(_split(lines[first - 1], separator), width):
        first -= 1  # a row, not a heading
    whole = all("." not in c and "," not in c for _, each, _ in rows for c in each)
    moments = frozenset(k for k, kind in enumerate(kinds) if kind == "moment")
    return _Fit(separator, decimal, first, cells, moments, fitting, whole)


def _lacks_a_value(cells: list[str], width: int) -> bool:
    return len(cells) == width and any(map(has_no_value, cells))


def _best(found: list[_Fit]) -> _Fit | None:
    """Choose a reading; None where two differ in what the numbers are."""
    most = max(each.count for each in found)
    found = [each for each in found if each.count > 0.9 * most]
    by_comma = [each for each in found if each.separator == "," and len(each.sample) > 1]
    decimal_comma = [each for each in found if each.decimal == "," and not each.whole]
    if by_comma and decimal_comma and by_comma[0].whole:
        # 0,0123 or -0,5: no whole number is written so
        odd = any(re.fullmatch(r"[-+]?0\d+", c) or c in ("-0", "+0") for c in by_comma[0].sample)
        return decimal_comma[0] if odd else None
    widest = max(len(each.sample) for each in found)
    return next(each for each in found if len(each.sample) == widest)


def _table(lines: list[str], fit: _Fit, encoding: str) -> TextTable:
    width = len(fit.sample)
    above = [
        (n, line.strip().lstrip(_COMMENT).strip())
        for n, line in enumerate(lines[: fit.first])
        if line.strip()
    ]
    headings = _headings(above, fit)
    names, units = [str(k + 1) for k in range(width)], [""] * width
    named = bool(headings)
    if headings:
        *before, last = headings
        cells = last[1]
        if before and width > 1 and _are_units(cells):
            units, cells = [usual(c.strip("[]() ")) for c in cells], before[-1][1]
        split = [split_unit(cell) for cell in cells]
        names = _distinct([name or str(k + 1) for k, (name, _) in enumerate(split)])
        units = [usual(unit) or known for (_, unit), known in zip(split, units, strict=True)]
    used = {n for n, _ in headings}
    facts = {}
    for n, line in above:
        key, sign, value = line.partition(":") if ":" in line else line.partition("=")
        if not sign and (mark := next((mark for mark in (";", "\t", ",") if mark in line), "")):
            key, sign, value = line.partition(mark)
            sign = sign if claims_in({key.strip(' "'): 1.0}) else ""  # ``Abtastrate;51200;Hz``
        if n not in used and sign and key.strip() and len(key) < 60:
            facts[key.strip(' "')] = value.strip().strip(";,\t")[:500]
    return TextTable(
        encoding, fit.separator, fit.decimal, tuple(names), tuple(units), fit.moments, fit.first, facts, named
    )


def _headings(above: list[tuple[int, str]], fit: _Fit) -> list[tuple[int, list[str]]]:
    """Find the lines right above the numbers that name their columns; lines further up do not."""
    width = len(fit.sample)
    found: list[tuple[int, list[str]]] = []
    for n, line in reversed(above):
        cells = _heading_cells(line, fit.separator, width)
        if fit.separator in _OPTIONAL_COLUMNS and not found:
            cells = cells[:width]  # such as one for comments, which no row has
        if len(cells) != width or not any(c and not _kind(c, fit.decimal) for c in cells):
            break
        found.append((n, cells))
    return found[::-1]


def _heading_cells(line: str, separator: str | None, width: int) -> list[str]:
    """Split a heading; white space before a unit in brackets does not: ``time [s] acc [g]``."""
    cells = _split(line, separator)
    if separator is not None or len(cells) == width:
        return cells
    if width == 1:  # then it may have several words, if it has a unit
        whole = line.strip('"')
        known = usual(split_unit(whole)[1]) in ACCELERATION and not set(":=") & set(whole)
        return [whole] if known else cells
    return _split(_SPACED_UNIT.sub(r"\1", line), separator)


def _are_units(cells: list[str]) -> bool:
    bracketed = all(c.startswith(("[", "(")) for c in cells if c)
    units = {*ACCELERATION, *TIME, *ROTATION, *TRAVEL, "V", "-"}
    known = [usual(c.strip("[]() ")) in units for c in cells]
    return bracketed or sum(known) * 2 >= len(cells)


def _distinct(names: list[str]) -> list[str]:
    seen: Counter[str] = Counter()
    out = []
    for name in names:
        seen[name] += 1
        out.append(name if seen[name] == 1 else f"{name} ({seen[name]})")
    return out

"""Tables for the terminal and for pages, and numbers in few digits."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

Column = tuple[str, Callable[[Any], str]]


@dataclass(frozen=True)
class Table:
    """A table with a title and remarks."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    remarks: tuple[str, ...] = ()

    @classmethod
    def of(cls, title: str, items: Iterable[Any], columns: Iterable[Column], *remarks: str) -> Table:
        """Make a row of each item; a column is its heading and what writes the cell of an item."""
        head, cells = zip(*columns, strict=True)
        return cls(title, head, tuple(tuple(cell(item) for cell in cells) for item in items), remarks)

    def text(self) -> str:
        """Write for the terminal: first column to the left, the others to the right."""
        widths = [max(len(row[i]) for row in (self.head, *self.rows)) for i in range(len(self.head))]
        lines = [self.title, ""]
        for row in (self.head, *self.rows):
            cells = [cell.rjust(width) for cell, width in zip(row, widths, strict=True)]
            lines.append("  ".join([row[0].ljust(widths[0]), *cells[1:]]).rstrip())
        return "\n".join([*lines, *self.remarks])

    def markdown(self) -> str:
        """Write for a page, without the title."""
        lines = [f"| {' | '.join(self.head)} |", f"|---|{'--:|' * (len(self.head) - 1)}"]
        lines += [f"| {' | '.join(row)} |" for row in self.rows]
        return "\n".join([*lines, *(f"\n{remark}" for remark in self.remarks)])


def digits(value: float, count: int = 3) -> str:
    """Write few digits, without an exponent where that is readable."""
    if not math.isfinite(value):
        return "-"
    if value == 0.0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        places = max(0, count - 1 - math.floor(math.log10(abs(value))))
        return f"{value:.{places}f}"
    return f"{value:.{count - 1}e}"


def nanometres(value: float) -> str:
    """Write the size of a length [m] in nm."""
    return f"{abs(value) * 1e9:.1e}" if math.isfinite(value) else "-"


def percent(share: float) -> str:
    """Write a share in percent."""
    return f"{100.0 * share:.1f}" if 0.0 < share < 0.9995 else f"{100.0 * share:.0f}"


def duration_text(hours: float) -> str:
    """Write hours, minutes or seconds."""
    if hours >= 0.95:
        return f"{hours:.1f} h"
    seconds = 3600.0 * hours
    return f"{seconds / 60.0:.1f} min" if seconds >= 60.0 else f"{digits(seconds, 2)} s"

"""Pages as PDF on A4: lines are broken and parts moved to a next sheet, nothing is cut off."""

# By matplotlib, which draws the pictures anyway: an HTML printer would need libraries of the system.

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Rectangle
from matplotlib.textpath import TextToPath

from beardyn_core.study.report_page.page import Facts, Headline, Page, PageReport, Part, Picture, Points, Rows
from beardyn_core.study.report_page.page_fonts import PLACEHOLDER, Fonts, fonts_for
from beardyn_core.study.report_page.page_html import PICTURE_STYLE, WIDTH, panel_places

_PAGE_WIDTH, _PAGE_HEIGHT = 210.0, 297.0  # A4, [mm]
_LEFT, _TOP, _BOTTOM = 12.0, 10.0, 12.0  # margins, [mm]
_MM_PER_INCH, _MM_PER_POINT = 25.4, 25.4 / 72.0
_SPACING = 1.28  # from line to line, in sizes of the font
_TITLE, _WORD, _SENTENCE, _HEADING, _TEXT, _DETAIL, _FOOT = 12.5, 11.0, 11.0, 9.5, 8.4, 7.8, 7.0  # [pt]
_GAP = 6.0  # between columns, [mm]
_INSET = 8.0  # of the headline in its frame, [mm]
_FALL = 0.78  # of the size of a font from the top of a line to the feet of its letters


def write_pdf(report: PageReport, path: Path) -> list[str]:
    """Write the pages; gives a sentence where a character cannot be shown.

    Parameters
    ----------
    report : PageReport
    path : Path
    """
    from matplotlib.backends.backend_pdf import PdfPages  # with libraries for fonts that a page alone needs

    fonts = fonts_for(report.text + PLACEHOLDER)
    told: list[str] = []
    if fonts.missing:
        told.append(
            f"the PDF cannot show {len(fonts.missing)} characters of the names in it, {PLACEHOLDER} stands "
            "for each: no font of this computer has them; install one, such as Noto Sans CJK. The HTML page "
            "shows them where its reader has such a font."
        )
    style: Any = {**PICTURE_STYLE, "pdf.fonttype": 42, "font.family": list(fonts.families)}
    with (
        rc_context(style),
        _quiet(),
        PdfPages(path, metadata={"Title": report.title}) as pdf,
    ):
        for page in report.pages:
            for sheet in _Sheets(fonts, page, report.foot, told).filled():
                pdf.savefig(sheet)
    return told


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep what matplotlib logs of fonts without a bold face to itself: the regular face is taken."""
    log = logging.getLogger("matplotlib.font_manager")
    before = log.level
    log.setLevel(logging.ERROR)
    try:
        yield
    finally:
        log.setLevel(before)


class _Sheets:
    """The sheets of one page, filled from the top."""

    def __init__(self, fonts: Fonts, page: Page, foot: str, told: Sequence[str]) -> None:
        self._fonts, self._page = fonts, page
        self._foot = " ".join((foot, *told))
        self._done: list[Figure] = []
        self._begin()

    def filled(self) -> Iterator[Figure]:
        """Give the sheets."""
        self._title(self._page.title)
        self._headline(self._page.headline)
        for part in self._page.parts:
            self._part(part)
        return iter([*self._done, self._figure])

    def _begin(self) -> None:
        self._figure = Figure(figsize=(_PAGE_WIDTH / _MM_PER_INCH, _PAGE_HEIGHT / _MM_PER_INCH))
        self._y = _TOP
        lines = self._broken(self._foot, _FOOT, WIDTH)
        for number, line in enumerate(lines):
            below = _PAGE_HEIGHT - 0.5 * _BOTTOM - (len(lines) - number) * _FOOT * _SPACING * _MM_PER_POINT
            self._write(line, _LEFT, below + 2.0, _FOOT, colour="0.3")

    def _need(self, height: float) -> bool:
        """Go on to the next sheet where a height [mm] is not free; returns whether it did."""
        if self._y + height <= _PAGE_HEIGHT - _BOTTOM or self._y <= _TOP:
            return False
        self._done.append(self._figure)
        self._begin()
        self._title(f"{self._page.title}, continued")
        return True

    def _write(
        self, text: str, x: float, y: float, size: float, *, bold: bool = False, colour: str = "0.07"
    ) -> None:
        """Write a line whose top is at a height."""
        base = y + _FALL * size * _SPACING * _MM_PER_POINT
        self._figure.text(
            x / _PAGE_WIDTH, 1.0 - base / _PAGE_HEIGHT, text, fontsize=size, color=colour, va="baseline",
            fontweight="bold" if bold else "normal", parse_math=False,
        )  # fmt: skip

    def _frame(self, x: float, y: float, width: float, height: float, **style: object) -> None:
        self._figure.add_artist(
            Rectangle(
                (x / _PAGE_WIDTH, 1.0 - (y + height) / _PAGE_HEIGHT),
                width / _PAGE_WIDTH,
                height / _PAGE_HEIGHT,
                **style,  # type: ignore[arg-type]
            )
        )

    def _broken(
        self, text: str, size: float, width: float, first: float = 0.0, *, bold: bool = False
    ) -> list[str]:
        """Break a text into lines of a width [mm], the first of which begins further right."""
        return _broken_lines(self._fonts.shown(text), self._fonts.families, size, bold, width, first)

    def _width(self, text: str, size: float, *, bold: bool = False) -> float:
        return _width_of(self._fonts.shown(text), self._fonts.families, size, bold)

    def _paragraph(
        self, text: str, size: float, x: float = _LEFT, width: float = WIDTH, *, bold: bool = False
    ) -> None:
        for line in self._broken(text, size, width, bold=bold):
            self._need(_line(size))
            self._write(line, x, self._y, size, bold=bold)
            self._y += _line(size)

    def _title(self, title: str) -> None:
        self._paragraph(title, _TITLE, bold=True)
        self._y += 1.0

    def _heading(self, heading: str, room: float) -> None:
        """Write a heading that stays with what follows, a room [mm] at least."""
        self._need(_line(_HEADING) + 2.5 + room)
        self._y += 1.5
        self._paragraph(heading, _HEADING, bold=True)
        self._frame(_LEFT, self._y, WIDTH, 0.15, color="0.6")
        self._y += 0.8

    def _headline(self, headline: Headline) -> None:
        inside = WIDTH - _INSET - 3.0
        word = self._fonts.shown(headline.word)
        begin = self._width(word, _WORD, bold=True) + 6.0
        lines = self._broken(headline.sentence, _SENTENCE, inside, begin, bold=True)
        details = [self._broken(each, _DETAIL, inside) for each in headline.details]
        height = (
            len(lines) * _line(_SENTENCE) + sum(0.6 + len(each) * _line(_DETAIL) for each in details) + 4.0
        )
        top, colour = self._y, headline.colour
        self._frame(_LEFT, top, WIDTH, height, fill=False, edgecolor=colour, linewidth=2.2)
        self._frame(_LEFT, top, 5.0, height, color=colour)
        self._y += 1.8
        self._frame(
            _LEFT + _INSET, self._y - 0.3, begin - 3.0, _line(_WORD) + 0.3, fill=False, edgecolor=colour,
            linewidth=1.2,
        )  # fmt: skip
        self._write(word, _LEFT + _INSET + 1.5, self._y, _WORD, bold=True, colour=colour)
        for number, line in enumerate(lines):
            x = _LEFT + _INSET + (begin if number == 0 else 0.0)
            self._write(line, x, self._y, _SENTENCE, bold=True, colour=colour)
            self._y += _line(_SENTENCE)
        for each in details:
            self._y += 0.6
            for line in each:
                self._write(line, _LEFT + _INSET, self._y, _DETAIL)
                self._y += _line(_DETAIL)
        self._y = top + height + 1.0

    def _part(self, part: Part) -> None:
        if isinstance(part, Picture):
            self._picture(part)
        elif isinstance(part, Facts):
            self._facts(part)
        elif isinstance(part, Points):
            self._points(part)
        else:
            self._rows(part)

    def _picture(self, part: Picture) -> None:
        self._heading(part.heading, part.height)
        bottom = self._y + part.height
        for panel, (left, below, width, height) in zip(
            part.panels, panel_places(len(part.panels), WIDTH, part.height), strict=True
        ):
            shares = (
                (_LEFT + left) / _PAGE_WIDTH,
                1.0 - (bottom - below) / _PAGE_HEIGHT,
                width / _PAGE_WIDTH,
                height / _PAGE_HEIGHT,
            )
            panel.draw(self._figure.add_axes(shares))
        self._y = bottom

    def _facts(self, part: Facts) -> None:
        """Write names and values in columns of like height; what has no room goes to the next sheet."""
        width = (WIDTH - (part.columns - 1) * _GAP) / part.columns
        cells = [self._fact_lines(name, value, width) for name, value in part.rows]
        self._heading(part.heading, 3.0 * _line(_DETAIL))
        while cells:
            room = int((_PAGE_HEIGHT - _BOTTOM - self._y) / _line(_DETAIL))
            columns, cells = _in_columns(cells, part.columns, room)
            for number, column in enumerate(columns):
                x = _LEFT + number * (width + _GAP)
                for place, (name, value) in enumerate(column):
                    y = self._y + place * _line(_DETAIL)
                    begin = self._width(name, _DETAIL, bold=True) if name else 0.0
                    self._write(name, x, y, _DETAIL, bold=True)
                    self._write(value, x + begin, y, _DETAIL)
            self._y += max(map(len, columns), default=0) * _line(_DETAIL)
            if cells:
                self._need(_PAGE_HEIGHT)
                self._heading(f"{part.heading}, continued", 0.0)

    def _fact_lines(self, name: str, value: str, width: float) -> list[tuple[str, str]]:
        """Break a row into lines: the name, bold, before the first or on lines of its own, and the value."""
        name = f"{name}: "
        begin = self._width(name, _DETAIL, bold=True) + 0.8
        if begin > 0.6 * width:
            own = [(line, "") for line in self._broken(name, _DETAIL, width, bold=True)]
            return own + [("", line) for line in self._broken(value, _DETAIL, width)]
        lines = self._broken(value, _DETAIL, width, begin)
        shown = self._fonts.shown(name)
        return [(shown if number == 0 else "", line) for number, line in enumerate(lines)]

    def _points(self, part: Points) -> None:
        for number, point in enumerate(part.points, 1):
            lines = self._broken(point, _TEXT, WIDTH - 5.0)
            if number == 1:
                self._heading(part.heading, len(lines) * _line(_TEXT))
            self._need(len(lines) * _line(_TEXT))
            self._write(f"{number}.", _LEFT, self._y, _TEXT, bold=True)
            for line in lines:
                self._write(line, _LEFT + 5.0, self._y, _TEXT)
                self._y += _line(_TEXT)
            self._y += 0.4

    def _rows(self, part: Rows) -> None:
        self._heading(part.heading, 3.0 * _line(_DETAIL))
        self._row(part.head, part.widths, bold=True)
        for row in part.rows:
            if self._need(self._row(row, part.widths, measure=True)):
                self._heading(f"{part.heading}, continued", 0.0)
                self._row(part.head, part.widths, bold=True)
            self._row(row, part.widths)

    def _row(
        self, cells: Sequence[str], widths: Sequence[float], *, bold: bool = False, measure: bool = False
    ) -> float:
        """Write a row of a table, or only measure it; gives its height [mm]."""
        broken = [
            self._broken(cell, _DETAIL, share * WIDTH - 2.0, bold=bold)
            for cell, share in zip(cells, widths, strict=True)
        ]
        height = max(map(len, broken)) * _line(_DETAIL) + 0.8
        if measure:
            return height
        x = _LEFT
        for lines, share in zip(broken, widths, strict=True):
            for number, line in enumerate(lines):
                self._write(line, x + 1.0, self._y + number * _line(_DETAIL), _DETAIL, bold=bold)
            x += share * WIDTH
        self._y += height
        self._frame(_LEFT, self._y - 0.3, WIDTH, 0.1, color="0.75")
        return height


def _in_columns(
    cells: list[list[tuple[str, str]]], count: int, room: int
) -> tuple[list[list[tuple[str, str]]], list[list[tuple[str, str]]]]:
    """Pack cells into columns, as low as they can be and of a room of lines at most; also what is left."""
    for height in range(max(1, -(-sum(map(len, cells)) // count)), room + 1):
        columns, left = _packed(cells, count, height)
        if not left:
            return columns, left
    columns, left = _packed(cells, count, room)
    if not any(columns):  # a cell that is higher than the sheet: in pieces
        first, *others = cells
        return [first[: max(1, room)]], [first[max(1, room) :], *others]
    return columns, left


def _packed(
    cells: list[list[tuple[str, str]]], count: int, height: int
) -> tuple[list[list[tuple[str, str]]], list[list[tuple[str, str]]]]:
    left, columns = list(cells), []
    for _ in range(count):
        column: list[tuple[str, str]] = []
        while left and len(column) + len(left[0]) <= height:
            column += left.pop(0)
        columns.append(column)
    return columns, left


def _line(size: float) -> float:
    """Height of a line, [mm]."""
    return size * _SPACING * _MM_PER_POINT


@lru_cache(maxsize=100_000)
def _width_of(text: str, families: tuple[str, ...], size: float, bold: bool) -> float:
    """Measure a text, [mm]."""
    font = FontProperties(family=list(families), size=size, weight="bold" if bold else "normal")
    kept = text.rstrip(" ")  # what ends with a space is as long as without, for the measure
    width, _, _ = TextToPath().get_text_width_height_descent(kept or " ", font, False)
    return float(width) * _MM_PER_POINT + 0.3 * size * _MM_PER_POINT * (len(text) - len(kept))


def _broken_lines(
    text: str, families: tuple[str, ...], size: float, bold: bool, width: float, first: float
) -> list[str]:
    """Break a text between words, and a word that is longer than a line within it."""

    def measured(piece: str) -> float:
        return _width_of(piece, families, size, bold)

    lines, line, room = [], "", width - first
    for word in text.split():
        joined = f"{line} {word}" if line else word
        if measured(joined) <= room:
            line = joined
            continue
        if line:
            lines.append(line)
            room = width
        while measured(word) > room:
            count = max(1, next(n for n in range(len(word), 0, -1) if n == 1 or measured(word[:n]) <= room))
            lines.append(word[:count])
            word, room = word[count:], width
        line = word
    return [*lines, line] if line or not lines else lines

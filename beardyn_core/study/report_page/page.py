"""What a page consists of, whatever it is written to: plain texts, tables, pictures drawn on axes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias
from typing import Annotated as A

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    Draw: TypeAlias = Callable[[Axes], None]


@dataclass(frozen=True)
class Headline:
    """The verdict, to be read first."""

    word: A[str, "one or two words in capitals: they replace the colour in a black-and-white print"]
    sentence: str
    colour: A[str, "of the frame, ``#rrggbb``"]
    details: A[tuple[str, ...], "confidence, size, what is not known"] = ()


@dataclass(frozen=True)
class Facts:
    """Names with their values."""

    heading: str
    rows: tuple[tuple[str, str], ...]
    columns: A[int, "next to each other"] = 2


@dataclass(frozen=True)
class Points:
    """A list of sentences."""

    heading: str
    points: tuple[str, ...]


@dataclass(frozen=True)
class Rows:
    """A table with a head."""

    heading: str
    head: tuple[str, ...]
    widths: A[tuple[float, ...], "of the columns, shares of the page"]
    rows: tuple[tuple[str, ...], ...]
    links: A[tuple[str, ...], "page that each row leads to, ``p1``; '' or none: no page"] = ()


@dataclass(frozen=True)
class Panel:
    """Axes of a picture."""

    draw: Draw
    words: A[str, "what it shows, for who cannot see it"]


@dataclass(frozen=True)
class Picture:
    """Panels next to each other."""

    heading: str
    panels: tuple[Panel, ...]
    height: A[float, "[mm]"]


Part: TypeAlias = Facts | Points | Rows | Picture


@dataclass(frozen=True)
class Page:
    """One page; a writer goes on to another sheet where it is too long."""

    title: str
    headline: Headline
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class PageReport:
    """All pages of a report."""

    title: str
    pages: tuple[Page, ...]
    foot: A[str, "a line at the end of each page"]

    @property
    def text(self) -> str:
        """All that is written, for who looks for its characters."""
        found = [self.title, self.foot]
        for page in self.pages:
            found += [page.title, page.headline.word, page.headline.sentence, *page.headline.details]
            for part in page.parts:
                found.append(part.heading)
                if isinstance(part, Facts):
                    found += [each for row in part.rows for each in row]
                elif isinstance(part, Points):
                    found += part.points
                elif isinstance(part, Rows):
                    found += [*part.head, *(cell for row in part.rows for cell in row)]
        return "\n".join(found)

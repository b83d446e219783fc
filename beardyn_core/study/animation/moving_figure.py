"""A figure of which some parts move: its frames as pixels. Needs no screen."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.record.run import Run
from beardyn_core.record.view_title import faults_elsewhere, view_title

WIDTH_PX, HEIGHT_PX, DPI = 900, 600, 100
ROW_NAMES = ("inboard", "outboard")
_LONGEST_LINE = 120  # letters of the title


@dataclass(frozen=True, eq=False)
class MovingFigure:
    """A figure and how it changes over the simulated time."""

    figure: Figure
    parts: A[Sequence[Artist], "what changes, the lowest first"]
    show: A[Callable[[float], None], "put every part where it is at a time, [s]"]
    begin: A[float, "first time to show, [s]"]
    end: A[float, "where the picture may begin again, [s]"]
    what: A[str, "in a few words"]

    def times(self, count: int) -> Float:
        """Spread the frames evenly over the time; the end, which looks like the beginning, is left out."""
        return np.linspace(self.begin, self.end, count, endpoint=False)

    def frames(self, count: int) -> Iterator[NDArray[np.uint8]]:
        """Draw the frames one after the other, shape [height, width, 3].

        What does not move is drawn once, so that it is the same to the pixel in all of them.
        """
        canvas = FigureCanvasAgg(self.figure)
        for part in self.parts:
            part.set_animated(True)
        canvas.draw()
        still = canvas.copy_from_bbox(self.figure.bbox)
        for time in self.times(count):
            self.show(float(time))
            canvas.restore_region(still)
            for part in self.parts:
                self.figure.draw_artist(part)
            yield np.asarray(canvas.buffer_rgba())[..., :3].copy()


def new_figure(run: Run, row: int) -> Figure:
    """Make a figure with the title of the recording and the row that is shown."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI)
    text = view_title(run.described(), run.box, faults_elsewhere(run))
    short = text if len(text) <= _LONGEST_LINE else f"{text[: _LONGEST_LINE - 3]}..."
    figure.text(0.5, 0.975, short, ha="center", va="top", fontsize=10)
    figure.text(
        0.01,
        0.925,
        f"row {row} ({ROW_NAMES[row]}), z up, x forward (to the right)",
        fontsize=8,
        va="top",
        color="0.3",
    )
    return figure


def mean_load(run: Run, begin: float, end: float) -> Float:
    """Average the force on the journal over a time, forward and up, shape [2]; 0 without a load, [N]."""
    time = run.load.time
    if not len(time):
        return np.zeros(2)
    grid = np.linspace(begin, end, 101)
    return np.array([np.interp(grid, time, run.load.wrench[:, axis]).mean() for axis in (0, 2)])


def slowness(begin: float, end: float, seconds: float) -> str:
    """Name by how much a picture of some seconds is slower than the motion."""
    times = seconds / (end - begin)
    return f"{times:.0f} times slower" if times >= 10.0 else f"{times:.1f} times slower"

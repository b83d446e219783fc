"""The envelope spectrum as a drawn plot: rerun's own plots have time as their only axis."""

from __future__ import annotations

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from beardyn_core.observe.features import OrderSpectrum

Colour = tuple[int, int, int]

ENTITY = "plots/envelope"
WIDTH, HEIGHT = 1000.0, 175.0
SPECTRUM_COLOUR: Colour = (80, 145, 255)
FRAME_COLOUR: Colour = (128, 134, 148)
GRID_COLOUR = (128, 134, 148, 70)
# colour, harmonics and row of the label of each marker
MARKERS: dict[str, tuple[Colour, int, int]] = {
    "BPFO": ((240, 70, 90), 3, 2),
    "BPFI": ((230, 155, 30), 3, 1),
    "2 BSF": ((70, 185, 90), 2, 0),
    "FTF": ((175, 110, 240), 1, 1),
}
ROW_HEIGHT = 25.0


def log_spectrum(stream: rr.RecordingStream, spectrum: OrderSpectrum, frequencies: dict[str, float]) -> None:
    """Draw the spectrum with axes and the orders of every fault.

    Parameters
    ----------
    frequencies : dict
        FTF, BPFO, BPFI, BSF per shaft revolution.
    """
    last = float(spectrum.order[-1])
    # The lowest orders hold the slow change of load, not faults; they must not set the scale.
    searched = spectrum.order > 0.5 * frequencies["FTF"]
    top = max(float(spectrum.amplitude[searched].max()), 1e-12) * 1.08
    _frame(stream, last, top)
    for name in MARKERS:  # a roller fault shows at twice its frequency first
        order = 2.0 * frequencies["BSF"] if name == "2 BSF" else frequencies[name]
        _marker(stream, name, order, last)
    shown = np.minimum(spectrum.amplitude, top)
    line = np.stack((spectrum.order / last * WIDTH, HEIGHT * (1.0 - shown / top)), axis=1)
    stream.log(
        f"{ENTITY}/spectrum",
        rr.LineStrips2D([line], colors=[SPECTRUM_COLOUR], radii=rr.Radius.ui_points(0.8), draw_order=20.0),
        static=True,
    )


def bounds() -> rrb.VisualBounds2D:
    """Compute the part of the drawing plane that the plot fills."""
    return rrb.VisualBounds2D(x_range=[-50.0, WIDTH + 20.0], y_range=[-3.2 * ROW_HEIGHT, HEIGHT + 30.0])


def nice_ticks(top: float, wanted: int) -> NDArray[np.float64]:
    """Round numbers from 0 to at most ``top``, about ``wanted`` of them."""
    raw = top / wanted
    power = 10.0 ** np.floor(np.log10(raw))
    step = min((factor * power for factor in (1.0, 2.0, 5.0, 10.0)), key=lambda size: abs(size - raw))
    return np.arange(0.0, top * (1.0 + 1e-9), step)


def _frame(stream: rr.RecordingStream, last: float, top: float) -> None:
    box = np.array([(0.0, 0.0), (0.0, HEIGHT), (WIDTH, HEIGHT)])
    orders, levels = nice_ticks(last, 8), nice_ticks(top, 4)
    grid = [np.array([(x, 0.0), (x, HEIGHT)]) for x in orders / last * WIDTH]
    grid += [np.array([(0.0, y), (WIDTH, y)]) for y in HEIGHT * (1.0 - levels / top)]
    colours = [GRID_COLOUR] * len(grid) + [(*FRAME_COLOUR, 255)]
    width = rr.Radius.ui_points(0.6)
    shown = rr.LineStrips2D([*grid, box], colors=colours, radii=width, draw_order=1.0)
    stream.log(f"{ENTITY}/grid", shown, static=True)
    below = np.stack((orders / last * WIDTH, np.full(len(orders), HEIGHT + 4.0)), axis=1)
    beside = np.stack((np.full(len(levels), -30.0), HEIGHT * (1.0 - levels / top) - 8.0), axis=1)
    _labels(stream, "order", below, [f"{order:g}" for order in orders], FRAME_COLOUR)
    _labels(stream, "level", beside, [f"{level:.3g}" for level in levels], FRAME_COLOUR)


def _marker(stream: rr.RecordingStream, name: str, order: float, last: float) -> None:
    colour, harmonics, row = MARKERS[name]
    multiples = np.arange(1, harmonics + 1)
    multiples = multiples[multiples * order <= last]
    place = multiples * order / last * WIDTH
    if not len(place):
        return
    heights = np.full(len(place), -ROW_HEIGHT * (0.8 + row))
    lines = [np.array([(x, heights[0]), (x, HEIGHT)]) for x in place]
    width = rr.Radius.ui_points(0.9)
    shown = rr.LineStrips2D(lines, colors=[(*colour, 190)], radii=width, draw_order=10.0)
    stream.log(f"{ENTITY}/{name.replace(' ', '')}", shown, static=True)
    labels = [f"{name} {order:.2f}" if multiple == 1 else f"{multiple}x" for multiple in multiples]
    _labels(stream, name.replace(" ", ""), np.stack((place, heights), axis=1), labels, colour)


def _labels(
    stream: rr.RecordingStream, name: str, at: NDArray[np.float64], texts: list[str], colour: Colour
) -> None:
    size = rr.Radius.ui_points(0.01)
    shown = rr.Points2D(at, labels=texts, colors=[colour], radii=size, show_labels=True, draw_order=30.0)
    stream.log(f"{ENTITY}/text/{name}", shown, static=True)

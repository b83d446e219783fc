"""What makes the view readable: the scale of the rollers' colours, the key of the arrows, round axes."""

from __future__ import annotations

import itertools

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from beardyn_core.base.arrays import Float
from beardyn_core.record.load_colours import load_colours
from beardyn_core.record.rerun_bearing import ARROW_COLOURS, RESULTANT_COLOUR

ENTITY = "scale"
NAME = "load of a roller on the cup, kN; arrows: forces"
TICK_COLOUR = (200, 204, 214)
_BAR = (40.0, 500.0, 0.0, 22.0)  # left, right, top, bottom
_KEY_LEFT, _KEY_STEP, _KEY_LENGTH = 560.0, 92.0, 50.0
_STRIPS = 60
_MOST_STEPS = 9.0  # between labels of an axis
_SPARE = 0.15  # of a step, above the last label


def log_scale(stream: rr.RecordingStream, largest: float) -> None:
    """Draw the colours of the rollers over their load, to the largest [N], and what each arrow is."""
    left, right, top, bottom = _BAR
    edges = np.linspace(left, right, _STRIPS + 1)
    middle = 0.5 * (top + bottom)
    strips = [np.array([(a, middle), (b + 0.3, middle)]) for a, b in itertools.pairwise(edges)]
    colours = load_colours(np.linspace(0.0, largest, _STRIPS), largest)
    width = 0.5 * (bottom - top)
    stream.log(f"{ENTITY}/bar", rr.LineStrips2D(strips, colors=colours, radii=width), static=True)
    ticks = nice_ticks(1e-3 * largest, 5) if largest > 0.0 else np.zeros(1)
    place = left + (right - left) * ticks / max(1e-3 * largest, 1e-12)
    below = np.stack((place, np.full(len(ticks), bottom + 4.0)), axis=1)
    _labels(stream, "ticks", below, [f"{tick:g}" for tick in ticks], [TICK_COLOUR] * len(ticks))
    key = {f"on {name}": colour for name, colour in ARROW_COLOURS.items()} | {"sum on cup": RESULTANT_COLOUR}
    begin = _KEY_LEFT + _KEY_STEP * np.arange(len(key))
    lines = [np.array([(x, middle), (x + _KEY_LENGTH, middle)]) for x in begin]
    shown = rr.LineStrips2D(lines, colors=list(key.values()), radii=3.0)
    stream.log(f"{ENTITY}/arrows", shown, static=True)
    under = np.stack((begin + 0.5 * _KEY_LENGTH, np.full(len(key), bottom + 4.0)), axis=1)
    _labels(stream, "names", under, list(key), list(key.values()))


def scale_view() -> rrb.Spatial2DView:
    """Make the view of the scale."""
    right = _KEY_LEFT + _KEY_STEP * (len(ARROW_COLOURS) + 1)
    bounds = rrb.VisualBounds2D(x_range=[0.0, right], y_range=[_BAR[2] - 6.0, _BAR[3] + 40.0])
    return rrb.Spatial2DView(origin=ENTITY, name=NAME, visual_bounds=bounds)


def _labels(
    stream: rr.RecordingStream,
    name: str,
    at: Float,
    texts: list[str],
    colours: list[tuple[int, int, int]],
) -> None:
    size = rr.Radius.ui_points(0.01)
    shown = rr.Points2D(at, labels=texts, colors=colours, radii=size, show_labels=True, draw_order=30.0)
    stream.log(f"{ENTITY}/text/{name}", shown, static=True)


def nice_ticks(top: float, wanted: int) -> Float:
    """Round numbers from 0 to at most ``top``, about ``wanted`` of them."""
    raw = top / wanted
    power = 10.0 ** np.floor(np.log10(raw))
    step = min((factor * power for factor in (1.0, 2.0, 5.0, 10.0)), key=lambda size: abs(size - raw))
    return np.arange(0.0, top * (1.0 + 1e-9), step)


def round_range(values: Float) -> tuple[float, float] | None:
    """Widen the range of values until an axis of the viewer, which labels powers of ten, shows two labels.

    Parameters
    ----------
    values : ndarray
        Any unit; what is not finite is left out.

    Returns
    -------
    tuple of 2 floats or None
        The range, whole steps of half a power of ten; ``None`` where no value is finite.
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return None
    low, high = float(finite.min()), float(finite.max())
    spare = max(0.02 * (high - low), 5e-3 * max(abs(low), abs(high)), 1e-6)
    low, high = low - (low != 0.0) * spare, high + (high != 0.0) * spare
    high = max(high, low + spare)
    power = 10.0 ** np.ceil(np.log10((high - low) / _MOST_STEPS))
    first, last = (0.5 * power * side(2.0 * end / power) for side, end in ((np.floor, low), (np.ceil, high)))
    labelled = power * np.arange(np.ceil(first / power - 1e-9), np.ceil(last / power - 0.02))
    if len(labelled) < 2:  # one at the upper edge is cut off
        last = power * (np.ceil(last / power - 1e-9) + _SPARE)
    return float(first), float(last)

"""Which of the two events of a passage is the entry, and which the exit: how the box moves around them."""

from __future__ import annotations

import numpy as np
from scipy.fft import irfft, rfft

from beardyn_core.base.arrays import Float, Int
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.passage_profile import BANDS
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.passage_order import band_envelope
from beardyn_core.monitor.severity import spacing_of

MOTIONS = (300.0, 600.0, 1200.0)  # up to which the motion of the box is taken, [Hz]
MOMENTS = {"before": (-2e-3, -0.3e-3), "at": (-0.3e-3, 0.6e-3), "after": (0.6e-3, 2e-3)}  # of an event, [m]
LEAST_WAY = 3.2e-3  # between two events whose order is asked for, [m]
WAY = "ordered_way"
CONTRASTS = tuple(f"ordered_motion_{high:.0f}_{when}" for high in MOTIONS for when in MOMENTS)
"""Names of what turns its sign when entry and exit are exchanged."""
NAMES = (WAY, *CONTRASTS)
_STEPS = 256  # of a passage
_OWN = 32  # steps by which rollers that float in their pockets strike sooner or later
_SMOOTHED, _SMOOTHED_LONG = 5, 8  # steps: around one event, around the mean of all
_FLOOR = 1e-9
_FEWEST = 8  # passages


def order_of_events(
    stretch: Stretch, part: str, order: float, plate: NamePlate, axes: tuple[str, ...]
) -> dict[str, float]:
    """Work out what distinguishes the entry of a spall from its exit, of the two loudest events of a passage.

    Parameters
    ----------
    stretch : Stretch
        In which the shaft turns one way.
    part : str
        ``cup`` or ``cone``.
    order : float
        Passages per revolution of the shaft, as found.
    plate : NamePlate
    axes : tuple of str
        Of the accelerometer; the vertical one is used.

    Returns
    -------
    dict
        By `NAMES`: the shorter way between the two events, [m], and the vertical speed of the box around the
        event at its end less that around the one at its beginning. All are 0 where there are no two events.

    Notes
    -----
    A spall of width w has its entry before its exit by w, and its exit before the entry of the next roller
    by the rest of the distance of two rollers: times and levels do not say which is which. But the box sinks
    as a roller is unloaded in the spall, and is pushed back as it is loaded again. As the contrasts turn
    their sign with the order, narrow spalls teach what wide ones do. Each passage is put on its own loudest
    moment, for rollers float in their pockets.
    """
    nothing = dict.fromkeys(NAMES, 0.0)
    spacing = spacing_of(part, plate)
    passed = stretch.shaft_angle * order / (2.0 * np.pi)
    first = np.ceil(passed[0])
    passages = int(passed[-1] - first) - 1
    if "z" not in axes or passages < _FEWEST:
        return nothing
    grid = first + np.arange(passages * _STEPS) / _STEPS
    loud = np.interp(grid, passed, band_envelope(stretch.acceleration, stretch.rate, *BANDS["high"]))
    inside, weight = _align_passages(loud)
    if not weight.sum() > 0.0:
        return nothing
    weight /= weight.sum()
    second = _second(np.asarray(weight @ loud[inside]), spacing)
    if not np.isfinite(second):
        return nothing
    start, end = min(second, 0.0), max(second, 0.0)
    shaken = np.interp(grid, passed, stretch.acceleration[:, axes.index("z")])
    line = rfft(np.roll(weight @ shaken[inside], _STEPS // 2))
    number = np.arange(len(line))
    frequency = number * (passed[-1] - passed[0]) * stretch.rate / (len(passed) - 1)
    found, step = {WAY: abs(second)}, spacing / _STEPS
    for high in MOTIONS:
        passing = np.where(number > 0, np.exp(-((frequency / high) ** 4)), 0.0)
        speed = irfft(-1j * line * passing / np.maximum(number, 1), _STEPS)
        speed /= max(float(speed.std()), _FLOOR)
        for when, (low, top) in MOMENTS.items():
            ways = np.arange(low, top + step, step)
            after, before = (
                np.interp(each + ways, np.arange(_STEPS) * step, speed, period=spacing).mean()
                for each in (end, start)
            )
            found[f"ordered_motion_{high:.0f}_{when}"] = float(after - before)
    return found


def _align_passages(loud: Float) -> tuple[Int, Float]:
    """Find the steps of each passage, shape [passage, step], its loudest moment in the middle, and how loud.

    The moment is looked for around the loudest place of the mean passage.
    """
    loudest = int(np.argmax(_smooth_circle(loud.reshape(-1, _STEPS).mean(axis=0), _SMOOTHED_LONG)))
    smooth = np.convolve(loud, np.ones(_SMOOTHED) / _SMOOTHED, "same")
    margin = _STEPS // 2 + _OWN
    middles = np.arange(loudest, len(loud), _STEPS)
    middles = middles[(middles >= margin) & (middles < len(loud) - margin)]
    near = middles[:, None] + np.arange(-_OWN, _OWN + 1)
    middles = near[np.arange(len(near)), smooth[near].argmax(axis=1)]
    return middles[:, None] + np.arange(-_STEPS // 2, _STEPS // 2), smooth[middles]


def _second(mean: Float, spacing: float) -> float:
    """Find the second event of a mean passage whose loudest one is in the middle, [m] behind it; else NaN."""
    smooth = _smooth_circle(mean, _SMOOTHED)
    ways = (np.arange(_STEPS) - _STEPS // 2) * spacing / _STEPS
    peak = (smooth >= np.roll(smooth, 1)) & (smooth >= np.roll(smooth, -1)) & (np.abs(ways) > LEAST_WAY)
    places = np.flatnonzero(peak)
    return float(ways[places[np.argmax(smooth[places])]]) if len(places) else float("nan")


def _smooth_circle(mean: Float, steps: int) -> Float:
    """Average over steps around the circle."""
    around = np.convolve(np.tile(mean, 3), np.ones(steps) / steps, "same")
    return np.asarray(around[len(mean) : 2 * len(mean)], np.float64)

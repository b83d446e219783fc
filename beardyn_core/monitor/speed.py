"""Speed of the shaft from the vibration itself, with its uncertainty, where there is no tachometer.

What turns with the shaft leaves lines at its whole orders, and rollers leave lines at the orders of the
bearing. No line is known to be there, and others are there that belong to neither: so every order of every
speed in question is weighed, and what comes out is how probable each speed is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log
from typing import Annotated as A

import numpy as np
from scipy.signal import savgol_filter
from scipy.special import logsumexp

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.speed_lines import (
    OVERSAMPLING,
    Signal,
    SpeedSettings,
    combs_of,
    line_spectrum,
    searched_signals,
    weigh,
)
from beardyn_core.monitor.speed_rivals import Alternatives, Rival, Shaft, find_alternatives

_TURN = 2.0 * np.pi
_LEAST_SAMPLES = 64
# of a speed, relative: lines of a bearing and of its shaft can be taken for each other
_CONFUSION = 0.012
_NEAR = 0.025  # of a speed, within which the second pass sharpens it
_NEIGHBOURS = 5
_WIDEST = 2.0  # highest over lowest frequency of the range
_INTERVAL = 1.96  # standard deviations, 95 %


@dataclass(frozen=True)
class SpeedTrack:
    """Speed of the shaft over time."""

    time: A[Float, "shape [point], [s]"]
    frequency: A[Float, "shape [point], of the shaft, [Hz]"]
    deviation: A[Float, "shape [point], standard deviation of the frequency, [Hz]"]
    evidence: A[float, "logarithm of the odds against no lines at all, the least of the windows, [-]"]
    share: A[float, "of the probability within 2.5 % of the speed, the least of the windows, [-]"]
    certain: A[bool, "whether the speed is one and no other"]
    reason: A[str, "the same in a sentence"]
    spread: A[float, "furthest speed of the range that explains about as much, relative, [-]"] = 0.0

    @property
    def interval(self) -> tuple[Float, Float]:
        """Ends of the 95 % interval of the frequency, [Hz]."""
        return self.frequency - _INTERVAL * self.deviation, self.frequency + _INTERVAL * self.deviation

    @property
    def uncertainty(self) -> float:
        """Half width of the 95 % interval at its widest, or as far as speeds that fit as well, relative."""
        if not len(self.frequency):
            return np.inf
        return max(float(np.max(_INTERVAL * self.deviation / self.frequency)), self.spread)

    def angle(self, time: Float) -> Float:
        """Integrate the speed to the angle of the shaft at times [s], linear between the points, [rad]."""
        edges = np.concatenate(([-1e9], self.time, [1e9]))
        ends = np.concatenate((self.frequency[:1], self.frequency, self.frequency[-1:]))
        knots = np.concatenate(
            ([0.0], np.cumsum(0.5 * (self.frequency[1:] + self.frequency[:-1]) * np.diff(self.time)))
        )
        place = np.clip(np.searchsorted(self.time, time) - 1, -1, len(self.time) - 1)
        origin = np.maximum(place, 0)
        after = time - self.time[origin]
        slope = np.where(
            (place >= 0) & (place < len(self.time) - 1),
            np.diff(ends)[np.clip(place + 1, 0, len(ends) - 2)]
            / np.maximum(np.diff(edges)[np.clip(place + 1, 0, len(ends) - 2)], 1e-12),
            0.0,
        )
        return np.asarray(_TURN * (knots[origin] + self.frequency[origin] * after + 0.5 * slope * after**2))


def speed_from_vibration(
    acceleration: Float,
    rate: float,
    lowest: float,
    highest: float,
    orders: Sequence[FaultFrequencies] = (),
    settings: SpeedSettings | None = None,
    names: Sequence[str] = (),
) -> SpeedTrack:
    """Find the speed of the shaft in a vibration.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis] or [sample]
        [m/s^2].
    rate : float
        [Hz].
    lowest, highest : float
        Frequency of the shaft between which it is sought, [Hz].
    orders : sequence of FaultFrequencies
        Of the bearings on the shaft, whose lines count too.
    names : sequence of str
        Of these bearings, for the sentence.

    Notes
    -----
    In noise the power of a bin over its mean is exponentially distributed; that of a line has no known size,
    1 / (1 + p)^2 stands for its distribution. A bin where a speed has an order counts as a line with one
    probability, any other bin with a smaller one, the share of bins with lines in this very spectrum. The
    logarithms of the odds are added over orders, raw spectrum and envelope: a strong line of something else
    counts no more than any other, and orders that are missing count against a speed.

    The first pass takes windows, each warped by a constant acceleration of the shaft, and chains them by a
    random walk of the speed, forwards and backwards. The second weighs more orders, over the angle that the
    first one gives. Its deviation is that of the probability, and 1.2 % in addition: an order of the bearing
    that is nearly a whole one, 3.05 or 4.95, is taken for it and pulls the speed along.

    Last, every other speed of the range is weighed over that angle, without counting the lines that would be
    one thing at the speed found and another there (`speed_rivals`).

    References
    ----------
    Leclère, André, Antoni (2016), A multi-order probabilistic approach for instantaneous angular speed
    tracking, Mech. Syst. Signal Process. 81: orders as probabilities, and the chain over time. The odds here
    are our own.
    """
    settings = settings or SpeedSettings()
    signal = np.asarray(acceleration, float)
    signal = signal[:, None] if signal.ndim == 1 else signal
    if not 0.0 < lowest < highest <= _WIDEST * lowest * (1.0 + 1e-9):
        return _nothing(
            f"the range of the speed is too wide; at most {_WIDEST:g} times the lowest can be distinguished"
        )
    duration = len(signal) / rate
    window = min(settings.window_revolutions / lowest, duration)
    if window * lowest < 4.0 or len(signal) < _LEAST_SAMPLES:
        return _nothing(f"{duration:.3g} s are too short: four revolutions at the lowest speed are needed")
    count = max(1, round(2.0 * duration / window) - 1)
    middles = (
        np.linspace(0.5 * window, duration - 0.5 * window, count) if count > 1 else np.array([0.5 * duration])
    )
    searched, fine = (
        searched_signals(signal, rate, min((count + 1.0) * highest, 0.45 * rate), settings)
        for count in (settings.orders, settings.fine_orders)
    )
    grid = _grid(lowest, highest, settings.orders * window)
    chances, slopes = [], []
    for middle in middles:
        found = _window_odds(searched, middle, window, grid, orders, settings)
        chances.append(found[0])
        slopes.append(found[1])
    posterior, evidence = _chain_windows(np.array(chances), grid, settings, window, count)
    shares = [
        float(p[np.abs(grid / grid[p.argmax()] - 1.0) <= max(_NEAR, 1.5 * (grid[1] / grid[0] - 1.0))].sum())
        for p in posterior
    ]
    first = grid[posterior.argmax(axis=1)]
    frequency, deviation, sure = _refine_track(fine, middles, first, window, orders, settings)
    share = min(shares)
    lines = evidence >= settings.least_evidence
    others = Alternatives(None, 0.0, 0.0)
    if lines:
        track = SpeedTrack(middles, frequency, deviation, evidence, share, True, "")
        shaft = Shaft(
            lambda time: track.angle(time) / _TURN,
            middles,
            window * float(frequency.min()),
            float(np.median(frequency)),
            lowest,
            highest,
        )
        others = find_alternatives(searched, shaft, orders, names, settings)
    certain = bool(lines and share >= settings.least_share and sure and others.rival is None)
    return SpeedTrack(
        middles,
        frequency,
        np.maximum(deviation, others.reach / _INTERVAL * frequency),
        evidence,
        share,
        certain,
        _said(certain, evidence, share, frequency, others.rival, settings),
        others.spread,
    )


def _said(
    certain: bool, evidence: float, share: float, frequency: Float, rival: Rival | None,
    settings: SpeedSettings,
) -> str:  # fmt: skip
    low, high = 60.0 * frequency.min(), 60.0 * frequency.max()
    if certain:
        return f"the shaft turns with {low:.5g} to {high:.5g} rpm, by its orders in the vibration"
    if evidence < settings.least_evidence:
        return (
            "the vibration has too few lines that belong to one speed: the odds of the best one "
            "against none "
            f"are e^{evidence:.1f}, e^{settings.least_evidence:g} are asked for"
        )
    if rival is not None:
        middle = 60.0 * float(np.median(frequency))
        return (
            f"{rival.why or 'the vibration fits several speeds'}: the other lines fit {middle:.4g} rpm and "
            f"{rival.ratio * middle:.4g} rpm about as well; give a range that holds only one of them, or the "
            "speed"
        )
    return (
        f"the vibration fits several speeds: {100.0 * share:.0f} % of the probability lie within "
        f"{100.0 * _NEAR:g} % of "
        f"{low:.5g} to {high:.5g} rpm, {100.0 * settings.least_share:g} % are asked for; give a "
        "narrower range"
    )


def _nothing(reason: str) -> SpeedTrack:
    none = np.empty(0)
    return SpeedTrack(none, none, none, -np.inf, 0.0, False, reason)


def _grid(lowest: float, highest: float, orders_times_window: float) -> Float:
    """Space frequencies evenly in their logarithm, a quarter of a bin at the highest order, [Hz]."""
    step = 0.25 / (orders_times_window * highest)
    return np.exp(np.arange(log(lowest), log(highest) + step, step))


def _warp_window(signal: Signal, middle: float, window: float, slope: float) -> Float:
    """Resample a window so that a shaft with a constant relative acceleration [1/s] would turn evenly.

    The phase f (t + slope t^2 / 2) about the middle increases evenly in the new time.
    """
    count = int(window * signal.rate)
    even = (np.arange(count) + 0.5) / signal.rate - 0.5 * window
    time = even if slope == 0.0 else (np.sqrt(np.maximum(1.0 + 2.0 * slope * even, 0.0)) - 1.0) / slope
    place = (middle + time) * signal.rate
    whole = np.arange(len(signal.values))
    return np.stack([np.interp(place, whole, axis) for axis in signal.values.T], axis=1)


def _window_odds(
    searched: list[Signal], middle: float, window: float, grid: Float,
    orders: Sequence[FaultFrequencies], settings: SpeedSettings,
) -> tuple[Float, Float]:  # fmt: skip
    """Weigh every frequency in one window, over all slopes, shape [frequency]; and the best slope of each."""
    combs = combs_of(orders, float(settings.orders), settings.orders, settings)
    revolutions = window * grid[len(grid) // 2]
    step = 4.0 / (settings.orders * revolutions)
    reach = int(np.floor(settings.swing / step))
    relative = np.arange(-reach, reach + 1) * step / window
    found = np.empty((len(relative), len(grid)))
    for number, slope in enumerate(relative):
        total = np.zeros(len(grid))
        for signal in searched:
            spectrum = line_spectrum(
                _warp_window(signal, middle, window, slope), signal.rate, {comb.probable for comb in combs}
            )
            total += weigh(spectrum, combs, grid, settings)
        found[number] = total
    # slopes are rarer the steeper they are
    prior = -0.5 * (relative * window / (0.3 * settings.swing)) ** 2
    prior -= logsumexp(prior)
    return np.asarray(logsumexp(found + prior[:, None], axis=0)), relative[found.argmax(axis=0)]


def _chain_windows(
    odds: Float, grid: Float, settings: SpeedSettings, window: float, count: int
) -> tuple[Float, float]:
    """Chain windows by a random walk; give the probability of each frequency, and the least evidence."""
    spacing = float(np.log(grid[1] / grid[0]))
    reach = min(len(grid) - 1, int(np.ceil(3.0 * settings.stray / spacing)))
    offsets = np.arange(-reach, reach + 1)
    walk = np.exp(-0.5 * (offsets * spacing / settings.stray) ** 2) + 1e-6
    walk /= walk.sum()

    def stepped(log_chance: Float) -> Float:
        top = log_chance.max()
        full = np.convolve(np.exp(log_chance - top), walk)
        return np.asarray(np.log(np.maximum(full[reach : reach + len(grid)], 1e-300)) + top)

    forward, backward = [odds[0]], [np.zeros(len(grid))]
    for each in odds[1:]:
        forward.append(each + stepped(forward[-1]))
    for each in odds[:0:-1]:
        backward.insert(0, stepped(each + backward[0]))
    joint = np.array(forward) + np.array(backward)
    posterior = np.exp(joint - logsumexp(joint, axis=1)[:, None])
    evidence = float(logsumexp(forward[-1])) - log(len(grid))
    return posterior, evidence / max(1.0, 0.5 * (count + 1)) if count > 1 else evidence


def _refine_track(
    searched: list[Signal], middles: Float, first: Float, window: float,
    orders: Sequence[FaultFrequencies], settings: SpeedSettings,
) -> tuple[Float, Float, bool]:  # fmt: skip
    """Sharpen a track by more orders over its own angle; frequencies, deviations, whether it held."""
    frequency = first.copy()
    deviation = np.empty(len(first))
    for turn in range(2):
        track = SpeedTrack(middles, frequency, frequency, 0.0, 0.0, True, "")
        reach = _NEAR if turn == 0 else 0.01
        scale = np.exp(
            np.arange(-reach, reach + 1e-9, 0.1 / (settings.fine_orders * window * frequency.min()))
        )
        better = np.empty(len(first))
        for number, middle in enumerate(middles):
            total = np.zeros(len(scale))
            for signal in searched:
                total += _order_odds(signal, track, middle, window, scale, orders, settings)
            chance = np.exp(total - logsumexp(total))
            mean = float(np.sum(chance * scale))
            spread = float(np.sqrt(np.sum(chance * (scale - mean) ** 2)))
            best = float(scale[total.argmax()])
            better[number] = frequency[number] * best
            deviation[number] = frequency[number] * float(np.hypot(spread, _CONFUSION))
        frequency = _smooth(better)
        deviation = np.hypot(deviation, better - frequency)
    return frequency, deviation, bool(np.all(deviation < 0.02 * frequency))


def _smooth(frequency: Float) -> Float:
    """Lay a parabola through each five neighbours: a heavy shaft changes its speed no faster."""
    count = len(frequency)
    if count < _NEIGHBOURS:
        return frequency
    return np.asarray(savgol_filter(frequency, _NEIGHBOURS, 2))


def _order_odds(
    signal: Signal, track: SpeedTrack, middle: float, window: float, scale: Float,
    orders: Sequence[FaultFrequencies], settings: SpeedSettings,
) -> Float:  # fmt: skip
    """Weigh factors of the speed in a window that is resampled evenly over the angle of a track."""
    begin = max(0, int((middle - 0.5 * window) * signal.rate))
    time = (begin + np.arange(int(window * signal.rate))) / signal.rate
    time = time[time < len(signal.values) / signal.rate]
    turned = track.angle(time) / _TURN
    even = np.linspace(turned[0], turned[-1], len(time))
    values = np.stack(
        [np.interp(even, turned, axis[begin : begin + len(time)]) for axis in signal.values.T], axis=1
    )
    per_turn = (len(time) - 1) / (turned[-1] - turned[0])
    highest = min(float(settings.fine_orders), 0.45 * per_turn / OVERSAMPLING * 2.0)
    combs = combs_of(orders, highest, int(highest), settings)
    spectrum = line_spectrum(values, per_turn, {comb.probable for comb in combs}, flanks=False)
    return weigh(spectrum, combs, scale, settings)

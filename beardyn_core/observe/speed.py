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
from typing import NamedTuple

import numpy as np
from scipy.signal import savgol_filter
from scipy.special import logsumexp

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.features import analytic_band, local_background, squared_magnitude

_TURN = 2.0 * np.pi
_MEDIAN_OVER_MEAN = np.log(2.0)  # of an exponential distribution
# of a line that may be anywhere: share of the bins that have one of no order, at least and at most
_LEAST_STRAY, _MOST_STRAY = 0.01, 0.2
_STRAY_POWER = 8.0  # over the background, from which a bin has a line
_PADDING = 4
_OVERSAMPLING = 4.0  # of what is warped by linear interpolation
_LEAST_SAMPLES = 64
_SLIPS = 12  # to each side
# of a speed, relative: lines of a bearing and of its shaft can be taken for each other
_CONFUSION = 0.011
_NEAR = 0.025  # of a speed, within which the second pass sharpens it
_NEIGHBOURS = 5
_WIDEST = 2.0  # highest over lowest frequency of the range
_INTERVAL = 1.96  # standard deviations, 95 %


@dataclass(frozen=True)
class SpeedSettings:
    """Settings of the search for the speed; frequencies of the shaft are sought between two limits."""

    window_revolutions: A[float, "of the slowest speed in one window; neighbours share half of it, [-]"] = (
        20.0
    )
    orders: A[int, "whole orders of the shaft that are weighed in the first pass"] = 12
    fine_orders: A[int, "and in the second, along the speed of the first"] = 40
    probable: A[float, "that an order of the shaft has a line, [-]"] = 0.4
    faulty: A[float, "that a part of the bearing has lines, [-]"] = 0.2
    probable_of_bearing: A[float, "that an order of such a part has one, [-]"] = 0.8
    slip: A[float, "standard deviation of the orders of the bearing about geometry, relative, [-]"] = 0.012
    swing: A[float, "largest change of the speed over a window, relative, [-]"] = 0.3
    stray: A[float, "standard deviation of the speed from one window to the next, relative, [-]"] = 0.1
    envelope: A[tuple[float, float], "band of the envelope, as far as the signal reaches, [Hz]"] = (
        2000.0,
        20_000.0,
    )
    least_evidence: A[float, "logarithm of the odds of the speeds found against no lines at all, [-]"] = 12.0
    least_share: A[float, "of the probability within 2.5 % of the speed, in every window, [-]"] = 0.9


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

    @property
    def interval(self) -> tuple[Float, Float]:
        """Ends of the 95 % interval of the frequency, [Hz]."""
        return self.frequency - _INTERVAL * self.deviation, self.frequency + _INTERVAL * self.deviation

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


class _Signal(NamedTuple):
    """What is searched: shape [sample, channel], of the raw signal and of its envelope."""

    values: Float
    rate: float


class _Comb(NamedTuple):
    """Orders with the probability that each has a line."""

    orders: Float
    probable: float


def speed_from_vibration(
    acceleration: Float,
    rate: float,
    lowest: float,
    highest: float,
    orders: Sequence[FaultFrequencies] = (),
    settings: SpeedSettings | None = None,
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

    Notes
    -----
    In noise the power of a bin over its mean is exponentially distributed; that of a line has no known size,
    1 / (1 + p)^2 stands for its distribution. A bin where a speed has an order counts as a line with one
    probability, any other bin with a smaller one, the share of bins with lines in this very spectrum. The
    logarithms of the odds are added over orders, raw spectrum and envelope: a strong line of something else
    counts no more than any other, and orders that are missing count against a speed.

    The first pass takes windows, each warped by a constant acceleration of the shaft, and chains them by a
    random walk of the speed, forwards and backwards. The second weighs more orders, over the angle that the
    first one gives. Its deviation is that of the probability, and 1.1 % beside: an order of the bearing
    that is nearly a whole one, 3.05 or 4.95, is taken for it and pulls the speed along.

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
            f"the range of the speed is too wide; at most {_WIDEST:g} times the lowest can be told apart"
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
        _searched(signal, rate, min((count + 1.0) * highest, 0.45 * rate), settings)
        for count in (settings.orders, settings.fine_orders)
    )
    grid = _grid(lowest, highest, settings.orders * window)
    chances, slopes = [], []
    for middle in middles:
        found = _window_odds(searched, middle, window, grid, orders, settings)
        chances.append(found[0])
        slopes.append(found[1])
    posterior, evidence = _chained(np.array(chances), grid, settings, window, count)
    shares = [
        float(p[np.abs(grid / grid[p.argmax()] - 1.0) <= max(_NEAR, 1.5 * (grid[1] / grid[0] - 1.0))].sum())
        for p in posterior
    ]
    first = grid[posterior.argmax(axis=1)]
    frequency, deviation, sure = _refined(fine, middles, first, window, orders, settings)
    share = min(shares)
    certain = bool(evidence >= settings.least_evidence and share >= settings.least_share and sure)
    return SpeedTrack(
        middles,
        frequency,
        deviation,
        evidence,
        share,
        certain,
        _said(certain, evidence, share, frequency, settings),
    )


def _said(certain: bool, evidence: float, share: float, frequency: Float, settings: SpeedSettings) -> str:
    low, high = 60.0 * frequency.min(), 60.0 * frequency.max()
    if certain:
        return f"the shaft turns with {low:.5g} to {high:.5g} rpm, as its orders in the vibration say"
    if evidence < settings.least_evidence:
        return (
            "the vibration has too few lines that belong to one speed: the odds of the best one "
            "against none "
            f"are e^{evidence:.1f}, e^{settings.least_evidence:g} are asked for"
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


def _searched(signal: Float, rate: float, top: float, settings: SpeedSettings) -> list[_Signal]:
    """Bring the raw signal and its squared envelope to a rate that holds the highest order."""
    found = [_slow(signal, rate, top)]
    low, high = settings.envelope[0], min(settings.envelope[1], 0.45 * rate)
    if high > low + 500.0:
        power = squared_magnitude(analytic_band(signal - signal.mean(axis=0), rate, (low, high)))
        found.append(_slow(np.sqrt(power)[:, None], rate, min(top, 0.5 * (high - low))))
    return found


def _slow(values: Float, rate: float, top: float) -> _Signal:
    """Take a signal to the lowest rate at which linear interpolation still holds its frequencies."""
    spectrum = np.fft.rfft(values - values.mean(axis=0), axis=0)
    length = min(len(values), int(2.0 * _OVERSAMPLING * top * len(values) / rate))
    kept = length // 2 + 1
    cut = np.zeros((kept, values.shape[1]), complex)
    last = min(kept - 1, int(1.1 * top * len(values) / rate))
    cut[:last] = spectrum[:last]
    return _Signal(np.fft.irfft(cut, length, axis=0) * (length / len(values)), rate * length / len(values))


def _combs(
    orders: Sequence[FaultFrequencies], highest: float, count: int, settings: SpeedSettings
) -> list[_Comb]:
    """List the orders of the shaft and of the bearing."""
    found = [_Comb(np.arange(1.0, count + 1.0), settings.probable)]
    sides = np.array([-1.0, 0.0, 1.0])
    for each in orders:
        parts = ((each.bpfo, sides[1:2]), (each.bpfi, sides), (2.0 * each.bsf, each.ftf * sides))
        for order, beside in parts:
            several = np.add.outer(order * np.arange(1.0, 7.0), beside).reshape(-1)
            found.append(_Comb(several[several <= highest], settings.probable_of_bearing))
    return found


class _Spectrum(NamedTuple):
    odds: dict[float, Float]  # by probability: odds of a line in every bin, logarithm
    step: float  # [Hz] or orders
    resolution: float


def _spectrum(values: Float, rate: float, probable: set[float]) -> _Spectrum:
    """Compute the odds that each bin has a line, for orders of a probability."""
    count = len(values)
    window = np.hanning(count + 1)[:-1, None]
    padded = int(2 ** np.ceil(np.log2(_PADDING * count)))
    power = np.abs(np.fft.rfft((values - values.mean(axis=0)) * window, padded, axis=0)) ** 2
    bin_ = padded / count
    background = np.stack([local_background(axis, 60.0 * bin_) for axis in power.T], axis=1)
    floor = 1e-12 * max(float(power.max()), 1e-300)
    mean = np.mean(_MEDIAN_OVER_MEAN * power / np.maximum(background, floor), axis=1)
    stray = float(np.clip(np.mean(mean > _STRAY_POWER), _LEAST_STRAY, _MOST_STRAY))
    noise, line = np.exp(-mean), 1.0 / (1.0 + mean) ** 2
    usual = np.log((1.0 - stray) * noise + stray * line)
    odds = {}
    for share in probable:
        here = max(share, 2.0 * stray)
        odds[share] = np.log((1.0 - here) * noise + here * line) - usual
    return _Spectrum(odds, rate / padded, rate / count)


def _weigh(spectrum: _Spectrum, combs: list[_Comb], frequencies: Float, settings: SpeedSettings) -> Float:
    """Add the odds of all orders at frequencies that are evenly spaced in their logarithm, shape [frequency].

    A part of the bearing may have no lines, and its lines may slip. One that would fall on a whole order is
    left to the shaft: a bin counts once.
    """
    total = _odds_at(spectrum, combs[0], frequencies).sum(axis=0)
    step = float(np.log(frequencies[1] / frequencies[0]))
    stride = max(1, int(2.0 * settings.slip / step) // _SLIPS)
    reach = stride * _SLIPS if stride > 1 else max(1, int(np.ceil(2.0 * settings.slip / step)))
    offsets = np.arange(-reach, reach + 1, stride)
    slip = step * offsets
    weight = np.exp(-0.5 * (slip / settings.slip) ** 2)
    blur = spectrum.resolution / float(np.median(frequencies))
    for comb in combs[1:]:
        beyond = np.exp(step * np.arange(1, reach + 1))
        padded = np.concatenate((frequencies[0] / beyond[::-1], frequencies, frequencies[-1] * beyond))
        slipped = np.outer(np.exp(slip), comb.orders)
        apart = np.abs(slipped - np.rint(slipped)) > blur
        odds = apart.astype(float) @ _odds_at(spectrum, comb, padded)  # [slip, frequency]
        count = len(frequencies)
        shifted = np.stack([odds[k, reach + off : reach + off + count] for k, off in enumerate(offsets)])
        found = logsumexp(shifted, b=(weight / weight.sum())[:, None], axis=0)
        total += np.logaddexp(log(1.0 - settings.faulty), log(settings.faulty) + found)
    return np.asarray(total)


def _odds_at(spectrum: _Spectrum, comb: _Comb, frequencies: Float) -> Float:
    """Look up the odds of each order at each frequency, shape [order, frequency]."""
    odds = spectrum.odds[comb.probable]
    place = np.rint(np.outer(comb.orders, frequencies) / spectrum.step).astype(int)
    return np.asarray(np.where(place < len(odds), odds[np.minimum(place, len(odds) - 1)], 0.0))


def _warped(signal: _Signal, middle: float, window: float, slope: float) -> Float:
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
    searched: list[_Signal], middle: float, window: float, grid: Float,
    orders: Sequence[FaultFrequencies], settings: SpeedSettings,
) -> tuple[Float, Float]:  # fmt: skip
    """Weigh every frequency in one window, over all slopes, shape [frequency]; and the best slope of each."""
    combs = _combs(orders, float(settings.orders), settings.orders, settings)
    revolutions = window * grid[len(grid) // 2]
    step = 4.0 / (settings.orders * revolutions)
    reach = int(np.floor(settings.swing / step))
    relative = np.arange(-reach, reach + 1) * step / window
    found = np.empty((len(relative), len(grid)))
    for number, slope in enumerate(relative):
        total = np.zeros(len(grid))
        for signal in searched:
            spectrum = _spectrum(
                _warped(signal, middle, window, slope), signal.rate, {comb.probable for comb in combs}
            )
            total += _weigh(spectrum, combs, grid, settings)
        found[number] = total
    # slopes are rarer the steeper they are
    prior = -0.5 * (relative * window / (0.3 * settings.swing)) ** 2
    prior -= logsumexp(prior)
    return np.asarray(logsumexp(found + prior[:, None], axis=0)), relative[found.argmax(axis=0)]


def _chained(
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


def _refined(
    searched: list[_Signal], middles: Float, first: Float, window: float,
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
    signal: _Signal, track: SpeedTrack, middle: float, window: float, scale: Float,
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
    highest = min(float(settings.fine_orders), 0.45 * per_turn / _OVERSAMPLING * 2.0)
    combs = _combs(orders, highest, int(highest), settings)
    spectrum = _spectrum(values, per_turn, {comb.probable for comb in combs})
    return _weigh(spectrum, combs, scale, settings)

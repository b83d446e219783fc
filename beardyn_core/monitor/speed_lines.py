"""What the lines of a vibration say of a speed: spectra of odds, orders of shaft and bearing, their sum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.ndimage import maximum_filter1d

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.features import analytic_band, local_background, squared_magnitude

_MEDIAN_OVER_MEAN = np.log(2.0)  # of an exponential distribution
# of a line that may be anywhere: share of the bins that have one of no order, at least and at most
_LEAST_STRAY, _MOST_STRAY = 0.01, 0.2
_STRAY_POWER = 8.0  # over the background, from which a bin has a line
_PADDING = 4
OVERSAMPLING = 4.0  # of what is warped by linear interpolation
_SLIPS = 12  # to each side
_LOBE = 2.0  # half width of a line, of the resolution


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
    least_lead: A[
        float, "of the speed over every other in the range, logarithm of the odds in one window, [-]"
    ] = 5.0
    least_share: A[float, "of the probability within 2.5 % of the speed, in every window, [-]"] = 0.9


class Signal(NamedTuple):
    """What is searched: shape [sample, channel], of the raw signal and of its envelope."""

    values: Float
    rate: float


class Comb(NamedTuple):
    """Orders with the probability that each has a line."""

    orders: Float
    probable: float


def searched_signals(signal: Float, rate: float, top: float, settings: SpeedSettings) -> list[Signal]:
    """Bring the raw signal and its squared envelope to a rate that holds the highest order."""
    found = [_slow(signal, rate, top)]
    low, high = settings.envelope[0], min(settings.envelope[1], 0.45 * rate)
    if high > low + 500.0:
        power = squared_magnitude(analytic_band(signal - signal.mean(axis=0), rate, (low, high)))
        found.append(_slow(np.sqrt(power)[:, None], rate, min(top, 0.5 * (high - low))))
    return found


def _slow(values: Float, rate: float, top: float) -> Signal:
    """Take a signal to the lowest rate at which linear interpolation still holds its frequencies."""
    spectrum = np.fft.rfft(values - values.mean(axis=0), axis=0)
    length = min(len(values), int(2.0 * OVERSAMPLING * top * len(values) / rate))
    kept = length // 2 + 1
    cut = np.zeros((kept, values.shape[1]), complex)
    last = min(kept - 1, int(1.1 * top * len(values) / rate))
    cut[:last] = spectrum[:last]
    return Signal(np.fft.irfft(cut, length, axis=0) * (length / len(values)), rate * length / len(values))


def combs_of(
    orders: Sequence[FaultFrequencies], highest: float, count: int, settings: SpeedSettings
) -> list[Comb]:
    """List the orders of the shaft and of the bearing."""
    found = [Comb(np.arange(1.0, count + 1.0), settings.probable)]
    sides = np.array([-1.0, 0.0, 1.0])
    for each in orders:
        parts = ((each.bpfo, sides[1:2]), (each.bpfi, sides), (2.0 * each.bsf, each.ftf * sides))
        for order, beside in parts:
            several = np.add.outer(order * np.arange(1.0, 7.0), beside).reshape(-1)
            found.append(Comb(several[several <= highest], settings.probable_of_bearing))
    return found


class LineSpectrum(NamedTuple):
    """Odds of a line over frequency or order."""

    odds: dict[float, Float]  # by probability: odds of a line in every bin, logarithm
    step: float  # [Hz] or orders
    resolution: float


def line_spectrum(values: Float, rate: float, probable: set[float], flanks: bool = True) -> LineSpectrum:
    """Compute the odds that each bin has a line, by the probability of an order; on flanks too, or not."""
    count = len(values)
    window = np.hanning(count + 1)[:-1, None]
    padded = int(2 ** np.ceil(np.log2(_PADDING * count)))
    power = np.abs(np.fft.rfft((values - values.mean(axis=0)) * window, padded, axis=0)) ** 2
    bin_ = padded / count
    background = np.stack([local_background(axis, 60.0 * bin_) for axis in power.T], axis=1)
    floor = 1e-12 * max(float(power.max()), 1e-300)
    mean = np.mean(_MEDIAN_OVER_MEAN * power / np.maximum(background, floor), axis=1)
    if not flanks:
        flank = mean < 0.5 * maximum_filter1d(mean, 2 * round(_LOBE * bin_) + 1)
        mean = np.where(flank, np.minimum(mean, 1.0), mean)
    stray = float(np.clip(np.mean(mean > _STRAY_POWER), _LEAST_STRAY, _MOST_STRAY))
    noise, line = np.exp(-mean), 1.0 / (1.0 + mean) ** 2
    usual = np.log((1.0 - stray) * noise + stray * line)
    odds = {}
    for share in probable:
        here = max(share, 2.0 * stray)
        odds[share] = np.log((1.0 - here) * noise + here * line) - usual
    return LineSpectrum(odds, rate / padded, rate / count)


def weigh(spectrum: LineSpectrum, combs: list[Comb], frequencies: Float, settings: SpeedSettings) -> Float:
    """Add the odds of all orders at frequencies that are evenly spaced in their logarithm, shape [frequency].

    A part of the bearing may have no lines, and its lines may slip. One that would fall on a whole order is
    left to the shaft: a bin counts once.
    """
    total = odds_at(spectrum, combs[0], frequencies).sum(axis=0)
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
        odds = apart.astype(float) @ odds_at(spectrum, comb, padded)  # [slip, frequency]
        count = len(frequencies)
        shifted = np.stack([odds[k, reach + off : reach + off + count] for k, off in enumerate(offsets)])
        best = shifted.max(axis=0)
        found = best + np.log(weight / weight.sum() @ np.exp(shifted - best))
        total += np.logaddexp(log(1.0 - settings.faulty), log(settings.faulty) + found)
    return np.asarray(total)


def odds_at(spectrum: LineSpectrum, comb: Comb, frequencies: Float) -> Float:
    """Look up the odds of each order at each frequency, shape [order, frequency]."""
    odds = spectrum.odds[comb.probable]
    place = np.rint(np.outer(comb.orders, frequencies) / spectrum.step).astype(int)
    return np.asarray(np.where(place < len(odds), odds[np.minimum(place, len(odds) - 1)], 0.0))

"""Quantities of a vibration, of one axis: octaves, kurtosis, envelope, ring-down, wander."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.signal import find_peaks, medfilt, welch

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.features import (
    analytic_band,
    envelope,
    kurtosis,
    line_at,
    order_spectrum,
    resample_by_angle,
)

OCTAVES = ((500.0, 1000.0), (1000.0, 2000.0), (2000.0, 4000.0), (4000.0, 8000.0), (8000.0, 12_000.0))  # [Hz]
LOW_OCTAVES = 3  # those that a record of 12 kHz holds
USABLE = 0.47  # of the sampling rate, [-]
ENVELOPE_BAND = (3000.0, 6000.0)  # [Hz]
TOLERANCE = 0.02  # of a fault's order against geometry, [-]
WINDOW = 25.0  # revolutions of one envelope spectrum, whose resolution decides its noise
STEPS = 1024  # per revolution
BACKGROUND = 3.0  # orders, whose median is the noise around a line
CLEAR = 15.0  # level of a line from which its phase is followed, [dB]
AROUND = 0.08  # of the fault's order, in which its phase is followed
LAGS = np.arange(8, 65, 4)  # passages, longer than the filter around the line remembers
LOST = 1.0  # spread of the phase over the first of these lags, beyond which turns are miscounted, [rad]
RESONANCE = (4000.0, 12_000.0)  # [Hz]
AROUND_RESONANCE = 0.2  # of its frequency, to each side
LEAST_REACH = 8000.0  # to which a record must reach for a ring-down, [Hz]
LONGEST_LAG = 5e-3  # to which a decay is followed: strikes come again soon after, [s]


class Octaves(NamedTuple):
    """Root mean square in each of `OCTAVES`."""

    levels: A[Float, "shape [octave], NaN where the record does not reach to its end, [m/s^2]"]
    above: A[float, "from 4 to 12 kHz, NaN likewise, [m/s^2]"]


class EnvelopeLine(NamedTuple):
    """Line of a fault in the spectrum of the envelope of `ENVELOPE_BAND`."""

    depth: A[float, "amplitude over the mean of the envelope, [-]"]
    level: A[float, "amplitude over the median around, [dB]"]
    order: A[float, "where it is, [-]"]


class RingDown(NamedTuple):
    """Decay in the band of the loudest resonance from 4 kHz on."""

    frequency: A[float, "of the resonance, NaN where there is none, [Hz]"]
    time: A[float, "in which the amplitude falls to 1/e, [s]"]


@dataclass(frozen=True)
class Texture:
    """What one record is like."""

    levels: A[tuple[float, ...], "root mean square in each of `OCTAVES`, [m/s^2]"]
    above: A[float, "the same from 4 to 12 kHz, [m/s^2]"]
    kurtosis: A[float, "from 0.5 to 12 kHz, or to where the record reaches, [-]"]
    whole_kurtosis: A[float, "of the whole signal, [-]"]
    depth: A[float, "modulation depth of the envelope at the fault's line, [-]"]
    line: A[float, "line over noise, [dB]"]
    ring_frequency: A[float, "of the loudest resonance above 4 kHz, [Hz]"]
    ring_down: A[float, "time constant of the amplitude there, [s]"]
    wander: A[float, "spread of the passage period that adds up, NaN without a clear line, [-]"]

    @property
    def shares(self) -> Float:
        """Shares of power of the octaves that the record holds, shape [octave], sum 1."""
        return shares_of(self.levels)

    @property
    def low_shares(self) -> Float:
        """Shares of power of the octaves from 0.5 to 4 kHz, sum 1."""
        return shares_of(self.levels[:LOW_OCTAVES])

    @property
    def high_over_low(self) -> float:
        """Power from 4 to 12 kHz over that from 0.5 to 4 kHz, [dB]."""
        return 20.0 * math.log10(self.above / float(np.linalg.norm(self.levels[:LOW_OCTAVES])))


def measure(signal: Float, rate: float, angle: Float, order: float) -> Texture:
    """Measure one axis of a record.

    Parameters
    ----------
    signal : float64 array, shape [sample]
        [m/s^2].
    rate : float
        [Hz].
    angle : float64 array, shape [sample]
        Of the shaft, increasing, [rad].
    order : float
        Of the fault's line, [-].
    """
    signal = signal - signal.mean()
    octaves = measure_octaves(signal, rate)
    line = measure_line(signal, rate, angle, order)
    ring = measure_ring_down(signal, rate)
    band = (OCTAVES[0][0], min(OCTAVES[-1][1], USABLE * rate))
    return Texture(
        levels=tuple(map(float, octaves.levels)),
        above=octaves.above,
        kurtosis=kurtosis(analytic_band(signal, rate, band).real),
        whole_kurtosis=kurtosis(signal),
        depth=line.depth,
        line=line.level,
        ring_frequency=ring.frequency,
        ring_down=ring.time,
        wander=measure_wander(signal, rate, angle, line.order) if line.level >= CLEAR else math.nan,
    )


def shares_of(levels: tuple[float, ...] | Float) -> Float:
    """Compute the shares of power of the octaves with a level, NaN for the others."""
    power = np.square(np.asarray(levels, np.float64))
    return np.asarray(power / np.nansum(power))


def measure_octaves(signal: Float, rate: float) -> Octaves:
    """Measure the root mean square by octave."""
    frequency, density = welch(signal, rate, nperseg=min(8192, len(signal)))
    step = frequency[1]

    def level(low: float, high: float) -> float:
        if high > USABLE * rate + step:
            return math.nan
        return math.sqrt(step * float(density[(frequency >= low) & (frequency < high)].sum()))

    levels = np.array([level(low, high) for low, high in OCTAVES])
    return Octaves(levels, level(*RESONANCE))


def envelope_over_angle(signal: Float, rate: float, angle: Float) -> Float:
    """Compute the envelope of `ENVELOPE_BAND` over equal steps of the shaft angle, shape [step]."""
    band = (ENVELOPE_BAND[0], min(ENVELOPE_BAND[1], USABLE * rate))
    return resample_by_angle(envelope(signal, rate, band), angle, STEPS)


def measure_line(signal: Float, rate: float, angle: Float, order: float) -> EnvelopeLine:
    """Measure the line nearest to an order; medians over windows of `WINDOW` revolutions, half overlapping.

    An envelope 1 + m cos has the depth m; short strikes out of silence come near to 2.
    """
    steps = envelope_over_angle(signal, rate, angle)
    size = min(int(WINDOW * STEPS), len(steps))
    lines = [
        _line_of(steps[first : first + size], order)
        for first in range(0, len(steps) - size + 1, max(size // 2, 1))
    ]
    return EnvelopeLine(*(float(np.median(column)) for column in zip(*lines, strict=True)))


def _line_of(steps: Float, order: float) -> EnvelopeLine:
    spectrum = order_spectrum(steps, STEPS, 1.5 * order + BACKGROUND, BACKGROUND)
    near = np.flatnonzero(np.abs(spectrum.order - order) <= TOLERANCE * order)
    top = near[np.argmax(spectrum.amplitude[near])]
    found, level = line_at(spectrum, order, TOLERANCE * order)
    if not math.isfinite(level):
        found, level = float(spectrum.order[top]), float(spectrum.level[top])
    return EnvelopeLine(float(spectrum.amplitude[top] / steps.mean()), level, found)


def measure_wander(signal: Float, rate: float, angle: Float, order: float) -> float:
    """Measure the spread of the passage period that adds up from passage to passage, over the period.

    The phase of the line is followed in a band of `AROUND` to each side. What wanders makes its variance over
    a number of passages grow with that number, and the slope is reported. Noise, and strikes that come early
    or late about a place that cages and rollers keep, do not grow; where they hide the slope it is 0.
    """
    steps = envelope_over_angle(signal, rate, angle)
    band = ((1.0 - AROUND) * order, (1.0 + AROUND) * order)
    analytic = analytic_band(steps - steps.mean(), float(STEPS), band)
    turned = np.arange(len(steps)) / STEPS
    phase = np.unwrap(np.angle(analytic)) - 2.0 * np.pi * order * turned
    phase -= np.polyval(np.polyfit(turned, phase, 1), turned)  # the order was found to the width of a line
    margin = LAGS[0] / order  # the ends of the filter
    at = np.interp(np.arange(margin, turned[-1] - margin, 1.0 / order), turned, phase)
    lags = LAGS[len(at) >= 4 * LAGS]
    if np.std(at[LAGS[0] :] - at[: -LAGS[0]]) > LOST:
        return math.nan
    if len(lags) < 4:
        return math.nan
    growth = np.polyfit(lags, [np.mean((at[lag:] - at[:-lag]) ** 2) for lag in lags], 1)[0]
    return math.sqrt(max(float(growth), 0.0)) / (2.0 * math.pi)


def measure_ring_down(signal: Float, rate: float) -> RingDown:
    """Measure the decay in the band of the loudest resonance from 4 to 12 kHz, as far as sampled.

    The resonance is the highest peak of the spectrum after a median over 100 Hz, which tones do not pass. The
    autocorrelation of a band of `AROUND_RESONANCE` to each side decays as the resonance does, whether
    strikes or noise excite it. A line is fitted to the logarithm of its envelope, from where the filter has
    decayed to where the envelope rises or is below a tenth. What is shorter than about 1 / (band width)
    cannot be seen; what takes longer than `LONGEST_LAG` is a tone.
    """
    top = min(RESONANCE[1], USABLE * rate)
    if top < LEAST_REACH:
        return RingDown(math.nan, math.nan)
    frequency, density = welch(signal, rate, nperseg=min(round(rate / 12.0), len(signal)))
    smooth = medfilt(density, 2 * round(50.0 / frequency[1]) + 1)
    smooth[(frequency < RESONANCE[0]) | (frequency > top)] = 0.0
    peaks = find_peaks(smooth)[0]
    peaks = peaks[(frequency[peaks] > 1.02 * RESONANCE[0]) & (frequency[peaks] < 0.98 * top)]
    if not len(peaks):
        return RingDown(math.nan, math.nan)
    centre = float(frequency[peaks[np.argmax(smooth[peaks])]])
    low, high = (1.0 - AROUND_RESONANCE) * centre, min((1.0 + AROUND_RESONANCE) * centre, USABLE * rate)
    return RingDown(centre, _decay(signal, rate, low, high))


def _decay(signal: Float, rate: float, low: float, high: float) -> float:
    analytic = analytic_band(signal, rate, (low, high))
    power = np.abs(np.fft.fft(analytic, 2 * len(analytic))) ** 2
    correlation = np.abs(np.fft.ifft(power))[: round(LONGEST_LAG * rate)]
    correlation /= correlation[0]
    memory = rate / (high - low)  # of the filter, in samples
    first = math.ceil(1.2 * memory)
    ahead = max(round(0.5 * memory), 2)
    last = first
    while last + ahead < len(correlation) and correlation[last] >= 0.1:
        if correlation[last] <= correlation[last + 1 : last + ahead].min():
            break  # an echo, or a beat
        last += 1
    if last - first < 4:  # nothing outlasts the filter, unless two resonances beat
        comes_back = correlation[last : last + round(3.0 * memory)].max() > 0.3
        return math.nan if comes_back else first / rate / -math.log(float(correlation[first]))
    lag = np.arange(first, last) / rate
    slope = float(np.polyfit(lag, np.log(correlation[first:last]), 1)[0])
    return -1.0 / slope if slope < -1.0 / LONGEST_LAG else math.nan

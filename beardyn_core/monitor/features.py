"""Envelope, order tracking and line search: features of vibration for condition monitoring."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, floor
from typing import Annotated as A

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.fft import ifft, irfft, rfft

from beardyn_core.base.arrays import Float

_EDGE = 0.1  # share of the band in each of its cosine edges


def analytic_band(signal: Float, rate: float, band: tuple[float, float]) -> NDArray[np.complex128]:
    """Filter a band [Hz] without phase shift, with the Hilbert transform as imaginary part.

    Cosine edges of a tenth of the width of the band lie inside of it; samples are along the first axis.
    """
    return analytic_part(rfft(signal, axis=0), len(signal), rate, band)


def analytic_part(
    spectrum: NDArray[np.complex128], count: int, rate: float, band: tuple[float, float]
) -> NDArray[np.complex128]:
    """Cut a band out of a spectrum as `analytic_band` does out of a signal.

    Parameters
    ----------
    spectrum : complex128 array, shape [line, ...]
        ``scipy.fft.rfft`` of the signal along its first axis.
    count : int
        Samples of the signal.
    rate : float
        [Hz].
    band : tuple of 2 floats
        [Hz].

    Returns
    -------
    complex128 array, shape [sample, ...]
    """
    weighted, lines = _weigh_band(spectrum, count, rate, band)
    whole = np.zeros((count, *spectrum.shape[1:]), np.complex128)
    whole[lines] = 2.0 * weighted
    return np.asarray(ifft(whole, axis=0, overwrite_x=True), np.complex128)


def real_part(spectrum: NDArray[np.complex128], count: int, rate: float, band: tuple[float, float]) -> Float:
    """Compute the real part of `analytic_part`: the signal in a band.

    Parameters
    ----------
    spectrum, count, rate, band
        As of `analytic_part`.

    Returns
    -------
    float64 array, shape [sample, ...]
    """
    weighted, lines = _weigh_band(spectrum, count, rate, band)
    part = np.zeros_like(spectrum)
    part[lines] = weighted
    return np.asarray(irfft(part, count, axis=0), np.float64)


@lru_cache(maxsize=8)
def hann(count: int) -> Float:
    """Compute a Hann window without the zero at its end, kept for the next time."""
    window = np.hanning(count + 1)[:-1]
    window.flags.writeable = False
    return window


def _weigh_band(
    spectrum: NDArray[np.complex128], count: int, rate: float, band: tuple[float, float]
) -> tuple[NDArray[np.complex128], slice]:
    """Weigh the lines of a band with its cosine edges, and say which they are."""
    low, high = band
    step = rate / count
    # the line of half the sampling rate is its own mirror image: it belongs to no positive frequency
    lines = slice(max(ceil(low / step), 0), min(floor(high / step) + 1, (count + 1) // 2))
    frequency = step * np.arange(lines.start, max(lines.stop, lines.start))
    edge = _EDGE * (high - low)
    rise = np.clip((frequency - low) / edge, 0.0, 1.0)
    fall = np.clip((high - frequency) / edge, 0.0, 1.0)
    weight = (0.5 - 0.5 * np.cos(np.pi * rise)) * (0.5 - 0.5 * np.cos(np.pi * fall))
    return spectrum[lines] * weight.reshape(-1, *(1,) * (spectrum.ndim - 1)), lines


def envelope(signal: Float, rate: float, band: tuple[float, float]) -> Float:
    """Compute the envelope of the band-passed signal; of several axes the root of the sum of squares.

    Parameters
    ----------
    signal : float64 array, shape [sample] or [sample, axis]
    rate : float
        [Hz].
    band : tuple of 2 floats
        [Hz].

    Returns
    -------
    float64 array, shape [sample]
        Unit of the signal.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 4 (envelope analysis).
    """
    return np.sqrt(squared_magnitude(analytic_band(signal, rate, band)))


def squared_magnitude(analytic: NDArray[np.complex128]) -> Float:
    """Compute the squared envelope of an analytic signal, summed over its axes, shape [sample]."""
    square = analytic.real**2 + analytic.imag**2
    # numpy takes three times as long to add up a few columns
    return square if analytic.ndim == 1 else np.asarray(sum(square.T), np.float64)


def resample_by_angle(signal: Float, angle: Float, samples_per_revolution: int) -> Float:
    """Average a signal over equal steps of the shaft angle: computed order tracking.

    The cumulative integral over angle is interpolated, so every sample counts and what is faster than
    the new grid is averaged away.

    Parameters
    ----------
    signal : float64 array, shape [sample]
    angle : float64 array, shape [sample]
        Shaft angle at each sample, increasing, [rad].

    Returns
    -------
    float64 array, shape [step]
        Whole steps of angle only.
    """
    step = 2.0 * np.pi / samples_per_revolution
    edges = angle[0] + step * np.arange(int(np.floor((angle[-1] - angle[0]) / step)) + 1)
    cumulative = np.concatenate(([0.0], np.cumsum(0.5 * (signal[1:] + signal[:-1]) * np.diff(angle))))
    return np.diff(np.interp(edges, angle, cumulative)) / step


@dataclass(frozen=True)
class OrderSpectrum:
    """Amplitude spectrum over multiples of the shaft speed."""

    order: A[Float, "shape [line], cycles per shaft revolution, [-]"]
    amplitude: A[Float, "shape [line], one-sided peak amplitude, unit of the signal"]
    level: A[Float, "shape [line], amplitude over the local background, [dB]"]
    resolution: A[float, "one over the revolutions analysed, [-]"]


def order_spectrum(
    signal: Float, samples_per_revolution: int, highest_order: float, background_width: float
) -> OrderSpectrum:
    """Compute the spectrum of a signal sampled evenly in angle (Hann window, mean removed, padded four-fold).

    Parameters
    ----------
    signal : float64 array, shape [step]
    highest_order : float
        Where the result ends, [-].
    background_width : float
        Width of the neighbourhood whose median is the background, [-].
    """
    count = len(signal)
    window = hann(count)
    padded = 2 ** int(np.ceil(np.log2(4 * count)))
    # a constant times the window must not leak into the first orders: remove the weighted mean
    centred = signal - np.sum(signal * window) / np.sum(window)
    amplitude = np.abs(np.fft.rfft(centred * window, padded)) * (2.0 / np.sum(window))
    order = np.arange(len(amplitude)) * (samples_per_revolution / padded)
    kept = int(np.searchsorted(order, highest_order + background_width))
    background = local_background(amplitude[:kept], background_width / order[1])
    level = 20.0 * np.log10(np.maximum(amplitude[:kept], 1e-300) / np.maximum(background, 1e-300))
    last = int(np.searchsorted(order, highest_order, side="right"))
    return OrderSpectrum(order[:last], amplitude[:last], level[:last], samples_per_revolution / count)


def local_background(amplitude: Float, width: float) -> Float:
    """Compute the median of the neighbourhood of each line, which a few lines do not lift; width in lines."""
    size = int(min(max(3, round(width)), len(amplitude)))
    stride = max(1, size // 8)
    medians = np.median(sliding_window_view(amplitude, size)[::stride], axis=1)
    centres = 0.5 * (size - 1) + stride * np.arange(len(medians))
    return np.interp(np.arange(len(amplitude)), centres, medians)


def line_at(spectrum: OrderSpectrum, order: float, tolerance: float) -> tuple[float, float]:
    """Find the highest peak within a tolerance of an order: its order and its level over the background [dB].

    The order is refined by a parabola through three lines; the level is -inf where there is no local maximum.
    """
    step = spectrum.order[1]
    first = max(1, int(np.ceil((order - tolerance) / step)))
    last = min(len(spectrum.order) - 2, int(np.floor((order + tolerance) / step)))
    if last < first:
        return order, -np.inf
    level = spectrum.level
    here = slice(first, last + 1)
    # a flank of a stronger line outside the tolerance is no line
    peak = (level[here] >= level[first - 1 : last]) & (level[here] >= level[first + 1 : last + 2])
    if not peak.any():
        return order, -np.inf
    top = first + int(np.argmax(np.where(peak, level[here], -np.inf)))
    below, centre, above = level[top - 1 : top + 2]
    bend = below - 2.0 * centre + above
    shift = 0.5 * (below - above) / bend if bend < 0.0 else 0.0
    return float((top + shift) * step), float(centre)


def kurtosis(signal: Float) -> float:
    """Compute the kurtosis of the samples, 3 for Gaussian noise, [-].

    Parameters
    ----------
    signal : float64 array
    """
    square = (signal - signal.mean()) ** 2
    variance = square.mean()
    return float(np.mean(square**2) / variance**2) if variance > 0.0 else 0.0

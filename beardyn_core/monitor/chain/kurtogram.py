"""Band selection: where the envelope is most impulsive, by the spectral kurtosis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray
from scipy.fft import ifft

from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.wheel import quiet_samples

Complex = NDArray[np.complex128]

_EDGE = 0.1  # share of the band in each of its cosine edges
_STANDS_OUT = 5.0  # standard deviations; of some 20 bands none does so by chance


@dataclass(frozen=True)
class Band:
    """A band of frequency, and how impulsive the signal is in it."""

    low: A[float, "[Hz]"]
    high: A[float, "[Hz]"]
    kurtosis: A[float, "spectral kurtosis, 0 for stationary Gaussian noise, [-]"] = np.nan
    scatter: A[float, "standard deviation of that kurtosis in noise, [-]"] = np.nan


def by_kurtogram(stretch: Stretch, settings: MonitorSettings) -> Band:
    """Choose the band of largest spectral kurtosis, or the default one when none exceeds noise."""
    narrowest = max(settings.narrowest_band, settings.orders_in_band * stretch.shaft_frequency)
    bands = [
        band
        for band in fast_kurtogram(stretch, narrowest, settings, settings.lowest_band)
        if band.kurtosis > _STANDS_OUT * band.scatter
    ]
    return max(bands, key=lambda band: band.kurtosis, default=Band(*settings.band))


def fast_kurtogram(
    stretch: Stretch, narrowest: float, settings: MonitorSettings, lowest: float = 0.0
) -> list[Band]:
    """Compute spectral kurtosis in bands of the 1/3-binary tree: all, halves, thirds, quarters, sixths ...

    Bands come from wide to narrow; below the narrowest width [Hz] nothing is divided further, and bands that
    reach below the lowest frequency [Hz] are left out, as are sectors in which the wheel strikes the rail,
    and the ramps of the stretch.

    Notes
    -----
    The bands are cut out of one Fourier transform instead of filtered in a cascade. Of several axes
    the squared envelopes are added: with C the covariance of the axes in the band their kurtosis is
    <e^4> / tr(C)^2 - 1 - tr(C^2) / tr(C)^2, which is 0 in Gaussian noise however the axes correlate,
    and Antoni's <|c|^4> / <|c|^2>^2 - 2 for one axis.

    References
    ----------
    Antoni (2007), Fast computation of the kurtogram for the detection of transient faults, Mech. Syst.
    Signal Process. 21, sections 2 and 3.2 (1/3-binary tree).
    """
    half = 0.5 * stretch.rate
    spectrum = stretch.spectrum  # the weight of the mean, its first line, is 0 in every band
    quiet = quiet_samples(stretch, settings)
    parts = sorted(
        count for power in range(16) for count in (2**power, 3 * 2**power) if half / count >= narrowest
    )
    return [
        _band(spectrum, quiet, half, part / count, (part + 1) / count)
        for count in parts
        for part in range(count)
        if part / count * half >= lowest
    ]


def _band(spectrum: Complex, quiet: NDArray[np.bool_], half: float, low: float, high: float) -> Band:
    """Compute the kurtosis of the band between two shares of half the sampling rate."""
    first, last = (round(share * (len(spectrum) - 1)) for share in (low, high))
    inside = np.linspace(0.0, 1.0, last - first)[:, None]
    edges = np.sin(0.5 * np.pi * np.clip(np.minimum(inside, 1.0 - inside) / _EDGE, 0.0, 1.0)) ** 2
    coefficients = ifft(spectrum[first:last] * edges, axis=0)
    squared = np.sum(np.abs(coefficients) ** 2, axis=1)
    kept = quiet[np.arange(len(squared)) * len(quiet) // len(squared)]
    coefficients = coefficients[kept]
    covariance = coefficients.conj().T @ coefficients / len(coefficients)
    power = covariance.trace().real
    if not power > 0.0:
        return Band(low * half, high * half, 0.0, np.inf)
    spread = float(np.sum(np.abs(covariance) ** 2)) / power**2
    kurtosis = float(np.mean(squared[kept] ** 2)) / power**2 - 1.0 - spread
    return Band(low * half, high * half, kurtosis, float(np.sqrt(4.0 * spread / len(coefficients))))

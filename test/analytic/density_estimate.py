"""Estimate of a one-sided density from a profile, and its mean over bands."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


def estimate(height: Float, spacing: float, segment: int) -> tuple[Float, Float]:
    """Welch: mean of the periodograms of half-overlapping segments under Hann's window.

    Parameters
    ----------
    height : float64 array, shape [point]
    spacing : float
        [m].
    segment : int
        Points in a segment.

    Returns
    -------
    wavenumber : float64 array, shape [line], [rad/m]
    density : float64 array, shape [line]
        One-sided, over the angular wavenumber.
    """
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(segment) / segment)
    starts = range(0, len(height) - segment + 1, segment // 2)
    power = np.zeros(segment // 2 + 1)
    for start in starts:
        power += np.abs(np.fft.rfft(height[start : start + segment] * window)) ** 2
    # per radian and metre; twice for the negative half
    density = 2.0 * power * spacing / (len(starts) * np.sum(window**2)) / (2.0 * np.pi)
    return np.asarray(2.0 * np.pi * np.fft.rfftfreq(segment, spacing), np.float64), density


def band_ratios(wavenumber: Float, density: Float, target: Float, edges: Float) -> Float:
    """Variance within each band over that of the target.

    Parameters
    ----------
    edges : float64 array, shape [band + 1]
        [rad/m].
    """
    bands = itertools.pairwise(edges)
    inside = [(wavenumber >= low) & (wavenumber < high) for low, high in bands]
    return np.array([density[band].sum() / target[band].sum() for band in inside])

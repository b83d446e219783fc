"""RMS, kurtosis and crest factor, and how the RMS rose against the stretches before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.features import kurtosis


@dataclass(frozen=True)
class Levels:
    """Levels of the vibration in a fixed band."""

    rms: A[float, "of all axes together, [m/s^2]"] = np.nan
    kurtosis: A[float, "the largest of the axes, 3 for noise, [-]"] = np.nan
    crest: A[float, "peak over RMS, the largest of the axes, [-]"] = np.nan
    shaft_frequency: A[float, "mean, [Hz]"] = np.nan


def levels_of(passed: Float, speed: float) -> Levels:
    """Compute the levels of what has passed a band [m/s^2], shape [sample, axis]; speed in [Hz]."""
    power = np.mean(passed**2, axis=0)
    peak = np.abs(passed).max(axis=0)
    return Levels(
        rms=float(np.sqrt(power.sum())),
        kurtosis=max(kurtosis(axis) for axis in passed.T),
        crest=float(np.max(peak / np.sqrt(np.maximum(power, 1e-300)))),
        shaft_frequency=speed,
    )


def rise(levels: Levels, earlier: Sequence[Levels], like: float = 0.1) -> float:
    """Compare RMS with the median of earlier stretches at similar speed; NaN for fewer than three, [dB].

    Parameters
    ----------
    like : float
        Difference of speed within which stretches are compared, [-].
    """
    comparable = [
        other.rms
        for other in earlier
        if abs(other.shaft_frequency - levels.shaft_frequency) <= like * levels.shaft_frequency
    ]
    if len(comparable) < 3 or not levels.rms > 0.0:
        return float("nan")
    return float(20.0 * np.log10(levels.rms / np.median(comparable)))

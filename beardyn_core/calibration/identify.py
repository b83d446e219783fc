"""What recordings determine: how levels change with each unknown, and how far scatter and misfit carry it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from scipy.stats import t as student

from beardyn_core.base.arrays import Float
from beardyn_core.calibration.spectra import SHARE

PRIOR = 1.0 / np.sqrt(12.0)  # standard deviation of what is anywhere in the unit box alike
LEVEL = 0.9  # of the intervals


def common_slope(one: Float, other: Float, weight: Float) -> Float:
    """Take from two slopes, of twins with different seeds, what they have in common.

    Each slope is a difference of two runs, and rollers make it a little by chance. A number that nothing
    follows from would seem to be determined by that; what two seeds agree in is no chance.

    Parameters
    ----------
    one, other : float64 array, shape [level, unknown]
        [dB] over the unit box.
    weight : float64 array, shape [level]
        [1/dB^2].

    Returns
    -------
    float64 array, shape [level, unknown]
        Their mean, times the share of its weighted square that both agree in.
    """
    mean = 0.5 * (one + other)
    agreed, whole = weight @ (one * other), weight @ mean**2
    return np.asarray(mean * np.clip(agreed / np.maximum(whole, 1e-12), 0.0, 1.0), np.float64)


@dataclass(frozen=True, eq=False)
class Identified:
    """How far unknowns are determined, on the unit box."""

    gain: A[Float, "shape [unknown, level]: from a difference of levels to one of the unknowns, [1/dB]"]
    deviation: A[Float, "shape [unknown], standard deviation"]
    correlation: A[Float, "shape [unknown, unknown]"]
    factor: A[float, "from a standard deviation to half of the interval"]

    @property
    def share(self) -> Float:
        """Width of each interval over that of the box, shape [unknown], 1 for no news."""
        return np.asarray(np.minimum(2.0 * self.factor * self.deviation, 1.0), np.float64)


def identify(
    slope: Float,
    weight: Float,
    scatter: Float,
    excess: float,
    model: Float,
    shape: tuple[int, ...],
    twins: int,
) -> Identified:
    """Work out what is determined.

    Parameters
    ----------
    slope : float64 array, shape [level, unknown]
        See `common_slope`.
    weight : float64 array, shape [level]
        [1/dB^2].
    scatter : float64 array, shape [seed, level]
        Levels of twins on other tracks with other bearings of the lot, less their mean, [dB].
    excess : float
        Mean square of what the fit leaves over that of the tolerance, [-].
    model : float64 array, shape [band]
        By which a right twin is off, over an octave alike, [dB].
    shape : tuple of int
        Of levels: rides, axes, bands.
    twins : int
        On how many of them the fit rests.

    Returns
    -------
    Identified
        With the deviation that the scatter gives estimates by `gain`, once for the recordings and a share for
        the twins, and what octaves of the model give, times the root of the excess where it is above 1, and
        with what the box leaves open.

    Notes
    -----
    Levels of neighbouring bands scatter together. So the deviation does not come from weights but from what
    `gain` makes of whole spectra of other twins.
    """
    count = len(scatter)
    information = slope.T @ (weight[:, None] * slope)
    posterior = np.linalg.inv(information + np.eye(len(information)) / PRIOR**2)
    gain = posterior @ (slope.T * weight)
    drawn = scatter @ gain.T
    by_band = gain.reshape(-1, *shape).sum(axis=1) * model
    octaves = np.add.reduceat(by_band, np.arange(0, shape[-1], SHARE), axis=-1)
    octaves = octaves.reshape(len(gain), int(np.prod(octaves.shape[1:])))  # of no unknown, too
    moved = drawn.T @ drawn / max(count - 1, 1) * (1.0 + 1.0 / twins) + octaves @ octaves.T
    moved = moved * max(excess, 1.0)
    left = posterior @ posterior / PRIOR**2  # of the box, where levels say nothing
    covariance = moved + left
    deviation = np.sqrt(np.diag(covariance))
    scale = np.sqrt(np.diag(posterior))
    factor = float(student.ppf(0.5 + 0.5 * LEVEL, max(count - 1, 1)))
    return Identified(gain, deviation, posterior / np.outer(scale, scale), factor)

"""What recordings determine: how levels change with each unknown, and how far scatter and misfit carry it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from scipy.stats import t as student

from beardyn_core.arrays import Float

PRIOR = 1.0 / np.sqrt(12.0)  # standard deviation of what is anywhere in the unit box alike
LEVEL = 0.9  # of the intervals
_NEAREST = 6  # points for each coefficient of the local law


def slopes(points: Float, levels: Float, at: Float, free: list[int]) -> Float:
    """Work out how levels change with unknowns at a point, from the points tried around it.

    A law of second order without products is put through the nearest points, the nearer the more.

    Parameters
    ----------
    points : float64 array, shape [point, unknown]
    levels : float64 array, shape [point, level]
        [dB].
    at : float64 array, shape [unknown]
    free : list of int
        Unknowns that the points differ in.

    Returns
    -------
    float64 array, shape [level, unknown]
        [dB] over the unit box; 0 for unknowns that the points do not differ in.
    """
    found = np.zeros((levels.shape[1], points.shape[1]))
    if not free:
        return found
    away = points[:, free] - at[free]
    distance = np.sqrt((away**2).mean(axis=1))
    wanted = min(len(points), _NEAREST * (1 + 2 * len(free)))
    reach = max(float(np.sort(distance)[wanted - 1]), 1e-3)
    weight = np.exp(-((distance / reach) ** 2))
    terms = np.concatenate([np.ones((len(points), 1)), away, away**2], axis=1) * weight[:, None]
    ridge = 1e-6 * np.trace(terms.T @ terms) * np.eye(terms.shape[1])
    law = np.linalg.solve(terms.T @ terms + ridge, terms.T @ (levels * weight[:, None]))
    found[:, free] = law[1 : 1 + len(free)].T
    return found


@dataclass(frozen=True, eq=False)
class Identified:
    """How far unknowns are determined, on the unit box."""

    gain: A[Float, "shape [unknown, level]: from a difference of levels to one of the unknowns, [1/dB]"]
    deviation: A[Float, "shape [unknown], standard deviation"]
    correlation: A[Float, "shape [unknown, unknown]"]
    factor: A[float, "from a standard deviation to half of the interval"]

    @property
    def share(self) -> Float:
        """Width of each interval over that of what is anywhere in the box, shape [unknown], 1 for no news."""
        return np.asarray(np.minimum(self.deviation / PRIOR, 1.0), np.float64)


def identified(slope: Float, weight: Float, scatter: Float, excess: float) -> Identified:
    """Work out what is determined.

    Parameters
    ----------
    slope : float64 array, shape [level, unknown]
        See `slopes`.
    weight : float64 array, shape [level]
        [1/dB^2].
    scatter : float64 array, shape [seed, level]
        Levels of twins on other tracks with other bearings of the lot, less their mean, [dB].
    excess : float
        Mean square of what the fit leaves over that of the tolerance, [-].

    Returns
    -------
    Identified
        With the deviation that the scatter gives estimates by `gain`, once for the recordings and a share for
        the twins, times the root of the excess where it is above 1, and with what the box leaves open.

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
    moved = drawn.T @ drawn / max(count - 1, 1) * (1.0 + 1.0 / count) * max(excess, 1.0)
    left = posterior @ posterior / PRIOR**2  # of the box, where levels say nothing
    covariance = moved + left
    deviation = np.sqrt(np.diag(covariance))
    scale = np.sqrt(np.diag(posterior))
    factor = float(student.ppf(0.5 + 0.5 * LEVEL, max(count - 1, 1)))
    return Identified(gain, deviation, posterior / np.outer(scale, scale), factor)

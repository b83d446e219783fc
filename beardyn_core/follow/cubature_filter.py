"""A belief about slow numbers: carried on by a law, corrected by what is observed."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float

_LEAST = 1e-12  # of the largest variance, that is added before a root is taken


class Belief(NamedTuple):
    """Mean and covariance of numbers that are normally distributed."""

    mean: Float  # shape [number]
    covariance: Float  # shape [number, number]

    @property
    def deviation(self) -> Float:
        """Standard deviation of each, shape [number]."""
        return np.asarray(np.sqrt(np.diag(self.covariance)), np.float64)


class Corrected(NamedTuple):
    """A belief after an observation, and how far that was from what was expected."""

    belief: Belief
    misses: Float  # shape [observation], in standard deviations of what was expected


def predict_belief(belief: Belief, law: Callable[[Float], Float], noise: Float) -> Belief:
    """Carry a belief on by a law of any form.

    Parameters
    ----------
    belief : Belief
    law : callable
        Of points, shape [point, number], to where each is then.
    noise : float64 array, shape [number]
        Variance that the step adds.

    Notes
    -----
    Third-degree cubature: as many points on either side of the mean as there are numbers, all of one weight,
    so that a covariance stays one. It is exact for a linear law.

    References
    ----------
    Julier, Uhlmann (2004), Proc. IEEE 92, 401: the unscented filter, of which this is the one without a
    point in the middle; Arasaratnam, Haykin (2009), IEEE Trans. Autom. Control 54, 1254.
    """
    count = len(belief.mean)
    spare = _LEAST * max(float(np.diag(belief.covariance).max()), _LEAST)
    root = np.linalg.cholesky(belief.covariance + spare * np.eye(count)) * np.sqrt(count)
    points = law(np.concatenate([belief.mean + root.T, belief.mean - root.T]))
    mean = points.mean(axis=0)
    apart = points - mean
    return Belief(mean, apart.T @ apart / len(points) + np.diag(noise))


def correct_belief(belief: Belief, rows: Float, observed: Float, variance: Float) -> Corrected:
    """Correct a belief by sums of its numbers that were observed.

    Parameters
    ----------
    belief : Belief
    rows : float64 array, shape [observation, number]
        Of each number in each observation.
    observed : float64 array, shape [observation]
    variance : float64 array, shape [observation]
        Of their errors, which are independent.

    References
    ----------
    Bucy, Joseph (1968), Filtering for stochastic processes, the form that keeps a covariance one.
    """
    spread = belief.covariance @ rows.T
    expected = rows @ spread + np.diag(variance)
    gain = np.linalg.solve(expected, spread.T).T
    missed = observed - rows @ belief.mean
    rest = np.eye(len(belief.mean)) - gain @ rows
    covariance = rest @ belief.covariance @ rest.T + (gain * variance) @ gain.T
    after = Belief(belief.mean + gain @ missed, 0.5 * (covariance + covariance.T))
    return Corrected(after, missed / np.sqrt(np.diag(expected)))

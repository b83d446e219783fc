"""A number from descriptors by kernel ridge regression, with intervals that keep their promise."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, inf
from typing import Annotated as A
from typing import NamedTuple, Protocol

import numpy as np
from scipy.spatial.distance import cdist

from beardyn_core.arrays import Float

LEVELS = (0.5, 0.9)  # of intervals
LEAST_DOUBT = 0.2  # of the usual one: no run is told more surely


class Guess(NamedTuple):
    """A number of each run, on the scale on which it is learnt."""

    value: Float  # shape [run]
    low: Float  # shape [level, run]
    high: Float  # shape [level, run]


class Learnt(Protocol):
    """A number that was learnt from descriptors: `Regression` and `forest.Forest` are such."""

    @property
    def reach(self) -> Float:
        """Half of an interval over the expected error, shape [level]."""

    def value(self, standardised: Float) -> Float:
        """Give the number, shape [run], of standardised descriptors, shape [run, descriptor]."""

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""

    def on_line(self, offset: float, slope: float) -> Learnt:
        """Put the number on a line of itself."""

    def reaching(self, reach: Float) -> Learnt:
        """Set how wide intervals are, shape [level], over the expected error."""


def guess_of(learnt: Learnt, standardised: Float) -> Guess:
    """Give number and intervals."""
    value, error = learnt.value(standardised), learnt.expected_error(standardised)
    half = learnt.reach[:, None] * error
    return Guess(value, value - half, value + half)


@dataclass(frozen=True, eq=False)
class Regression:
    """Kernel ridge regression on directions of descriptor space, and the same of how far it errs.

    Descriptors are standardised, projected on the directions that vary with the number (partial least
    squares), and compared with those of every run learnt from by a Gaussian kernel. A second set of weights
    gives the logarithm of the error to be expected there. The widths of the intervals are quantiles of errors
    over expected errors of runs that were not learnt from: whatever the law of the errors, an interval of
    90 % holds the truth in 90 % of runs that come from where those came from.

    References
    ----------
    Wold, Sjostrom, Eriksson (2001), Chemometr. Intell. Lab. Syst. 58, 109: partial least squares.
    Lei, G'Sell, Rinaldo, Tibshirani, Wasserman (2018), J. Am. Stat. Assoc. 113, 1094, section 5.2: intervals
    from errors over expected errors (locally weighted conformal inference).
    """

    directions: A[Float, "shape [descriptor, direction], of standardised descriptors"]
    support: A[Float, "shape [run, direction], runs learnt from"]
    weights: A[Float, "shape [run], of the number"]
    doubt_weights: A[Float, "shape [run], of the logarithm of its error"]
    width: A[float, "of the Gaussian kernel: 1 / (2 width^2) of the squared distance"]
    mean: A[float, "of the number, as learnt"]
    doubt: A[float, "mean of the logarithm of its error"]
    reach: A[Float, "shape [level], half of an interval over the expected error"]

    def value(self, standardised: Float) -> Float:
        """Give the number, shape [run], of standardised descriptors, shape [run, descriptor]."""
        return self.mean + self._kernel(standardised) @ self.weights

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""
        learnt = self._kernel(standardised) @ self.doubt_weights
        return np.exp(self.doubt + np.maximum(learnt, np.log(LEAST_DOUBT)))

    def on_line(self, offset: float, slope: float) -> Regression:
        """Put the number on a line of itself."""
        return replace(self, weights=slope * self.weights, mean=offset + slope * self.mean)

    def reaching(self, reach: Float) -> Regression:
        """Set how wide intervals are, shape [level], over the expected error."""
        return replace(self, reach=reach)

    def solved(self, standardised: Float, values: Float, ridge: float) -> Float:
        """Solve for the weights, shape [run], that give values of the runs learnt from."""
        kernel = self._kernel(standardised)
        return np.asarray(np.linalg.solve(kernel + ridge * np.eye(len(kernel)), values), np.float64)

    def _kernel(self, standardised: Float) -> Float:
        place = standardised @ self.directions
        square = cdist(place, self.support, "sqeuclidean")
        return np.asarray(np.exp(-0.5 * square / self.width**2), np.float64)


def reach_of(errors: Float, expected: Float) -> Float:
    """Find how wide intervals must be, shape [level], over the expected error, of runs not learnt from.

    The quantile is that of one run more than there are, so that the promise holds for the next one; where
    there are too few runs for it, the interval is without end.
    """
    ratio = np.sort(np.abs(errors) / expected)
    found = []
    for level in LEVELS:
        place = ceil(level * (len(ratio) + 1))
        found.append(float(ratio[place - 1]) if place <= len(ratio) else inf)
    return np.array(found)

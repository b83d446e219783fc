"""A number from descriptors by kernel ridge regression."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np
from scipy.spatial.distance import cdist

from beardyn_core.base.arrays import Float

LEAST_DOUBT = 0.2  # of the usual one: no run is reported more surely


@dataclass(frozen=True, eq=False)
class Regression:
    """Kernel ridge regression on directions of descriptor space, and the same of how far it errs.

    Descriptors are standardised, projected on the directions that vary with the number (partial least
    squares), and compared with those of every run learnt from by a Gaussian kernel. A second set of weights
    gives the logarithm of the error to be expected there.

    References
    ----------
    Wold, Sjostrom, Eriksson (2001), Chemometr. Intell. Lab. Syst. 58, 109: partial least squares.
    """

    directions: A[Float, "shape [descriptor, direction], of standardised descriptors"]
    support: A[Float, "shape [run, direction], runs learnt from"]
    weights: A[Float, "shape [run], of the number"]
    doubt_weights: A[Float, "shape [run], of the logarithm of its error"]
    width: A[float, "of the Gaussian kernel: 1 / (2 width^2) of the squared distance"]
    mean: A[float, "of the number, as learnt"]
    doubt: A[float, "mean of the logarithm of its error"]

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

    def solve_weights(self, standardised: Float, values: Float, ridge: float) -> Float:
        """Solve for the weights, shape [run], that give values of the runs learnt from."""
        kernel = self._kernel(standardised)
        return np.asarray(np.linalg.solve(kernel + ridge * np.eye(len(kernel)), values), np.float64)

    def _kernel(self, standardised: Float) -> Float:
        place = standardised @ self.directions
        square = cdist(place, self.support, "sqeuclidean")
        return np.asarray(np.exp(-0.5 * square / self.width**2), np.float64)

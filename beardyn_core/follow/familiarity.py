"""Whether runs are of the kind learnt from: another box or sensor place lies far from all of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.optional import library

HELD = 0.95  # share of runs of the kind learnt from that count as familiar
_DIRECTIONS = 20  # along which runs differ most, where not all can be reported
_ALL_OF = 150  # columns of which all directions are kept
_LEAST_SIZE = 1e-6  # of a direction


@dataclass(frozen=True, eq=False)
class Familiarity:
    """Distance from the runs learnt from: along the directions in which they differ, and outside of them.

    Along principal directions a distance counts in standard deviations of the runs learnt from, shrunk as
    their number asks for. Where not all directions are kept, what is left outside counts in its usual size on
    runs that were not learnt from. The sum of both is 1 where one in twenty of such runs lies farther away.
    Another box shows in directions in which the runs learnt from hardly differ, so all are kept of the levels
    in which it rings.

    References
    ----------
    Jackson, Mudholkar (1979), Technometrics 21, 341: the two statistics of principal components.
    Ledoit, Wolf (2004), J. Multivar. Anal. 88, 365: how far standard deviations are to be shrunk.
    """

    columns: A[Int, "shape [column], places of the descriptors that are compared"]
    directions: A[Float, "shape [direction, column], of standardised descriptors"]
    sizes: A[Float, "shape [direction], standard deviation along each"]
    outside: A[float, "usual distance from the space of the directions"] = 1.0
    farthest: A[float, "distance that one in twenty runs of the kind exceeds"] = 1.0

    def distance(self, standardised: Float) -> Float:
        """Compute the distance of runs, shape [run], 1 at the bound."""
        along, outside = self._parts(standardised)
        return np.asarray(np.hypot(along, outside / self.outside) / self.farthest, np.float64)

    def set_bound(self, standardised: Float) -> Familiarity:
        """Set the bound by runs of the kind that were not learnt from, shape [run, descriptor]."""
        _, outside = self._parts(standardised)
        scaled = replace(self, outside=max(float(np.median(outside)), _LEAST_SIZE), farthest=1.0)
        distance = np.sort(scaled.distance(standardised))
        place = min(ceil(HELD * (len(distance) + 1)), len(distance))
        return replace(scaled, farthest=max(float(distance[place - 1]), _LEAST_SIZE))

    def _parts(self, standardised: Float) -> tuple[Float, Float]:
        chosen = standardised[:, self.columns]
        along, outside = chosen @ self.directions.T, np.zeros(len(chosen))
        if len(self.directions) < len(self.columns):
            outside = np.linalg.norm(chosen - along @ self.directions, axis=1)
        return np.sqrt(np.mean((along / self.sizes) ** 2, axis=1)), outside


def familiarity_of(standardised: Float, columns: Int) -> Familiarity:
    """Find the directions in which runs differ most, bounded by the same runs until others set the bound."""
    library("sklearn.covariance", "training", "sweep")
    from sklearn.covariance import ledoit_wolf_shrinkage

    chosen = standardised[:, columns]
    chosen = chosen - chosen.mean(axis=0)
    _, size, turn = np.linalg.svd(chosen, full_matrices=len(columns) <= _ALL_OF)
    shrinkage = float(ledoit_wolf_shrinkage(chosen, assume_centered=True))
    power = np.zeros(len(turn))
    power[: len(size)] = size**2 / len(chosen)
    power = (1.0 - shrinkage) * power + shrinkage * power.sum() / len(columns)
    count = len(columns) if len(columns) <= _ALL_OF else min(_DIRECTIONS, len(turn))
    sizes = np.sqrt(np.maximum(power[:count], _LEAST_SIZE**2))
    return Familiarity(columns, turn[:count], sizes).set_bound(standardised)

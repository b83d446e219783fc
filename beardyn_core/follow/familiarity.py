"""Whether runs are of the kind learnt from: another box or sensor place lies far from all of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float, Int

HELD = 0.95  # share of runs of the kind learnt from that count as familiar
_DIRECTIONS = 20  # along which runs differ most
_LEAST_SIZE = 1e-6  # of a direction, relative to the first


@dataclass(frozen=True, eq=False)
class Familiarity:
    """Distance from the runs learnt from: along the directions in which they differ, and outside of them.

    Along principal directions a distance counts in standard deviations of the runs learnt from. What is left
    outside of these directions counts in its usual size on runs that were not learnt from. The sum of both is
    1 where one in twenty of such runs lies farther away.

    References
    ----------
    Jackson, Mudholkar (1979), Technometrics 21, 341: the two statistics of principal components.
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

    def bounded(self, standardised: Float) -> Familiarity:
        """Set the bound by runs of the kind that were not learnt from, shape [run, descriptor]."""
        _, outside = self._parts(standardised)
        scaled = replace(self, outside=max(float(np.median(outside)), _LEAST_SIZE), farthest=1.0)
        distance = np.sort(scaled.distance(standardised))
        place = min(ceil(HELD * (len(distance) + 1)), len(distance))
        return replace(scaled, farthest=max(float(distance[place - 1]), _LEAST_SIZE))

    def _parts(self, standardised: Float) -> tuple[Float, Float]:
        chosen = standardised[:, self.columns]
        along = chosen @ self.directions.T
        outside = np.linalg.norm(chosen - along @ self.directions, axis=1)
        return np.sqrt(np.mean((along / self.sizes) ** 2, axis=1)), outside


def familiarity_of(standardised: Float, columns: Int) -> Familiarity:
    """Find the directions in which runs differ most, bounded by the same runs until others set the bound."""
    chosen = standardised[:, columns]
    _, size, turn = np.linalg.svd(chosen - chosen.mean(axis=0), full_matrices=False)
    count = max(1, min(_DIRECTIONS, int(np.count_nonzero(size > _LEAST_SIZE * max(size[0], _LEAST_SIZE)))))
    sizes = np.maximum(size[:count] / np.sqrt(len(chosen)), _LEAST_SIZE)
    return Familiarity(columns, turn[:count], sizes).bounded(standardised)

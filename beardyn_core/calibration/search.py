"""The search: an evolution strategy over the unit box of the unknowns, a twin for each point."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library

_SPREAD = 0.2  # of the first points, of the unit box
_POPULATION = 8
_SEED = 1
_STILL = 1e-3  # of the box and of the misfit: below, the search ends before its budget
_ROBUST = 2.0  # tolerances, beyond which a band counts by its distance and no more by the square of it


class Tried(NamedTuple):
    """A point that was tried."""

    point: Float  # of the unit box, shape [unknown]
    power: Float  # of the twin there; see `Beside.power`
    misfit: float  # [-]


def misfit(difference: Float, tolerance: Float) -> float:
    """Mean of a robust square of differences over their tolerances, [-]; 1 where all are as large as those.

    References
    ----------
    Charbonnier et al. (1997), IEEE Trans. Image Process. 6, 298: the pseudo-Huber function.
    """
    far = difference / tolerance
    return float(np.mean(2.0 * _ROBUST**2 * (np.sqrt(1.0 + (far / _ROBUST) ** 2) - 1.0)))


def weights(difference: Float, tolerance: Float) -> Float:
    """Weigh bands for least squares as `misfit` counts them, [1/dB^2]."""
    return np.asarray(
        1.0 / (tolerance**2 * np.sqrt(1.0 + (difference / tolerance / _ROBUST) ** 2)), np.float64
    )


def search(
    look: Callable[[Float], Tried],
    begin: Float,
    free: Sequence[int],
    budget: int,
) -> Iterator[Tried]:
    """Try points, as many as the budget at most, and give each.

    Parameters
    ----------
    look : callable
        Runs the twin at a point, shape [unknown].
    begin : float64 array, shape [unknown]
        Where the search begins; what is not free stays there.
    free : sequence of int
        Unknowns that are searched for.
    budget : int
        Twins.

    References
    ----------
    Hansen (2016), The CMA evolution strategy: a tutorial, arXiv:1604.00772.
    """
    chosen = list(free)

    def take(part: Float) -> Tried:
        point = begin.copy()
        point[chosen] = part
        return look(point)

    if len(chosen) < 2:  # the strategy needs two
        for share in np.linspace(-2.0, 2.0, budget) * _SPREAD if chosen else (0.0,):
            yield take(np.clip(begin[chosen] + share, 0.0, 1.0))
        return
    options = {
        "bounds": [0.0, 1.0],
        "popsize": _POPULATION,
        "seed": _SEED,
        "tolx": _STILL,
        "tolfun": _STILL,
        "verbose": -9,
        "verb_log": 0,
    }
    strategy = library("cma", "a calibration", "calibrate").CMAEvolutionStrategy(
        begin[chosen], _SPREAD, options
    )
    while budget > 0 and not strategy.stop():
        asked = strategy.ask()
        found = []
        for each in asked[:budget]:
            found.append(take(np.asarray(each, np.float64)))
            yield found[-1]
        budget -= len(found)
        if len(found) == len(asked):
            strategy.tell(asked, [each.misfit for each in found])

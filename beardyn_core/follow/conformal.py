"""A number that was learnt from descriptors, with intervals that keep their promise."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, inf
from typing import Annotated as A
from typing import NamedTuple, Protocol

import numpy as np

from beardyn_core.base.arrays import Float

LEVELS = (0.5, 0.9)  # of intervals


class Guess(NamedTuple):
    """A number of each run, on the scale on which it is learnt."""

    value: Float  # shape [run]
    low: Float  # shape [level, run]
    high: Float  # shape [level, run]


class Way(Protocol):
    """A way from descriptors to a number: `regression.Regression` and `forest.Forest` are such."""

    def value(self, standardised: Float) -> Float:
        """Give the number, shape [run], of standardised descriptors, shape [run, descriptor]."""

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""

    def on_line(self, offset: float, slope: float) -> Way:
        """Put the number on a line of itself."""


@dataclass(frozen=True, eq=False)
class Learnt:
    """The mean of what several ways give, such as of two tiers that were learnt from.

    The widths of the intervals are quantiles of errors over expected errors of runs that were not learnt
    from: whatever the law of the errors, an interval of 90 % holds the truth in 90 % of runs that come from
    where those came from.

    References
    ----------
    Lei, G'Sell, Rinaldo, Tibshirani, Wasserman (2018), J. Am. Stat. Assoc. 113, 1094, section 5.2: intervals
    from errors over expected errors (locally weighted conformal inference).
    """

    ways: A[tuple[Way, ...], "one or more"]
    reach: A[Float, "shape [level], half of an interval over the estimated error"]

    def value(self, standardised: Float) -> Float:
        """Give the number, shape [run], of standardised descriptors, shape [run, descriptor]."""
        return np.asarray(np.mean([each.value(standardised) for each in self.ways], axis=0), np.float64)

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""
        errors = [each.expected_error(standardised) for each in self.ways]
        return np.asarray(np.mean(errors, axis=0), np.float64)

    def guess(self, standardised: Float) -> Guess:
        """Give number and intervals."""
        value, error = self.value(standardised), self.expected_error(standardised)
        half = self.reach[:, None] * error
        return Guess(value, value - half, value + half)

    def on_line(self, offset: float, slope: float) -> Learnt:
        """Put the number on a line of itself."""
        return replace(self, ways=tuple(each.on_line(offset, slope) for each in self.ways))


def reach_of(errors: Float, expected: Float) -> Float:
    """Find how wide intervals must be, shape [level], over the estimated error, of runs not learnt from.

    The quantile is that of one run more than there are, so that the promise holds for the next one; where
    there are too few runs for it, the interval is without end.
    """
    ratio = np.sort(np.abs(errors) / expected)
    found = []
    for level in LEVELS:
        place = ceil(level * (len(ratio) + 1))
        found.append(float(ratio[place - 1]) if place <= len(ratio) else inf)
    return np.array(found)

"""Which part is spalled, by logistic regression, with sets of parts that hold their promise."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, isnan
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.follow.conformal import LEVELS


@dataclass(frozen=True)
class PartEstimate:
    """What is known of the condition of a bearing."""

    condition: A[str, "most probable: healthy, cup, cone or roller"]
    probability: A[float, "of it; NaN in a box that is not learnt from"]
    sets: A[tuple[tuple[str, ...], ...], "conditions that hold the truth in 50 % and in 90 % of runs"]

    @property
    def sentence(self) -> str:
        """Say it in a line."""
        if isnan(self.probability):
            return f"condition: {self.condition} is the likeliest; {' or '.join(self.sets[-1])} is possible"
        return (
            f"condition: {self.condition}, probability {100 * self.probability:.0f} %; "
            f"{100 * LEVELS[-1]:.0f} % set: {' or '.join(self.sets[-1])}"
        )


@dataclass(frozen=True, eq=False)
class PartRule:
    """Multinomial logistic regression on descriptors, and how improbable the truth may be.

    A condition belongs to the set of a level when its probability is at least what the truth has in that
    share of runs that were not learnt from.

    References
    ----------
    Sadinle, Lei, Wasserman (2019), J. Am. Stat. Assoc. 114, 223: least ambiguous sets with a given coverage.
    """

    conditions: A[tuple[str, ...], "that were learnt"]
    slope: A[Float, "shape [condition, descriptor], of standardised descriptors"]
    offset: A[Float, "shape [condition]"]
    least: A[Float, "shape [level], probability from which a condition belongs to the set"]

    def probabilities(self, standardised: Float) -> Float:
        """Give the probability of each condition, shape [run, condition]."""
        power = standardised @ self.slope.T + self.offset
        weight = np.exp(power - power.max(axis=1, keepdims=True))
        return np.asarray(weight / weight.sum(axis=1, keepdims=True), np.float64)

    def sets(self, probability: Float) -> list[tuple[str, ...]]:
        """List the conditions of each level by their probabilities, shape [condition]; never none."""
        ranked = [int(k) for k in np.argsort(-probability)]
        return [
            tuple(self.conditions[k] for k in ranked if probability[k] >= each or k == ranked[0])
            for each in self.least
        ]

    def estimate(self, standardised: Float) -> PartEstimate:
        """Estimate the condition from stretches of one run, whose mean probabilities are taken."""
        probability = self.probabilities(standardised).mean(axis=0)
        best = int(np.argmax(probability))
        return PartEstimate(self.conditions[best], float(probability[best]), tuple(self.sets(probability)))


def least_of(probability: Float) -> Float:
    """Find the probability that the truth has at least, shape [level], from those of runs not learnt from."""
    ranked = np.sort(probability)
    places = [floor((1.0 - level) * (len(ranked) + 1)) for level in LEVELS]
    return np.array([ranked[place - 1] if place else 0.0 for place in places])

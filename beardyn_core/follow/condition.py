"""Which part is spalled, believed over many stretches instead of from one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import log

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.fault_location import PartEstimate

_WEIGHT = 0.5  # of a stretch: stretches of one axlebox are not independent of each other
_SURE = 0.98  # that a single stretch counts as at most
_TURNS = 1e-3  # probability that the condition becomes another from one stretch to the next


@dataclass
class ConditionBelief:
    """Recursive Bayesian belief about the condition, with forgetting.

    Every condition is as probable at first. A stretch counts for half of its logarithm, and for no more than
    odds of 50 to 1; from stretch to stretch one in a thousand bearings becomes another. A clear stretch is
    believed at once where nothing was known; after twenty that were clearly of one condition it takes four to
    believe in another.
    """

    conditions: tuple[str, ...]
    probability: Float = field(init=False)

    def __post_init__(self) -> None:
        self.probability = np.full(len(self.conditions), 1.0 / len(self.conditions))

    def take(self, received: Mapping[str, float]) -> None:
        """Add what one stretch says of the probability of each condition."""
        count = len(self.conditions)
        least = (1.0 - _SURE) / max(count - 1, 1)
        said = np.array([min(max(received[each], least), _SURE) for each in self.conditions])
        turned = (1.0 - _TURNS) * self.probability + _TURNS / count
        power = np.log(turned) + _WEIGHT * (np.log(said) - log(1.0 / count))
        weight = np.exp(power - power.max())
        self.probability = weight / weight.sum()

    @property
    def estimate(self) -> PartEstimate:
        """The most probable condition, and the smallest sets with the probability of each level."""
        ranked = [int(k) for k in np.argsort(-self.probability)]
        total = np.cumsum(self.probability[ranked])
        sets = tuple(
            tuple(self.conditions[k] for k in ranked[: int(np.searchsorted(total, level)) + 1])
            for level in LEVELS
        )
        return PartEstimate(self.conditions[ranked[0]], float(self.probability[ranked[0]]), sets)

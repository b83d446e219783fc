"""A step of the follower as numbers that any tool plots."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite, nan

from beardyn_core.follow.estimator import Estimate
from beardyn_core.follow.following import Followed
from beardyn_core.record.plot_values import Bounded, code_of

_NAMES = {
    "temperature": "bearing_temperature",
    "width": "estimated_spall_width",
    "length": "estimated_spall_length",
    "depth": "estimated_spall_depth",
}


def follower_values(step: Followed) -> Mapping[str, Bounded]:
    """Give the values of a step by their names on ``values/<name>``; see `record.plot_values`."""
    part, remains = step.estimates.part, step.remains
    low, middle, high = (nan, nan, nan) if remains is None else remains.remaining
    return {
        "health": Bounded(code_of(step.health)),
        "condition": Bounded(nan if part is None else code_of(part.condition)),
        "condition_probability": Bounded(nan if part is None else part.probability),
        "strangeness": Bounded(step.estimates.strangeness),
        "remaining_mileage": Bounded(middle, low, high),
        **{
            _NAMES.get(each.quantity.name, each.quantity.name): _bounded(each)
            for each in step.estimates.quantities
        },
    }


def _bounded(estimate: Estimate) -> Bounded:
    """Give value and 90 % interval; the upper end is open where the number is at least so large."""
    low, high = estimate.intervals[-1] if estimate.intervals else (nan, nan)
    return Bounded(estimate.value, low, nan if isfinite(estimate.at_least) else high)

"""What a noun refuses: values outside their range, each a sentence, all at once."""

from __future__ import annotations

import math
from collections.abc import Iterator

from beardyn_core.errors import InputError


def refuse(problems: Iterator[str]) -> None:
    """Raise `InputError` with all problems, if there are any."""
    found = list(problems)
    if found:
        raise InputError(found)


def outside(owner: str, name: str, value: float, low: float, high: float, unit: str) -> Iterator[str]:
    """One sentence when the value is not within its range, or not a number."""
    if not low <= value <= high:  # also true for NaN
        yield f"{owner}: {name} is {value:g} {unit}; allowed is {low:g} to {high:g} {unit}"


def not_finite(owner: str, name: str, values: tuple[float, ...]) -> Iterator[str]:
    """One sentence when a component is infinite or not a number."""
    if not all(math.isfinite(value) for value in values):
        yield f"{owner}: {name} is {values}; every component must be a finite number"

"""One published number and ours."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

# The threshold of every trend: what changes or differs by less than this part of itself does neither.
HOLDS_FROM = 0.03


@dataclass(frozen=True)
class Anchor:
    """A published number, its source, and how we come to ours.

    `topic` begins the row on the validation page; `tolerance` is relative, `absolute` adds to it; `misses`
    says why ours is known to lie outside; `slow` rows are dynamic runs, and what warms
    slowly like another row. `beside`: ours is a formula of the
    literature that stands in `evidence` alone, or what the twin's sensors do not read; it does not count.
    `by_chance`: what ours may change by with any other draw; nearer to the limit no verdict is held against
    the page.
    `measured`: the reference comes from an instrument, not from a formula, a catalogue or another model.
    """

    topic: str
    quantity: str
    reference: float
    unit: str
    source: str
    ours: Callable[[], float]
    tolerance: float = 0.0
    absolute: float = 0.0
    misses: str = ""
    slow: bool = False
    beside: bool = False
    measured: bool = False
    by_chance: float = 0.0

    @property
    def allowed(self) -> float:
        """Return the deviation that is allowed, in the unit of the row."""
        return self.tolerance * abs(self.reference) + self.absolute

    def agrees(self, ours: float) -> bool:
        """Return whether our number is within the tolerance."""
        return bool(abs(ours - self.reference) <= self.allowed)

    def is_certain(self, ours: float) -> bool:
        """Return whether another draw would leave the verdict as it is."""
        return bool(abs(abs(ours - self.reference) - self.allowed) >= self.by_chance)


@dataclass(frozen=True)
class Finding:
    """What a study of a published trend found: whether it holds, in one sentence."""

    holds: bool
    sentence: str


def rises(values: Sequence[float]) -> bool:
    """Tell whether values end by `HOLDS_FROM` above where they began, and no step goes back by as much."""
    above = values[-1] > (1.0 + HOLDS_FROM) * values[0]
    return above and all(later >= (1.0 - HOLDS_FROM) * earlier for earlier, later in pairwise(values))


def falls(values: Sequence[float]) -> bool:
    """Tell whether the values rise the other way round."""
    return rises(values[::-1])


def turns(values: Sequence[float]) -> bool:
    """Tell whether some value lies above, or below, one before and one after it by more than `HOLDS_FROM`."""
    inner = [(values[:at], value, values[at + 1 :]) for at, value in enumerate(values)][1:-1]
    return any(
        value > (1.0 + HOLDS_FROM) * max(min(before), min(after))
        or (1.0 + HOLDS_FROM) * value < min(max(before), max(after))
        for before, value, after in inner
    )


@dataclass(frozen=True)
class Trend:
    """A published qualitative claim and the study that checks it; all of them are dynamic runs."""

    topic: str
    claim: str
    source: str
    study: Callable[[], Finding]
    misses: str = ""
    picture: str = ""

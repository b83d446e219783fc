"""One published number and ours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Anchor:
    """A published number, its source, and how we come to ours.

    `topic` begins the row on the validation page; `tolerance` is relative, `absolute` adds to it; `misses`
    says why ours is known to lie outside; `slow` rows are dynamic runs. `beside`: ours is a formula of the
    literature that stands in `evidence` alone, or what the twin's sensors do not read; it does not count.
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

    @property
    def allowed(self) -> float:
        """Return the deviation that is allowed, in the unit of the row."""
        return self.tolerance * abs(self.reference) + self.absolute

    def agrees(self, ours: float) -> bool:
        """Return whether our number is within the tolerance."""
        return bool(abs(ours - self.reference) <= self.allowed)


@dataclass(frozen=True)
class Finding:
    """What a study of a published trend found: whether it holds, in one sentence."""

    holds: bool
    sentence: str


@dataclass(frozen=True)
class Trend:
    """A published qualitative claim and the study that checks it; all of them are dynamic runs."""

    topic: str
    claim: str
    source: str
    study: Callable[[], Finding]
    misses: str = ""
    picture: str = ""

"""Result of a ladder: levels with cost and errors, those that meet an accuracy, the efficient ones."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.arrays import Float
from beardyn_core.study.ladder_errors import QuantityError
from beardyn_core.study.ladder_levels import Level
from beardyn_core.study.measures import FaultLine

# a dearer level has to lower the worst error by this share
_WORTH_IT = 0.1


@dataclass(frozen=True)
class Cost:
    """Wall time per simulated second, kernel and observation, compiling apart; over blocks."""

    median: A[float, "[-]"]
    lower: A[float, "quartile, [-]"]
    upper: A[float, "quartile, [-]"]


@dataclass(frozen=True)
class Score:
    """The worst of the asked errors in units of its limit."""

    quantity: str
    value: A[float, "1 is just good enough, [-]"]
    bar: A[float, "run-to-run band in the same unit, [-]"]

    @property
    def resolved(self) -> bool:
        """Whether the error is larger than the run-to-run band."""
        return self.value > self.bar


@dataclass(frozen=True)
class LevelResult:
    """A level with its cost and its errors."""

    level: Level
    runs: A[int, "how often it was run"]
    cost: Cost
    errors: A[tuple[QuantityError, ...], "empty when a run left the model's validity"]
    values: A[tuple[Float, ...], "one of `measures.MEASURES` each, means over the runs; empty likewise"]
    status: A[str, "``complete``, with warnings if there were any, or how a run ended"]

    def of(self, quantity: str) -> QuantityError | None:
        """Return the error of one quantity; ``None`` when there is none."""
        return next((error for error in self.errors if error.quantity == quantity), None)

    def score(self, asked: tuple[str, ...], accuracy: float) -> Score | None:
        """Return the worst of the asked errors; ``None`` when a run left the model's validity."""
        found = [
            Score(error.quantity, abs(worst.error) / limit, worst.band / limit)
            for error in self.errors
            if error.quantity in asked and (worst := error.worst) and (limit := error.limit(accuracy))
        ]
        return max(found, key=lambda score: score.value, default=None)

    def verdict(self, asked: tuple[str, ...], accuracy: float) -> str:
        """Return whether the level meets an accuracy: ``yes``, ``no``, ``open`` (the band hides it).

        ``-`` where the scene has nothing of what is asked for.
        """
        if not self.errors:
            return "no"
        found = {error.verdict(accuracy) for error in self.errors if error.quantity in asked and error.parts}
        if not found:
            return "-"
        return "no" if "no" in found else "open" if "open" in found else "yes"


@dataclass(frozen=True)
class Ladder:
    """The levels of a scene against its reference."""

    scene: str
    purpose: str
    accuracy: A[float, "asked for, a share"]
    asked: A[tuple[str, ...], "quantities that it is asked of"]
    settling: A[float, "before the comparison begins, [s]"]
    edges: A[tuple[float, ...], "ends of the windows that are compared, [s]"]
    revolutions: A[int, "whole cage revolutions from the first to the last edge; 0 when there is none"]
    fault_line: FaultLine | None
    reference: A[LevelResult, "its errors are those of its first run against the mean of all"]
    neighbour: A[LevelResult | None, "the reference with half of its laminae and twice its step"]
    rows: A[tuple[LevelResult, ...], "the levels in the order in which they were run"]
    interrupted: A[bool, "whether levels are missing"] = False

    def score(self, row: LevelResult) -> Score | None:
        """Return the worst of the asked errors of a row."""
        return row.score(self.asked, self.accuracy)

    def verdict(self, row: LevelResult) -> str:
        """Return whether a row meets the accuracy that is asked for."""
        return row.verdict(self.asked, self.accuracy)

    @property
    def by_cost(self) -> tuple[LevelResult, ...]:
        """The levels, the cheapest first."""
        return tuple(sorted(self.rows, key=lambda row: row.cost.median))

    @property
    def unconverged(self) -> tuple[str, ...]:
        """Quantities in which the reference and its coarser neighbour differ by more than the accuracy."""
        if self.neighbour is None:
            return ()
        return tuple(e.quantity for e in self.neighbour.errors if e.verdict(self.accuracy) == "no")

    @property
    def efficient(self) -> tuple[LevelResult, ...]:
        """Levels for which no cheaper one is as good, the cheapest first.

        As good is what is not worse by more than the run-to-run band and a tenth.
        """
        kept: list[tuple[LevelResult, Score]] = []
        scored = [(row, score) for row in self.rows if (score := self.score(row))]
        for row, score in sorted(scored, key=lambda pair: pair[0].cost.median):
            if all(_better(score, cheaper) for _, cheaper in kept):
                kept.append((row, score))
        return tuple(row for row, _ in kept)

    @property
    def cheapest(self) -> LevelResult | None:
        """The cheapest level that meets the accuracy."""
        meeting = [row for row in self.rows if self.verdict(row) == "yes"]
        return min(meeting, key=lambda row: row.cost.median, default=None)


def _better(one: Score, other: Score) -> bool:
    """Return whether the first is better beyond both bands together, and worth its cost."""
    return other.value - one.value > max(math.hypot(one.bar, other.bar), _WORTH_IT * other.value)

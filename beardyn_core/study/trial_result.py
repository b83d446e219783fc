"""Result of a trial: rates with their intervals, smallest sizes found, and a comparison of tiers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from math import nan
from statistics import median
from typing import Annotated as A

from scipy.stats import binomtest

from beardyn_core.monitor.chain import FAULTS as PARTS
from beardyn_core.scene.trial import HEALTHY, Cell, Trial
from beardyn_core.study.trial import TrialRun

CONFIDENCE = 0.95
FOUND_AT = 0.9  # detection rate from which a size counts as found


@dataclass(frozen=True)
class Rate:
    """Share of runs, with the confidence interval of its probability.

    References
    ----------
    Clopper, Pearson (1934), The use of confidence or fiducial limits illustrated in the case of the
    binomial, Biometrika 26: the exact interval.
    """

    count: int
    total: int
    low: A[float, "of the 95 % interval, [-]"]
    high: A[float, "of the 95 % interval, [-]"]

    @classmethod
    def of(cls, count: int, total: int) -> Rate:
        """Compute the rate of a count; its interval is 0 to 1 when there is nothing to count."""
        if total == 0:
            return cls(0, 0, 0.0, 1.0)
        interval = binomtest(count, total).proportion_ci(CONFIDENCE, method="exact")
        return cls(count, total, float(interval.low), float(interval.high))

    @property
    def value(self) -> float:
        """Count over total, NaN without any."""
        return self.count / self.total if self.total else float("nan")


@dataclass(frozen=True)
class SizeRow:
    """Runs with a spall of one size on one part."""

    fault: str
    size: A[float, "[m]"]
    found: A[Rate, "the right part named"]
    wrong: A[int, "another part named"]
    score: A[tuple[float, float, float], "smallest, median and largest of the part's own score, [dB]"]
    on_surfaces: A[tuple[tuple[str, Rate], ...], "the right part named, by surface of the matrix"] = ()


@dataclass(frozen=True)
class Smallest:
    """Smallest size of a fault that is found; ``None``: beyond the largest of the trial."""

    fault: str
    size: A[float | None, "from which on every size is found in at least 90 % of the runs, [m]"]
    low: A[float | None, "the same for the upper limits of the rates: lower end of the interval, [m]"]
    high: A[float | None, "the same for the lower limits, [m]"]


Pairs = Sequence[tuple[Cell, TrialRun]]
Where = Callable[[Cell], bool]


def everywhere(_cell: Cell) -> bool:
    """Take every cell of the matrix."""
    return True


@dataclass(frozen=True)
class TrialResult:
    """Result of a trial."""

    trial: Trial
    algorithm: str
    runs: A[tuple[tuple[Cell, TrialRun], ...], "those of the matrix"]
    checks: A[tuple[tuple[Cell, TrialRun], ...], "those in the tier of the check"]

    @classmethod
    def of(cls, trial: Trial, algorithm: str, runs: Sequence[TrialRun]) -> TrialResult:
        """Compute the result from the runs."""
        by_key = {run.key: run for run in runs}
        pairs = [(cell, by_key[cell.key]) for cell in trial.cells() if cell.key in by_key]
        own, checks = (
            tuple(pair for pair in pairs if pair[0].checks == is_check) for is_check in (False, True)
        )
        return cls(trial, algorithm, own, checks)

    @property
    def invalid(self) -> tuple[tuple[Cell, TrialRun], ...]:
        """Runs that left the model's validity, or whose monitor failed; no rate counts them."""
        return tuple(pair for pair in (*self.runs, *self.checks) if not pair[1].complete)

    def false_alarms(self, where: Where = everywhere) -> Rate:
        """Count healthy runs in which at least one analysis reported a fault."""
        return false_alarms(_choose_pairs(self.runs, where))

    def false_analyses(self, where: Where = everywhere) -> Rate:
        """Count analyses of healthy runs that reported a fault."""
        healthy = [run for cell, run in _choose_pairs(self.runs, where) if cell.fault == HEALTHY]
        return Rate.of(sum(run.alarms for run in healthy), sum(run.analyses for run in healthy))

    @property
    def alarmed(self) -> tuple[tuple[Cell, TrialRun], ...]:
        """Healthy runs with an alarm, those of the check too."""
        both = (*self.runs, *self.checks)
        return tuple(
            (cell, run) for cell, run in both if cell.fault == HEALTHY and run.complete and run.alarms
        )

    def detection(self, where: Where = everywhere) -> Rate:
        """Count faulty runs whose verdict names the faulty part."""
        return detection(_choose_pairs(self.runs, where))

    def sizes(self) -> list[SizeRow]:
        """Make a row for every part and size."""
        rows = []
        for fault, size in product(self.trial.faults, self.trial.sizes):
            pairs = [(c, r) for c, r in self.runs if (c.fault, c.size) == (fault, size) and r.complete]
            wrong = sum(run.verdict in PARTS and run.verdict != fault for _, run in pairs)
            scores = _spread([own_score(cell, run) for cell, run in pairs] if fault in PARTS else [])
            on_surfaces = tuple(
                (surface, detection([pair for pair in pairs if pair[0].surface == surface]))
                for surface in self.trial.surfaces
            )
            rows.append(SizeRow(fault, size, detection(pairs), wrong, scores, on_surfaces))
        return rows

    def smallest(self) -> list[Smallest]:
        """Find the smallest size found of every part."""
        rows = self.sizes()
        found = []
        for fault in self.trial.faults:
            own = sorted((row for row in rows if row.fault == fault), key=lambda row: -row.size)
            found.append(Smallest(fault, *(_from_on(own, limit) for limit in ("value", "high", "low"))))
        return found

    def agreement(self) -> Rate:
        """Count the checked runs with the same verdict in both tiers."""
        pairs = self.pairs()
        return Rate.of(sum(own.verdict == other.verdict for _, own, other in pairs), len(pairs))

    def score_differences(self) -> tuple[float, float, float]:
        """Compare the scores of found faults, check less matrix: smallest, median and largest, [dB]."""
        differences = [
            own_score(cell, other) - own_score(cell, own)
            for cell, own, other in self.pairs()
            if cell.fault != HEALTHY and own.verdict == other.verdict == cell.fault
        ]
        return _spread(differences)

    def pairs(self) -> list[tuple[Cell, TrialRun, TrialRun]]:
        """List runs of the matrix with their runs of the check, where both exist."""
        own = {cell.conditions: run for cell, run in self.runs if run.complete}
        return [
            (cell, own[cell.conditions], run)
            for cell, run in self.checks
            if run.complete and cell.conditions in own
        ]


def false_alarms(pairs: Pairs) -> Rate:
    """Count healthy runs in which at least one analysis reported a fault."""
    healthy = [run for cell, run in pairs if cell.fault == HEALTHY and run.complete]
    return Rate.of(sum(run.alarms > 0 for run in healthy), len(healthy))


def detection(pairs: Pairs) -> Rate:
    """Count faulty runs whose verdict names the faulty part."""
    faulty = [(cell, run) for cell, run in pairs if cell.fault != HEALTHY and run.complete]
    return Rate.of(sum(run.verdict == cell.fault for cell, run in faulty), len(faulty))


def own_score(cell: Cell, run: TrialRun) -> float:
    """Score of the part that is spalled, NaN of a cage, which has none, [dB]."""
    return run.scores[PARTS.index(cell.fault)] if cell.fault in PARTS else nan


def _choose_pairs(pairs: Pairs, where: Callable[[Cell], bool]) -> list[tuple[Cell, TrialRun]]:
    return [(cell, run) for cell, run in pairs if run.complete and where(cell)]


def _from_on(rows: Sequence[SizeRow], limit: str) -> float | None:
    """Find the smallest size from which on a limit of the rate stays at or above 90 %; largest first."""
    size = None
    for row in rows:
        if not getattr(row.found, limit) >= FOUND_AT:
            break
        size = row.size
    return size


def _spread(values: Sequence[float]) -> tuple[float, float, float]:
    return (min(values), median(values), max(values)) if values else (nan, nan, nan)

"""Result of a ladder: errors of its levels with the scatter between runs, and which levels are good enough.

The bearing is chaotic: two runs that begin a hair apart share statistics, not trajectories. Repeated runs
give the variance of every component twice: between whole runs, and between the same windows of two runs
(which feel the same load), divided by the number of windows. The larger one counts. The band of an error is
what the difference of two means stays in with 95 % probability, for all components of a quantity together
(Student's t with the degrees of freedom of Welch, Bonferroni). That some component errs is claimed with this
band. That all of them are good enough is claimed when each is, beyond its one-sided 95 %: a level that fails
anywhere passes with 5 % at most, however many components there are (intersection-union test: Berger 1982,
Technometrics 24, 295).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Annotated as A

import numpy as np
from scipy.stats import t as student

from beardyn_core.base.arrays import Float
from beardyn_core.study.ladder_levels import Level
from beardyn_core.study.measures import MEASURES, QUANTITIES, UNITS, FaultLine, Measure, Outcome

CONFIDENCE = 0.95
BAND_LIMIT_DB = 1.5


@dataclass(frozen=True)
class Part:
    """Error of one component."""

    name: str
    error: A[float, "signed; a share, or dB. NaN where the component does not exist"]
    band: A[float, "half-width of the run-to-run band, in the same unit"]
    margin: A[float, "what the error is larger by with 5 % probability at most, in the same unit"]

    @property
    def resolved(self) -> bool:
        """Whether the error is larger than the run-to-run band."""
        return abs(self.error) > self.band

    def verdict(self, limit: float) -> str:
        """Judge an error: ``yes`` surely within, ``no`` surely beyond, ``open`` in between."""
        if abs(self.error) + self.margin <= limit:
            return "yes"
        return "no" if abs(self.error) - self.band > limit else "open"


@dataclass(frozen=True)
class QuantityError:
    """Errors of the components of one quantity."""

    quantity: str
    unit: A[str, "``%`` (errors are shares) or ``dB``"]
    parts: A[tuple[Part, ...], "components that exist; empty when the scene has none"]

    @property
    def worst(self) -> Part | None:
        """The largest resolved error; the largest one when none is resolved."""
        resolved = [part for part in self.parts if part.resolved]
        return max(resolved or self.parts, key=lambda part: abs(part.error), default=None)

    def limit(self, accuracy: float) -> float:
        """Return the largest error at an accuracy (share): the accuracy itself, or 1.5 dB."""
        return accuracy if self.unit == "%" else BAND_LIMIT_DB

    def verdict(self, accuracy: float) -> str:
        """Judge all components together: ``yes``, ``no`` or ``open``."""
        found = {part.verdict(self.limit(accuracy)) for part in self.parts}
        return "no" if "no" in found else "open" if "open" in found else "yes"


def errors(found: Sequence[Outcome], reference: Sequence[Outcome]) -> tuple[QuantityError, ...]:
    """Compare the runs of a level with the runs of the reference.

    Parameters
    ----------
    found : sequence of Outcome
        One or more; with one its scatter is taken to be the reference's.
    reference : sequence of Outcome
        Two or more.

    Returns
    -------
    tuple of QuantityError, in the order of `QUANTITIES`
    """
    results = []
    for quantity in QUANTITIES:
        own = [(index, each) for index, each in enumerate(MEASURES) if each.quantity == quantity]
        tail = 0.5 * (1.0 - CONFIDENCE) / sum(len(measure.parts) for _, measure in own)
        parts = (_parts(measure, index, found, reference, tail) for index, measure in own)
        results.append(QuantityError(quantity, UNITS[quantity], tuple(chain.from_iterable(parts))))
    return tuple(results)


def _parts(
    measure: Measure, index: int, found: Sequence[Outcome], reference: Sequence[Outcome], tail: float
) -> list[Part]:
    here = _stack_runs(found, index).mean(axis=0)
    there = _stack_runs(reference, index).mean(axis=0)
    if np.all(np.isnan(there)):
        return []
    scatterers = found if len(found) > 1 else reference
    pairs = ((scatterers, found), (reference, reference))
    variances = np.array([variance(scattered, index) / len(runs) for scattered, runs in pairs])
    windows = len(reference[0].windows)
    degrees = windows * np.array([[len(scatterers) - 1], [len(reference) - 1]])
    scale = np.ones(1) if measure.scale is None else measure.scale(there)
    with np.errstate(divide="ignore", invalid="ignore"):
        error = (here - there) / scale
        variances = variances / scale**2
    if measure.weighed is not None:
        counts = measure.weighed(there)
        error = np.sqrt(np.mean(error[counts] ** 2, keepdims=True))
        variances = np.mean(variances[:, counts], axis=1, keepdims=True)
    total = variances.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        effective = np.where(total > 0.0, total**2 / (variances**2 / degrees).sum(axis=0), 1.0)
    band, margin = (student.isf(each, effective) * np.sqrt(total) for each in (tail, 1.0 - CONFIDENCE))
    columns = zip(measure.parts, error, band, margin, strict=True)
    return [Part(name, float(e), float(b), float(m)) for name, e, b, m in columns if math.isfinite(e)]


def variance(runs: Sequence[Outcome], index: int) -> Float:
    """Return the variance of a measure's components among two or more runs, shape [component].

    The larger of what whole runs and what equal windows of them say.
    """
    between = np.var(_stack_runs(runs, index), axis=0, ddof=1)
    windows = np.array([[window[index] for window in run.windows] for run in runs])
    spread = np.var(windows, axis=0, ddof=1)
    # a bin of the load distribution may be empty in a short window
    seen = np.isfinite(spread)
    total = np.where(seen, spread, 0.0).sum(axis=0)
    within = total / np.maximum(seen.sum(axis=0), 1) / windows.shape[1]
    return np.fmax(between, within)


def _stack_runs(runs: Sequence[Outcome], index: int) -> Float:
    return np.array([run.whole[index] for run in runs])


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
        """The levels, the least costly first."""
        return tuple(sorted(self.rows, key=lambda row: row.cost.median))

    @property
    def unconverged(self) -> tuple[str, ...]:
        """Quantities in which the reference and its coarser neighbour differ by more than the accuracy."""
        if self.neighbour is None:
            return ()
        return tuple(e.quantity for e in self.neighbour.errors if e.verdict(self.accuracy) == "no")

    @property
    def efficient(self) -> tuple[LevelResult, ...]:
        """Levels for which no cheaper one is as good, the least costly first.

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

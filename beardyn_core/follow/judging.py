"""Judge an estimator by runs that it has neither learnt from nor been calibrated with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float, Int
from beardyn_core.follow.conformal import LEVELS, Guess
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.labelled import Described, select_runs
from beardyn_core.follow.learning import calibrate_intervals, true_values, widen_intervals
from beardyn_core.follow.quantities import BY_NAME, Quantity

_CHANCE = 0.025  # that fewer runs than so many lie inside of an interval that is right
CROSSWISE = 10  # parts of a calibration set, each judged by the others


class Score(NamedTuple):
    """How an estimate does on runs that were not learnt from."""

    runs: int
    explained: float  # share of the variance
    error: float  # median, relative or in SI
    bias: float  # median, the same
    coverage: tuple[float, ...]  # share of runs whose truth lies inside of the intervals of 50 and 90 %


def is_held(score: Score) -> bool:
    """Tell whether as many runs lie inside of the last interval as it promises, but for chance (97.5 %)."""
    from scipy.stats import binom

    return score.coverage[-1] * score.runs >= float(binom.ppf(_CHANCE, score.runs, LEVELS[-1]))


class Guessed(NamedTuple):
    """A number of runs that were not learnt from next to its truth, on the scale on which it is learnt."""

    guess: Guess
    truth: Float  # shape [run]
    places: Int  # shape [run], of each among the runs that judge

    def taken(self, inside: NDArray[np.bool_]) -> Guessed:
        """Take some of the runs, shape [run]."""
        return Guessed(
            Guess(*(each[..., inside] for each in self.guess)), self.truth[inside], self.places[inside]
        )


class Judgement(NamedTuple):
    """What runs that were not learnt from say of an estimator."""

    guessed: dict[str, Guessed]  # by quantity
    part: dict[str, Any] | None  # see `part_score`

    @property
    def scores(self) -> dict[str, Score]:
        """How each number does that two runs or more have."""
        return {
            name: score_of(BY_NAME[name], each) for name, each in self.guessed.items() if len(each.truth) > 1
        }


def judged_by(estimator: Estimator, runs: Described) -> Judgement:
    """Judge an estimator by runs that it has neither learnt from nor been calibrated with."""
    return Judgement(guess_quantities(estimator, runs), part_score([part_judged(estimator, runs)]))


def judged_crosswise(
    estimator: Estimator, runs: Described, parts: int = CROSSWISE, own: Described | None = None
) -> Judgement:
    """Judge by the runs that calibrate: a part of their bearings at a time, put right by the rest of them.

    Parameters
    ----------
    estimator : Estimator
        That is not calibrated yet.
    runs : Described
    parts : int
    own : Described, optional
        Of the tier that was learnt from, which widen the intervals.
    """
    pieces, of_part = [], []
    for inside in crosswise_parts(runs.bearings, parts):
        by, asked = (
            calibrate_intervals(estimator, select_runs(runs, ~inside), straightened=True),
            select_runs(runs, inside),
        )
        by = by if own is None else widen_intervals(by, own)
        places = np.flatnonzero(inside)
        found = guess_quantities(by, asked)
        pieces.append({name: each._replace(places=places[each.places]) for name, each in found.items()})
        of_part.append(part_judged(by, asked))
    numbers = {
        name: _join_guesses([each[name] for each in pieces if name in each])
        for name in BY_NAME
        if any(name in each for each in pieces)
    }
    return Judgement(numbers, part_score(of_part))


def crosswise_parts(bearings: NDArray[Any], parts: int = CROSSWISE) -> Iterator[NDArray[np.bool_]]:
    """Part runs by their bearings: which are judged, part after part; none where there is one bearing."""
    names = sorted(set(bearings.tolist()))
    for k in range(min(parts, len(names)) if len(names) > 1 else 0):
        yield np.isin(bearings, names[k::parts])


def guess_quantities(estimator: Estimator, runs: Described) -> dict[str, Guessed]:
    """Guess every number of runs that have one and of which it is reported, by quantity."""
    standard = estimator.standardise(runs.descriptors)
    found = {}
    for name, each in estimator.regressions.items():
        values, inside = true_values(BY_NAME[name], runs)
        inside = inside & estimator.reports(BY_NAME[name], standard)
        if inside.any():
            found[name] = Guessed(each.guess(standard[inside]), values[inside], np.flatnonzero(inside))
    return found


def _join_guesses(pieces: Sequence[Guessed]) -> Guessed:
    guess = Guess(
        *(np.concatenate([each.guess[k] for each in pieces], axis=-1) for k in range(len(Guess._fields)))
    )
    return Guessed(
        guess,
        np.concatenate([each.truth for each in pieces]),
        np.concatenate([each.places for each in pieces]),
    )


def score_of(quantity: Quantity, found: Guessed) -> Score:
    """Judge guesses by the truth."""
    value, low, high = found.guess
    truth = found.truth
    missed = quantity.restored(value) - quantity.restored(truth)
    if quantity.relative:
        missed = missed / quantity.restored(truth)
    held = (low <= truth) & (truth <= high)
    return Score(
        len(truth),
        1.0 - float(np.mean((value - truth) ** 2) / np.var(truth)),
        float(np.median(np.abs(missed))),
        float(np.median(missed)),
        tuple(held.mean(axis=1).tolist()),
    )


class PartJudged(NamedTuple):
    """Conditions of runs that were not learnt from, next to what an estimator says of them."""

    right: NDArray[np.bool_]  # shape [run], whether the truth is the one that is named
    held: NDArray[np.bool_]  # shape [run, level], whether it is in the set


def part_judged(estimator: Estimator, runs: Described) -> PartJudged | None:
    """Judge which conditions are named, and which are in the sets of each level; `None` without a rule."""
    part = estimator.part
    if part is None or not len(runs.conditions):
        return None
    probability = part.probabilities(estimator.standardise(runs.descriptors))
    named = np.array(part.conditions)[probability.argmax(axis=1)]
    held = [
        [truth in each for each in part.sets(row)]
        for row, truth in zip(probability, runs.conditions, strict=True)
    ]
    return PartJudged(named == runs.conditions, np.array(held))


def part_score(pieces: Sequence[PartJudged | None]) -> dict[str, Any] | None:
    """Tell the shares of runs whose condition is named, and is in the sets; `None` without any."""
    there = [each for each in pieces if each is not None]
    if not there:
        return None
    right = np.concatenate([each.right for each in there])
    held = np.concatenate([each.held for each in there])
    return {"runs": len(right), "named": float(right.mean()), "coverage": held.mean(axis=0).tolist()}

"""Train an estimator on a set of labelled runs, and judge it on bearings that it has not seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.judging import is_held, judged_by, judged_crosswise
from beardyn_core.follow.labelled import (
    Described,
    check_alike,
    check_unseen,
    describe_runs,
    is_one_bearing,
    join_sets,
    plate_of,
    sampling_of,
)
from beardyn_core.follow.learning import FEWEST, calibrate_intervals, train_estimator, widen_intervals
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.population.labelled_set import TEST, TRAIN, VALIDATION, LabelledSet


def train(
    runs: LabelledSet,
    *,
    calibration: Sequence[LabelledSet] = (),
    test: LabelledSet | None = None,
    axes: tuple[str, ...] = AXES,
) -> Estimator:
    """Train an estimator on the training part of a set.

    Parameters
    ----------
    runs : LabelledSet
    calibration : sequence of LabelledSet
        Sets by which the widths of the intervals are set, such as one in a truer tier, next to the validation
        part of `runs` and its test part where that does not judge: the wider ones count.
    test : LabelledSet, optional
        All of it judges the estimator; by default `calibration` crosswise, or the test part of `runs`.
    axes : tuple of str
        Of the accelerometer.

    Raises
    ------
    InputError
        There are too few runs, or bearings of several drawings; another set is of another bearing, sampling
        rate or length, or of bearings that were learnt from.
    """
    about, plate = runs.about, plate_of(runs)
    for place, other in enumerate([*calibration, *([] if test is None else [test])]):
        check_alike(runs, other)
        check_unseen([runs, *calibration[:place]], other)
    across = bool(calibration) and test is None
    judges = TEST if test is None and not calibration else None  # part of `runs`
    spare = [part for part in (VALIDATION, TEST) if part != judges]
    seen, own = (
        describe_runs(runs, TRAIN, axes),
        join_sets([describe_runs(runs, part, axes) for part in spare]),
    )
    if len(seen.bearings) < FEWEST:
        raise InputError(
            f"{runs.folder}: has {len(seen.bearings)} complete runs to learn from; {FEWEST} are needed"
        )
    found = train_estimator(seen, plate, axes, *sampling_of(runs))
    learnt, held = found, join_sets([describe_runs(each, None, axes) for each in calibration] or [own])
    learnt, found = _calibrate_width(learnt, held, own if calibration else None)
    if across:
        judged = judged_crosswise(learnt, held, own=own)
    else:
        others = describe_runs(runs if test is None else test, judges, axes)
        judged = judged_by(found, others)
    quantities: Mapping[str, dict[str, Any]] = found.card["quantities"]
    for name, each in judged.scores.items():
        if name in found.regressions and is_held(each):
            quantities[name]["test"] = each._asdict()
    found = withhold(found, [name for name, each in judged.scores.items() if not is_held(each)])
    judge = f"{about['sweep']}, {TEST}" if test is None else test.about["sweep"]
    card = {
        "condition": judged.part,
        "quantities": dict(quantities),
        "set": about["sweep"],
        "runs": len(seen.bearings),
        "bearings": 1 if is_one_bearing(runs) else len(set(seen.bearings)),
        "calibration": [
            *(each.about["sweep"] for each in calibration),
            f"{about['sweep']}, {' and '.join(spare)}",
        ],
        "test": "calibration, crosswise" if across else judge,
        "levels": LEVELS,
        "code": about["code"],
        "training": "",  # of a set that was given
        "licence": about["licence"],
    }
    return replace(found, card=card)


def _calibrate(learnt: Estimator, held: Described, own: Described | None) -> Estimator:
    """Set the intervals by runs of a truer tier and by `own`, or without these by runs of the same tier."""
    found = calibrate_intervals(learnt, held, straightened=own is not None)
    return found if own is None else widen_intervals(found, own)


def _calibrate_width(
    learnt: Estimator, held: Described, own: Described | None
) -> tuple[Estimator, Estimator]:
    """Calibrate, without numbers of widths where too few runs set their interval; what was learnt, and it."""
    found = _calibrate(learnt, held, own)
    if learnt.wide is None or _has_interval(found, learnt):
        return learnt, found
    learnt = replace(learnt, wide=learnt.wide.without_numbers())
    return learnt, _calibrate(learnt, held, own)


def _has_interval(found: Estimator, learnt: Estimator) -> bool:
    """Tell whether enough spalls are taken for narrow ones to set the interval of their width."""
    return all(
        name in found.regressions and bool(np.isfinite(found.regressions[name].reach).all())
        for name in learnt.regressions
        if BY_NAME[name].of_passages
    )


def withhold(estimator: Estimator, names: Sequence[str]) -> Estimator:
    """Leave the numbers out of an estimator whose intervals do not hold: no interval has an end then."""
    kept = {
        name: replace(each, reach=np.full(len(LEVELS), np.inf)) if name in names else each
        for name, each in estimator.regressions.items()
    }
    return replace(estimator, regressions=kept)

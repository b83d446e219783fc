"""Train an estimator on a set of labelled runs, and judge it on bearings that it has not seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.errors import InputError
from beardyn_core.estimate.descriptors import AXES, describe, names_of
from beardyn_core.estimate.estimator import Estimator, farthest_of
from beardyn_core.estimate.quantities import QUANTITIES, Quantity
from beardyn_core.estimate.regression import LEVELS, Regression, reach_of
from beardyn_core.observe.chain import Stretch
from beardyn_core.population.labelled_set import TEST, TRAIN, VALIDATION, LabelledSet
from beardyn_core.population.store import library

LEAST_EXPLAINED = 0.3  # of the variance, on bearings not learnt from: below it nothing is said
_FEWEST = 40  # runs to learn a number from
_FOLDS = 5
_DIRECTIONS, _WIDTHS, _RIDGES = (6, 12, 20), (1.0, 2.0, 4.0), (0.01, 0.1, 1.0)  # what is tried, widths per root
_DOUBT_RIDGE = 3.0
_LEAST_ERROR = 1e-3  # of the spread of the number, so that its logarithm is finite
_USUAL = 20  # principal directions that strangeness looks along


class Described(NamedTuple):
    """Runs of a set as an estimator sees them."""

    descriptors: Float  # shape [run, descriptor]
    truth: dict[str, Float]  # by quantity, SI, shape [run]; NaN where a run has none
    bearings: NDArray[Any]  # shape [run], names


class Score(NamedTuple):
    """How an estimate does on runs that were not learnt from."""

    runs: int
    explained: float  # share of the variance
    error: float  # median, relative or in SI
    bias: float  # median, the same
    coverage: tuple[float, ...]  # share of runs whose truth lies inside of the intervals of 50 and 90 %


def described(runs: LabelledSet, part: str | None, axes: tuple[str, ...] = AXES) -> Described:
    """Work out the descriptors of the complete runs of a part of a set, of all parts with `None`."""
    chosen = runs.runs_of(part)
    columns = [each.label for each in QUANTITIES if each.label in runs.table]
    known = runs.labels_of(chosen, [*columns, "bearing_id"])
    plate = plate_of(runs)
    orders = frequencies(
        plate.roller_count, plate.pitch_diameter, plate.roller_diameter, plate.contact_angle
    )
    kept = [AXES.index(axis) for axis in axes]
    rows = np.full((len(chosen), len(names_of(axes))), np.nan)
    signals = runs.signals
    time, turned = np.asarray(signals.time_vibration), np.asarray(signals.time_shaft)
    rate = (len(time) - 1) / float(time[-1] - time[0])
    for k, run in enumerate(chosen):
        heard = np.asarray(runs.arrays["vibration"][int(run)], np.float64)[:, kept]
        angle = np.interp(time, turned, np.asarray(runs.arrays["shaft_angle"][int(run)], np.float64))
        rows[k] = describe(Stretch(rate, heard, angle, np.nan, 0), orders, plate, axes)
    truth = {
        each.name: np.asarray(known[each.label], np.float64)
        if each.label in columns
        else np.full(len(chosen), np.nan)
        for each in QUANTITIES
    }
    return Described(rows, truth, np.asarray(known["bearing_id"]).astype(str))


def plate_of(runs: LabelledSet) -> NamePlate:
    """Take the name plate of the bearings of a set.

    Raises
    ------
    InputError
        They are of several drawings.
    """
    keys = {"roller_count": "roller_count", "roller_diameter": "roller_diameter_m",
            "pitch_diameter": "pitch_diameter_m", "contact_angle": "contact_angle_rad"}  # fmt: skip
    several = runs.table["bearing"].nunique() > 1
    if several:
        names = ", ".join(sorted(runs.table["bearing"].unique()))
        raise InputError(f"{runs.folder}: has the bearings {names}; an estimator is for one")
    usual = runs.table.median(numeric_only=True)
    numbers = {name: float(usual[f"geometry_{column}"]) for name, column in keys.items()}
    return NamePlate(
        name=str(runs.table["bearing"].iloc[0]), **numbers | {"roller_count": round(numbers["roller_count"])}
    )


def trained(train: Described, plate: NamePlate, axes: tuple[str, ...], rate: float, stretch: float) -> Estimator:
    """Learn every quantity from the runs of a training part; intervals are not calibrated yet."""
    descriptors = train.descriptors
    with np.errstate(invalid="ignore"):
        middle, spread = np.nanmean(descriptors, axis=0), np.nanstd(descriptors, axis=0)
    middle, spread = np.nan_to_num(middle), np.where(spread > 1e-9, spread, 1.0)
    standard = np.nan_to_num((descriptors - middle) / spread, nan=0.0)
    sizes, usual = _principal(standard)
    regressions, card = {}, {}
    for quantity in QUANTITIES:
        values, inside = _known(quantity, train)
        if inside.sum() < _FEWEST or np.ptp(values[inside]) < 1e-12:
            continue
        learnt, explained = _learnt(standard[inside], values[inside], train.bearings[inside])
        card[quantity.name] = {"runs": int(inside.sum()), "explained": explained}
        if explained >= LEAST_EXPLAINED:
            regressions[quantity.name] = learnt
    farthest = farthest_of(standard @ usual.T / sizes)
    return Estimator(
        plate, axes, rate, stretch, middle, spread, usual, sizes, farthest, regressions, {"quantities": card}
    )


def calibrated(estimator: Estimator, runs: Described) -> Estimator:
    """Set the widths of the intervals by runs that were not learnt from."""
    standard = estimator.standardised(runs.descriptors)
    found = {}
    for quantity in QUANTITIES:
        if quantity.name in estimator.regressions:
            each = estimator.regressions[quantity.name]
            values, inside = _known(quantity, runs)
            errors = values[inside] - each.value(standard[inside])
            found[quantity.name] = replace(
                each, reach=reach_of(errors, each.expected_error(standard[inside]))
            )
    return replace(estimator, regressions=found)


def scores(estimator: Estimator, runs: Described) -> dict[str, Score]:
    """Judge an estimator by runs that it has neither learnt from nor been calibrated with."""
    standard = estimator.standardised(runs.descriptors)
    found = {}
    for quantity in QUANTITIES:
        values, inside = _known(quantity, runs)
        if quantity.name not in estimator.regressions or inside.sum() < 2:
            continue
        guess = estimator.regressions[quantity.name].guess(standard[inside])
        truth = values[inside]
        missed = quantity.restored(guess.value) - quantity.restored(truth)
        if quantity.relative:
            missed = missed / quantity.restored(truth)
        held = (guess.low <= truth) & (truth <= guess.high)
        found[quantity.name] = Score(
            int(inside.sum()),
            1.0 - float(np.mean((guess.value - truth) ** 2) / np.var(truth)),
            float(np.median(np.abs(missed))),
            float(np.median(missed)),
            tuple(held.mean(axis=1).tolist()),
        )
    return found


def train(
    runs: LabelledSet, *, calibration: Sequence[LabelledSet] = (), axes: tuple[str, ...] = AXES
) -> Estimator:
    """Train an estimator on the training part of a set.

    Parameters
    ----------
    runs : LabelledSet
    calibration : sequence of LabelledSet
        Sets by which the widths of the intervals are set, such as one in a truer tier; by default the
        validation part of `runs`.
    axes : tuple of str
        Of the accelerometer.

    Raises
    ------
    InputError
        There are too few runs, or bearings of several drawings.
    """
    about = runs.about
    seen = described(runs, TRAIN, axes)
    if len(seen.bearings) < _FEWEST:
        raise InputError(
            f"{runs.folder}: has {len(seen.bearings)} complete runs to learn from; {_FEWEST} are needed"
        )
    time = np.asarray(runs.signals.time_vibration)
    seconds = float(time[-1] - time[0])
    found = trained(seen, plate_of(runs), axes, (len(time) - 1) / seconds, seconds)
    held_back = [described(each, None, axes) for each in calibration] or [described(runs, VALIDATION, axes)]
    found = calibrated(found, _joined(held_back))
    judged = scores(found, described(runs, TEST, axes))
    quantities: Mapping[str, dict[str, Any]] = found.card["quantities"]
    for name, each in judged.items():
        quantities[name]["test"] = each._asdict()
    card = {
        "quantities": dict(quantities),
        "set": about["sweep"],
        "runs": len(seen.bearings),
        "bearings": len(set(seen.bearings)),
        "calibration": [each.about["sweep"] for each in calibration] or [f"{about['sweep']}, {VALIDATION}"],
        "levels": LEVELS,
        "code": about["code"],
        "licence": about["licence"],
    }
    return replace(found, card=card)


def _joined(parts: Sequence[Described]) -> Described:
    return Described(
        np.concatenate([each.descriptors for each in parts]),
        {name: np.concatenate([each.truth[name] for each in parts]) for name in parts[0].truth},
        np.concatenate([each.bearings for each in parts]),
    )


def _known(quantity: Quantity, runs: Described) -> tuple[Float, NDArray[np.bool_]]:
    """Give the truth of a quantity on the scale of learning, and which runs have one."""
    values = quantity.scaled(runs.truth[quantity.name])
    return values, np.isfinite(values)


def _principal(standard: Float) -> tuple[Float, Float]:
    """Find the directions in which runs differ most, shape [direction, descriptor], and their spreads."""
    _, size, turn = np.linalg.svd(standard - standard.mean(axis=0), full_matrices=False)
    count = min(_USUAL, int(np.count_nonzero(size > 1e-6 * size[0])))
    return size[:count] / np.sqrt(len(standard)), turn[:count]


def _learnt(standard: Float, values: Float, bearings: NDArray[Any]) -> tuple[Regression, float]:
    """Learn a number; gives with it the share of its variance that is explained on other bearings."""
    library("sklearn.kernel_ridge")
    from sklearn.model_selection import GroupKFold

    folds = list(GroupKFold(min(_FOLDS, len(set(bearings)))).split(standard, values, bearings))
    best, errors = np.inf, np.zeros(len(values))
    chosen = (_DIRECTIONS[0], _WIDTHS[0], _RIDGES[0])
    for setting in product(_DIRECTIONS, _WIDTHS, _RIDGES):
        missed = np.empty(len(values))
        for fit, rest in folds:
            learnt = _fitted(standard[fit], values[fit], setting)
            missed[rest] = values[rest] - learnt.value(standard[rest])
        if (square := float(np.mean(missed**2))) < best:
            best, errors, chosen = square, missed, setting
    learnt = _fitted(standard, values, chosen)
    return _doubting(learnt, standard, errors, float(np.std(values))), 1.0 - best / float(np.var(values))


def _fitted(standard: Float, values: Float, setting: tuple[int, float, float]) -> Regression:
    """Fit the number alone, its error everywhere alike."""
    from sklearn.cross_decomposition import PLSRegression
    from sklearn.kernel_ridge import KernelRidge

    count, width, ridge = setting
    mean = float(values.mean())
    directions = PLSRegression(min(count, *standard.shape), scale=False).fit(standard, values).x_rotations_
    directions = directions / np.std(standard @ directions, axis=0)
    support = standard @ directions
    reach = width * np.sqrt(directions.shape[1])
    ridged = KernelRidge(alpha=ridge, kernel="rbf", gamma=0.5 / reach**2).fit(support, values - mean)
    nothing = np.zeros(len(support))
    return Regression(
        directions, support, ridged.dual_coef_, nothing, reach, mean, 0.0, np.ones(len(LEVELS))
    )


def _doubting(learnt: Regression, standard: Float, errors: Float, spread: float) -> Regression:
    """Learn where the number errs more and where less, from errors on bearings not learnt from."""
    from sklearn.kernel_ridge import KernelRidge

    size = np.log(np.maximum(np.abs(errors), _LEAST_ERROR * spread))
    mean = float(size.mean())
    ridged = KernelRidge(alpha=_DOUBT_RIDGE, kernel="rbf", gamma=0.5 / learnt.width**2)
    ridged.fit(learnt.support, size - mean)
    return replace(learnt, doubt_weights=ridged.dual_coef_, doubt=mean)

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
from beardyn_core.follow.descriptors import AXES, describe, names_of
from beardyn_core.follow.estimator import Estimator, farthest_of
from beardyn_core.follow.part import PartRule, least_of
from beardyn_core.follow.quantities import QUANTITIES, Quantity
from beardyn_core.follow.regression import LEVELS, Regression, reach_of
from beardyn_core.observe.chain import Stretch
from beardyn_core.optional import library
from beardyn_core.population.labelled_set import TEST, TRAIN, VALIDATION, LabelledSet

LEAST_EXPLAINED = 0.3  # of the variance, on bearings not learnt from: below it nothing is said
_FEWEST = 40  # runs to learn a number from
_FOLDS = 5
# what is tried: descriptors that are kept, directions among them, width of the kernel, ridge
_SCREENS, _DIRECTIONS, _WIDTHS, _RIDGES = (20, 80, 1000), (2, 6, 16), (1.0, 2.0, 4.0), (0.01, 0.1, 1.0)
_DOUBT_RIDGE = 3.0
_LEAST_ERROR = 1e-3  # of the spread of the number, so that its logarithm is finite
_OF_MONITOR = ("score", "kurtosis", "crest", "strongest", "way")  # descriptors that tell the parts apart
_USUAL = 20  # principal directions that strangeness looks along


class Described(NamedTuple):
    """Runs of a set as an estimator sees them."""

    descriptors: Float  # shape [run, descriptor]
    truth: dict[str, Float]  # by quantity, SI, shape [run]; NaN where a run has none
    bearings: NDArray[Any]  # shape [run], names
    conditions: NDArray[Any]  # shape [run]


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
    known = runs.labels_of(chosen, [*columns, "bearing_id", "condition"])
    plate = plate_of(runs)
    orders = frequencies(plate.roller_count, plate.pitch_diameter, plate.roller_diameter, plate.contact_angle)
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
    return Described(
        rows, truth, *(np.asarray(known[name]).astype(str) for name in ("bearing_id", "condition"))
    )


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
    numbers: dict[str, Any] = {name: float(usual[f"geometry_{column}"]) for name, column in keys.items()}
    numbers["roller_count"] = round(numbers["roller_count"])
    return NamePlate(name=str(runs.table["bearing"].iloc[0]), **numbers)


def trained(
    train: Described, plate: NamePlate, axes: tuple[str, ...], rate: float, stretch: float
) -> Estimator:
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
        bearings = train.bearings[inside]
        learnt, errors = _learnt(standard[inside], values[inside], bearings)
        explained = 1.0 - float(np.mean(errors**2) / np.var(values[inside]))
        ends = np.array([(0.5 - 0.5 * level, 0.5 + 0.5 * level) for level in LEVELS])
        ranges = quantity.restored(np.quantile(values[inside], ends)).tolist()
        card[quantity.name] = {"runs": int(inside.sum()), "explained": explained, "ranges": ranges,
                               "shared": shared_of(errors, bearings)}  # fmt: skip
        if explained >= LEAST_EXPLAINED:
            regressions[quantity.name] = learnt
    farthest = farthest_of(standard @ usual.T / sizes)
    return Estimator(
        plate, axes, rate, stretch, middle, spread, usual, sizes, farthest, regressions,
        _part_of(standard, train.conditions, names_of(axes)), {"quantities": card},
    )  # fmt: skip


def calibrated(estimator: Estimator, runs: Described, *, straightened: bool = False) -> Estimator:
    """Set the widths of the intervals by runs that were not learnt from.

    With `straightened` numbers are first put on the line that fits those runs, which takes out what a tier
    that learns has too much or too little of; the errors that remain are those of each run by a line through
    the others.
    """
    standard = estimator.standardised(runs.descriptors)
    found = {}
    for quantity in QUANTITIES:
        if quantity.name in estimator.regressions:
            each = estimator.regressions[quantity.name]
            values, inside = _known(quantity, runs)
            given = each.value(standard[inside])
            errors = values[inside] - given
            if straightened:
                each, errors = _straightened(each, given, values[inside])
            found[quantity.name] = replace(
                each, reach=reach_of(errors, each.expected_error(standard[inside]))
            )
    part = estimator.part
    if part is not None:
        inside = np.isin(runs.conditions, part.conditions)
        places = [part.conditions.index(each) for each in runs.conditions[inside]]
        truth = part.probabilities(standard[inside])[np.arange(len(places)), places]
        part = replace(part, least=least_of(truth))
    return replace(estimator, regressions=found, part=part)


def _straightened(learnt: Regression, given: Float, values: Float) -> tuple[Regression, Float]:
    """Put a regression on the line through runs not learnt from; gives their errors too, each left out."""
    table = np.stack([np.ones(len(given)), given], axis=1)
    turn = np.linalg.pinv(table)
    offset, slope = turn @ values
    errors = (values - table @ (turn @ values)) / (1.0 - np.einsum("ij,ji->i", table, turn))
    return replace(learnt, weights=slope * learnt.weights, mean=offset + slope * learnt.mean), errors


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


def part_score(estimator: Estimator, runs: Described) -> dict[str, Any] | None:
    """Judge which conditions are named, and which are in the sets of each level; `None` without a rule."""
    part = estimator.part
    if part is None or not len(runs.conditions):
        return None
    probability = part.probabilities(estimator.standardised(runs.descriptors))
    named = np.array(part.conditions)[probability.argmax(axis=1)]
    held = [
        [truth in each for each in part.sets(row)]
        for row, truth in zip(probability, runs.conditions, strict=True)
    ]
    return {
        "runs": len(named),
        "named": float(np.mean(named == runs.conditions)),
        "coverage": np.mean(held, axis=0).tolist(),
    }


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
        Sets by which the widths of the intervals are set, such as one in a truer tier; by default the
        validation part of `runs`.
    test : LabelledSet, optional
        All of it judges the estimator; by default the test part of `runs`.
    axes : tuple of str
        Of the accelerometer.

    Raises
    ------
    InputError
        There are too few runs, or bearings of several drawings.
    """
    about = runs.about
    seen = _joined(
        [described(runs, part, axes) for part in ((TRAIN, VALIDATION) if calibration else (TRAIN,))]
    )
    if len(seen.bearings) < _FEWEST:
        raise InputError(
            f"{runs.folder}: has {len(seen.bearings)} complete runs to learn from; {_FEWEST} are needed"
        )
    time = np.asarray(runs.signals.time_vibration)
    seconds = float(time[-1] - time[0])
    found = trained(seen, plate_of(runs), axes, (len(time) - 1) / seconds, seconds)
    held_back = [described(each, None, axes) for each in calibration] or [described(runs, VALIDATION, axes)]
    found = calibrated(found, _joined(held_back), straightened=bool(calibration))
    others = described(runs, TEST, axes) if test is None else described(test, None, axes)
    judged = scores(found, others)
    quantities: Mapping[str, dict[str, Any]] = found.card["quantities"]
    for name, each in judged.items():
        quantities[name]["test"] = each._asdict()
    card = {
        "condition": part_score(found, others),
        "quantities": dict(quantities),
        "set": about["sweep"],
        "runs": len(seen.bearings),
        "bearings": len(set(seen.bearings)),
        "calibration": [each.about["sweep"] for each in calibration] or [f"{about['sweep']}, {VALIDATION}"],
        "test": f"{about['sweep']}, {TEST}" if test is None else test.about["sweep"],
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
        np.concatenate([each.conditions for each in parts]),
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


def shared_of(errors: Float, bearings: NDArray[Any]) -> float:
    """Find the share of the errors' variance that runs of one bearing and box have in common, 0 to 1.

    It is their correlation from run to run; two runs of a bearing differ in load, speed, track and fault.
    """
    together = [errors[bearings == each] for each in set(bearings.tolist())]
    several = [each for each in together if len(each) > 1]
    pairs = [(each.sum() ** 2 - each @ each) / (len(each) * (len(each) - 1)) for each in several]
    return float(np.clip(np.mean(pairs) / np.mean(errors**2), 0.0, 1.0)) if pairs else 1.0


def _learnt(standard: Float, values: Float, bearings: NDArray[Any]) -> tuple[Regression, Float]:
    """Learn a number; gives with it the errors on bearings that are left out."""
    library("sklearn.cross_decomposition", "training", "sweep")
    from sklearn.model_selection import GroupKFold

    folds = list(GroupKFold(min(_FOLDS, len(set(bearings)))).split(standard, values, bearings))
    best, errors = np.inf, np.zeros(len(values))
    screen, chosen = _SCREENS[0], (_DIRECTIONS[0], _WIDTHS[0], _RIDGES[0])
    for kept in _SCREENS:
        directions = [_directions(standard[fit], values[fit], kept) for fit, _ in folds]
        for setting in product(_DIRECTIONS, _WIDTHS, _RIDGES):
            missed = np.empty(len(values))
            for (fit, rest), along in zip(folds, directions, strict=True):
                learnt = _fitted(standard[fit], values[fit], along, setting)
                missed[rest] = values[rest] - learnt.value(standard[rest])
            if (square := float(np.mean(missed**2))) < best:
                best, errors, screen, chosen = square, missed, kept, setting
    learnt = _fitted(standard, values, _directions(standard, values, screen), chosen)
    return _doubting(learnt, standard, errors, float(np.std(values))), errors


def _part_of(standard: Float, conditions: NDArray[Any], names: tuple[str, ...]) -> PartRule | None:
    """Learn which part is spalled from what a monitor works out; `None` of one condition alone."""
    if len(set(conditions)) < 2:
        return None
    from sklearn.linear_model import LogisticRegression

    heard = [k for k, name in enumerate(names) if name.startswith(_OF_MONITOR)]
    learnt = LogisticRegression(max_iter=2000).fit(standard[:, heard], conditions)
    slope = np.zeros((len(learnt.classes_), len(names)))
    # of two conditions the library keeps the second one's power alone
    slope[-len(learnt.coef_) :, heard], offset = learnt.coef_, np.zeros(len(slope))
    offset[-len(learnt.intercept_) :] = learnt.intercept_
    return PartRule(tuple(map(str, learnt.classes_)), slope, offset, np.zeros(len(LEVELS)))


def _directions(standard: Float, values: Float, kept: int) -> Float:
    """Find the directions that vary with a number, shape [descriptor, direction], the first ones most.

    Descriptors beyond the `kept` that are best correlated with the number are left out: where runs are few,
    hundreds of them fit any number.
    """
    from sklearn.cross_decomposition import PLSRegression

    centred = standard - standard.mean(axis=0)
    size = np.maximum(np.linalg.norm(centred, axis=0), 1e-9)
    heard = np.argsort(-np.abs(centred.T @ (values - values.mean())) / size)[:kept]
    count = min(max(_DIRECTIONS), len(standard) - 1, len(heard))
    found = PLSRegression(count, scale=False).fit(standard[:, heard], values).x_rotations_
    directions = np.zeros((standard.shape[1], count))
    directions[heard] = found / np.std(standard[:, heard] @ found, axis=0)
    return directions


def _fitted(
    standard: Float, values: Float, directions: Float, setting: tuple[int, float, float]
) -> Regression:
    """Fit the number alone, its error everywhere alike."""
    count, width, ridge = setting
    directions = directions[:, :count]
    mean, reach = float(values.mean()), width * np.sqrt(directions.shape[1])
    nothing = np.zeros(len(standard))
    empty = Regression(
        directions, standard @ directions, nothing, nothing, reach, mean, 0.0, np.ones(len(LEVELS))
    )
    return replace(empty, weights=empty.solved(standard, values - mean, ridge))


def _doubting(learnt: Regression, standard: Float, errors: Float, spread: float) -> Regression:
    """Learn where the number errs more and where less, from errors on bearings not learnt from."""
    size = np.log(np.maximum(np.abs(errors), _LEAST_ERROR * spread))
    mean = float(size.mean())
    return replace(learnt, doubt_weights=learnt.solved(standard, size - mean, _DOUBT_RIDGE), doubt=mean)

"""Learn numbers and condition from labelled runs, and set their intervals by runs not learnt from."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.one_thread import in_one_thread
from beardyn_core.base.optional import library
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.conformal import LEVELS, Learnt, Way, reach_of
from beardyn_core.follow.descriptors import names_of, places_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.event_order import CONTRASTS, LEAST_WAY, WAY
from beardyn_core.follow.familiarity import familiarity_of
from beardyn_core.follow.fault_location import PartRule, least_of
from beardyn_core.follow.forest import EventForest, Forest, forest_of
from beardyn_core.follow.labelled import Described
from beardyn_core.follow.quantities import BY_NAME, QUANTITIES, Quantity
from beardyn_core.follow.regression import LEAST_DOUBT, Regression
from beardyn_core.follow.wide_spall import FEWEST as FEWEST_OF_KIND
from beardyn_core.follow.wide_spall import (
    LEAST_FOLDED,
    RACEWAYS,
    WideRule,
    agree,
    chance_of,
    fold_widths,
    spacings_of,
)
from beardyn_core.sensors.labels import HEALTHY

LEAST_EXPLAINED = 0.3  # of the variance, on bearings not learnt from: below it nothing is said
FEWEST = 40  # runs to learn a number from
_FOLDS = 5
# what is tried: descriptors that are kept, directions among them, width of the kernel, ridge
_SCREENS, _DIRECTIONS, _WIDTHS, _RIDGES = (20, 80, 1000), (2, 6, 16), (1.0, 2.0, 4.0), (0.01, 0.1, 1.0)
_DOUBT_RIDGE = 3.0
_TREES, _LEAST_RUNS = 60, 2  # of a forest, and at each end of a tree
_ASKED = 0.33  # share of the descriptors among which each question of a tree is chosen
_ORDER_PENALTY = 0.3  # inverse of the ridge of the order of events
_LEAST_ERROR = 1e-3  # of the spread of the number, so that its logarithm is finite
_OF_MONITOR = ("score", "kurtosis", "crest", "strongest", "way_")  # descriptors that tell the parts apart


class Judged(NamedTuple):
    """Ways to a number whose mean is taken, and how it does on bearings that are left out."""

    ways: tuple[Way, ...]
    errors: A[Float, "shape [run]"]
    expected: A[Float, "shape [run], as far as it knows itself"]

    @property
    def square(self) -> float:
        """Mean square of the errors."""
        return float(np.mean(self.errors**2))


@in_one_thread
def train_estimator(
    train: Described, plate: NamePlate, axes: tuple[str, ...], rate: float, stretch: float
) -> Estimator:
    """Learn every quantity from the runs of a training part; intervals are not calibrated yet."""
    descriptors = train.descriptors
    with np.errstate(invalid="ignore"):
        middle, spread = np.nanmean(descriptors, axis=0), np.nanstd(descriptors, axis=0)
    middle, spread = np.nan_to_num(middle), np.where(spread > 1e-9, spread, 1.0)
    standard = np.nan_to_num((descriptors - middle) / spread, nan=0.0)
    found, card = {}, {}
    wide = _wide_rule(train, plate, names_of(axes), middle, spread)
    for quantity in QUANTITIES:
        values, inside = _training_values(quantity, train, wide)
        if inside.sum() < FEWEST or np.ptp(values[inside]) < 1e-12:
            continue
        bearings = train.bearings[inside]
        best = _learnt(quantity, standard[inside], values[inside], bearings, axes, wide)
        explained = 1.0 - best.square / float(np.var(values[inside]))
        ends = np.array([(0.5 - 0.5 * level, 0.5 + 0.5 * level) for level in LEVELS])
        truth, there = true_values(quantity, train)
        ranges = quantity.restored(np.quantile(truth[there], ends)).tolist()
        reached = quantity.restored(np.quantile(truth[there], [0.0, 1.0])).tolist()
        card[quantity.name] = {"runs": int(inside.sum()), "explained": explained, "ranges": ranges,
                               "shared": shared_of(best.errors, bearings),
                               "ends": reached}  # fmt: skip
        if explained >= LEAST_EXPLAINED:
            found[quantity.name] = Learnt(best.ways, np.ones(len(LEVELS)))
    spalled = train.conditions != HEALTHY
    box = familiarity_of(standard, places_of(axes, "box"))
    passages = familiarity_of(standard[spalled] if spalled.any() else standard, places_of(axes, "passages"))
    return Estimator(
        plate, axes, rate, stretch, middle, spread, box, passages, found,
        _part_of(standard, train.conditions, names_of(axes)), wide, {"quantities": card},
    )  # fmt: skip


@in_one_thread
def calibrate_intervals(estimator: Estimator, runs: Described, *, straightened: bool = False) -> Estimator:
    """Set the widths of the intervals by runs that were not learnt from.

    With `straightened` those runs are of a truer tier, and they have more to say. Each number is put on the
    line that fits them, which takes out what a tier that learns has too much or too little of, or learnt from
    them alone, or is the mean of both, as errs least on bearings left out; one that none explains is left out
    any more.
    """
    standard = estimator.standardise(runs.descriptors)
    spalled = runs.conditions != HEALTHY
    estimator = replace(
        estimator,
        box=estimator.box.set_bound(standard) if len(standard) else estimator.box,
        passages=estimator.passages.set_bound(standard[spalled]) if spalled.any() else estimator.passages,
    )
    found, card = {}, {name: dict(each) for name, each in estimator.card["quantities"].items()}
    for quantity in QUANTITIES:
        if quantity.name not in card:
            continue
        learnt = estimator.regressions.get(quantity.name)
        values, inside = _judging(quantity, runs, estimator, standard)
        if not inside.any():  # nothing judges it, so nothing is reported
            continue
        best = None
        # a way of events is the same in every tier
        truer = straightened and not (quantity.of_passages and estimator.wide is not None)
        if learnt is not None:
            given, expected = learnt.value(standard[inside]), learnt.expected_error(standard[inside])
            best = Judged(learnt.ways, values[inside] - given, expected)
            if truer:
                best = _straighten(best, given, values[inside])
        if truer:
            shown = (standard[inside], values[inside], runs.bearings[inside], estimator.axes)
            best = _truer(best, quantity, *shown)
            variance = float(np.var(values[inside]))
            explained = 0.0 if best is None or not variance else 1.0 - best.square / variance
            card[quantity.name]["explained"] = explained
            if explained < LEAST_EXPLAINED:
                continue
        if best is not None:
            found[quantity.name] = Learnt(best.ways, reach_of(best.errors, best.expected))
    part = estimator.part
    if part is not None:
        inside = np.isin(runs.conditions, part.conditions)
        places = [part.conditions.index(each) for each in runs.conditions[inside]]
        truth = part.probabilities(standard[inside])[np.arange(len(places)), places]
        part = replace(part, least=least_of(truth))
    return replace(estimator, regressions=found, part=part, card={**estimator.card, "quantities": card})


def widen_intervals(estimator: Estimator, runs: Described) -> Estimator:
    """Widen the intervals to those that other runs not learnt from need, where these are wider.

    A truer tier that straightens a number sets intervals that hold for that tier alone; the runs of the tier
    that was learnt from need intervals of their own. An interval is the widest of those of the sets that
    calibrate it; without an end where one of them has too few runs, and then no number is reported.
    """
    standard = estimator.standardise(runs.descriptors)
    found = {}
    for name, each in estimator.regressions.items():
        values, inside = _judging(BY_NAME[name], runs, estimator, standard)
        shown = standard[inside]
        needed = reach_of(values[inside] - each.value(shown), each.expected_error(shown))
        found[name] = replace(each, reach=np.maximum(each.reach, needed))
    return replace(estimator, regressions=found)


def _training_values(
    quantity: Quantity, runs: Described, wide: WideRule | None
) -> tuple[Float, NDArray[np.bool_]]:
    """Give what is learnt of a quantity, on the scale of learning, and from which runs: a width folded."""
    values, inside = true_values(quantity, runs)
    if wide is not None and quantity.of_passages:
        ways = fold_widths(runs.truth[quantity.name], _spacings(runs, wide.spacings))
        values = quantity.scaled(np.maximum(ways, LEAST_FOLDED))
    return values, inside


def _judging(
    quantity: Quantity, runs: Described, estimator: Estimator, standard: Float
) -> tuple[Float, NDArray[np.bool_]]:
    """Give the truth of a quantity on the scale of learning, and which runs judge it.

    A width is judged by the runs whose number would be reported, whatever they are: of passages like those
    learnt from, and taken for narrow spalls. Where no number is reported, the narrower of two readings is
    judged, of all passages like those learnt from, by the folded width.
    """
    values, inside = true_values(quantity, runs)
    learnt, wide = estimator.regressions.get(quantity.name), estimator.wide
    if wide is not None and quantity.of_passages and learnt is not None:
        if not wide.gives_numbers:
            return _training_values(quantity, runs, wide)[0], inside & estimator.knows(standard)
        value, doubt = learnt.value(standard), learnt.expected_error(standard)
        ends = (quantity.restored(each) for each in (value, value - doubt, value + doubt))
        inside = inside & (wide.chance(standard, *ends) <= wide.narrow) & estimator.knows(standard)
    return values, inside


def _spacings(runs: Described, spacings: Float) -> Float:
    """Give the distance of two rollers on the raceway that is spalled, shape [run], [m]."""
    return np.where(runs.conditions == RACEWAYS[1], spacings[1], spacings[0])


def _truer(
    best: Judged | None,
    quantity: Quantity,
    standard: Float,
    values: Float,
    bearings: NDArray[Any],
    axes: tuple[str, ...],
) -> Judged | None:
    """Learn a number from runs of a truer tier alone; that, what is there, or their mean, as errs least."""
    if len(values) < FEWEST or len(set(bearings.tolist())) < 2 or np.ptp(values) < 1e-12:
        return best
    alone = _learnt(quantity, standard, values, bearings, axes, None)
    if best is None:
        return alone
    errors, expected = 0.5 * (alone.errors + best.errors), 0.5 * (alone.expected + best.expected)
    both = Judged((*alone.ways, *best.ways), errors, expected)
    return min(both, alone, best, key=lambda each: each.square)


def _straighten(best: Judged, given: Float, values: Float) -> Judged:
    """Put a number on the line through runs not learnt from, each error that of a line without its run."""
    table = np.stack([np.ones(len(given)), given], axis=1)
    turn = np.linalg.pinv(table)
    offset, slope = (turn @ values).tolist()
    errors = (values - table @ (turn @ values)) / (1.0 - np.einsum("ij,ji->i", table, turn))
    return Judged(tuple(each.on_line(offset, slope) for each in best.ways), errors, best.expected)


def true_values(quantity: Quantity, runs: Described) -> tuple[Float, NDArray[np.bool_]]:
    """Give the truth of a quantity on the scale of learning, and which runs have one."""
    values = quantity.scaled(runs.truth[quantity.name])
    return values, np.isfinite(values)


def _wide_rule(
    runs: Described, plate: NamePlate, names: tuple[str, ...], middle: Float, spread: Float
) -> WideRule | None:
    """Learn the order of events, and set what decides on bearings left out; `None` with few of a kind.

    A run teaches twice: its contrasts, and those of the events exchanged.
    """
    library("sklearn.linear_model", "training", "sweep")
    from sklearn.linear_model import LogisticRegression
    from sklearn.model_selection import GroupKFold

    contrasts, way = [names.index(name) for name in CONTRASTS], names.index(WAY)
    spacings, widths = _spacings(runs, spacings_of(plate)), runs.truth["width"]
    ways = fold_widths(widths, spacings)
    teach = np.isfinite(widths) & (ways > LEAST_WAY) & agree(runs.descriptors[:, way], ways)
    wide = np.mod(widths, spacings)[teach] > 0.5 * spacings[teach]
    if min(wide.sum(), len(wide) - wide.sum()) < FEWEST_OF_KIND:
        return None
    shown, bearings = runs.descriptors[teach][:, contrasts], runs.bearings[teach]
    size = np.maximum(shown.std(axis=0), 1e-9)

    def slope(fit: NDArray[Any]) -> Float:
        learnt = LogisticRegression(C=_ORDER_PENALTY, fit_intercept=False, max_iter=2000)
        twice = np.concatenate([shown[fit], -shown[fit]]) / size
        return np.asarray(learnt.fit(twice, np.concatenate([wide[fit], ~wide[fit]])).coef_[0] / size)

    odds = np.empty(len(wide))
    for fit, rest in GroupKFold(min(2 * _FOLDS, len(set(bearings)))).split(shown, wide, bearings):
        odds[rest] = shown[rest] @ slope(fit)
    readings = np.zeros((3, len(names)))
    readings[0, contrasts] = slope(np.arange(len(wide)))
    readings[1, way] = readings[2, names.index("louder")] = 1.0
    largest = float(np.nanmax(widths))
    short = ~wide
    added = float(np.median((ways[teach] - runs.descriptors[teach, way])[short]))
    doubt = float(np.std(np.log(ways[teach] / (runs.descriptors[teach, way] + added))[short]))
    rule = WideRule(readings * spread, readings @ middle, spacings_of(plate), largest, added, doubt)
    chances = chance_of(odds, runs.descriptors[teach, way], spacings[teach])
    return rule.set_chances(chances, widths[teach], spacings[teach])


def shared_of(errors: Float, bearings: NDArray[Any]) -> float:
    """Find the share of the errors' variance that runs of one bearing and box have in common, 0 to 1.

    It is their correlation from run to run, half where no bearing has two; two runs of a bearing differ in
    load, speed, track and fault.
    """
    together = [errors[bearings == each] for each in set(bearings.tolist())]
    several = [each for each in together if len(each) > 1]
    pairs = [(each.sum() ** 2 - each @ each) / (len(each) * (len(each) - 1)) for each in several]
    return float(np.clip(np.mean(pairs) / np.mean(errors**2), 0.0, 1.0)) if pairs else 0.5


def _learnt(
    quantity: Quantity,
    standard: Float,
    values: Float,
    bearings: NDArray[Any],
    axes: tuple[str, ...],
    wide: WideRule | None,
) -> Judged:
    """Learn a number; one of a spall by trees too, of which what errs less on bearings left out is taken.

    A number of the passages is learnt from descriptors without a level; a load, from all but the profile of
    the passages.
    """
    library("sklearn.cross_decomposition", "training", "sweep")
    from sklearn.model_selection import GroupKFold

    folds = list(GroupKFold(min(_FOLDS, len(set(bearings)))).split(standard, values, bearings))
    if quantity.of_passages and wide is not None:
        return _by_trees(standard, values, folds, places_of(axes, "shape"), wide)
    columns = places_of(axes, "shape" if quantity.of_passages else "levels")
    shown = np.zeros_like(standard)
    shown[:, columns] = standard[:, columns]
    by_kernel = _by_kernel(shown, values, folds)
    if not quantity.of_fault:
        return by_kernel
    by_trees = _by_trees(standard, values, folds, places_of(axes, "shape"))
    return by_trees if by_trees.square < by_kernel.square else by_kernel


def _by_trees(
    standard: Float,
    values: Float,
    folds: list[tuple[NDArray[Any], NDArray[Any]]],
    columns: NDArray[np.int64],
    wide: WideRule | None = None,
) -> Judged:
    """Learn a number by a forest that asks some of the descriptors; with a rule, by the way of events too."""
    errors, spread = np.empty(len(values)), np.empty(len(values))
    for fit, rest in folds:
        grown = _grow_forest(standard[fit], values[fit], columns, wide)
        errors[rest] = values[rest] - grown.value(standard[rest])
        spread[rest] = grown.expected_error(standard[rest])
    usual = float(np.median(spread))
    forest = replace(_grow_forest(standard, values, columns, wide), usual=usual)
    return Judged((forest,), errors, np.maximum(spread, LEAST_DOUBT * usual))


def _grow_forest(standard: Float, values: Float, columns: NDArray[np.int64], wide: WideRule | None) -> Forest:
    """Grow a forest."""
    from sklearn.ensemble import ExtraTreesRegressor

    trees = ExtraTreesRegressor(_TREES, min_samples_leaf=_LEAST_RUNS, max_features=_ASKED, random_state=0)
    found = forest_of(trees.fit(standard[:, columns], values).estimators_, columns)
    if wide is None:
        return found
    return EventForest(
        found.descriptor, found.number, found.other, found.roots, found.usual, found.offset, found.slope,
        wide.readings[1], float(wide.offsets[1]), wide.added, wide.doubt,
    )  # fmt: skip


def _by_kernel(standard: Float, values: Float, folds: list[tuple[NDArray[Any], NDArray[Any]]]) -> Judged:
    """Learn a number by kernel ridge regression, with the best of its settings."""
    best, errors = np.inf, np.zeros(len(values))
    screen, chosen = _SCREENS[0], (_DIRECTIONS[0], _WIDTHS[0], _RIDGES[0])
    for kept in _SCREENS:
        directions = [_directions(standard[fit], values[fit], kept) for fit, _ in folds]
        for setting in product(_DIRECTIONS, _WIDTHS, _RIDGES):
            missed = np.empty(len(values))
            for (fit, rest), along in zip(folds, directions, strict=True):
                learnt = _fit_regression(standard[fit], values[fit], along, setting)
                missed[rest] = values[rest] - learnt.value(standard[rest])
            if (square := float(np.mean(missed**2))) < best:
                best, errors, screen, chosen = square, missed, kept, setting
    spread, expected = float(np.std(values)), np.empty(len(values))
    for fit, rest in folds:
        # what is expected of a run may not have been learnt from its own error
        part = _fit_regression(
            standard[fit], values[fit], _directions(standard[fit], values[fit], screen), chosen
        )
        expected[rest] = _doubting(part, standard[fit], errors[fit], spread).expected_error(standard[rest])
    learnt = _fit_regression(standard, values, _directions(standard, values, screen), chosen)
    return Judged((_doubting(learnt, standard, errors, spread),), errors, expected)


def _part_of(standard: Float, conditions: NDArray[Any], names: tuple[str, ...]) -> PartRule | None:
    """Learn which part is spalled from what a monitor works out; `None` of one condition alone."""
    if len(set(conditions)) < 2:
        return None
    from sklearn.linear_model import LogisticRegression

    received = [k for k, name in enumerate(names) if name.startswith(_OF_MONITOR)]
    learnt = LogisticRegression(max_iter=2000).fit(standard[:, received], conditions)
    slope = np.zeros((len(learnt.classes_), len(names)))
    # of two conditions the library keeps the second one's power alone
    slope[-len(learnt.coef_) :, received], offset = learnt.coef_, np.zeros(len(slope))
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
    received = np.argsort(-np.abs(centred.T @ (values - values.mean())) / size)[:kept]
    count = min(max(_DIRECTIONS), len(standard) - 1, len(received))
    found = PLSRegression(count, scale=False).fit(standard[:, received], values).x_rotations_
    directions = np.zeros((standard.shape[1], count))
    directions[received] = found / np.std(standard[:, received] @ found, axis=0)
    return directions


def _fit_regression(
    standard: Float, values: Float, directions: Float, setting: tuple[int, float, float]
) -> Regression:
    """Fit the number alone, its error everywhere alike."""
    count, width, ridge = setting
    directions = directions[:, :count]
    mean, reach = float(values.mean()), width * np.sqrt(directions.shape[1])
    nothing = np.zeros(len(standard))
    empty = Regression(directions, standard @ directions, nothing, nothing, reach, mean, 0.0)
    return replace(empty, weights=empty.solve_weights(standard, values - mean, ridge))


def _doubting(learnt: Regression, standard: Float, errors: Float, spread: float) -> Regression:
    """Learn where the number errs more and where less, from errors on bearings not learnt from."""
    size = np.log(np.maximum(np.abs(errors), _LEAST_ERROR * spread))
    mean = float(size.mean())
    return replace(
        learnt, doubt_weights=learnt.solve_weights(standard, size - mean, _DOUBT_RIDGE), doubt=mean
    )

"""How hard a set of labelled runs is: what the shipped monitor finds in it, how far apart its classes are.

A learner that names every run of an easy set right has shown no skill. Both numbers come from what is worked
out of every run anyway, so they cost less than a second.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import nan
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.population.features import TRANSFERABLE, VERDICT
from beardyn_core.sensors.labels import HEALTHY

_EASY = 0.95
_FOLDS, _RIDGE = 5, 1e-3


def difficulty_of(
    rows: Sequence[Mapping[str, Any]], features: Sequence[Mapping[str, Any]], seed: int = 0
) -> dict[str, Any] | None:
    """Measure how hard the complete runs of a set are; ``None`` where they have no two conditions.

    Parameters
    ----------
    rows : sequence of mappings
        Labels of every run: ``status``, ``condition``, ``bearing_id``.
    features : sequence of mappings
        Of the same runs, with the verdict of the shipped monitor.
    seed : int
        Of the parts that bearings are divided into.

    Returns
    -------
    dict
        JSON-able. ``monitor``: for each condition its ``runs``, the share ``right`` (the part named, or no
        fault of a healthy run) and the share ``false``, another part named. ``separation``: for each
        condition but the healthy one the area under the ROC curve against healthy runs by the best single
        feature, and which.
        ``linear``: share of runs that a linear rule of all features names right, learnt from other bearings
        in five parts; ``None`` of one bearing. ``chance``: the same by naming the most frequent condition.

    References
    ----------
    Fisher (1936) for the rule: what it names needs no learner.
    """
    chosen = [k for k, row in enumerate(rows) if row.get("status") == "complete" and row.get("condition")]
    conditions = np.array([str(rows[k]["condition"]) for k in chosen])
    if len(set(conditions)) < 2:
        return None
    verdicts = np.array([str(features[k].get(VERDICT, "")) for k in chosen])
    values = _scaled(np.array([[_number(features[k].get(name)) for name in TRANSFERABLE] for k in chosen]))
    bearings = np.array([str(rows[k].get("bearing_id") or k) for k in chosen])
    return {
        "runs": len(chosen),
        "monitor": {each: _found(verdicts[conditions == each], each) for each in sorted(set(conditions))},
        "separation": _separations(conditions, values),
        **_linear_rule(conditions, values, bearings, seed),
    }


def difficulty_line(found: Mapping[str, Any] | None) -> str:
    """Write the difficulty in a sentence."""
    if not found:
        return "difficulty not known: the set has one condition, or was made by an earlier version"
    faulty = {name: each for name, each in found["monitor"].items() if name != HEALTHY}
    count = sum(each["runs"] for each in faulty.values())
    named = sum(each["runs"] * each["right"] for each in faulty.values()) / max(count, 1)
    alarms = found["monitor"].get(HEALTHY)
    wrong = "" if alarms is None else f", false alarms in {_percent(1.0 - alarms['right'])} of healthy ones"
    linear = found["linear"]
    if linear is None:
        apart = "all runs are of one bearing"
    else:
        skill = "; a learner near 100 % shows no skill on it" if linear >= _EASY else ""
        share = f"{_percent(linear)} of all {found['runs']} runs"
        apart = f"a linear rule that learns from other bearings names {share}{skill}"
    word = "an easy set" if linear is not None and linear >= _EASY else "difficulty"
    return f"{word}: the shipped monitor names the part in {_percent(named)} of faulty runs{wrong}; {apart}"


def card_lines(found: Mapping[str, Any] | None) -> list[str]:
    """Write the section of the data card."""
    lines = ["## Difficulty", "", f"{difficulty_line(found)[:1].upper()}{difficulty_line(found)[1:]}.", ""]
    if not found:
        return lines
    lines += [
        "| condition | runs | monitor right | another part named | area under ROC, best feature |",
        "|---|--:|--:|--:|---|",
    ]
    for name, each in found["monitor"].items():
        apart = found["separation"].get(name)
        against = "" if apart is None else f"{apart['area']:.3f}, `{apart['feature']}`"
        right, false = _percent(each["right"]), _percent(each["false"])
        lines.append(f"| {name} | {each['runs']} | {right} | {false} | {against} |")
    return [
        *lines,
        "",
        "A healthy run is *right* where no part is named. The monitor judges each run once, by six "
        "revolutions or more. The area is against healthy runs: 0.5 where a feature does not separate a "
        "condition from them, 1 where it separates them whole. The linear rule is a discriminant of "
        f"{len(TRANSFERABLE)} features that compare a signal with itself, tested on bearings that it has not "
        f"seen; naming the most frequent condition is right in {_percent(found['chance'])}.",
        "",
    ]


def _found(verdicts: Any, condition: str) -> dict[str, Any]:
    """Compare the verdicts on the runs of a condition with it."""
    parts = condition.split("+")
    named = ~np.isin(verdicts, _NO_PART)
    right = ~named if condition == HEALTHY else np.isin(verdicts, parts)
    return {
        "runs": len(verdicts),
        "right": float(right.mean()),
        "false": float((named & ~np.isin(verdicts, parts)).mean()),
    }


_NO_PART = ("", "healthy", "waiting", "not_diagnosable", "unexplained")


def _separations(conditions: Any, values: Float) -> dict[str, dict[str, Any]]:
    """Find the feature that separates each condition from healthy runs best."""
    healthy = values[conditions == HEALTHY]
    found: dict[str, dict[str, Any]] = {}
    if not len(healthy):
        return found
    for condition in sorted(set(conditions) - {HEALTHY}):
        areas = [_area(column, other) for column, other in zip(values[conditions == condition].T, healthy.T)]  # noqa: B905
        best = int(np.argmax(areas))
        found[condition] = {"area": areas[best], "feature": TRANSFERABLE[best]}
    return found


def _area(one: Float, other: Float) -> float:
    """Compute the area under the ROC curve of a number that separates one class from another, 0.5 to 1."""
    from scipy.stats import rankdata

    ranks = rankdata(np.concatenate([one, other]))[: len(one)].sum()
    area = (ranks - 0.5 * len(one) * (len(one) + 1)) / (len(one) * len(other))
    return float(max(area, 1.0 - area))


def _linear_rule(conditions: Any, values: Float, bearings: Any, seed: int) -> dict[str, float | None]:
    """Name every run by a linear discriminant that has learnt from other bearings."""
    counts = np.unique(conditions, return_counts=True)[1]
    known = np.random.default_rng(seed).permutation(np.unique(bearings))
    right = np.zeros(len(conditions), bool)
    for part in np.array_split(known, min(_FOLDS, len(known))):
        tested = np.isin(bearings, part)
        if tested.all():
            return {"linear": None, "chance": float(counts.max() / counts.sum())}
        right[tested] = conditions[tested] == _discriminate(
            conditions[~tested], values[~tested], values[tested]
        )
    return {"linear": float(right.mean()), "chance": float(counts.max() / counts.sum())}


def _discriminate(conditions: Any, values: Float, others: Float) -> Any:
    """Learn a linear discriminant, each condition with its mean and all with one scatter; name other runs."""
    names = np.unique(conditions)
    means = np.stack([values[conditions == name].mean(axis=0) for name in names])
    left = values - means[np.searchsorted(names, conditions)]
    scatter = left.T @ left / len(values)
    scatter += np.eye(len(scatter)) * (_RIDGE * np.trace(scatter) / len(scatter) + 1e-9)
    weights = np.linalg.solve(scatter, means.T)
    shares = np.array([(conditions == name).mean() for name in names])
    return names[(others @ weights - 0.5 * (means.T * weights).sum(axis=0) + np.log(shares)).argmax(axis=1)]


def _scaled(values: Float) -> Float:
    """Divide features by their spread between the quartiles; what is not known counts as the median."""
    known = np.where(np.isfinite(values), values, np.nan)
    known[:, np.isnan(known).all(axis=0)] = 0.0
    low, middle, high = np.nanquantile(known, (0.25, 0.5, 0.75), axis=0)
    spread = np.where(high > low, high - low, 1.0)
    return np.asarray(np.clip((np.where(np.isnan(known), middle, known) - middle) / spread, -30.0, 30.0))


def _number(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else nan


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"

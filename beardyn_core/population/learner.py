"""A learner to compare others with: features of the monitor, trees that are put together, nothing tuned.

It says which part of a bearing is spalled, if any, and how wide the spall is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.population.features import NAMES
from beardyn_core.population.labelled_set import TEST, TRAIN, LabelledSet

WIDTH = "fault_width_m"
_TREES = 300


@dataclass(frozen=True)
class Judgement:
    """How a learner does on runs that it has not seen."""

    name: A[str, "of the runs"]
    count: int
    accuracy: A[float, "share of runs whose condition is named, [-]"]
    balanced: A[float, "the same, each condition counted alike, [-]"]
    matrix: A[dict[str, dict[str, int]], "runs by true condition and by the one that is named"]
    width_error: A[float, "median of the relative error of the width, of spalled runs; NaN without, [-]"]
    width_bias: A[float, "median of estimated less true width, [m]"]


class Learner:
    """Random forests on the features of runs: a class and a width.

    Parameters
    ----------
    names : sequence of str
        Of the features, of `features.NAMES`.
    seed : int
    """

    def __init__(self, names: Sequence[str] = NAMES, seed: int = 0) -> None:
        self.names = tuple(names)
        self._seed = seed
        self._classes: Any = None
        self._widths: Any = None

    def fit(
        self, runs: LabelledSet, part: str | None = TRAIN, only: NDArray[np.int64] | None = None
    ) -> Learner:
        """Learn from the complete runs of a part.

        Parameters
        ----------
        part : str or None
            Of the set; ``None``: all.
        only : int array, optional
            Numbers of the runs, where not all of the part.

        Raises
        ------
        InputError
            There are too few of them.
        """
        library("sklearn.ensemble", "the baseline", "sweep")
        from sklearn.ensemble import RandomForestClassifier, RandomForestRegressor

        chosen = runs.runs_of(part) if only is None else only
        known = runs.labels_of(chosen, ["condition", *self.names])
        conditions = known["condition"].astype(str)
        if len(set(conditions)) < 2 or len(chosen) < 10:
            raise InputError(
                f"{runs.folder}: part {part} has {len(chosen)} complete runs of {len(set(conditions))} "
                "conditions; a learner needs ten runs of two"
            )
        values = self._values(known)
        self._classes = RandomForestClassifier(_TREES, class_weight="balanced", random_state=self._seed)
        self._classes.fit(values, conditions)
        width = widths_of(runs, chosen)
        spalled = np.isfinite(width)
        if spalled.sum() >= 10:
            self._widths = RandomForestRegressor(_TREES, random_state=self._seed)
            self._widths.fit(values[spalled], np.log(width[spalled]))
        return self

    def conditions(self, features: Mapping[str, Any]) -> NDArray[Any]:
        """Name the condition of runs by their features, an array each."""
        return np.asarray(self._classes.predict(self._values(features)))

    def widths(self, features: Mapping[str, Any]) -> Float:
        """Estimate the width of the spall that runs may have, [m]; NaN where none was learnt."""
        values = self._values(features)
        if self._widths is None:
            return np.full(len(values), np.nan)
        return np.exp(np.asarray(self._widths.predict(values), np.float64))

    def importance(self) -> dict[str, float]:
        """Give the share of each feature in the classes, the largest first."""
        found = dict(zip(self.names, self._classes.feature_importances_.tolist(), strict=True))
        return dict(sorted(found.items(), key=lambda pair: -pair[1]))

    def judged(self, name: str, runs: LabelledSet, part: str | None = TEST) -> Judgement:
        """Judge the learner by the complete runs of a part, or of a whole set."""
        chosen = runs.runs_of(part)
        known = runs.labels_of(chosen, ["condition", *self.names])
        return self.judged_by(name, known, known["condition"].astype(str), widths_of(runs, chosen))

    def judged_by(
        self, name: str, features: Mapping[str, Any], truth: NDArray[Any], width: Float | None = None
    ) -> Judgement:
        """Judge the learner by runs of which the condition is known, and perhaps the width [m]."""
        named = self.conditions(features)
        matrix: dict[str, dict[str, int]] = {}
        for right, said in zip(truth, named, strict=True):
            row = matrix.setdefault(str(right), {})
            row[str(said)] = row.get(str(said), 0) + 1
        hits = [row.get(right, 0) / sum(row.values()) for right, row in matrix.items()]
        error, bias = float("nan"), float("nan")
        if width is not None and (spalled := np.isfinite(width)).any():
            found = self.widths(features)[spalled]
            error = float(np.median(np.abs(found / width[spalled] - 1.0)))
            bias = float(np.median(found - width[spalled]))
        right = float(np.mean(named == truth)) if len(truth) else float("nan")
        return Judgement(
            name,
            len(truth),
            right,
            float(np.mean(hits)) if hits else float("nan"),
            dict(sorted(matrix.items())),
            error,
            bias,
        )

    def _values(self, features: Mapping[str, Any]) -> Float:
        columns = [np.asarray(features[name], np.float64) for name in self.names]
        values = np.stack(columns, axis=1) if columns else np.zeros((0, 0))
        return np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0)


def widths_of(runs: LabelledSet, chosen: NDArray[np.int64]) -> Float:
    """Take the width of the spall of runs, NaN without one, [m]."""
    if WIDTH not in runs.table:
        return np.full(len(chosen), np.nan)
    return np.asarray(runs.labels_of(chosen, [WIDTH])[WIDTH], np.float64)

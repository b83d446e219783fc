"""What a learner's errors come from: which lines it is given, how many runs, how wide the spall is."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from beardyn_core.population.features import NAMES
from beardyn_core.population.labelled_set import TEST, TRAIN, LabelledSet
from beardyn_core.population.learner import Learner, widths_of

_BAND = "band_"
_WHITENED = ("score", "threshold_margin", "lead", "strongest_")
WIDTHS_MM = (1.0, 2.0, 4.0, 7.0, 14.0)
_SHARES = (1.0, 0.5, 0.25)


def lines_of() -> dict[str, tuple[str, ...]]:
    """Give the features with the lines of one reception only, and those of both."""
    whitened = tuple(name for name in NAMES if not name.startswith(_BAND))
    measured = tuple(name for name in NAMES if not name.startswith(_WHITENED))
    return {
        "whitened, as the monitor receives": whitened,
        "as measured, in one band": measured,
        "both": NAMES,
    }


def causes(runs: LabelledSet) -> dict[str, Any]:
    """Judge learners that know less, and each kind of run by itself, on unseen bearings."""
    lines = {name: Learner(names).fit(runs).judged(name, runs).balanced for name, names in lines_of().items()}
    return {"lines": lines, "sizes": _by_size(runs), "widths": _by_width(runs)}


def _by_size(runs: LabelledSet) -> dict[str, float]:
    """Train on the first bearings only, by number of runs."""
    chosen = runs.runs_of(TRAIN)
    found = {}
    for share in _SHARES:
        count = round(share * len(chosen))
        learner = Learner().fit(runs, TRAIN, chosen[:count])
        found[str(count)] = learner.judged("", runs).balanced
    return found


def _by_width(runs: LabelledSet) -> list[dict[str, float]]:
    """Share of the runs with a spall that are named right, by its width; and of the healthy ones."""
    chosen = runs.runs_of(TEST)
    known = runs.labels_of(chosen, ["condition", *NAMES])
    right = Learner().fit(runs).conditions(known) == known["condition"].astype(str)
    width = 1e3 * widths_of(runs, chosen)
    rows = []
    for low, high in pairwise(WIDTHS_MM):
        inside = (width >= low) & (width < high)
        rows.append(
            {"low": low, "high": high, "runs": int(inside.sum()), "right": float(right[inside].mean())}
        )
    sound = np.isnan(width)
    return [*rows, {"low": 0.0, "high": 0.0, "runs": int(sound.sum()), "right": float(right[sound].mean())}]

"""What is shipped: an estimator for each bearing of a shipped sweep, whose intervals hold."""

from __future__ import annotations

from pathlib import Path

import pytest
from scipy.stats import binom

from beardyn_core.config import load_any_bearing
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.estimator import read_estimator
from beardyn_core.follow.estimator_choice import estimator_for
from beardyn_core.follow.shipped import list_shipped
from test.follow.test_training_sweep import OWN

CHANCE = 0.025  # that fewer runs than so many are held by intervals that are right
LARGEST = 400_000  # bytes of a file
UNTRAINED = ("WJ130x240", "SRB120x260", "WJ180x320")  # `beardyn train --bearing` makes theirs


@pytest.mark.parametrize("path", list_shipped(), ids=lambda path: path.stem)
def test_intervals_of_ninety_percent_hold_on_runs_that_were_not_learnt_from(path: Path) -> None:
    card = read_estimator(path).card
    judged = [each["test"] for each in card["quantities"].values() if "test" in each]
    judged.append(card["condition"])
    assert len(judged) > 1
    for each in judged:
        assert each["coverage"][-1] * each["runs"] >= binom.ppf(CHANCE, each["runs"], LEVELS[-1])
    assert path.stat().st_size < LARGEST


@pytest.mark.parametrize("axes", ["xyz", "z"])
@pytest.mark.parametrize("bearing", [each for each in OWN if each not in UNTRAINED])
def test_every_axlebox_bearing_has_an_estimator_for_three_axes_and_for_one(bearing: str, axes: str) -> None:
    found = estimator_for(load_any_bearing(bearing), tuple(axes))
    assert (found.plate.name, "".join(found.axes)) == (bearing, axes)

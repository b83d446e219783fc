"""Another box or sensor place is recognised, and its numbers are not reported."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import AXES, places_of
from beardyn_core.follow.estimator import Estimator, within_learnt
from beardyn_core.follow.familiarity import familiarity_of
from beardyn_core.follow.quantities import BY_NAME
from test.follow.synthetic import drawn, standard_estimator

FOUR_SIGMA = 4.0


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return standard_estimator()


def test_one_in_twenty_runs_of_the_kind_learnt_from_is_strange(estimator: Estimator) -> None:
    share = float(np.mean(estimator.strangeness(drawn(400, 3).descriptors) > 1.0))
    assert abs(share - 0.05) < FOUR_SIGMA * np.sqrt(0.05 * 0.95 * (1 / 400 + 1 / 200))


def test_box_that_shifts_many_levels_gives_no_load_and_says_why(estimator: Estimator) -> None:
    rows = drawn(20, 4).descriptors
    levels = places_of(AXES, "box")
    rows[:, levels] += np.random.default_rng(5).normal(
        0.0, 3.0, len(levels)
    )  # each band by some of its spread
    for row in rows:
        found = estimator.estimates(row[None])
        assert found.strangeness > 1.0
        assert np.isnan(found["vertical_load"].value)
        assert np.isnan(found["end_play"].value)
        assert found.part is not None
        assert set(found.part.sets[-1]) == {"healthy", "cup", "cone"}
        assert "another box, sensor place or track" in found["vertical_load"].reason
        assert "another box, sensor place or track" in found.sentences[-1]


def test_a_box_is_noticed_that_differs_where_the_runs_learnt_from_hardly_do() -> None:
    random = np.random.default_rng(8)
    turn, _ = np.linalg.qr(random.normal(size=(120, 120)))
    sizes = 3.0 / np.arange(1, 121)

    def runs(count: int) -> Float:
        return random.normal(size=(count, 120)) * sizes @ turn

    found = familiarity_of(runs(320), np.arange(120)).set_bound(runs(100))
    assert np.mean(found.distance(runs(400)) > 1.0) < 0.05 + FOUR_SIGMA * np.sqrt(
        0.0475 * (1 / 400 + 1 / 100)
    )
    other = runs(100) + 2.5 * (sizes * (np.arange(120) >= 90)) @ turn
    assert np.mean(found.distance(other) > 1.0) > 0.9


def test_passages_unlike_those_learnt_from_give_no_width(estimator: Estimator) -> None:
    runs = drawn(60, 6)
    rows = runs.descriptors[runs.conditions == "cup"]
    shape = places_of(AXES, "passages")
    rows[:, shape] += np.random.default_rng(7).normal(0.0, 3.0, len(shape))
    found = [estimator.estimates(row[None])["width"] for row in rows]
    assert all(np.isnan(each.value) and np.isnan(each.at_least) for each in found)
    assert any("passages are unlike" in each.reason for each in found)


@given(value=st.floats(1e-3, 30e-3), factor=st.floats(1.01, 4.0), end=st.floats(5e-3, 40e-3))
def test_width_whose_interval_reaches_the_largest_one_learnt_is_a_least_width(
    value: float, factor: float, end: float
) -> None:
    intervals = ((value / factor**0.4, value * factor**0.4), (value / factor, value * factor))
    found = within_learnt(BY_NAME["width"], value, intervals, (1e-3, end))
    if value * factor >= end:
        assert np.isnan(found.value)
        assert found.at_least == value / factor
        assert "at least" in found.sentence
    if value * factor < 0.9 * end:
        assert found.value == value
        assert np.isnan(found.at_least)

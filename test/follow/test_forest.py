"""A forest gives what scikit-learn's gives, finds what few descriptors say together, and knows its doubt."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.follow.forest import Forest, forest_of

COLUMNS = np.array([2, 5, 7, 11])


def peak(seed: int, count: int = 400) -> tuple[Float, Float]:
    """Draw descriptors of which one says where another one counts."""
    random = np.random.default_rng(seed)
    rows = random.normal(size=(count, 12))
    return rows, np.where(rows[:, 5] > 0.0, rows[:, 2], -rows[:, 7]) + 0.05 * random.normal(size=count)


@pytest.fixture(scope="module")
def grown() -> tuple[Forest, Float]:
    ensemble = pytest.importorskip("sklearn.ensemble")
    rows, values = peak(1)
    trees = ensemble.ExtraTreesRegressor(40, min_samples_leaf=2, max_features=1.0, random_state=0)
    trees.fit(rows[:, COLUMNS], values)
    others = peak(2)[0]
    return forest_of(trees.estimators_, COLUMNS), trees.predict(others[:, COLUMNS])


def test_numbers_are_those_of_the_library(grown: tuple[Forest, Float]) -> None:
    forest, expected = grown
    np.testing.assert_allclose(forest.value(peak(2)[0]), expected, rtol=1e-9, atol=1e-9)


def test_what_descriptors_say_together_is_found(grown: tuple[Forest, Float]) -> None:
    rows, values = peak(3)
    errors = values - grown[0].value(rows)
    assert np.mean(errors**2) < 0.2 * np.var(values)


def test_lines_follow_one_another(grown: tuple[Forest, Float]) -> None:
    forest, rows = grown[0], peak(4)[0]
    moved = forest.on_line(2.0, 0.5).on_line(1.0, -1.0)
    np.testing.assert_allclose(moved.value(rows), -1.0 - 0.5 * forest.value(rows))


def test_doubt_tells_where_it_errs(grown: tuple[Forest, Float]) -> None:
    rows, values = peak(5)
    errors, doubt = np.abs(values - grown[0].value(rows)), grown[0].expected_error(rows)
    sure = doubt < np.median(doubt)
    assert errors[sure].mean() < 0.8 * errors[~sure].mean()


def test_trees_that_would_never_end_are_refused(grown: tuple[Forest, Float]) -> None:
    forest = grown[0]
    for wrong in (np.zeros_like(forest.other), forest.other + len(forest.other)):
        with pytest.raises(ValueError, match="go back"):
            replace(forest, other=wrong)

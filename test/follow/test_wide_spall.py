"""Spalls that can be wide are told from narrow ones by the order of their two events."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.event_order import CONTRASTS, WAY
from beardyn_core.follow.labelled import Described
from beardyn_core.follow.learning import calibrate_intervals, train_estimator
from beardyn_core.follow.wide_spall import (
    LEAST_FOLDED,
    NARROW,
    UNKNOWN,
    WIDE,
    WideRule,
    chance_of,
    fold_widths,
    spacings_of,
)
from test.follow.synthetic import NAMES, PLATE, RATE, STRETCH, received

DRAWING = PLATE if isinstance(PLATE, NamePlate) else NamePlate.of(PLATE)
CUP, CONE = spacings_of(DRAWING)
LARGEST = 34e-3


def rule() -> WideRule:
    """A rule that reads odds, way and raceway from three descriptors."""
    return WideRule(np.eye(3), np.zeros(3), np.array([CUP, CONE]), LARGEST)


def spalled(count: int, seed: int, noise: float = 1.0) -> Described:
    """Runs of spalls up to 34 mm whose events say way and order, in the units of their descriptors."""
    random = np.random.default_rng(seed)
    condition = random.choice(["cup", "cone"], count)
    width = np.exp(random.uniform(np.log(1.5e-3), np.log(LARGEST), count))
    runs = received(random, np.full(count, 5e4), np.full(count, 1e-4), condition, width)
    spacing = np.where(condition == "cone", CONE, CUP)
    way, wide = fold_widths(width, spacing), np.mod(width, spacing) > 0.5 * spacing
    for name in ("way_cup", "way_cone", "kurtosis"):
        place = NAMES.index(name)
        runs.descriptors[:, place] = 1e3 * way + 0.3 * noise * random.normal(size=count)
    runs.descriptors[:, NAMES.index("louder")] = condition == "cone"
    for part in ("cup", "cone"):
        runs.descriptors[:, NAMES.index(f"score_{part}")] = 10.0 * (condition == part)
    received_way = np.where(way > 3.2e-3, way - 0.6e-3 + 0.1e-3 * random.normal(size=count), 0.0)
    runs.descriptors[:, NAMES.index(WAY)] = np.maximum(received_way, 0.0)
    for name in CONTRASTS:
        order = np.where(received_way > 0.0, np.where(wide, 1.0, -1.0), 0.0)
        runs.descriptors[:, NAMES.index(name)] = order + noise * random.normal(size=count)
    return runs


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return calibrate_intervals(
        train_estimator(spalled(240, 1), DRAWING, AXES, RATE, STRETCH), spalled(150, 2)
    )


@pytest.mark.slow
def test_no_wide_spall_is_reported_as_a_narrow_one_and_most_narrow_ones_are_numbers(
    estimator: Estimator,
) -> None:
    runs = spalled(300, 3)
    found = [estimator.estimates(row[None])["width"] for row in runs.descriptors]
    truth, value = runs.truth["width"], np.array([each.value for each in found])
    least = np.array([each.at_least for each in found])
    assert np.mean(value[truth > 20e-3] < 12e-3) <= 0.03
    decided = (truth < 12e-3) & ((runs.conditions == "cup") | (truth > 6e-3))
    assert np.mean(np.isfinite(value[decided])) > 0.7
    given_ = np.isfinite(value)
    assert np.median(np.abs(value[given_] / truth[given_] - 1.0)) < 0.1
    held = [low <= width <= high for each, width in zip(found, truth, strict=True)
            if np.isfinite(each.value) for low, high in [each.intervals[-1]]]  # fmt: skip
    assert np.mean(held) > 0.8
    assert np.mean(least[np.isfinite(least)] <= truth[np.isfinite(least)]) > 0.9


def test_small_spalls_of_the_cone_are_no_numbers_as_one_wider_than_the_rollers_distance_looks_alike(
    estimator: Estimator,
) -> None:
    runs = spalled(200, 4)
    small = (runs.conditions == "cone") & (runs.truth["width"] < 3.5e-3)
    found = [estimator.estimates(row[None])["width"] for row in runs.descriptors[small]]
    assert all(np.isnan(each.value) for each in found)
    assert any("looks alike" in each.reason for each in found)


def test_numbers_that_are_judged_are_those_that_are_reported(estimator: Estimator) -> None:
    runs = spalled(80, 5)
    for name in estimator.regressions:
        quantity = next(each for each in estimator.estimates(runs.descriptors[:1]).quantities
                        if each.quantity.name == name).quantity  # fmt: skip
        told = [np.isfinite(estimator.estimates(row[None])[name].value) for row in runs.descriptors]
        np.testing.assert_array_equal(
            estimator.reports(quantity, estimator.standardise(runs.descriptors)), told
        )


def test_a_file_keeps_the_rule(estimator: Estimator, tmp_path: Path) -> None:
    estimator.save(tmp_path / "one.npz")
    again = read_estimator(tmp_path / "one.npz")
    for row in spalled(40, 6).descriptors:
        one, other = (each.estimates(row[None])["width"] for each in (estimator, again))
        assert one.reason[:12] == other.reason[:12]
        np.testing.assert_allclose(one.value, other.value, rtol=1e-3)


@given(seed=st.integers(0, 1000), apart=st.floats(-0.5, 3.0))
def test_hardly_a_wide_spall_is_taken_for_a_narrow_one(seed: int, apart: float) -> None:
    random = np.random.default_rng(seed)
    widths = np.concatenate([random.uniform(2e-3, 11e-3, 100), random.uniform(24e-3, 34e-3, 100)])
    chances = 1.0 / (1.0 + np.exp(-random.normal(0.0, 0.3, 200) - apart * np.repeat([-1.0, 1.0], 100)))
    found = rule().set_chances(chances, widths, np.full(200, CUP))
    assert np.mean(chances[100:] <= found.narrow) <= 0.04
    assert np.mean(chances[:100] > found.wide) <= 0.04
    assert found.narrow <= NARROW < UNKNOWN < WIDE <= found.wide


@given(width=st.floats(1.5e-3, 34e-3), cone=st.booleans())
def test_widths_that_fold_alike_are_decided_by_the_order_or_not_at_all(width: float, cone: bool) -> None:
    spacing = CONE if cone else CUP
    way = fold_widths(np.array([width]), np.array([spacing]))
    for odds in (-9.0, 9.0):
        shown = np.array([[odds, float(way[0]), float(cone)]])
        chance = float(rule().chance(shown, way, 0.95 * way, 1.05 * way)[0])
        if width > 0.5 * spacing and odds > 0.0:  # it may not be called narrow
            assert chance > NARROW
        if width > spacing:
            assert chance == UNKNOWN


def test_events_that_lie_elsewhere_than_the_width_decide_nothing() -> None:
    shown = np.array([[-9.0, 15e-3, 0.0]])
    width = np.array([8e-3])
    assert rule().chance(shown, width, width, width)[0] == UNKNOWN


@given(odds=st.floats(-5.0, 5.0), way=st.floats(3e-3, 14e-3))
def test_of_equal_odds_the_narrow_spall_is_the_likelier(odds: float, way: float) -> None:
    chance = chance_of(np.array([odds]), np.array([way]), np.array([CONE]))[0]
    assert chance < 1.0 / (1.0 + np.exp(-odds))


@pytest.mark.slow
def test_where_too_few_are_taken_for_narrow_no_number_is_reported_and_both_readings_are() -> None:
    learnt = train_estimator(spalled(240, 1), DRAWING, AXES, RATE, STRETCH)
    assert learnt.wide is not None
    found = calibrate_intervals(replace(learnt, wide=learnt.wide.without_numbers()), spalled(150, 2))
    runs = spalled(300, 3)
    told = [found.estimates(row[None])["width"] for row in runs.descriptors]
    assert all(np.isnan(each.value) for each in told)
    least = np.array([each.at_least for each in told])
    given_ = np.isfinite(least)
    assert given_.mean() > 0.8
    assert np.mean(least[given_] <= runs.truth["width"][given_]) > 0.9
    # the narrower reading holds the folded width as often as its interval promises
    spacing = np.where(runs.conditions == "cone", CONE, CUP)
    folded = np.log(np.maximum(fold_widths(runs.truth["width"], spacing), LEAST_FOLDED))
    standard = found.standardise(runs.descriptors)
    guess, known = found.regressions["width"].guess(standard), found.knows(standard)
    held = (guess.low[-1] <= folded) & (folded <= guess.high[-1])
    assert abs(held[known].mean() - 0.9) < 4.0 * np.sqrt(0.09 * (1 / known.sum() + 1 / 140))

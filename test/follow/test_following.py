"""The filter on signals of a known law: it follows steps, growth and faults, and doubts what is strange."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.follow.condition import ConditionBelief
from beardyn_core.follow.cubature_filter import Belief, correct_belief, predict_belief
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.following import (
    SPALLED,
    TAKE_OUT,
    UNEXPLAINED,
    WAITING,
    Followed,
    Follower,
)
from beardyn_core.follow.growth import GrowthLaw
from beardyn_core.follow.service import Service
from beardyn_core.sensors.labels import HEALTHY
from test.follow.synthetic import NAMES, received, standard_estimator

NORMAL_OF_TEN = np.array([-1.64, -1.04, -0.67, -0.39, -0.13, 0.13, 0.39, 0.67, 1.04, 1.64])  # quantiles


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return standard_estimator()


def stretches(
    seed: int,
    condition: str,
    count: int,
    load: float = 5e4,
    width: float = 6e-3,
    play: float = 1e-4,
    length: float = 20e-3,
) -> Float:
    """Hear stretches of one bearing."""
    random, ones = np.random.default_rng(seed), np.ones(count)
    numbers = (load * ones, play * ones, np.repeat(condition, count), width * ones)
    return received(random, *numbers, length=length * ones).descriptors


def followed(
    estimator: Estimator, rows: Float, metres: float = 80.0, with_life: bool = True
) -> list[Followed]:
    """Follow stretches; the rating life takes most of the time, and says nothing to what is believed."""
    follower = Follower(estimator)
    if with_life:
        bearing, lubricant = load_bearing("HS130x230"), load_lubricant("L055")
        follower = Follower(estimator, bearing, lubricant, Service(mileage=1e8))
    return [follower.take(row, (k + 1) * 1.5, (k + 1) * metres) for k, row in enumerate(rows)]


def test_a_linear_law_is_carried_exactly_and_a_correction_is_that_of_gauss() -> None:
    belief = Belief(np.array([1.0, -2.0]), np.array([[2.0, 0.5], [0.5, 1.0]]))
    turn = np.array([[1.0, 0.3], [-0.2, 0.9]])
    after = predict_belief(belief, lambda points: points @ turn.T, np.array([0.1, 0.2]))
    np.testing.assert_allclose(after.mean, turn @ belief.mean, rtol=1e-9)
    expected = turn @ belief.covariance @ turn.T + np.diag([0.1, 0.2])
    np.testing.assert_allclose(after.covariance, expected, rtol=1e-9)
    row = np.array([[1.0, 1.0]])
    seen = correct_belief(belief, row, np.array([0.0]), np.array([0.5]))
    information = np.linalg.inv(belief.covariance) + row.T @ row / 0.5
    np.testing.assert_allclose(seen.belief.covariance, np.linalg.inv(information), rtol=1e-9)
    mean = np.linalg.solve(information, np.linalg.inv(belief.covariance) @ belief.mean)
    np.testing.assert_allclose(seen.belief.mean, mean, rtol=1e-9)


def test_an_area_grows_in_the_distance_that_its_growth_takes() -> None:
    law = GrowthLaw()
    begin, rate = np.array([50e-6, 200e-6, 400e-6]), np.array([1e-10, 3e-10, 2e-10])
    for distance in (1e5, 3e6, 2e7):
        end = law.grow_areas(begin, rate, distance)
        np.testing.assert_allclose(law.distance(begin, end, rate), distance, rtol=1e-9)


def test_a_first_clear_stretch_is_believed_and_of_another_condition_only_the_fourth() -> None:
    belief = ConditionBelief(("cone", "cup", "healthy"))
    clear = {each: {k: float(k == each) for k in belief.conditions} for each in belief.conditions}
    belief.take(clear["cup"])
    assert belief.estimate.condition == "cup"
    assert belief.estimate.probability == pytest.approx(0.83, abs=0.01)
    for usual, other in (("healthy", "cup"), ("cup", "healthy")):
        belief = ConditionBelief(belief.conditions)
        for _ in range(20):
            belief.take(clear[usual])
        said = []
        for _ in range(4):
            belief.take(clear[other])
            said.append(belief.estimate.condition)
        assert said == [usual, usual, usual, other]
        assert other in belief.estimate.sets[0]


def test_sound_and_spalled_bearings_are_told_apart(estimator: Estimator) -> None:
    sound = followed(estimator, stretches(5, "healthy", 12))
    assert sound[0].health == WAITING
    assert {each.health for each in sound[1:]} == {HEALTHY}
    spalled = followed(estimator, stretches(5, "cup", 8))
    assert spalled[-1].health in (SPALLED, TAKE_OUT)
    assert spalled[-1].estimates["width"].value == pytest.approx(6e-3, rel=0.2)


def test_intervals_narrow_with_stretches_and_not_to_nothing(estimator: Estimator) -> None:
    steps = followed(estimator, stretches(6, "healthy", 20), with_life=False)
    width = [np.ptp(np.log(each.estimates["vertical_load"].intervals[-1])) for each in steps]
    assert width[-1] < width[0]
    assert width[-1] > 0.3 * width[0]  # what stays with the bearing does not go away by repetition


def test_a_load_of_another_recording_is_no_step_of_the_last_one(estimator: Estimator) -> None:
    follower = Follower(estimator)
    may = [follower.take(row, 1.5 * k, 80.0 * k) for k, row in enumerate(stretches(7, "cup", 8, load=4e4))]
    follower.begin()
    rows = stretches(8, "cup", 6, load=8e4)
    june = [follower.take(row, 12.0 + 1.5 * k, 1.2e5 + 80.0 * k) for k, row in enumerate(rows)]
    assert not any(each.changed or each.doubts for each in june)
    assert june[0].estimates["vertical_load"].value == pytest.approx(8e4, rel=0.2)
    width = [np.ptp(np.log(each.estimates["width"].intervals[-1])) for each in (may[0], june[0])]
    assert width[1] < width[0]  # the spall is the one of May


def over_recordings(estimator: Estimator, offset: float, seed: int, count: int) -> Followed:
    """Follow a spall of 6 mm over recordings of two stretches, in which box and bearing sound too wide."""
    follower = Follower(estimator)
    rows = stretches(seed, "cup", 2 * count)
    for name in ("kurtosis", "way_cup"):
        rows[:, NAMES.index(name)] += offset
    for k, row in enumerate(rows):
        if k and k % 2 == 0:
            follower.begin()
        last = follower.take(row, 1.5 * (k + 1), 80.0 * (k + 1))
    return last


def test_what_box_and_bearing_add_is_in_all_recordings_and_repetition_does_not_take_it_away(
    estimator: Estimator,
) -> None:
    quantities = dict(estimator.card["quantities"])
    quantities["width"] = {**quantities["width"], "shared": 0.9, "explained": 0.6}
    shy = replace(estimator, card={**estimator.card, "quantities": quantities})
    low, high = np.log(np.array(quantities["width"]["ranges"][-1]))
    least = np.sqrt(0.9 * 0.4) * (high - low)  # of an interval of 90 %
    for count in (2, 10, 40):
        width = np.ptp(np.log(over_recordings(shy, 0.0, 3, count).estimates["width"].intervals[-1]))
        assert 0.85 * least < width < 1.2 * least
    # boxes that differ by a third of the width: many recordings of one do not make it surely wrong
    held = 0
    for seed, offset in enumerate(2.0 * NORMAL_OF_TEN):
        last = over_recordings(shy, offset, seed, 10).estimates["width"]
        held += last.intervals[-1][0] <= 6e-3 <= last.intervals[-1][1]
    assert held >= 9


def test_a_step_of_the_load_is_followed_within_three_stretches(estimator: Estimator) -> None:
    rows = np.concatenate([stretches(7, "healthy", 10, load=4e4), stretches(8, "healthy", 6, load=8e4)])
    steps = followed(estimator, rows, with_life=False)
    assert not any("vertical_load" in each.changed for each in steps[:10])
    assert steps[9].estimates["vertical_load"].value == pytest.approx(4e4, rel=0.15)
    assert steps[12].estimates["vertical_load"].value == pytest.approx(8e4, rel=0.2)


@pytest.mark.parametrize("rate", [0.3e-10, 3e-10])
def test_width_and_rate_of_a_growing_spall_are_followed(estimator: Estimator, rate: float) -> None:
    law, length, metres, count = GrowthLaw(), 40e-3, 5e4, 15
    area = np.full(count, 260e-6)
    for k in range(1, count):
        area[k] = law.grow_areas(area[k - 1 : k], np.array([rate]), metres)[0]
    ones = np.ones(count)
    ends = []
    for seed in (12, 13, 14):  # one of several draws can be off by chance
        rows = received(
            np.random.default_rng(seed), 5e4 * ones, 1e-4 * ones, np.repeat("cup", count), area / length,
            length=length * ones,
        ).descriptors  # fmt: skip
        ends.append(followed(estimator, rows, metres, with_life=False)[-1])
    for last in ends:
        assert last.estimates["width"].value == pytest.approx(area[-1] / length, rel=0.2)
        assert last.rate[1] < law.rate_spread  # more is known of it than at first
    found = float(np.median([last.rate[0] for last in ends]))
    # half a millimetre of growth is less than what stretches differ by: then it is only called slow
    assert found < law.rate if rate < law.rate else 0.5 < found / rate < 2.0


def test_a_signal_unlike_all_that_was_learnt_from_is_unexplained(estimator: Estimator) -> None:
    rows = stretches(9, "healthy", 6)
    strange = rows[-1:] + 60.0 * (np.arange(rows.shape[1]) % 2)
    steps = followed(estimator, np.concatenate([rows, strange]))
    assert steps[-2].health == HEALTHY
    assert steps[-1].health == UNEXPLAINED
    assert "learnt from" in steps[-1].doubts[0]


def test_what_no_stretch_tells_is_not_told_of_all_of_them(estimator: Estimator) -> None:
    deaf = {name: replace(each, reach=20.0 * each.reach) for name, each in estimator.regressions.items()}
    last = followed(replace(estimator, regressions=deaf), stretches(5, "cup", 6, load=8e4))[-1]
    for name in ("vertical_load", "end_play", "width", "length"):
        assert np.isnan(last.received[name].value)
        assert np.isnan(last.estimates[name].value)
        assert "not identifiable" in last.estimates[name].sentence
    assert last.remains is not None
    assert np.isnan([*last.remains.remaining, last.remains.life, *last.remains.used]).all()
    received = followed(estimator, stretches(5, "cup", 6, load=8e4))[-1]
    assert received.remains is not None
    assert np.isfinite([*received.remains.remaining, received.remains.life, *received.remains.used]).all()


def test_a_doubt_does_not_hide_that_a_bearing_must_come_out(estimator: Estimator) -> None:
    rows = stretches(9, "cup", 6, width=16e-3, length=17e-3)
    strange = rows[-1:] + 60.0 * (np.arange(rows.shape[1]) % 2)
    steps = followed(estimator, np.concatenate([rows, strange]))
    assert steps[-2].health == TAKE_OUT
    assert not steps[-2].doubts
    assert steps[-1].health == TAKE_OUT
    assert "learnt from" in steps[-1].doubts[0]


def test_a_length_that_no_signal_tells_is_that_of_the_runs_learnt_from(estimator: Estimator) -> None:
    fewer = {name: each for name, each in estimator.regressions.items() if name != "length"}
    rows = np.concatenate([stretches(5, "cup", 6), stretches(5, "healthy", 1)])
    last = followed(replace(estimator, regressions=fewer), rows)[-1]
    assert last.estimates.part is not None
    assert last.estimates.part.condition == "cup"
    assert not last.received["length"].intervals  # of this stretch, which receives no spall
    assert last.estimates["length"].intervals[-1] == tuple(
        estimator.card["quantities"]["length"]["ranges"][-1]
    )
    assert last.remains is not None
    assert np.isfinite(last.remains.remaining).all()

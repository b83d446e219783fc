"""The filter under a known load: it is conditioned once, and doubts what the vibration contradicts."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.following import Follower
from beardyn_core.follow.known_load import read_load
from test.follow.synthetic import standard_estimator
from test.follow.test_following import stretches

K = "vertical_load"


@pytest.fixture(scope="module")
def estimator() -> Estimator:
    return standard_estimator()


def test_a_known_load_narrows_the_vertical_load_and_no_repetition_wears_it_to_nothing(
    estimator: Estimator,
) -> None:
    rows = stretches(6, "healthy", 30)
    without, under = Follower(estimator), Follower(estimator)
    load = read_load("50:2")
    for k, row in enumerate(rows):
        under.know_load(load)
        free, told = without.take(row, 1.5 * (k + 1)), under.take(row, 1.5 * (k + 1))
    assert told.estimates.known_load is not None
    assert not told.doubts
    low, high = told.estimates[K].intervals[-1]
    assert low < 50e3 < high
    assert high - low < 0.5 * np.ptp(free.estimates[K].intervals[-1])
    # the vibration may sharpen what is stated, and does not outvote it: its shared error stays
    assert high - low > 0.5 * np.ptp(load.interval)
    k = told.names.index(K)
    assert told.covariance[k, k] < load.deviation**2
    # numbers that are learnt each for itself have no covariance with the load: nothing is bought
    play = told.names.index("end_play")
    assert told.covariance[play, play] == pytest.approx(free.covariance[play, play], rel=1e-6)


def test_a_load_that_the_vibration_contradicts_is_doubted_and_spanned(estimator: Estimator) -> None:
    follower = Follower(estimator)
    follower.know_load(read_load("85:2"))
    for k, row in enumerate(stretches(6, "healthy", 4, load=4e4)):
        step = follower.take(row, 1.5 * (k + 1))
    assert any("contradict" in each for each in step.doubts)
    low, high = step.estimates[K].intervals[-1]
    assert low < 45e3
    assert high > 83e3


def test_another_recording_has_the_load_that_is_then_known(estimator: Estimator) -> None:
    follower = Follower(estimator)
    values = []
    for load, number in (("45:2", 4.5e4), ("75:2", 7.5e4)):
        follower.begin()
        follower.know_load(read_load(load))
        for k, row in enumerate(stretches(7, "healthy", 5, load=number)):
            step = follower.take(row, 1.5 * (k + 1))
        values.append(step.estimates[K].value)
        assert not step.doubts
    assert values == pytest.approx([45e3, 75e3], rel=0.05)
    conditioned = step.covariance[step.names.index(K), step.names.index(K)]
    follower.know_load(None)  # within the recording: the belief opens again
    step = follower.take(stretches(8, "healthy", 1, load=75e3)[0], 100.0)
    assert step.estimates.known_load is None
    assert not step.estimates[K].source
    assert step.covariance[step.names.index(K), step.names.index(K)] > 2.0 * conditioned

"""Drifts are told with their lag; what is simulated lies where the estimator has learnt."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from beardyn_core.follow.quantities import BY_NAME
from evidence.follow import drift
from evidence.follow.drift import DRIFTS, Piece


def step(low: float, high: float, health: str = "healthy", rate: float = 1e-10) -> Any:
    """Make what following came to: an interval of the lateral load [kN]."""
    ends = ((1e3 * low, 1e3 * high),) * 2
    told = SimpleNamespace(
        quantity=BY_NAME["lateral_load"], value=500.0 * (low + high), intervals=ends, reason=""
    )
    part = SimpleNamespace(condition="healthy")
    estimates = type("Told", (dict,), {"part": part})({"lateral_load": told})
    return SimpleNamespace(estimates=estimates, health=health, rate=(rate, 4.0))


@pytest.fixture
def pieces() -> list[Piece]:
    return [Piece(2, {}, {"lateral_load": 1e3 * load}) for load in (-5.0, 12.0)]


def test_the_lag_is_counted_from_the_step_until_the_truth_stays_inside(pieces: list[Piece]) -> None:
    before = [step(-8.0, -2.0), step(-8.0, -2.0)]
    late = [before, [step(-8.0, -2.0), step(8.0, 14.0), step(0.0, 11.0), step(8.0, 14.0)]]
    assert drift.lag(pieces, late, "lateral_load", 1) == 3
    assert drift.lag(pieces, [before, [step(8.0, 14.0)]], "lateral_load", 1) == 0
    assert drift.lag(pieces, [before, [step(8.0, 14.0), step(0.0, 1.0)]], "lateral_load", 1) is None
    row = drift.told("load step", pieces, late, 1.5)[0]
    assert "| -5 kN to 12 kN | 11 kN, 8 kN to 14 kN | 3 stretches, 4.5 s | 2 of 2 | healthy |" in row
    missed = drift.told("load step", pieces, [before, [step(0.0, 1.0)]], 1.5)[0]
    assert "| never |" in missed


def test_what_is_kept_is_of_its_pieces_and_of_how_it_is_received(pieces: list[Piece]) -> None:
    estimator = drift.shipped_estimator()
    kept = drift.digest_of(pieces, estimator)
    assert drift.digest_of(pieces, estimator) == kept
    assert drift.digest_of(pieces[:1], estimator) != kept
    assert drift.digest_of(pieces, replace(estimator, axes=("z",))) != kept


def test_false_growth_is_counted() -> None:
    steps = [[step(0.0, 1.0, "waiting"), step(0.0, 1.0)], [step(0.0, 1.0, "spalled", 2e-10)]]
    sentence = drift.false_growth(steps)
    assert "1 of 3 stretches" in sentence
    assert "2.00 times" in sentence


def test_drifts_lie_within_what_was_learnt_from_and_go_forwards() -> None:
    ranges = drift.shipped_estimator().card["quantities"]
    for make in DRIFTS.values():
        every = make()
        for piece in every:
            for name, truth in piece.truth.items():
                low, high = ranges[name]["ranges"][-1]
                assert low <= truth <= high, (name, truth)
        for one, two in pairwise(every):
            assert one.mileage <= two.mileage
            assert one.time < two.time


def test_a_recording_that_begins_anew_forgets_the_load_of_the_one_before() -> None:
    estimator = drift.shipped_estimator()
    received = np.repeat(estimator.middle[None], 6, axis=0)
    widths = []
    for anew in (False, True):
        several = [Piece(6, {}, {}), Piece(1, {}, {}, 1e6, 10.0, anew)]
        last = drift.followed(several, [received, received[:1]], estimator)[1][0]
        widths.append(np.ptp(last.estimates["lateral_load"].intervals[-1]))
    assert widths[1] > widths[0]

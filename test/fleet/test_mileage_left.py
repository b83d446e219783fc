"""Mileage left: from widths that grow as the law says, and refused where they do not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.fleet.mileage_left import judge_mileage
from beardyn_core.follow.growth import GrowthLaw
from test.fleet.made_history import DAY, history, wide


def test_the_interval_holds_the_mileage_of_spalls_that_grow_by_the_law() -> None:
    law, random, inside, judged = GrowthLaw(), np.random.default_rng(3), 0, 0
    mileage = 2e5 * np.arange(8.0)  # 200 km between the recordings
    for rate in law.rates(40, random):
        across = float(np.exp(random.uniform(np.log(10e-3), np.log(30e-3))))
        begin, drawn = np.array([across * 6e-3]), np.array([rate])
        width = [float(law.grow_areas(begin, drawn, at)[0]) / across for at in mileage]
        measured = [wide("cup", each + random.normal(0.0, 0.5e-3)) for each in width]
        days = history(measured)
        left = judge_mileage([replace(e, mileage=1e8 + m) for e, m in zip(days, mileage, strict=True)], "cup")
        true = float(law.distance(across * np.array(width[-1:]), np.array([across * 20e-3]), drawn)[0])
        if left.is_known and left.distance[2] > 0.0:
            judged += 1
            inside += left.distance[0] <= true <= left.distance[2]
    assert judged >= 30
    assert inside >= 0.8 * judged  # 90 %, less what so few draws scatter


def test_no_number_without_widths_or_where_they_shrink() -> None:
    assert "fewer than 3" in judge_mileage(history(["cup"] * 5), "cup").sentence
    shrinking = history([wide("cup", each) for each in (18e-3, 17e-3, 4e-3, 12e-3, 3e-3, 2e-3, 2e-3)])
    assert not judge_mileage(shrinking, "cup").is_known


def test_a_spall_of_20_mm_has_nothing_left_and_the_assumed_is_named() -> None:
    assert judge_mileage(history([wide("cup", 21e-3)] * 4), "cup").distance == (0.0, 0.0, 0.0)
    known = judge_mileage(history([wide("cup", 8e-3)] * 6), "cup")
    assert known.is_known
    assert any("assumed" in each for each in known.assumed)
    assert "a day" in known.sentence


def test_mileage_counts_from_the_last_recording_although_it_has_no_width() -> None:
    measured = [wide("cup", each) for each in (8e-3, 8.4e-3, 9e-3, 9.5e-3)]
    first = judge_mileage(history(measured, every=DAY), "cup")
    later = judge_mileage(history([*measured, "cup", "cup"], every=DAY), "cup")
    assert first.distance[1] - later.distance[1] == pytest.approx(2 * 5e5, rel=0.2)
    long_ago = judge_mileage(history([*measured, *["cup"] * 400], every=DAY), "cup")
    assert long_ago.distance[1] == 0.0
    assert "take the bearing out now" in long_ago.sentence

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


def test_the_range_over_the_laws_holds_each_that_agrees() -> None:
    measured = [wide("cup", each) for each in (6e-3, 6.4e-3, 7e-3, 7.5e-3, 8e-3)]
    left = judge_mileage(history(measured), "cup")
    assert [each.law for each in left.laws] == [
        "slow, then linear", "linear", "root of the area", "exponential",
    ]  # fmt: skip
    assert [each.is_assumed for each in left.laws] == [True, False, False, False]
    assert left.distance == left.laws[0].distance
    agreeing = [each for each in left.laws if each.agrees]
    assert len(agreeing) > 1  # so few widths tell few laws apart
    for each in agreeing:
        low, likely, high = each.distance
        assert left.span[0] <= low < likely < high <= left.span[1]
    sentence = left.laws_sentence
    assert sentence.endswith("assumed: slow, then linear")
    assert all(each.law in sentence for each in left.laws)


def test_a_history_that_the_assumed_law_cannot_have_made_is_left_to_the_others() -> None:
    # the area grows by the same factor from recording to recording, and is measured well
    widths = 2e-3 * 1.08 ** np.arange(28.0)
    measured = [wide("cup", each, 0.02 * each) for each in widths]
    left = judge_mileage(history(measured), "cup")
    by_name = {each.law: each for each in left.laws}
    assert by_name["exponential"].agrees
    assert not by_name["linear"].agrees
    true = 5e5 * (np.log(20e-3 / 2e-3) / np.log(1.08) - 27.0)
    low, _, high = by_name["exponential"].distance
    assert low <= true <= high
    if not by_name["slow, then linear"].agrees:
        assert not left.is_known
        assert "do not agree with the assumed law" in left.sentence
    assert "and not with" in left.laws_sentence

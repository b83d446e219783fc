"""Health of an axlebox: many recordings, hysteresis, sisters, exchange, a sensor that dies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.fleet.health import ACT, CANNOT_TELL, OK, PLAN, WATCH, Health, HealthSettings, replay
from beardyn_core.fleet.identity import Axlebox
from beardyn_core.fleet.sisters import compare_sisters
from beardyn_core.fleet.store import Stored
from test.fleet.made_history import BEGIN, BOX, DAY, LEVELS, analysis, history, wide

RELEASE = HealthSettings().release


def states(several: list[Stored], exchanges: tuple[float, ...] = ()) -> list[str]:
    return [each.state for each in replay(several, {}, exchanges)[1]]


def train(own: list[float], partner: list[float] | None = None) -> tuple[Health, list[Stored]]:
    """Health of one of 8 axleboxes whose levels rise by so many decibels, day by day."""
    boxes = [Axlebox("V1", str(axle), side) for axle in range(1, 5) for side in ("left", "right")]
    random = np.random.default_rng(1)
    track = random.normal(0.0, 4.0, len(own))  # what all share
    recordings: list[Stored] = []
    for number, box in enumerate(boxes):
        rise = {BOX: own, BOX._replace(side="right"): partner or []}.get(box) or [0.0] * len(own)
        noise = random.normal(0.0, 0.4, (len(own), *LEVELS.shape))
        made = [analysis(levels=LEVELS + each + track[day] + noise[day]) for day, each in enumerate(rise)]
        recordings += history(made, box, first=1000 * number)
    recordings.sort(key=lambda each: each.time)
    mine = [each for each in recordings if each.axlebox == BOX]
    return replay(mine, compare_sisters(recordings))[0], recordings


def test_a_single_verdict_is_watched_and_agreeing_ones_are_planned() -> None:
    found = states(history(["healthy", "cup", "healthy", "cup", "cup"]))
    assert found == [OK, WATCH, WATCH, WATCH, PLAN]


def test_a_verdict_of_little_confidence_does_not_count() -> None:
    assert set(states(history([analysis("cup", 0.3)] * 6))) == {OK}


def test_verdicts_of_different_parts_do_not_add_up() -> None:
    assert PLAN not in states(history(["cup", "cone", "roller", "cup", "cone"]))


def test_wide_spalls_call_for_action_by_the_upper_end_of_their_interval() -> None:
    assert states(history([wide("cup", 8e-3)] * 4))[-1] == PLAN
    assert states(history([wide("cup", 9e-3, 11.5e-3)] * 4))[-1] == ACT


def test_a_spall_that_was_wide_stays_wide_where_it_is_no_longer_measured() -> None:
    assert states(history([wide("cup", 11e-3), "cup", wide("cup", 12e-3), *["cup"] * 5]))[-1] == ACT
    assert states(history([wide("cup", 11e-3), *["cup"] * 7]))[-1] == PLAN


def test_an_alarm_stays_while_levels_are_high_though_no_part_is_named() -> None:
    rise = [0.0] * 14 + [14.0] * (RELEASE + 8)
    _, recordings = train(rise)
    mine = [each for each in recordings if each.axlebox == BOX]
    made = [
        replace(each, analysis=replace(each.analysis, verdict="cone" if 14 <= day < 18 else "healthy"))
        for day, each in enumerate(mine)
    ]
    health, _ = replay(made, compare_sisters(recordings))
    assert (health.state, health.part, health.support) == (PLAN, "cone", 0)


def test_an_alarm_ends_only_after_many_recordings_without_cause() -> None:
    # the last of the three agreeing ones leaves the last five after three more
    found = states(history(["cup"] * 3 + ["healthy"] * (RELEASE + 3)))
    assert found[2 : 2 + RELEASE] == [PLAN] * RELEASE
    assert found[-1] != PLAN
    again = states(history(["cup"] * 3 + ["healthy"] * (RELEASE - 1) + ["cup"] * 3 + ["healthy"]))
    assert set(again[2:]) == {PLAN}


def test_since_is_when_it_left_ok_and_at_which_mileage() -> None:
    health, _ = replay(history(["healthy", "healthy", "cup", "cup", "cup", "cup"]), {})
    assert health.since == BEGIN + 2 * DAY
    assert health.since_mileage == 1e8 + 1e6
    assert health.raised == BEGIN + 4 * DAY


def test_an_exchanged_bearing_starts_anew() -> None:
    several = history(["cup"] * 5 + ["healthy"] * 2)
    health, points = replay(several, {}, [BEGIN + 4.5 * DAY])
    assert health.state == OK
    assert len(points) == 2


def test_a_sensor_that_dies_is_never_healthy_and_an_alarm_stays() -> None:
    dead = analysis("not_diagnosable", np.nan)
    assert states(history(["healthy", "healthy", dead, dead])) == [OK, OK, CANNOT_TELL, CANNOT_TELL]
    health, _ = replay(history(["cup", "cup", "cup", dead, dead]), {})
    assert health.state == PLAN
    assert any("the alarm stays" in each for each in health.notes)


def test_a_hot_box_is_for_action_at_once() -> None:
    hot = analysis(temperature=273.15 + 125.0)
    assert states(history(["healthy", hot]))[-1] == ACT
    assert states(history(["healthy", "hot_box"]))[-1] == ACT


def test_levels_that_rise_over_the_sisters_are_watched_and_not_those_that_all_share() -> None:
    steady, recordings = train([0.0] * 20)
    assert steady.state == OK
    for box in {each.axlebox for each in recordings}:
        own = [each for each in recordings if each.axlebox == box]
        assert replay(own, compare_sisters(recordings))[0].state == OK
    risen, _ = train([0.0] * 14 + [9.0] * 6)
    assert risen.state == WATCH
    assert "risen over its own baseline" in risen.why[0]


def test_a_wheel_that_both_ends_of_an_axle_have_is_a_note() -> None:
    rise = [0.0] * 14 + [14.0] * 6
    health, _ = train(rise, partner=rise)
    assert health.state == OK
    assert any("wheelset" in each for each in health.notes)


def test_a_level_far_below_all_others_cannot_tell() -> None:
    health, _ = train([0.0] * 12 + [-40.0])
    assert health.state == CANNOT_TELL
    assert "far below" in health.why[0]


def test_two_verdicts_and_risen_levels_agree_to_a_plan() -> None:
    _, recordings = train([0.0] * 14 + [14.0] * 6)
    mine = [each for each in recordings if each.axlebox == BOX]
    called = history(["healthy"] * 18 + ["cup"] * 2)
    merged = [
        Stored(
            one.number, one.axlebox, one.train, one.time, one.mileage, one.bearing, one.file, False,
            analysis(two.analysis.verdict, levels=one.analysis.levels),
        )
        for one, two in zip(mine, called, strict=True)
    ]  # fmt: skip
    others = [each for each in recordings if each.axlebox != BOX]
    both = sorted([*merged, *others], key=lambda each: each.time)
    assert replay(merged, compare_sisters(both))[0].state == PLAN
    assert replay(called, {})[0].state == WATCH

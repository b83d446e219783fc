"""The stream that the load node takes out of a scenario."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.replay import Replay, ReplayClock

STEP_NS = 500_000
BEGIN_NS = 7_000_000
FADE = 0.05
FADE_SAMPLES = 100


def scenario(count: int = 1001) -> LoadHistory:
    """Half a second of a load that ends far from where it begins."""
    at = np.arange(float(count))
    wrench = np.outer(at + 40.0 * np.sin(0.02 * at), [1.0, -2.0, 30.0, 0.1, 0.2, -0.3])
    time_ns = BEGIN_NS + np.arange(count) * STEP_NS
    return LoadHistory(time_ns, wrench, 100.0 + 0.02 * at, np.outer(at, [0.0, 0.0, 1e-6]))


def columns(load: LoadHistory) -> np.ndarray:
    return np.column_stack([load.wrench, load.shaft_speed, load.bogie])


def joined(parts: list[LoadHistory]) -> tuple[np.ndarray, np.ndarray]:
    return np.concatenate([part.time_ns for part in parts]), np.concatenate([columns(p) for p in parts])


@given(cuts=st.lists(st.integers(1, 400), min_size=1, max_size=12))
def test_stream_is_the_scenario_itself_however_it_is_cut(cuts: list[int]) -> None:
    whole, replay = scenario(), Replay(scenario())
    parts = [replay.take(count) for count in (*cuts, 2000)]
    time_ns, values = joined(parts)
    assert np.array_equal(time_ns, whole.time_ns)
    assert np.array_equal(values, columns(whole))
    assert replay.next_sample == len(whole)
    assert len(replay.take(10)) == 0
    assert [passage.sample for passage in replay.passages] == [0]


@given(cuts=st.lists(st.integers(1, 700), min_size=1, max_size=8))
def test_loop_does_not_depend_on_how_the_stream_is_cut(cuts: list[int]) -> None:
    at_once, in_parts = (Replay(scenario(), loop=True, fade=FADE) for _ in range(2))
    parts = [in_parts.take(count) for count in cuts]
    time_ns, values = joined(parts)
    whole = at_once.take(sum(cuts))
    assert np.array_equal(time_ns, whole.time_ns)
    assert np.array_equal(values, columns(whole))
    assert at_once.passages == in_parts.passages


def test_loop_goes_on_in_numbers_and_stamps_and_never_jumps() -> None:
    whole, replay = columns(scenario()), Replay(scenario(), loop=True, fade=FADE)
    load = replay.take(3000)
    assert np.array_equal(load.time_ns, BEGIN_NS + np.arange(3000) * STEP_NS)
    lap = len(whole) - FADE_SAMPLES
    assert [passage.sample for passage in replay.passages] == [0, lap, 2 * lap, 3 * lap]
    for passage in replay.passages[1:]:
        assert (passage.position_s, passage.fade_s) == (0.0, FADE)
    assert np.array_equal(columns(load)[lap + FADE_SAMPLES : 2 * lap], whole[FADE_SAMPLES:lap])
    own = np.abs(np.diff(whole, axis=0)).max(axis=0)
    steepest = np.pi / 2 * np.abs(whole[lap:] - whole[:FADE_SAMPLES]).max(axis=0) / FADE_SAMPLES
    assert np.all(np.abs(np.diff(columns(load), axis=0)).max(axis=0) <= own + steepest)
    # half a cosine also keeps the slope: no sample bends the load more than the middle of the fade
    bend = np.abs(np.diff(columns(load)[:, 2], 2))
    assert bend[lap - 5 : lap + 2].max() < 2.0 * bend[lap + 2 : lap + FADE_SAMPLES].max()


def test_seek_moves_the_position_while_stamps_go_on() -> None:
    whole, replay = columns(scenario()), Replay(scenario(), fade=FADE)
    before = replay.take(200)
    replay.seek(0.3)
    after = replay.take(2000)
    time_ns, values = joined([before, after])
    assert np.all(np.diff(time_ns) == STEP_NS)
    first, passage = replay.passages
    assert (first.sample, first.position_s, first.stamp_ns) == (0, 0.0, BEGIN_NS)
    assert (passage.sample, passage.position_s, passage.stamp_ns) == (200, 0.3, BEGIN_NS + 200 * STEP_NS)
    assert np.array_equal(values[200 + FADE_SAMPLES :], whole[600 + FADE_SAMPLES :])
    middle = 200 + FADE_SAMPLES // 2 - 1
    weight = 0.5 - 0.5 * np.cos(np.pi * 50 / 101)
    assert np.allclose(values[middle], (1 - weight) * whole[249] + weight * whole[649], rtol=1e-12)


def test_seek_during_a_cross_fade_waits_for_its_end() -> None:
    replay = Replay(scenario(), fade=FADE)
    replay.take(200)
    replay.seek(0.3)
    replay.take(10)
    replay.seek(0.1)
    replay.take(500)
    assert [p.sample for p in replay.passages] == [0, 200, 200 + FADE_SAMPLES]
    assert [p.position_s for p in replay.passages] == pytest.approx([0.0, 0.3, 0.1])


def test_seek_close_to_the_end_fades_onto_the_last_sample_and_ends() -> None:
    whole, replay = columns(scenario()), Replay(scenario(), fade=FADE)
    replay.take(10)
    replay.seek(0.5)
    load = replay.take(2000)
    assert len(load) == FADE_SAMPLES
    assert np.allclose(columns(load)[-1], whole[-1], rtol=1e-2)
    assert len(replay.take(1)) == 0


def test_loop_can_be_switched_off_and_the_scenario_then_ends() -> None:
    replay = Replay(scenario(), loop=True, fade=FADE)
    replay.take(1500)
    replay.loop = False
    assert replay.next_sample + len(replay.take(5000)) == 901 + 1001


def test_begin_inside_the_scenario_has_no_fade() -> None:
    replay = Replay(scenario(), position=0.25)
    assert np.array_equal(columns(replay.take(2000)), columns(scenario())[500:])


def test_uneven_samples_of_a_recording_go_straight_through_with_their_own_stamps() -> None:
    load = scenario(400)
    time_ns = BEGIN_NS + np.cumsum(np.where(np.arange(400) % 7, 500_000, 2_000_000))
    uneven = LoadHistory(time_ns, load.wrench, load.shaft_speed, load.bogie)
    replay, parts = Replay(uneven), []
    while not replay.exhausted:
        parts.append(replay.take(max(replay.samples_before(replay.next_ns + 20_000_000), 1)))
        assert parts[-1].time_ns[-1] - parts[-1].time_ns[0] < 20_000_000
    times, values = joined(parts)
    assert np.array_equal(times, time_ns)
    assert np.array_equal(values, columns(uneven))
    assert "straight through" in replay.problem_of_seek(0.1)
    assert "straight through" in replay.problem_of_loop(True)


@given(ahead_ns=st.integers(-STEP_NS, 10 * STEP_NS), taken=st.integers(0, 300))
def test_samples_before_a_stamp_are_counted(ahead_ns: int, taken: int) -> None:
    replay = Replay(scenario())
    replay.take(taken)
    count = replay.samples_before(replay.next_ns + ahead_ns)
    times = scenario().time_ns[taken:]
    assert count == np.count_nonzero(times < BEGIN_NS + taken * STEP_NS + ahead_ns)


def test_what_cannot_be_replayed_is_refused_with_the_reason() -> None:
    backwards, uneven = scenario(), scenario()
    backwards.time_ns[5] = backwards.time_ns[4]
    uneven.time_ns[5] += 1
    for arguments, words in (
        ({"history": backwards}, "one after the other"),
        ({"history": uneven, "position": 0.1}, "evenly spaced"),
        ({"history": uneven, "loop": True}, "evenly spaced"),
        ({"history": scenario(1)}, "two samples"),
        ({"history": scenario(), "position": 0.6}, "outside the scenario, which is 0.5 s long"),
        ({"history": scenario(), "loop": True, "fade": 0.3}, "needs a scenario at least twice as long"),
    ):
        with pytest.raises(InputError, match=words):
            Replay(**arguments)


def test_clock_follows_pace_and_pause_without_a_jump() -> None:
    wall = [100.0]
    clock = ReplayClock(1.0, lambda: wall[0])
    passed = []
    for order, argument in (
        ("start", ()),
        ("set_pace", (4.0,)),
        ("pause", (True,)),
        ("set_pace", (0.5,)),
        ("pause", (False,)),
        ("start", ()),
    ):
        before = clock.passed()
        getattr(clock, order)(*argument)
        assert clock.passed() == pytest.approx(before)
        wall[0] += 2.0
        passed.append(clock.passed())
    assert passed == pytest.approx([2.0, 10.0, 10.0, 10.0, 11.0, 12.0])
    assert all(later >= earlier for earlier, later in pairwise(passed))

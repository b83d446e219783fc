"""The queue between the subscription and the twin's thread."""

from __future__ import annotations

import threading
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.load_check import problem_with
from beardyn_ros.live_load import LiveLoad
from beardyn_ros.load_gate import LoadGate, Refusals

STEP_NS = 500_000


def history(count: int) -> LoadHistory:
    wrench = np.arange(6.0 * count).reshape(count, 6)
    return LoadHistory(np.arange(count) * STEP_NS, wrench, np.full(count, 100.0), np.zeros((count, 3)))


def new_gate(seconds: int = 60, most_bytes: int = 10**9) -> LoadGate:
    return LoadGate(seconds * 1_000_000_000, most_bytes, Refusals(), threading.Condition())


@given(
    cuts=st.lists(st.integers(1, 399), max_size=8),
    ends=st.lists(st.integers(0, 400 * STEP_NS), min_size=1, max_size=12),
)
def test_what_goes_in_comes_out_in_order_however_it_is_cut(cuts: list[int], ends: list[int]) -> None:
    whole, gate = history(400), new_gate()
    edges = sorted({0, 400, *cuts})
    for first, last in pairwise(edges):
        assert gate.offer(whole.part(first, last), np.arange(first, last)) is None
    taken: list[int] = []
    for end in [*sorted(ends), 10**12]:
        part = gate.take_through(end)
        if part is None:
            continue
        taken += part.time_ns.tolist()
        assert np.count_nonzero(part.time_ns >= end) <= 1
        if gate.waiting:
            assert part.time_ns[-1] >= end
    assert taken == whole.time_ns.tolist()
    assert gate.waiting == 0


def test_block_with_a_hole_inside_is_a_gap() -> None:
    gate = new_gate()
    samples = np.array([0, 1, 3, 4])
    assert "do not run on" in (gate.offer(history(4), samples) or "")
    assert gate.refusals.report().by_reason == (("gap", 1),)


def test_refused_block_can_be_sent_again_and_the_end_is_then_clean() -> None:
    gate, whole = new_gate(), history(30)
    assert gate.offer(whole.part(0, 10), np.arange(0, 10)) is None
    assert gate.offer(whole.part(20, 30), np.arange(20, 30)) is not None
    assert gate.offer(whole.part(10, 30), np.arange(10, 30)) is None
    gate.offer(whole.part(0, 0), np.arange(0))
    assert gate.ended
    assert gate.failure == ""


def test_leftovers_of_the_old_stream_are_dropped_after_a_restart() -> None:
    gate, whole = new_gate(), history(30)
    gate.offer(whole.part(0, 10), np.arange(0, 10))
    gate.restart()
    assert gate.offer(whole.part(10, 20), np.arange(10, 20)) is None
    gate.offer(whole.part(0, 0), np.arange(0))
    assert gate.waiting == 0
    assert not gate.ended
    assert gate.offer(whole.part(0, 10), np.arange(0, 10)) is None
    assert gate.waiting == 10
    assert gate.refusals.report().count == 0


def test_live_load_refuses_old_stamps_and_absurd_numbers() -> None:
    live = LiveLoad(Refusals(), threading.Condition(), bandwidth=10.0)
    assert live.held() is None
    assert live.offer_wrench(np.full(6, 5.0), 10) is None
    assert live.offer_speed(100.0, 10) is None
    assert "not after" in (live.offer_speed(101.0, 10) or "")
    assert "allowed is up to" in (live.offer_wrench(np.array([0, 0, 1.1e7, 0, 0, 0]), 20) or "")
    held = live.held()
    assert held is not None
    assert held.shaft_speed == 100.0
    assert live.refusals.report().count == 2


@pytest.mark.parametrize("cut", [10, 15])
def test_a_jump_of_the_shaft_speed_is_absurd_inside_a_block_and_between_blocks(cut: int) -> None:
    whole, gate = history(30), new_gate()
    speed = whole.shaft_speed.copy()
    speed[15:] = 151.0
    jumping = LoadHistory(whole.time_ns, whole.wrench, speed, whole.bogie)
    assert "shaft_speed jumps from 100 to 151 rad/s within 0.5 ms" in (problem_with(jumping, None) or "")
    assert gate.offer(jumping.part(0, cut), np.arange(cut)) is None
    assert "jumps from 100 to 151" in (gate.offer(jumping.part(cut, 30), np.arange(cut, 30)) or "")
    assert gate.refusals.report().by_reason == (("absurd", 1),)
    assert gate.offer(whole.part(cut, 30), np.arange(cut, 30)) is None


def test_a_change_of_50_rad_per_s_or_one_over_a_tenth_of_a_second_is_taken() -> None:
    whole = history(2)
    for last_ns, speed in ((STEP_NS, 150.0), (100_000_000, 300.0)):
        time_ns = np.array([0, last_ns])
        load = LoadHistory(time_ns, whole.wrench, np.array([100.0, speed]), whole.bogie)
        assert problem_with(load, None) is None


def test_live_load_refuses_a_jump_of_the_shaft_speed() -> None:
    live = LiveLoad(Refusals(), threading.Condition(), bandwidth=10.0)
    assert live.offer_speed(100.0, 0) is None
    assert "jumps from 100 to 160" in (live.offer_speed(160.0, 20_000_000) or "")
    assert live.offer_speed(101.0, 40_000_000) is None
    assert live.refusals.report().by_reason == (("absurd", 1),)


def test_queue_is_bounded_by_time_at_any_sample_rate() -> None:
    for step_ns in (500_000, 100_000):
        gate = new_gate(seconds=1)
        count = 1_000_000_000 // step_ns
        load = history(count + 2)
        load = LoadHistory(np.arange(count + 2) * step_ns, load.wrench, load.shaft_speed, load.bogie)
        assert gate.offer(load.part(0, 10), np.arange(10)) is None
        assert gate.offer(load.part(10, count + 1), np.arange(10, count + 1)) is None
        assert gate.waiting_s == pytest.approx(1.0)
        sentence = gate.offer(load.part(count + 1, count + 2), np.arange(count + 1, count + 2)) or ""
        assert "s of load are waiting, the queue holds 1 s" in sentence
        assert gate.failure
        assert gate.refusals.report().by_reason == (("overflow", 1),)


def test_queue_is_bounded_by_memory_whatever_the_stamps_say() -> None:
    gate, load = new_gate(seconds=3600, most_bytes=880), history(11)
    assert gate.offer(load.part(0, 10), np.arange(10)) is None
    assert "880" not in gate.failure
    assert "load_queue_size is too small" in (gate.offer(load.part(10, 11), np.arange(10, 11)) or "")
    assert "load_queue_size" in gate.failure

"""Blocks that are computed before they are due: how many, held, left and failed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rclpy", reason="rclpy is not installed (pip install .[ros])")

from beardyn_ros.load_feed import LOAD_IS_PAUSED
from beardyn_ros.run_state import Outgoing, SessionOptions
from beardyn_ros.session import MOST_AHEAD, TwinSession
from test.ros.fake_twin import FakeTwin, fake_history, fake_rig

PATIENCE_S, LOAD_TIMEOUT_S = 20.0, 0.3
SLOWLY = 0.01  # a block is due every two seconds
PART = 40  # samples of load in a message, one block


class Run:
    """A session of the fake twin in this process, and what it has handed over."""

    def __init__(self, pace: float, monkeypatch: pytest.MonkeyPatch, load_timeout: float) -> None:
        options = SessionOptions(
            *("lockstep", load_timeout, PATIENCE_S, 1.0, 10**11, 10**9, False, 10.0, "axlebox", "fake")
        )
        self.computed = 0
        self.handed_over: list[Outgoing] = []
        advance = FakeTwin.advance

        def counted(twin: FakeTwin) -> Any:
            self.computed += 1
            return advance(twin)

        monkeypatch.setattr(FakeTwin, "advance", counted)
        self.session = TwinSession(fake_rig("fake", ""), options, pace, lambda: None)
        self.session.compile()
        self.session.activate(True)

    def send(self, first_block: int, blocks: int, last: bool = False) -> None:
        load = fake_history("", "", 10.0)
        for first in range(first_block * PART, (first_block + blocks) * PART, PART):
            numbers = np.arange(first, first + PART)
            assert self.session.feed.gate.offer(load.part(first, first + PART), numbers) is None
        if last:
            assert self.session.feed.gate.offer(load.part(0, 0), np.arange(0)) is None

    def hold_with_its_load(self, blocks: int) -> None:
        """Pause load and run behind so many blocks."""
        self.until(lambda: self.blocks >= blocks)
        self.session.feed.pause(True)
        self.session.pause(True)
        self.until(lambda: self.state == "paused")

    def until(self, condition: Callable[[], Any]) -> None:
        deadline = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < deadline
            self.collect()
            time.sleep(0.002)

    def collect(self) -> None:
        for outgoing in self.session.collect():
            self.handed_over.append(outgoing)
            if outgoing.clock_ns is not None:
                self.session.pacer.check_published(outgoing.clock_ns, outgoing.due_at)

    def go_on(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        self.until(lambda: time.monotonic() > end)

    @property
    def state(self) -> str:
        return self.session.report().state

    @property
    def blocks(self) -> int:
        return self.session.report().blocks

    def stamps(self) -> list[int]:
        """Simulated times of the blocks, each run begun by a ``None``, which is left out here."""
        return [each.clock_ns for each in self.handed_over if each.clock_ns is not None]


@pytest.fixture
def make_run(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Run]]:
    made: list[Run] = []

    def make(pace: float, load_timeout: float = PATIENCE_S) -> Run:
        made.append(Run(pace, monkeypatch, load_timeout))
        return made[-1]

    yield make
    for run in made:
        run.session.end(5.0)


def test_no_more_blocks_are_computed_than_may_wait(make_run: Callable[..., Run]) -> None:
    run = make_run(SLOWLY)
    run.send(0, 40)
    run.until(lambda: run.computed == MOST_AHEAD + 1)
    time.sleep(0.1)
    run.collect()
    assert (run.computed, run.stamps(), run.blocks) == (MOST_AHEAD + 1, [], 0)


def test_every_block_is_handed_over_in_its_order_and_the_end_is_told_after_it(
    make_run: Callable[..., Run],
) -> None:
    run = make_run(5.0)
    run.send(0, 50, last=True)
    run.until(lambda: run.state == "finished")
    run.collect()
    steps = np.diff(run.stamps())
    assert len(steps) > 40
    assert len(set(steps)) == 1
    assert run.blocks == run.computed


def test_a_run_that_is_held_waits_for_load_as_long_as_it_is_held(make_run: Callable[..., Run]) -> None:
    """The load node sends no more than is used, and of a held run nothing is."""
    run = make_run(1.0, LOAD_TIMEOUT_S)
    run.send(0, 10)
    run.until(lambda: run.computed >= 9)
    run.session.pause(True)
    run.until(lambda: run.state == "paused")
    stood = run.blocks
    time.sleep(3 * LOAD_TIMEOUT_S)
    assert (run.state, run.blocks) == ("paused", stood)
    run.session.pause(False)
    run.until(lambda: run.state == "stopped")
    report = run.session.report()
    assert f"no usable load for {LOAD_TIMEOUT_S:g} s" in report.sentence
    assert report.blocks == run.computed  # all that could be computed is handed over first


def test_time_without_load_is_left_out_of_the_pace_once_nothing_is_ahead(
    make_run: Callable[..., Run],
) -> None:
    run = make_run(0.5)
    run.send(0, 10)  # computed at once, and handed over in 0.4 s
    run.until(lambda: run.blocks >= 9)
    begin = time.monotonic()
    time.sleep(0.2)
    run.send(10, 30, last=True)
    slept = time.monotonic() - begin
    run.until(lambda: run.state == "finished")
    assert 0.1 < run.session.report().waited_for_load_s < slept + 0.15


def test_a_reset_forgets_what_is_ahead(make_run: Callable[..., Run]) -> None:
    run = make_run(SLOWLY)
    run.send(0, 40)
    run.until(lambda: run.computed == MOST_AHEAD + 1)
    assert run.session.reset() is None
    run.until(lambda: run.state == "waiting for load")
    run.session.pacer.set_speed_factor(10.0)
    run.send(0, 5, last=True)
    run.until(lambda: run.state == "finished")
    run.collect()
    assert run.blocks == len(run.stamps()) == run.computed - MOST_AHEAD - 1


def test_a_defect_while_handing_over_ends_the_run_with_its_reason(
    make_run: Callable[..., Run], monkeypatch: pytest.MonkeyPatch
) -> None:
    run = make_run(10.0)
    put = run.session._put

    def fails(outgoing: Outgoing, block: Any = None) -> None:
        if block is not None:
            raise ValueError("no such topic")
        put(outgoing)

    monkeypatch.setattr(run.session, "_put", fails)
    run.send(0, 5)
    run.until(lambda: run.state == "stopped")
    assert run.session.report().sentence == "the twin failed: ValueError: no such topic"


def test_a_pause_of_the_load_and_of_the_run_at_once_are_left_out_once(make_run: Callable[..., Run]) -> None:
    run = make_run(1.0)
    run.send(0, 20)
    run.hold_with_its_load(8)
    run.go_on(1.0)
    run.send(20, 100)
    run.session.feed.pause(False)
    run.session.pause(False)
    before, begin = run.blocks, time.monotonic()
    run.until(lambda: run.blocks >= before + 25)
    assert time.monotonic() - begin < 1.0  # it stood still for as long as it had been held
    assert run.session.report().worst_lag_s < 0.5


def test_a_hold_with_nothing_ahead_makes_no_block_late(make_run: Callable[..., Run]) -> None:
    run = make_run(1.0)
    run.send(0, 10)
    run.until(lambda: run.blocks >= 9)
    run.session.pause(True)
    run.until(lambda: run.state == "paused")
    run.go_on(1.0)
    run.send(10, 30, last=True)
    run.session.pause(False)
    run.until(lambda: run.state == "finished")
    assert run.session.report().worst_lag_s < 0.5
    assert run.session.report().wall_s < 1.5


def test_a_run_that_is_slower_than_its_load_timeout_waits_for_none(make_run: Callable[..., Run]) -> None:
    """A load node that keeps to its credit sends nothing until the next block is handed over."""
    run = make_run(0.02 / (3.0 * LOAD_TIMEOUT_S), LOAD_TIMEOUT_S)
    run.send(0, 5)
    run.until(lambda: run.blocks >= 3)
    assert run.state == "running"


def test_a_load_that_is_still_paused_when_a_held_run_goes_on_is_told(make_run: Callable[..., Run]) -> None:
    run = make_run(1.0)
    run.send(0, 12)
    run.hold_with_its_load(4)
    run.session.pause(False)
    run.until(lambda: run.session.report().sentence == LOAD_IS_PAUSED)
    assert run.state == "paused"


def test_a_step_that_is_ordered_of_an_inactive_run_lets_no_load_be_missed(
    make_run: Callable[..., Run],
) -> None:
    run = make_run(1.0, LOAD_TIMEOUT_S)
    run.send(0, 6)
    run.until(lambda: run.blocks >= 1)
    run.session.pause(True)
    run.session.activate(False)
    run.session.step()
    run.go_on(2.0 * LOAD_TIMEOUT_S)
    run.send(6, 10, last=True)
    run.session.activate(True)
    run.session.pause(False)
    run.until(lambda: run.state == "finished")

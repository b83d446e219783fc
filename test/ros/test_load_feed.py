"""What counts as waiting for load: only the time in which there is none."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_of_scene
from beardyn_core.scene.load import LoadHistory
from beardyn_ros import load_feed
from beardyn_ros.load_feed import LoadFeed, missing_background
from beardyn_ros.run_state import SessionOptions

OPTIONS = SessionOptions("lockstep", 5.0, 5.0, 1.0, 10**10, 10**8, False, 10.0, "axlebox", "one")
HANDING_OVER_S, WITHOUT_LOAD_S = 0.03, 0.05
BLOCK_NS, MESSAGE_NS = 20_000_000, 5_000_000


class SlowlyFed:
    """A twin that takes its time with each part of load, and is covered by two."""

    wanted_ns = 0
    parts = 0

    def covered(self) -> bool:
        """Two parts are a block."""
        return self.parts == 2

    def feed(self, _part: Any) -> None:
        """Take a part."""
        time.sleep(HANDING_OVER_S)
        self.parts += 1


class Covered:
    """Takes load until it covers a block, and what the twin looks ahead."""

    block_ns = BLOCK_NS

    def __init__(self, look_ahead_ns: int) -> None:
        self.times: list[int] = []
        self.vertical: list[float] = []
        self.wanted_ns = look_ahead_ns

    def next_block(self) -> None:
        self.wanted_ns += BLOCK_NS

    def covered(self) -> bool:
        return bool(self.times) and self.times[-1] >= self.wanted_ns

    def feed(self, load: LoadHistory) -> None:
        self.times += load.time_ns.tolist()
        self.vertical += load.wrench[:, 2].tolist()


@pytest.mark.parametrize("absent", [False, True])
def test_handing_load_over_is_no_waiting(absent: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Otherwise a run that is never late falls behind the clock by what its load takes: 2 % were found."""
    parts = [None, "load", "load"] if absent else ["load", "load"]

    def wait(_ready: Any, _timeout: float) -> bool:
        time.sleep(WITHOUT_LOAD_S)
        return True

    feed = LoadFeed(OPTIONS, threading.Condition(), wait, lambda _state, _sentence: None)
    gate = SimpleNamespace(take_through=lambda _ns: parts.pop(0), failure="", ended=False, waiting=1)
    monkeypatch.setattr(feed, "gate", gate)
    monkeypatch.setattr(load_feed, "shift_load", lambda part, _ns: part)
    waited = feed.cover(SlowlyFed())
    assert waited is not None
    if absent:
        assert WITHOUT_LOAD_S <= waited < WITHOUT_LOAD_S + HANDING_OVER_S
    else:
        assert waited == 0.0


def test_only_a_load_that_cannot_have_the_background_is_told_of() -> None:
    scene = load_scene("service_freight", tier="lumped")
    assert scene.background is not None
    with_forces = load_of_scene(scene, 0.02)
    without = load_of_scene(replace(scene, background=None), 0.02)
    name = scene.background.name
    assert missing_background(name, with_forces, live=False) == ""
    assert missing_background("", without, live=False) == ""
    told = missing_background(name, without, live=False)
    assert "this load has 10000 samples a second" in told
    assert name in told
    assert "live load is filtered" in missing_background(name, with_forces, live=True)


@pytest.mark.parametrize(("frequency", "least", "most"), [(2.0, 0.97, 1.0), (45.0, 0.0, 0.02)])
def test_live_load_is_filtered_before_it_is_sampled(frequency: float, least: float, most: float) -> None:
    """A sine of 45 Hz, sampled every 20 ms, would come out as one of 5 Hz; found was 5.01 Hz, as strong."""
    options = replace(OPTIONS, mode="live")
    feed = LoadFeed(options, threading.Condition(), lambda ready, _timeout: ready(), lambda *_said: None)
    twin = Covered(0)
    for block in range(200):
        for stamp_ns in range((block - 1) * BLOCK_NS + MESSAGE_NS, block * BLOCK_NS + 1, MESSAGE_NS):
            vertical = 5e4 + 2e4 * np.sin(2.0 * np.pi * frequency * 1e-9 * stamp_ns)
            feed.live.offer_wrench(np.array([0.0, 0.0, vertical, 0.0, 0.0, 0.0]), 10**12 + stamp_ns)
            feed.live.offer_speed(100.0, 10**12 + stamp_ns)
        if block == 0:
            twin.feed(feed.first(BLOCK_NS))
        twin.next_block()
        feed.cover(twin)
    settled = np.array(twin.vertical)[np.array(twin.times) > 1_000_000_000]
    assert least * 2e4 <= 0.5 * np.ptp(settled) <= most * 2e4

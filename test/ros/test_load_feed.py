"""What counts as waiting for load: only the time in which there is none."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_of_scene
from beardyn_ros import load_feed
from beardyn_ros.load_feed import LoadFeed, missing_background
from beardyn_ros.run_state import SessionOptions

OPTIONS = SessionOptions("lockstep", 5.0, 5.0, 1.0, 10**10, 10**8, False, 10.0, "axlebox", "one")
HANDING_OVER_S, WITHOUT_LOAD_S = 0.03, 0.05


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

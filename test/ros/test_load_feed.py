"""What counts as waiting for load: only the time in which there is none."""

from __future__ import annotations

import threading
import time
from types import SimpleNamespace
from typing import Any

import pytest

from beardyn_ros import load_feed
from beardyn_ros.load_feed import LoadFeed
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
    monkeypatch.setattr(load_feed, "shifted", lambda part, _ns: part)
    waited = feed.cover(SlowlyFed())
    assert waited is not None
    if absent:
        assert WITHOUT_LOAD_S <= waited < WITHOUT_LOAD_S + HANDING_OVER_S
    else:
        assert waited == 0.0

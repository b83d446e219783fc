"""When the load looks for credit: seldom for a twin in real time, often for a fast one."""

from __future__ import annotations

import pytest

from beardyn_ros import replay
from beardyn_ros.replay import LEISURELY_S, QUICK_S, Credit

LEAD_S = 0.9  # of the default horizon, less one message
BLOCK_S = 0.02


class Clock:
    """Wall time that a test moves."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now


def periods(monkeypatch: pytest.MonkeyPatch, rate: float, lead: float = LEAD_S) -> list[float]:
    """Periods of two seconds beside a twin that uses ``rate`` seconds of load a second, block by block."""
    clock = Clock()
    monkeypatch.setattr(replay, "time", clock)
    held = Credit()
    held.begin(0)
    begin, found = clock.now, []
    while clock.now < begin + 2.0:
        held.receive(round((clock.now - begin) * rate / BLOCK_S) * round(BLOCK_S * 1e9))
        found.append(held.look_period(lead))
        clock.now += found[-1]
    return found


def test_a_twin_in_real_time_wakes_the_load_twenty_times_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    assert periods(monkeypatch, 1.0).count(LEISURELY_S) >= 38


@pytest.mark.parametrize("rate", [5.0, 20.0, 300.0])
def test_a_fast_twin_is_served_quickly(monkeypatch: pytest.MonkeyPatch, rate: float) -> None:
    """Between two looks it never uses up what it has in advance."""
    found = periods(monkeypatch, rate)
    assert set(found[2:]) == {QUICK_S}
    assert rate * QUICK_S < 2.0 * LEAD_S


def test_a_short_lead_is_looked_after_in_real_time_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shortest horizon, with messages of half its length."""
    assert set(periods(monkeypatch, 1.0, lead=0.05)[1:]) == {QUICK_S}


def test_silence_is_told_from_credit_that_does_not_move(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(replay, "time", clock)
    held = Credit()
    held.receive(5)
    clock.now += 1.0
    held.receive(5)
    assert (held.received_at, held.changed_at) == (101.0, 100.0)

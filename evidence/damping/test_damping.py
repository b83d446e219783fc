"""Contact damping over its quoted range: every run goes to its end, and its energy closes."""

from __future__ import annotations

import pytest

from evidence.damping.study import TIMES_US, inlet, receive, spalled


# the ends of the range; what lies between is slow
@pytest.mark.parametrize(
    "time_us",
    [t if t in (TIMES_US[0], TIMES_US[-1]) else pytest.param(t, marks=pytest.mark.slow) for t in TIMES_US],
)
def test_a_deep_spall_runs_to_its_end_over_the_quoted_range(time_us: float) -> None:
    """At 25 us it ended with a roller beyond the edge of its rib: damping pulled rollers down from edges."""
    received = receive(spalled(2e-4, 1e-2), 0.6, time_us)
    assert received.says == "fine"
    assert received.residual < 1e-2


def test_the_film_alone_damps_within_the_quoted_range() -> None:
    """The estimate falls with the speed as 0.7 l / u does."""
    times = [inlet(speed).time for speed in (500.0, 1165.0, 2500.0)]
    assert times == sorted(times, reverse=True)
    assert 2.5e-6 < times[1] < 25e-6

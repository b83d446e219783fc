"""Trend messages in time: even, in order, made up for when late, and all at once when there is no pace."""

from __future__ import annotations

import time

import numpy as np

from beardyn_ros.wire import CLOSEST, MOST_MOMENTS, Spreader

SPACING_S = 0.01


class Times(list[tuple[float, str]]):
    """When each message went out."""

    def publish(self, name: str, _cdr: bytes) -> None:
        self.append((time.monotonic(), name))


def block(count: int, first: int = 0) -> list[tuple[float, str, bytes]]:
    return [(k * SPACING_S, f"{first + k}", b"") for k in range(count)]


def gaps(times: Times) -> np.ndarray:
    return np.diff([at for at, _ in times])


def test_messages_are_never_early_and_go_out_in_order() -> None:
    times = Times()
    spreader = Spreader(times.publish)
    begin = time.monotonic()
    spreader.spread(block(8), 1.0)
    spreader.drain(5.0)
    spreader.end()
    assert [name for _, name in times] == [f"{k}" for k in range(8)]
    assert all(at - begin >= k * SPACING_S for k, (at, _) in enumerate(times))


def test_what_is_late_keeps_apart_from_the_next() -> None:
    times = Times()
    spreader = Spreader(times.publish)
    spreader.spread(block(8), 1.0)
    spreader.spread(block(8, 8), 1.0)  # two blocks at the same time: the second one is a block early
    spreader.drain(5.0)
    spreader.end()
    assert [name for _, name in times] == [f"{k}" for k in range(16)]
    assert np.all(gaps(times) >= CLOSEST * SPACING_S)


def test_without_a_pace_and_far_behind_everything_goes_out_at_once() -> None:
    times = Times()
    spreader = Spreader(times.publish)
    spreader.spread(block(8), 0.0)
    assert len(times) == 8
    for first in range(0, 4 * MOST_MOMENTS, 8):
        spreader.spread(block(8, first), 0.001)
        assert len(spreader._waiting) <= MOST_MOMENTS + 8
    spreader.end()
    assert len(times) == 8 + 4 * MOST_MOMENTS

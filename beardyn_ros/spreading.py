"""Trend messages one after the other instead of in bursts: a reader with a short queue gets them all."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from itertools import groupby
from typing import NamedTuple

CLOSEST = 0.8  # of the spacing between two moments that were meant; so a late one is made up for
LONGEST_SLEEP_S = 0.05
MOST_MOMENTS = 24  # behind more than that, everything goes out at once


class _Moment(NamedTuple):
    """Messages of one time: when they are due, and how close to the ones before they may come."""

    due: float
    gap: float
    messages: tuple[tuple[str, bytes], ...]


class Spreader:
    """Publishes messages at their times, from a thread of its own.

    Parameters
    ----------
    publish : callable
        ``publish(topic, cdr)``; may be called from any thread.
    """

    def __init__(self, publish: Callable[[str, bytes], object]) -> None:
        self._publish = publish
        self._condition = threading.Condition()
        self._waiting: deque[_Moment] = deque()
        self._last = 0.0
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="trends", daemon=True)
        self._thread.start()

    def spread(self, messages: Sequence[tuple[float, str, bytes]], pace: float) -> None:
        """Publish messages over the time to come, behind what still waits.

        Parameters
        ----------
        messages : sequence of (offset, topic, bytes)
            In the order of their offsets from now, in simulated time, [s].
        pace : float
            Simulated seconds per wall second; 0: everything at once.
        """
        now, wall = time.monotonic(), 1.0 / (pace or 1.0)
        groups = [(offset, tuple(group)) for offset, group in groupby(messages, lambda message: message[0])]
        gap = CLOSEST * wall * (groups[1][0] - groups[0][0]) if len(groups) > 1 else 0.0
        moments = [
            _Moment(now + wall * offset, gap, tuple((name, cdr) for _, name, cdr in group))
            for offset, group in groups
        ]
        with self._condition:
            if len(self._waiting) > MOST_MOMENTS:
                self._publish_waiting()
            self._waiting.extend(moments)
            if pace == 0.0:
                self._publish_waiting()
            self._condition.notify()

    def flush(self) -> None:
        """Publish at once what still waits."""
        with self._condition:
            self._publish_waiting()

    def drain(self, timeout: float) -> None:
        """Wait until everything is out in its time; after `timeout` seconds the rest goes at once."""
        deadline = time.monotonic() + timeout
        while self._waiting and time.monotonic() < deadline:
            time.sleep(0.001)
        self.flush()

    def end(self) -> None:
        """Publish the rest and end the thread."""
        with self._condition:
            self._publish_waiting()
            self._ended = True
            self._condition.notify()
        self._thread.join()

    def _publish_waiting(self) -> None:
        while self._waiting:
            self._publish_next()

    def _publish_next(self) -> None:
        for name, cdr in self._waiting.popleft().messages:
            self._publish(name, cdr)
        self._last = time.monotonic()

    def _run(self) -> None:
        while not self._ended:
            with self._condition:
                if not self._waiting:
                    self._condition.wait()
                    continue
                moment = self._waiting[0]
                delay = max(moment.due, self._last + moment.gap) - time.monotonic()
                if delay <= 0.0:
                    self._publish_next()
                    continue
            time.sleep(min(delay, LONGEST_SLEEP_S))

"""Trend messages one after the other instead of in bursts: a reader with a short queue gets them all."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Sequence


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
        self._waiting: deque[tuple[float, str, bytes]] = deque()
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="trends", daemon=True)
        self._thread.start()

    def spread(self, messages: Sequence[tuple[float, str, bytes]], pace: float) -> None:
        """Publish messages over the time to come; what still waits from before goes out at once.

        Parameters
        ----------
        messages : sequence of (offset, topic, bytes)
            In the order of their offsets from now, in simulated time, [s].
        pace : float
            Simulated seconds per wall second; 0: everything at once.
        """
        with self._condition:
            self._publish_waiting()
            now = time.monotonic()
            self._waiting.extend((now + offset / (pace or 1.0), name, cdr) for offset, name, cdr in messages)
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
            self._publish(*self._waiting.popleft()[1:])

    def _run(self) -> None:
        with self._condition:
            while not self._ended:
                if not self._waiting:
                    self._condition.wait()
                elif (delay := self._waiting[0][0] - time.monotonic()) > 0.0:
                    self._condition.wait(delay)
                else:
                    self._publish(*self._waiting.popleft()[1:])

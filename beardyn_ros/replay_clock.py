"""How far a replay in real time has come: wall clock, pace and pauses."""

from __future__ import annotations

import time
from collections.abc import Callable


class ReplayClock:
    """Seconds of the stream that have passed.

    Parameters
    ----------
    pace : float
        Seconds of the stream per wall second.
    now : callable
        Wall clock, [s].
    """

    def __init__(self, pace: float, now: Callable[[], float] = time.monotonic) -> None:
        self._pace = pace
        self._now = now
        self._paused = False
        self.restart()

    def restart(self) -> None:
        """Stop at 0 until `start`."""
        self._passed = 0.0
        self._since: float | None = None

    def start(self) -> None:
        """Begin to run, once."""
        if self._since is None:
            self._since = self._now()

    def passed(self) -> float:
        """Compute the seconds of the stream since the start."""
        if self._since is None or self._paused:
            return self._passed
        return self._passed + (self._now() - self._since) * self._pace

    def set_pace(self, pace: float) -> None:
        """Go on at another pace from now on."""
        self._settle()
        self._pace = pace

    def pause(self, paused: bool) -> None:
        """Stop the stream, or let it go on."""
        self._settle()
        self._paused = paused

    def _settle(self) -> None:
        self._passed = self.passed()
        if self._since is not None:
            self._since = self._now()

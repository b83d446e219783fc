"""Credit of a twin: up to when its load is used, how fast that goes on, when to look again."""

from __future__ import annotations

import math
import time

QUICK_S = 0.005
LEISURELY_S = 0.05
USED_SHARE = 0.2  # of the lead that the twin may use until the next look
FORGETTING = 0.8  # of the rate from look to look: the credit moves in steps


class Credit:
    """Time up to which a twin has used its load, as it tells.

    Attributes
    ----------
    time_ns : int
        In the time of the load, [ns].
    changed_at, heard_at : float
        When it has moved, and when the twin has told it, on the monotonic clock, [s].
    """

    def __init__(self) -> None:
        self.heard_at = -math.inf
        self.begin(0)

    def begin(self, time_ns: int) -> None:
        """Begin a stream of load at a time."""
        self.time_ns = self._seen_ns = time_ns
        self.changed_at = self._seen_at = time.monotonic()
        self._rate = 0.0

    def hear(self, time_ns: int) -> None:
        """Take what the twin has told."""
        self.heard_at = time.monotonic()
        if time_ns != self.time_ns:
            self.time_ns, self.changed_at = time_ns, self.heard_at

    def look_period(self, lead: float, quick: float = QUICK_S) -> float:
        """Choose when to look again, [s]: a twin in real time keeps its lead for long.

        Parameters
        ----------
        lead : float
            By how much the load may be ahead of the twin, beyond what one message holds, [s].
        quick : float
            Shortest period, [s].
        """
        now = time.monotonic()
        used, passed = (self.time_ns - self._seen_ns) * 1e-9, max(now - self._seen_at, 1e-6)
        self._seen_ns, self._seen_at = self.time_ns, now
        self._rate = max(used / passed, FORGETTING * self._rate)
        return LEISURELY_S if self._rate * LEISURELY_S < USED_SHARE * lead else quick

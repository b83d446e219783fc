"""Whether two streams that are paired by stamp have one clock: sensors of a train may have their own."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

WINDOW_S = 5.0
FAR_S = 0.5  # streams of one clock are paired block by block


class ClocksApart:
    """Compares the latest stamps of two streams while both come.

    Parameters
    ----------
    one, other : str
        Their names.
    now : callable
        A clock of this machine, [s].
    """

    def __init__(self, one: str, other: str, now: Callable[[], float] = time.monotonic) -> None:
        self._names = (one, other)
        self._now = now
        self.begin()

    def begin(self) -> None:
        """Forget both."""
        self._latest: dict[str, int] = {}
        self._seen: deque[tuple[float, float]] = deque()  # time, one ahead of the other, both [s]

    def receive(self, name: str, stamp_ns: int) -> None:
        """Note the latest stamp of a stream."""
        self._latest[name] = stamp_ns

    def look(self) -> None:
        """Compare the latest stamps of both, when everything that has come is taken."""
        if len(self._latest) < len(self._names):
            return  # one of them pauses
        one, other = (self._latest.pop(name) for name in self._names)
        now = self._now()
        self._seen.append((now, 1e-9 * (one - other)))
        while self._seen[0][0] < now - WINDOW_S:
            self._seen.popleft()

    @property
    def sentence(self) -> str:
        """Report clocks that have been apart for the whole window; empty where they have not."""
        if not self._seen or self._seen[-1][0] - self._seen[0][0] < 0.8 * WINDOW_S:
            return ""
        apart = min((each for _, each in self._seen), key=abs)
        if abs(apart) < FAR_S or {each > 0.0 for _, each in self._seen} != {apart > 0.0}:
            return ""
        one, other = self._names
        side = "ahead of" if apart > 0.0 else "behind"
        return (
            f"{one} is stamped {abs(apart):.2f} s {side} {other}: they have two clocks, and samples are "
            "paired by stamp"
        )

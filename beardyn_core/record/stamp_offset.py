"""Offset of stamps over simulated time along a run, where they are those of the source of its load."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

LEAP_NS = 25_000_000  # changes beyond are leaps; a clock that drifts changes by 1 ms a second at most
_LATEST_NS = 2**63
BLOCK_NS = 20_000_000  # a reference has the stamp of the end of its block


def earliest_stamp(truth: Mapping[str, Any]) -> int:
    """Read the stamp that no sample of a run is earlier than from its truth; 0 of simulated time, [ns]."""
    found = truth.get("begin_ns", 0)
    return found if isinstance(found, int) and 0 <= found < _LATEST_NS else 0


class StampOffset:
    """Follows the messages of ``source_time``.

    Parameters
    ----------
    references : iterable of (int, int)
        Stamp and simulated time at it, in their order, [ns].
    earliest_ns : int
        Stamps before that are of an earlier run, and left out, [ns].

    Attributes
    ----------
    first_ns : int or None
        Offset where the recording begins; ``None``: no reference has come, [ns].
    """

    def __init__(self, references: Iterable[tuple[int, int]] = (), earliest_ns: int = 0) -> None:
        self.first_ns: int | None = None
        self._earliest_ns = earliest_ns
        self._last_ns = 0
        self._leaps: list[tuple[int, int]] = []  # stamp of the first block behind, and by how much, [ns]
        for stamp_ns, simulated_ns in references:
            self.add(stamp_ns, simulated_ns)

    def add(self, stamp_ns: int, simulated_ns: int) -> None:
        """Take the next reference."""
        if stamp_ns < self._earliest_ns:
            return
        ahead_ns = stamp_ns - simulated_ns
        if self.first_ns is None:
            self.first_ns = ahead_ns
        elif ahead_ns - self._last_ns > LEAP_NS:
            self._leaps.append((stamp_ns - BLOCK_NS, ahead_ns - self._last_ns))
        self._last_ns = ahead_ns

    def count_missing(self, last_ns: int, stamp_ns: int, step_ns: int) -> int:
        """Count the samples of a regular stream that are missing between two stamps; leaps lose none."""
        leapt = self.leapt(last_ns, stamp_ns + step_ns)
        return max(round((stamp_ns - last_ns - leapt) / step_ns) - 1, 0)

    def leapt(self, begin_ns: int, end_ns: int) -> int:
        """Add up the leaps after a stamp and up to another, [ns]."""
        return sum(by for at, by in self._leaps if begin_ns < at <= end_ns)

"""Time of the train: what the clock of the source of live load shows at an instant of simulated time.

Messages arrive late, never early, so that the least late of the last seconds shows the clock. It may run a
little faster or slower than that of this machine, and it may be set: stamps follow it, and never go back.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import Annotated as A

from beardyn_core.record.messages import header, make, serialize, time
from beardyn_core.record.topics import TIME_REFERENCE

AUTO, SOURCE, SIMULATED = STAMPS = ("auto", "source", "simulated")
SIMULATED_TIME = "simulated time"  # names the second clock of a `source_time`
WINDOW_S = 2.0
SETTLED_S = 0.5  # for which later messages must come before an earlier one is believed no longer
SET_NS = 50_000_000  # a clock that differs by more was set; it drifts otherwise
SET_AFTER = 5  # messages that come too early for a clock
FASTEST_DRIFT = 1e-3  # of a clock that is followed without a step; clocks of computers drift by 1e-4, [-]
LONGEST_HOLD_S = 10.0
LONGEST_ANNOUNCEMENT_S = 1.0  # between the earliest stamp that a truth names and the first of the run
FAR_APART_S = 0.1  # clocks of two topics
RECENT_S = 5.0  # for which a leap is reported
LEAPS_AT_ANOTHER_PACE, LEAP_GAP_NS = 8, 500_000_000  # leaps or holds in a row, each so soon after the other


def follows_source(stamps: str, mode: str) -> bool:
    """Tell whether stamps are those of the source, as the parameter `stamps` and the mode say."""
    return stamps == SOURCE or (stamps == AUTO and mode == "live")


def encode_time_reference(stamp_ns: int, simulated_ns: int, frame: str) -> bytes:
    """Encode a ``source_time``: simulated time at a stamp, both [ns]."""
    return serialize(
        make(
            TIME_REFERENCE,
            header=header(stamp_ns, frame),
            time_ref=time(simulated_ns),
            source=SIMULATED_TIME,
        )
    )


class ClockReading:
    """How far the clock in the stamps of a topic is ahead of simulated time, by the least late message.

    Parameters
    ----------
    simulated_at : callable
        Simulated time at a time of `time.monotonic`, [s].
    """

    def __init__(self, simulated_at: Callable[[float], float]) -> None:
        self._simulated_at = simulated_at
        self._received: deque[tuple[float, int]] = deque()  # arrival [s], stamp [ns]; the least late first
        self._early = 0

    def receive(self, stamp_ns: int, arrival: float, was_set: bool = False) -> None:
        """Take note of a message.

        Parameters
        ----------
        stamp_ns : int
        arrival : float
            By `time.monotonic`, [s].
        was_set : bool
            Whether the source has set its clock: what was received before says nothing any more.
        """
        ahead = self._ahead_ns(arrival, stamp_ns)
        known = self.ahead_ns()
        self._early = self._early + 1 if known is not None and ahead - known > SET_NS else 0
        if was_set or self._early >= SET_AFTER:
            self._received.clear()
            self._early = 0
        elif self._early:
            return  # one alone may be a stray
        while self._received and self._ahead_ns(*self._received[-1]) <= ahead:
            self._received.pop()
        self._received.append((arrival, stamp_ns))
        while len(self._received) > 1 and self._received[0][0] < arrival - WINDOW_S:
            if self._received[1][0] > arrival - SETTLED_S:
                break  # after a silence a burst of late messages says nothing yet
            self._received.popleft()

    def ahead_ns(self) -> int | None:
        """Tell how far the clock is ahead of simulated time, ``None`` before the first message, [ns]."""
        return self._ahead_ns(*self._received[0]) if self._received else None

    def _ahead_ns(self, arrival: float, stamp_ns: int) -> int:
        return stamp_ns - round(1e9 * self._simulated_at(arrival))


@dataclass(frozen=True)
class Offset:
    """Offset of the stamps of a block."""

    ahead_ns: A[int, "of the stamps over simulated time, [ns]"]
    is_new: A[bool, "whether it has begun with this block, or leaps at it"] = False


class SourceStamps:
    """Offset between simulated time and stamps: none, that of the load stream, or that of a live source.

    Parameters
    ----------
    condition : threading.Condition
        Guards the readings: messages come in another thread than blocks.
    simulated_at : callable
        See `ClockReading`.
    """

    def __init__(self, condition: threading.Condition, simulated_at: Callable[[float], float]) -> None:
        self._condition = condition
        self._simulated_at = simulated_at
        self._readings: dict[str, ClockReading] = {}
        self._end_ns = self._earliest_ns = 0  # latest stamp so far, earliest one of the present run
        self.begin()

    def begin(self) -> None:
        """Begin with a run; the clocks go on."""
        self._offset_ns: int | None = None
        self._leap, self._leapt_at = 0.0, -RECENT_S
        self._is_leap_expected = False
        self._unsteady: list[int] = []  # simulated times of leaps and holds in a row, [ns]

    def expect_leap(self) -> None:
        """Note that the run was held on purpose: the clock goes on meanwhile."""
        self._is_leap_expected = True

    @property
    def recent_leap(self) -> str:
        """Report a leap of the last seconds that nobody has ordered, empty without."""
        if monotonic() - self._leapt_at > RECENT_S:
            return ""
        return f"the clock of the source was set forward, stamps leap by {self._leap:.3f} s"

    @property
    def is_at_another_pace(self) -> bool:
        """Whether the clock runs at another pace than simulated time, and is followed no longer in this run.

        Stamps would leap, or wait, all the time.
        """
        return len(self._unsteady) >= LEAPS_AT_ANOTHER_PACE

    def receive(self, topic: str, stamp_ns: int, arrival: float, was_set: bool) -> None:
        """Take note of a message of live load; the condition must be held."""
        reading = self._readings.setdefault(topic, ClockReading(self._simulated_at))
        reading.receive(stamp_ns, arrival, was_set)

    @property
    def offset_ns(self) -> int:
        """Offset of the latest block, 0 before the first, [ns]."""
        return self._offset_ns or 0

    def apart_s(self, topic: str, other: str) -> float:
        """Tell how far the clock of one topic is ahead of that of another, NaN when one is silent, [s]."""
        with self._condition:
            one, two = self._ahead_ns(topic), self._ahead_ns(other)
        return float("nan") if one is None or two is None else 1e-9 * (one - two)

    def note(self, topic: str, followed: str, speed_factor: float) -> str:
        """Report a leap of the stamps, and two clocks where one is expected."""
        if self.is_at_another_pace:
            notes = [
                f"{followed} is stamped at another pace than speed_factor = {speed_factor:g}: "
                "stamps follow it no longer"
            ]
        else:
            notes = [self.recent_leap] if self.recent_leap else []
        apart = self.apart_s(topic, followed)
        if abs(apart) > FAR_APART_S:
            notes.append(
                f"{topic} is stamped {abs(apart):.3f} s {'ahead of' if apart > 0.0 else 'behind'} "
                f"{followed}: they have two clocks; stamps are those of {followed}"
            )
        return "; ".join(notes)

    def preview(self, topic: str, delay_ns: int) -> int:
        """Give the stamp that none of a run is earlier than which begins now, nor those of the run before."""
        with self._condition:
            ahead = self._ahead_ns(topic)
        wanted = max((ahead or 0) - delay_ns, 0)
        overlap = self._end_ns - wanted
        self._earliest_ns = wanted + (overlap if 0 < overlap <= 2 * SET_NS else 0)
        return self._earliest_ns

    def follow(self, topic: str, begin_ns: int, block_ns: int, delay_ns: int) -> tuple[Offset, float]:
        """Give the offset of the next block, and for how long the twin must be held before it.

        Where the clock was set back, the twin is held until the clock shows a new time: then call again.
        Where the clock was set forward, or the twin was held, stamps leap with it.

        Parameters
        ----------
        topic : str
            Whose clock is followed.
        begin_ns, block_ns : int
            Simulated time at the begin of the block, and its length, [ns].
        delay_ns : int
            By which what the twin computes lags what came in, [ns].

        Returns
        -------
        Offset, float
            And seconds of simulated time, 0 when the block may go out.
        """
        with self._condition:
            ahead = self._ahead_ns(topic)
        if ahead is None or self.is_at_another_pace:
            return self._stamped(begin_ns, block_ns), 0.0
        wanted = ahead - delay_ns
        if self._offset_ns is None:
            if wanted + begin_ns < 0:  # a clock that has begun at 0 just now
                return Offset(0), -1e-9 * (wanted + begin_ns)
            early = self._earliest_ns - wanted - begin_ns
            self._offset_ns = wanted + (early if 0 < early <= 2 * SET_NS else 0)
            return self._stamped(begin_ns, block_ns, is_new=True), 0.0
        change = wanted - self._offset_ns
        if abs(change) > SET_NS:
            before = [each for each in self._unsteady[-1:] if begin_ns - each <= LEAP_GAP_NS]
            if not before or before[0] != begin_ns:
                self._unsteady = [*(self._unsteady if before else ()), begin_ns][-LEAPS_AT_ANOTHER_PACE:]
        if change < -SET_NS:
            return Offset(self._offset_ns), -1e-9 * change
        if change > SET_NS:
            if not self._is_leap_expected:
                self._leap, self._leapt_at = 1e-9 * change, monotonic()
            self._offset_ns, self._is_leap_expected = wanted, False
            return self._stamped(begin_ns, block_ns, is_new=True), 0.0
        self._is_leap_expected = False
        most = round(FASTEST_DRIFT * block_ns)
        self._offset_ns += max(-most, min(most, change))
        return self._stamped(begin_ns, block_ns), 0.0

    def _stamped(self, begin_ns: int, block_ns: int, *, is_new: bool = False) -> Offset:
        offset_ns = self.offset_ns
        self._end_ns = offset_ns + begin_ns + block_ns
        return Offset(offset_ns, is_new)

    def _ahead_ns(self, topic: str) -> int | None:
        return self._readings[topic].ahead_ns() if topic in self._readings else None

    def set_constant(self, offset_ns: int) -> Offset:
        """Stamp the run with a constant offset, that of a stream of load, [ns]."""
        is_new = self._offset_ns is None
        self._offset_ns = offset_ns
        return Offset(offset_ns, is_new)

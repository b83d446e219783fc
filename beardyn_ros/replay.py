"""A scenario as an endless stream: sample numbers and stamps go on while the position in it moves.

A loop or a seek moves the position with a cross-fade, so that the load never jumps. How far the stream has
come says the wall clock in live mode (`ReplayClock`), and the twin in lockstep, by what it has used
(`Credit`).
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError
from beardyn_core.scene.load import LoadHistory

LAST_SAMPLE = 2**32 - 1  # `sample` on the wire is uint32: five days at 10 kHz
UNEVEN = "the samples of this load are not evenly spaced in time: it can only be replayed straight through"
QUICK_S = 0.005
LEISURELY_S = 0.05
USED_SHARE = 0.2  # of the lead that the twin may use until the next look
FORGETTING = 0.8  # of the rate from look to look: the credit moves in steps


@dataclass(frozen=True)
class Passage:
    """A stretch of the stream during which the position runs on with time.

    Parameters
    ----------
    sample : int
        Of the stream, where it begins.
    stamp_ns : int
        Of that sample, [ns].
    position_s : float
        In the scenario at that sample, [s].
    fade_s : float
        How long the passage before it still fades out from there on, [s].
    """

    sample: int
    stamp_ns: int
    position_s: float
    fade_s: float


class Replay:
    """Takes a stream of load out of a scenario, part by part.

    Parameters
    ----------
    history : LoadHistory
        The scenario. Unless it is evenly spaced in time it can only be replayed straight through.
    loop : bool
        Wrap from the end to the start, for ever.
    fade : float
        Duration of the cross-fade of a wrap or a seek, [s].
    position : float
        Where in the scenario the stream begins, [s].

    Notes
    -----
    Without loop and seek the stream is the scenario itself, bit by bit. In a cross-fade every column
    is ``(1 - w) old + w new`` with `w` half a cosine: value and slope are steady at both ends. Speed and
    force of the two places are mixed alike, so a fade between two speeds is a short change of speed
    under the mixed load, not a run of the rail model. The passage that fades out holds its last sample
    when the scenario ends under it.

    Raises
    ------
    InputError
        The position is outside, a loop has no room for its fade, or uneven samples are to be moved.
    """

    def __init__(
        self, history: LoadHistory, loop: bool = False, fade: float = 0.5, position: float = 0.0
    ) -> None:
        spacing = np.diff(history.time_ns)
        if len(history) < 2 or spacing.min() <= 0:
            raise InputError("the load to be replayed needs two samples or more, one after the other in time")
        self._history = history
        self._even = bool(np.ptp(spacing) == 0)
        self._spacing_ns = int(np.median(spacing))
        self._fade = max(round(fade * 1e9 / self._spacing_ns), 1)
        self._begin = self._sample_at(position)
        problem = self.problem_of_seek(position) or self.problem_of_loop(loop)
        if problem:
            raise InputError(problem)
        self.loop = loop
        self.restart()

    def restart(self) -> None:
        """Begin again: sample 0, first stamp, the position given at the start."""
        self.next_sample = 0
        self._position = self._begin
        self._old: int | None = None  # place that fades out
        self._faded = 0
        self._wanted: int | None = None
        self.passages: list[Passage] = []
        self._begin_passage(0.0)

    @property
    def spacing_ns(self) -> int:
        """Time between samples, the usual one when it changes, [ns]."""
        return self._spacing_ns

    @property
    def length_s(self) -> float:
        """Of the scenario, [s]."""
        return float(self._history.time_ns[-1] - self._history.time_ns[0]) / 1e9

    @property
    def next_ns(self) -> int:
        """Stamp of the next sample, [ns]."""
        if self._even:
            return int(self._history.time_ns[0]) + self.next_sample * self._spacing_ns
        return int(self._history.time_ns[min(self._position, len(self._history) - 1)])

    def samples_before(self, stamp_ns: int) -> int:
        """Count the next samples with stamps below `stamp_ns`, should the stream be that long."""
        if self._even:
            return max(-((self.next_ns - stamp_ns) // self._spacing_ns), 0)
        return max(int(np.searchsorted(self._history.time_ns, stamp_ns)) - self._position, 0)

    @property
    def position_s(self) -> float:
        """Where in the scenario the next sample stands, [s]."""
        at = min(self._position, len(self._history) - 1)
        return float(self._history.time_ns[at] - self._history.time_ns[0]) / 1e9

    def problem_of_seek(self, position: float) -> str:
        """Say why there is no such place; '' when there is."""
        if not self._even and position != 0.0:
            return UNEVEN
        if 0.0 <= position <= self.length_s:
            return ""
        return f"position {position:g} s is outside the scenario, which is {self.length_s:g} s long"

    def problem_of_loop(self, loop: bool) -> str:
        """Say why the scenario cannot be repeated; '' when it can."""
        if loop and not self._even:
            return UNEVEN
        if not loop or 2 * self._fade <= len(self._history):
            return ""
        return (
            f"a loop with a cross-fade of {self._fade * self._spacing_ns / 1e9:g} s needs a scenario at "
            f"least twice as long, this one is {self.length_s:g} s long: shorten fade"
        )

    def seek(self, position: float) -> None:
        """Move the position with the next sample, or when a cross-fade under way has ended."""
        self._wanted = self._sample_at(position)

    @property
    def exhausted(self) -> bool:
        """Whether no sample is left."""
        moving = self.loop or self._old is not None or self._wanted is not None
        return self.next_sample >= LAST_SAMPLE or not (moving or self._position < len(self._history))

    def take(self, count: int) -> LoadHistory:
        """Take the next samples of the stream; fewer, or none, at its end.

        Parameters
        ----------
        count : int
            Samples at most.
        """
        first_ns, first = self.next_ns, self._position
        pieces: list[NDArray[np.float64]] = []
        left = min(count, LAST_SAMPLE - self.next_sample)
        while left > 0:
            self._turn()
            piece = self._piece(left)
            if len(piece) == 0:
                break
            pieces.append(piece)
            left -= len(piece)
            self.next_sample += len(piece)
        columns = np.concatenate(pieces) if pieces else np.zeros((0, 10))
        time_ns = first_ns + np.arange(len(columns), dtype=np.int64) * self._spacing_ns
        if not self._even:
            time_ns = self._history.time_ns[first : first + len(columns)]
        return LoadHistory(
            time_ns,
            np.ascontiguousarray(columns[:, :6]),
            np.ascontiguousarray(columns[:, 6]),
            np.ascontiguousarray(columns[:, 7:]),
        )

    def _turn(self) -> None:
        """Begin a cross-fade when one is due."""
        if self._old is not None:
            return
        if self._wanted is None and not (self.loop and self._position >= len(self._history) - self._fade):
            return
        self._old, self._faded = self._position, 0
        self._position, self._wanted = self._wanted or 0, None
        self._begin_passage(self._fade * self._spacing_ns / 1e9)

    def _piece(self, count: int) -> NDArray[np.float64]:
        """Take the samples up to the next turn, shape [sample, 10]."""
        if self._old is None:
            last = len(self._history) - (self._fade if self.loop else 0)
            count = max(min(count, last - self._position), 0)
            piece = self._columns(self._position, count)
        else:
            count = min(count, self._fade - self._faded)
            at = (self._faded + 1 + np.arange(count)) / (self._fade + 1)
            weight = (0.5 - 0.5 * np.cos(np.pi * at))[:, None]
            old, new = self._columns(self._old, count), self._columns(self._position, count)
            piece = old + weight * (new - old)
            self._faded += count
            self._old = self._old + count if self._faded < self._fade else None
        self._position += count
        return piece

    def _columns(self, first: int, count: int) -> NDArray[np.float64]:
        """Gather wrench, speed and bogie from a sample on, the last one held, shape [count, 10]."""
        at = np.minimum(first + np.arange(count), len(self._history) - 1)
        load = self._history
        return np.column_stack([load.wrench[at], load.shaft_speed[at], load.bogie[at]])

    def _sample_at(self, position: float) -> int:
        return round(position * 1e9 / self._spacing_ns)

    def _begin_passage(self, fade_s: float) -> None:
        self.passages.append(Passage(self.next_sample, self.next_ns, self.position_s, fade_s))


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


class Credit:
    """Time up to which a twin has used its load, as it reports.

    Attributes
    ----------
    time_ns : int
        In the time of the load, [ns].
    changed_at, received_at : float
        When it has moved, and when the twin has reported it, on the monotonic clock, [s].
    """

    def __init__(self) -> None:
        self.received_at = -math.inf
        self.begin(0)

    def begin(self, time_ns: int) -> None:
        """Begin a stream of load at a time."""
        self.time_ns = self._seen_ns = time_ns
        self.changed_at = self._seen_at = time.monotonic()
        self._rate = 0.0

    def receive(self, time_ns: int) -> None:
        """Take what the twin has reported."""
        self.received_at = time.monotonic()
        if time_ns != self.time_ns:
            self.time_ns, self.changed_at = time_ns, self.received_at

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

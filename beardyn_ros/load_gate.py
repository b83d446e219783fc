"""What comes in as load: checked, counted, queued.

A sample that is missing cannot be invented: a refused block leaves a hole, blocks behind the hole are
refused too, and the stream goes on only when the hole is filled by a good block with the same sample
numbers.
"""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.load import WRENCH_AXES, LoadHistory
from beardyn_core.scene.load_check import (
    LARGEST_DISPLACEMENT,
    LARGEST_FORCE,
    LARGEST_MOMENT,
    LARGEST_SPEED,
    speed_jump,
)

# time, wrench, shaft speed and bogie of one sample
SAMPLE_BYTES = 88
RECENT_S = 5.0
REFUSED_BLOCKS_KEPT = 64


@dataclass(frozen=True)
class RefusalReport:
    """Messages that were refused since the start.

    Parameters
    ----------
    count : int
    by_reason : tuple of (reason, count)
    last_sentence : str
        About the latest one, '' when there was none.
    recent : bool
        Whether the latest one was within the last `RECENT_S` seconds.
    """

    count: int
    by_reason: tuple[tuple[str, int], ...]
    last_sentence: str
    recent: bool


class Refusals:
    """Counts refused messages by reason; may be used from any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._counts: Counter[str] = Counter()
        self._last = ""
        self._last_at = -RECENT_S

    def add(self, reason: str, sentence: str) -> str:
        """Count one refusal and give its sentence back."""
        with self._lock:
            self._counts[reason] += 1
            self._last = sentence
            self._last_at = time.monotonic()
        return sentence

    def report(self) -> RefusalReport:
        """Return the counts so far."""
        with self._lock:
            recent = bool(self._last) and time.monotonic() - self._last_at < RECENT_S
            counts = tuple(sorted(self._counts.items()))
            return RefusalReport(self._counts.total(), counts, self._last, recent)


def unphysical(
    wrench: NDArray[np.float64], shaft_speed: NDArray[np.float64], bogie: NDArray[np.float64]
) -> tuple[str, str] | None:
    """Give reason and sentence when numbers are not finite or absurd, ``None`` when they are fine.

    Parameters
    ----------
    wrench : array, shape [sample, 6], [N, N m]
    shaft_speed : array, shape [sample], [rad/s]
    bogie : array, shape [sample, 3], [m]
    """
    columns = [(axis, wrench[:, i]) for i, axis in enumerate(WRENCH_AXES)]
    columns += [("shaft_speed", shaft_speed)]
    columns += [(axis, bogie[:, i]) for i, axis in enumerate(("ux", "uy", "uz"))]
    limits = [LARGEST_FORCE] * 3 + [LARGEST_MOMENT] * 3 + [LARGEST_SPEED] + [LARGEST_DISPLACEMENT] * 3
    for name, values in columns:
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            return "not finite", f"{name} is {values[bad[0]]} in {len(bad)} of {len(values)} samples"
    units = ["N"] * 3 + ["N m"] * 3 + ["rad/s"] + ["m"] * 3
    for (name, values), limit, unit in zip(columns, limits, units, strict=True):
        largest = float(values[np.argmax(np.abs(values))])
        if abs(largest) > limit:
            return "absurd", f"{name} is {largest:g} {unit}; allowed is up to {limit:g} {unit} either way"
    return None


class _RefusedBlock(NamedTuple):
    """Sample numbers and first time of a block that was not taken."""

    first: int
    last: int
    begin_ns: int


class LoadGate:
    """Queue of load samples between the subscription and the twin's thread.

    A stream begins at sample 0: a block from further on shows that its beginning was lost.

    Parameters
    ----------
    longest_ns : int
        Stretch of load that may wait, [ns]; more is an overflow, which ends the run.
    most_bytes : int
        Memory that it may take, whatever its sample rate.
    refusals : Refusals
    condition : threading.Condition
        Guards the queue and is notified of every change.
    join : bool
        Whether a stream may be joined at any of its samples.
    """

    def __init__(
        self,
        longest_ns: int,
        most_bytes: int,
        refusals: Refusals,
        condition: threading.Condition,
        join: bool = False,
    ) -> None:
        self.longest_ns = longest_ns
        self.most_bytes = most_bytes
        self.refusals = refusals
        self.condition = condition
        self._join = join
        self._begin(after_reset=False)

    def restart(self) -> None:
        """Forget everything; the stream begins again at sample 0, leftovers of the old one are dropped."""
        with self.condition:
            self._begin(after_reset=True)

    def _begin(self, after_reset: bool) -> None:
        self._parts: deque[LoadHistory] = deque()
        self._waiting = 0
        self._expected = 0
        self._after_reset = after_reset
        self._refused: deque[_RefusedBlock] = deque(maxlen=REFUSED_BLOCKS_KEPT)
        self._first: tuple[int, int] | None = None  # sample and time of the first one taken
        self._last: LoadHistory | None = None
        self.ended = False
        self.failure = ""

    def offer(
        self, load: LoadHistory, samples: NDArray[np.int64], wrong: tuple[str, str] | None = None
    ) -> str | None:
        """Take one block; the sentence of the refusal when it is not taken.

        Parameters
        ----------
        load : LoadHistory
            Empty: the end of the stream.
        samples : int64 array, shape [sample]
            Running index of each sample.
        wrong : tuple of (reason, sentence) or None
            What is already known to be wrong with the message.
        """
        with self.condition:
            if self._after_reset and (len(samples) == 0 or samples[0] != 0):
                return None
            if len(samples) == 0 and not self.ended and wrong is None:
                self._end()
                return None
            if self._join and self._first is None and len(samples):
                self._expected = int(samples[0])
            problem = wrong or self._problem(load, samples)
            if problem is not None:
                if len(samples):
                    begin = int(samples[0])
                    self._refused.append(_RefusedBlock(begin, begin + len(samples) - 1, int(load.time_ns[0])))
                self.condition.notify_all()
                first = f" from sample {samples[0]}" if len(samples) else ""
                return self.refusals.add(problem[0], f"load/blocks{first} refused: {problem[1]}")
            self._after_reset = False
            self._parts.append(load)
            self._waiting += len(load)
            self._expected = int(samples[-1]) + 1
            self._first = self._first or (int(samples[0]), int(load.time_ns[0]))
            self._last = load.part(len(load) - 1, len(load))
            self.condition.notify_all()
        return None

    def refuse(self, reason: str, sentence: str, name: str = "load/blocks") -> str:
        """Count a message that cannot even be read, or is of another sender."""
        return self.refusals.add(reason, f"{name} refused: {sentence}")

    def _end(self) -> None:
        self.ended = True
        hole_until = max((block.last for block in self._refused if self._leaves_a_hole(block)), default=-1)
        if hole_until >= 0:
            self.failure = (
                f"the load stream has ended, but its samples {self._expected} to {hole_until} were refused "
                f"and never sent again; last refusal: {self.refusals.report().last_sentence}"
            )
        self.condition.notify_all()

    def _leaves_a_hole(self, block: _RefusedBlock) -> bool:
        """Check whether a refused block belongs to the stream and was never sent again.

        Where the block stands in time must fit its sample numbers: a message with wild numbers is no
        part of the stream, which is complete without it.
        """
        if block.last < self._expected:
            return False
        if block.first <= self._expected or self._first is None or self._last is None:
            return True
        first_sample, first_ns = self._first
        last_ns = int(self._last.time_ns[0])
        if last_ns == first_ns:
            return True
        spacing_ns = (last_ns - first_ns) / (self._expected - 1 - first_sample)
        predicted_ns = (block.first - self._expected + 1) * spacing_ns
        return 0.5 * predicted_ns <= block.begin_ns - last_ns <= 2.0 * predicted_ns

    @property
    def lacks_its_beginning(self) -> str:
        """What is missing when blocks have come but none that the stream can begin with; '' otherwise."""
        with self.condition:
            if self._first is not None or not self._refused or self._after_reset:
                return ""
            begin = min(block.first for block in self._refused)
        if begin == 0:
            return "its first block was refused"
        return (
            f"samples 0 to {begin - 1} are missing: sent before the twin was ready (`ros2 bag play` "
            "needs --delay 1), or the stream is to be joined where it stands (parameter join)"
        )

    def _problem(self, load: LoadHistory, samples: NDArray[np.int64]) -> tuple[str, str] | None:
        if self.ended:
            return "after the end", "an empty block has ended the stream"
        if np.any(np.diff(samples) != 1):
            return "gap", "its sample numbers do not run on one by one"
        first_sample = int(samples[0])
        bad = unphysical(load.wrench, load.shaft_speed, load.bogie)
        if bad is not None:
            return bad
        if np.any(np.diff(load.time_ns) <= 0):
            return "out of order", "its times do not increase from sample to sample"
        if first_sample < self._expected:
            return "out of order", f"sample {self._expected} comes next, these samples were there before"
        if first_sample > self._expected:
            return (
                "gap",
                f"{first_sample - self._expected} samples are missing from sample {self._expected} on",
            )
        if self._last is not None and load.time_ns[0] <= self._last.time_ns[0]:
            return "out of order", (
                f"it begins at {load.time_ns[0] / 1e9:.6f} s, not after {self._last.time_ns[0] / 1e9:.6f} s"
            )
        leap_ns = 0 if self._last is None else int(load.time_ns[0] - self._last.time_ns[0])
        if leap_ns > self.longest_ns:
            return "far future", (
                f"it begins {leap_ns * 1e-9:.6g} s after the sample before it, more than load_queue holds"
            )
        run = load if self._last is None else join_loads([self._last, load])
        jump = speed_jump(run.time_ns, run.shaft_speed)
        if jump is not None:
            return "absurd", jump
        sentence = self._overflow(load)
        if sentence is not None:
            self.failure = sentence
            self.condition.notify_all()
            return "overflow", sentence
        return None

    def _overflow(self, load: LoadHistory) -> str | None:
        first_ns = int((self._parts[0] if self._parts else load).time_ns[0])
        stretch_ns = int(load.time_ns[-1]) - first_ns
        size = (self._waiting + len(load)) * SAMPLE_BYTES
        cause = "the sender does not keep to the credit on load/consumed"
        if self._parts and stretch_ns > self.longest_ns:
            return (
                f"{stretch_ns * 1e-9:.3f} s of load are waiting, the queue holds "
                f"{self.longest_ns * 1e-9:g} s: {cause}, or load_queue is too small"
            )
        if size > self.most_bytes:
            return (
                f"{size / 1e6:.3g} MB of load are waiting, the queue holds {self.most_bytes / 1e6:g} MB: "
                f"{cause}, or load_queue_size is too small for its sample rate"
            )
        return None

    def take_through(self, end_ns: int) -> LoadHistory | None:
        """Take the samples up to the first at or after `end_ns`, or all that wait; ``None`` without any."""
        with self.condition:
            taken: list[LoadHistory] = []
            covered = False
            while self._parts and not covered:
                part = self._parts.popleft()
                last = int(np.searchsorted(part.time_ns, end_ns, side="left")) + 1
                covered = last <= len(part)
                if last < len(part):
                    self._parts.appendleft(part.part(last, len(part)))
                    part = part.part(0, last)
                taken.append(part)
                self._waiting -= len(part)
        return join_loads(taken) if taken else None

    def first_time_ns(self) -> int | None:
        """Return the time of the first waiting sample."""
        with self.condition:
            return int(self._parts[0].time_ns[0]) if self._parts else None

    @property
    def waiting(self) -> int:
        """Samples in the queue."""
        return self._waiting

    @property
    def waiting_s(self) -> float:
        """Stretch of time that the waiting samples cover, [s]."""
        with self.condition:
            if not self._parts:
                return 0.0
            return float(self._parts[-1].time_ns[-1] - self._parts[0].time_ns[0]) * 1e-9


def shift_load(load: LoadHistory, by_ns: int) -> LoadHistory:
    """Shift samples to later times."""
    if by_ns == 0:
        return load
    return LoadHistory(load.time_ns + by_ns, load.wrench, load.shaft_speed, load.bogie)


def join_loads(parts: list[LoadHistory]) -> LoadHistory:
    """Join consecutive histories to one."""
    if len(parts) == 1:
        return parts[0]
    return LoadHistory(
        np.concatenate([part.time_ns for part in parts]),
        np.concatenate([part.wrench for part in parts]),
        np.concatenate([part.shaft_speed for part in parts]),
        np.concatenate([part.bogie for part in parts]),
    )

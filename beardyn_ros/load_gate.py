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

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.load import WRENCH_AXES, LoadHistory
from beardyn_core.scene.load_buffer import (
    LARGEST_DISPLACEMENT,
    LARGEST_FORCE,
    LARGEST_MOMENT,
    LARGEST_SPEED,
    speed_jump,
)

# time, wrench, shaft speed and bogie of one sample
SAMPLE_BYTES = 88


@dataclass(frozen=True)
class RefusalReport:
    """Messages that were refused since the start.

    Parameters
    ----------
    count : int
    by_reason : tuple of (reason, count)
    last_sentence : str
        About the latest one, '' when there was none.
    """

    count: int
    by_reason: tuple[tuple[str, int], ...]
    last_sentence: str


class Refusals:
    """Counts refused messages by reason; may be used from any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._counts: Counter[str] = Counter()
        self._last = ""

    def add(self, reason: str, sentence: str) -> str:
        """Count one refusal and give its sentence back."""
        with self._lock:
            self._counts[reason] += 1
            self._last = sentence
        return sentence

    def report(self) -> RefusalReport:
        """Return the counts so far."""
        with self._lock:
            return RefusalReport(self._counts.total(), tuple(sorted(self._counts.items())), self._last)


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


class LoadGate:
    """Queue of load samples between the subscription and the twin's thread.

    Parameters
    ----------
    longest_ns : int
        Stretch of load that may wait, [ns]; more is an overflow, which ends the run.
    most_bytes : int
        Memory that it may take, whatever its sample rate.
    refusals : Refusals
    condition : threading.Condition
        Guards the queue and is notified of every change.
    """

    def __init__(
        self, longest_ns: int, most_bytes: int, refusals: Refusals, condition: threading.Condition
    ) -> None:
        self.longest_ns = longest_ns
        self.most_bytes = most_bytes
        self.refusals = refusals
        self.condition = condition
        self._begin(None)

    def restart(self) -> None:
        """Forget everything; the stream begins again at sample 0, leftovers of the old one are dropped."""
        with self.condition:
            self._begin(0)

    def _begin(self, expected: int | None) -> None:
        self._parts: deque[LoadHistory] = deque()
        self._waiting = 0
        self._expected = expected
        self._after_reset = expected is not None
        self._hole_until = -1
        self._last: LoadHistory | None = None
        self.ended = False
        self.failure = ""

    def offer(self, load: LoadHistory, samples: NDArray[np.int64]) -> str | None:
        """Take one block; the sentence of the refusal when it is not taken.

        Parameters
        ----------
        load : LoadHistory
            Empty: the end of the stream.
        samples : int64 array, shape [sample]
            Running index of each sample.
        """
        with self.condition:
            if self._after_reset and (len(samples) == 0 or samples[0] != 0):
                return None
            if len(samples) == 0 and not self.ended:
                self._end()
                return None
            problem = self._problem(load, samples)
            if problem is not None:
                self._hole_until = max([self._hole_until, *samples[-1:].tolist()])
                first = f" from sample {samples[0]}" if len(samples) else ""
                return self.refusals.add(problem[0], f"load/blocks{first} refused: {problem[1]}")
            self._after_reset = False
            self._parts.append(load)
            self._waiting += len(load)
            self._expected = int(samples[-1]) + 1
            self._last = load.part(len(load) - 1, len(load))
            self.condition.notify_all()
        return None

    def refuse(self, reason: str, sentence: str) -> str:
        """Count a message that cannot even be read."""
        return self.refusals.add(reason, f"load/blocks refused: {sentence}")

    def _end(self) -> None:
        self.ended = True
        if self._hole_until >= (self._expected or 0):
            hole = f"{self._expected or 0} to {self._hole_until}"
            self.failure = (
                f"the load stream has ended, but its samples {hole} were refused and never sent again; "
                f"last refusal: {self.refusals.report().last_sentence}"
            )
        self.condition.notify_all()

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
        if self._expected is not None and first_sample < self._expected:
            return "out of order", f"sample {self._expected} comes next, these samples were there before"
        if self._expected is not None and first_sample > self._expected:
            return (
                "gap",
                f"{first_sample - self._expected} samples are missing from sample {self._expected} on",
            )
        if self._last is not None and load.time_ns[0] <= self._last.time_ns[0]:
            return "out of order", (
                f"it begins at {load.time_ns[0] / 1e9:.6f} s, not after {self._last.time_ns[0] / 1e9:.6f} s"
            )
        run = load if self._last is None else joined([self._last, load])
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
        return joined(taken) if taken else None

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


def shifted(load: LoadHistory, by_ns: int) -> LoadHistory:
    """Shift samples to later times."""
    if by_ns == 0:
        return load
    return LoadHistory(load.time_ns + by_ns, load.wrench, load.shaft_speed, load.bogie)


def joined(parts: list[LoadHistory]) -> LoadHistory:
    """Join consecutive histories to one."""
    if len(parts) == 1:
        return parts[0]
    return LoadHistory(
        np.concatenate([part.time_ns for part in parts]),
        np.concatenate([part.wrench for part in parts]),
        np.concatenate([part.shaft_speed for part in parts]),
        np.concatenate([part.bogie for part in parts]),
    )


@dataclass(frozen=True)
class HeldLoad:
    """Last value of the live load.

    Parameters
    ----------
    wrench : array, shape [6], [N, N m]
    shaft_speed : float, [rad/s]
    age : float
        Of the older of the two, since its arrival, [s].
    """

    wrench: NDArray[np.float64]
    shaft_speed: float
    age: float


class LiveLoad:
    """Last wrench and shaft speed, one message a sample.

    Parameters
    ----------
    refusals : Refusals
    condition : threading.Condition
    """

    def __init__(self, refusals: Refusals, condition: threading.Condition) -> None:
        self.refusals = refusals
        self.condition = condition
        self._wrench: NDArray[np.float64] | None = None
        self._speed: float | None = None
        self._arrival = {"load/wrench": 0.0, "load/shaft": 0.0}
        self._stamp: dict[str, int] = {}

    def offer_wrench(self, wrench: NDArray[np.float64], stamp_ns: int) -> str | None:
        """Take force and moment, shape [6]; the sentence of the refusal when refused."""
        problem = unphysical(wrench[None, :], np.zeros(1), np.zeros((1, 3)))
        return self._take("load/wrench", stamp_ns, problem, wrench=wrench)

    def offer_speed(self, speed: float, stamp_ns: int) -> str | None:
        """Take the shaft speed, [rad/s]; the sentence of the refusal when refused."""
        problem = unphysical(np.zeros((1, 6)), np.array([speed]), np.zeros((1, 3)))
        return self._take("load/shaft", stamp_ns, problem, speed=speed)

    def _take(
        self,
        topic: str,
        stamp_ns: int,
        problem: tuple[str, str] | None,
        wrench: NDArray[np.float64] | None = None,
        speed: float | None = None,
    ) -> str | None:
        with self.condition:
            if problem is None and stamp_ns <= self._stamp.get(topic, -1):
                problem = (
                    "out of order",
                    f"its stamp {stamp_ns / 1e9:.6f} s is not after {self._stamp[topic] / 1e9:.6f} s",
                )
            if problem is None and speed is not None and self._speed is not None and topic in self._stamp:
                jump = speed_jump(np.array([self._stamp[topic], stamp_ns]), np.array([self._speed, speed]))
                problem = ("absurd", jump) if jump else None
            if problem is not None:
                return self.refusals.add(problem[0], f"{topic} refused: {problem[1]}")
            self._stamp[topic] = stamp_ns
            self._arrival[topic] = time.monotonic()
            if wrench is not None:
                self._wrench = wrench
            if speed is not None:
                self._speed = speed
            self.condition.notify_all()
        return None

    def restart_age(self) -> None:
        """Count the age of what is held from now on: its source was silent on purpose."""
        with self.condition:
            self._arrival = dict.fromkeys(self._arrival, time.monotonic())

    def accept_any_stamp(self) -> None:
        """Accept any stamp next: the sender starts again."""
        with self.condition:
            self._stamp.clear()

    def held(self) -> HeldLoad | None:
        """Return the last value, ``None`` until both messages have come."""
        with self.condition:
            if self._wrench is None or self._speed is None:
                return None
            return HeldLoad(self._wrench, self._speed, time.monotonic() - min(self._arrival.values()))

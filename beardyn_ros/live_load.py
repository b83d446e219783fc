"""Load of the live mode: one message a sample, checked, filtered, its last value held.

The low-pass filter takes away what a sampler behind it would fold, and its delay is known. The load node has
one before it samples, the twin one before it holds a value.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.record.messages import header, make, serialize
from beardyn_core.record.topics import FRAME, TWIST, WRENCH
from beardyn_core.scene.load_check import speed_jump
from beardyn_ros.load_gate import Refusals, unphysical

# Poles of the Bessel filter of order 4 that has its half-power point at 1 rad/s, one of each pair.
POLES = np.array([-1.3700678306 + 0.4102497175j, -0.9952087644 + 1.2571057395j])
# A stamp may run ahead of the one before it by so much, and by so many seconds for each that has passed.
LARGEST_LEAP_S = 10.0
FASTEST_PACE = 1000.0
CLOCK_BELIEVED_AFTER = 5
WRENCH_TOPIC, SHAFT_TOPIC = "load/wrench", "load/shaft"


def encode_wrench(wrench: np.ndarray, stamp_ns: int, frame: str = FRAME) -> bytes:
    """Encode one ``load/wrench`` as CDR, shape [6], [N, N m]."""
    force = make("geometry_msgs/msg/Vector3", x=wrench[0], y=wrench[1], z=wrench[2])
    torque = make("geometry_msgs/msg/Vector3", x=wrench[3], y=wrench[4], z=wrench[5])
    content = make("geometry_msgs/msg/Wrench", force=force, torque=torque)
    return serialize(make(WRENCH, header=header(stamp_ns, frame), wrench=content))


def encode_shaft(speed: float, stamp_ns: int, frame: str = FRAME) -> bytes:
    """Encode one ``load/shaft`` as CDR, [rad/s] about +y."""
    zero = make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
    turning = make("geometry_msgs/msg/Vector3", x=0.0, y=speed, z=0.0)
    content = make("geometry_msgs/msg/Twist", linear=zero, angular=turning)
    return serialize(make(TWIST, header=header(stamp_ns, frame), twist=content))


class LowPass:
    """Bessel filter of order 4 for unevenly spaced samples, straight between them.

    A step comes through with less than 1 % of overshoot, and all frequencies below the bandwidth with
    the same delay.

    Parameters
    ----------
    bandwidth : float
        Where half of the power passes, [Hz].
    """

    def __init__(self, bandwidth: float) -> None:
        both = np.concatenate((POLES, POLES.conj()))
        others = [np.prod([pole - each for each in both if each != pole]) for pole in POLES]
        scale = 2.0 * np.pi * bandwidth
        self._poles = POLES * scale
        self._residues = np.prod(both) / np.array(others) * scale
        self._state: NDArray[np.complex128] | None = None
        # the filter works on what differs from the first value: a constant comes through to the bit
        self._rest = self._last = np.zeros(0)

    @property
    def delay(self) -> float:
        """Delay of frequencies far below the bandwidth, [s]."""
        return float(-2.0 * (1.0 / self._poles).real.sum())

    def push(self, steps: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take samples and return the filtered value at the last of them, shape [column].

        Parameters
        ----------
        steps : array, shape [sample]
            Time since the sample before, [s]; the very first one counts from rest in its own value.
        values : array, shape [sample, column]
        """
        if self._state is None:
            self._rest, self._last = values[0], np.zeros_like(values[0])
            self._state = np.zeros((len(self._poles), len(values[0])), complex)
        values = values - self._rest
        before = np.vstack((self._last, values[:-1]))
        turn = self._poles[:, None] * steps
        growth = np.expm1(turn)
        # of a straight line from `before` to `values` over a step: weights of its two ends
        end = self._residues[:, None] * (growth - turn) / (self._poles[:, None] * turn)
        start = self._residues[:, None] * growth / self._poles[:, None] - end
        left = np.cumsum(turn[:, ::-1], axis=1)[:, ::-1]
        decay = np.exp(left - turn)
        self._state = np.exp(left[:, :1]) * self._state + (decay * start) @ before + (decay * end) @ values
        self._last = values[-1]
        return np.asarray(self._rest + 2.0 * self._state.sum(axis=0).real)


@dataclass(frozen=True)
class HeldLoad:
    """Last value of the live load, filtered.

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


class _SourceClock:
    """Stamps of one topic: any clock that runs forward, and a new one when the source keeps to it."""

    def __init__(self) -> None:
        self.stamp_ns: int | None = None
        self.was_set = False  # before the latest message
        self.arrival = 0.0
        self._doubted: tuple[int, float] | None = None
        self._doubts = 0

    def step(self, stamp_ns: int, now: float) -> tuple[float, str]:
        """Compute the time since the sample before, [s], and the problem with the stamp, '' when none."""
        self.was_set = self.stamp_ns is None
        if self.stamp_ns is None:
            return max(now - self.arrival, 1e-3), ""
        if _follows((self.stamp_ns, self.arrival), stamp_ns, now):
            self._doubts = 0
            return (stamp_ns - self.stamp_ns) * 1e-9, ""
        goes_on = self._doubts and self._doubted and _follows(self._doubted, stamp_ns, now)
        self._doubts = self._doubts + 1 if goes_on else 1
        self._doubted = (stamp_ns, now)
        if self._doubts >= CLOCK_BELIEVED_AFTER:
            self._doubts, self.was_set = 0, True
            return max(now - self.arrival, 1e-3), ""
        return 0.0, (
            f"its stamp {stamp_ns / 1e9:.6f} s is not after {self.stamp_ns / 1e9:.6f} s"
            if stamp_ns <= self.stamp_ns
            else f"its stamp {stamp_ns / 1e9:.6f} s lies {(stamp_ns - self.stamp_ns) / 1e9:.6g} s after the "
            "one before it, too far in the future"
        )


def _follows(before: tuple[int, float], stamp_ns: int, now: float) -> bool:
    """Check whether a stamp may be the next one after another that arrived at a known wall time."""
    stamp_before_ns, arrival = before
    leap = (stamp_ns - stamp_before_ns) * 1e-9
    return 0.0 < leap <= LARGEST_LEAP_S + FASTEST_PACE * (now - arrival)


class _Signal:
    """Filtered samples of one topic; filtered when they are asked for, all at once."""

    def __init__(self, bandwidth: float) -> None:
        self.clock = _SourceClock()
        self.raw: NDArray[np.float64] | None = None
        self.refused_since = 0
        self._filter = LowPass(bandwidth)
        self._steps: list[float] = []
        self._waiting: list[NDArray[np.float64]] = []
        self._filtered = np.zeros(0)

    def take(self, step: float, values: NDArray[np.float64], stamp_ns: int, now: float) -> None:
        self.clock.stamp_ns, self.clock.arrival = stamp_ns, now
        self.raw, self.refused_since = values, 0
        self._steps.append(step)
        self._waiting.append(values)

    def filtered(self) -> NDArray[np.float64]:
        if self._waiting:
            self._filtered = self._filter.push(np.array(self._steps), np.array(self._waiting))
            self._steps, self._waiting = [], []
        return self._filtered


class LiveLoad:
    """Last wrench and shaft speed, one message a sample, behind a low-pass filter.

    Parameters
    ----------
    refusals : Refusals
    condition : threading.Condition
    bandwidth : float
        Of the filter, [Hz].
    on_stamp : callable, optional
        ``on_stamp(topic, stamp_ns, arrival, was_set)`` is called for every message that is taken.

    Notes
    -----
    A stamp that does not follow the one before it is refused; after `CLOCK_BELIEVED_AFTER` of them that
    follow each other the source has set its clock, and the load goes on.
    """

    def __init__(
        self,
        refusals: Refusals,
        condition: threading.Condition,
        bandwidth: float,
        on_stamp: Callable[[str, int, float, bool], None] = lambda *_stamp: None,
    ) -> None:
        self.refusals = refusals
        self.condition = condition
        self._on_stamp = on_stamp
        self.delay = LowPass(bandwidth).delay
        self._signals = {WRENCH_TOPIC: _Signal(bandwidth), SHAFT_TOPIC: _Signal(bandwidth)}

    def offer_wrench(self, wrench: NDArray[np.float64], stamp_ns: int) -> str | None:
        """Take force and moment, shape [6]; the sentence of the refusal when refused."""
        problem = unphysical(wrench[None, :], np.zeros(1), np.zeros((1, 3)))
        return self._take(WRENCH_TOPIC, wrench, stamp_ns, problem)

    def offer_speed(self, speed: float, stamp_ns: int) -> str | None:
        """Take the shaft speed, [rad/s]; the sentence of the refusal when refused."""
        problem = unphysical(np.zeros((1, 6)), np.array([speed]), np.zeros((1, 3)))
        return self._take(SHAFT_TOPIC, np.array([speed]), stamp_ns, problem)

    def refuse(self, topic: str, reason: str, sentence: str) -> str:
        """Count a message that is not looked into."""
        with self.condition:
            self._signals[topic].refused_since += 1
        return self.refusals.add(reason, f"{topic} refused: {sentence}")

    def _take(
        self, topic: str, values: NDArray[np.float64], stamp_ns: int, problem: tuple[str, str] | None
    ) -> str | None:
        signal, now, step = self._signals[topic], time.monotonic(), 0.0
        with self.condition:
            if problem is None:
                step, wrong = signal.clock.step(stamp_ns, now)
                later = stamp_ns > (signal.clock.stamp_ns or 0)
                problem = ("far future" if later else "out of order", wrong) if wrong else None
            if problem is None and topic == SHAFT_TOPIC and signal.raw is not None:
                times = np.array([0, round(step * 1e9)])
                jump = speed_jump(times, np.concatenate((signal.raw, values)))
                problem = ("absurd", jump) if jump and signal.clock.stamp_ns is not None else None
            if problem is None:
                signal.take(step, values, stamp_ns, now)
                self._on_stamp(topic, stamp_ns, now, signal.clock.was_set)
                self.condition.notify_all()
                return None
        return self.refuse(topic, *problem)

    def restart_age(self) -> None:
        """Count the age of what is held from now on: its source was silent on purpose."""
        with self.condition:
            for signal in self._signals.values():
                signal.clock.arrival = time.monotonic()

    def accept_any_stamp(self) -> None:
        """Accept any stamp next: the sender starts again."""
        with self.condition:
            for signal in self._signals.values():
                signal.clock.stamp_ns = None

    def refused_since(self) -> int:
        """Count the refused messages since the last good one, of the topic that waits longest for one."""
        with self.condition:
            return min(self._signals.values(), key=lambda signal: signal.clock.arrival).refused_since

    def held(self) -> HeldLoad | None:
        """Return the last value, ``None`` until both messages have come."""
        with self.condition:
            wrench, shaft = self._signals[WRENCH_TOPIC], self._signals[SHAFT_TOPIC]
            if wrench.raw is None or shaft.raw is None:
                return None
            oldest = min(wrench.clock.arrival, shaft.clock.arrival)
            return HeldLoad(wrench.filtered(), float(shaft.filtered()[0]), time.monotonic() - oldest)

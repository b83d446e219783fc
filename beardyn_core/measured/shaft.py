"""Angle of the shaft over time: from a constant speed, from a channel with the speed, from tacho pulses.

The angle is given on an even grid fine enough that the shaft turns less than a quarter of a revolution from
one point to the next: whoever unwraps it loses none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.monitor.speed import SpeedTrack

_POINTS_PER_TURN = 4.0
_SLOWEST_GRID = 50.0  # [Hz]
_USUAL_GRID = 400.0  # [Hz], that of a simulated tachometer
_HYSTERESIS = 0.1  # of the range of the pulses
_IRREGULAR = 0.6  # share of an interval by which the next one may differ
_SPIKE = 0.5  # of the range of the pulses, beyond which a value is no pulse
_LATEST = 4  # intervals of which the longest is the usual one
_LOST = 3.5  # times an interval, from which the next one is a hole: the pulses are lost, or the shaft stands


@dataclass(frozen=True)
class Turned:
    """Angle and speed of the shaft."""

    time_ns: Int
    angle: Float  # [rad]
    speed: Float  # [rad/s]


class Constant:
    """A shaft that turns evenly, from the angle 0 on, at a speed [rad/s]."""

    def __init__(self, speed: float) -> None:
        self._speed, self._angle = speed, 0.0
        self._last: int | None = None

    def turn(self, speed: float) -> None:
        """Turn at another speed from now on, [rad/s]."""
        self._speed = speed

    def until(self, begin_ns: int, end_ns: int) -> Turned:
        """Give evenly spaced points behind those before, up to a time and at it, [ns].

        The first ones of all begin with one at ``begin_ns``.
        """
        if self._last is not None and end_ns <= self._last:  # another accelerometer has been there
            return NOTHING
        begin = begin_ns if self._last is None else self._last
        span = (end_ns - begin) * 1e-9
        count = int(np.ceil(span * max(_SLOWEST_GRID, _POINTS_PER_TURN * self._speed / (2.0 * np.pi)) - 1e-9))
        steps = np.arange(0 if self._last is None else 1, count + 1)
        time = begin + np.round((end_ns - begin) / max(count, 1) * steps).astype(np.int64)
        angle = np.asarray(self._angle + self._speed * 1e-9 * (time - begin), np.float64)
        self._last, self._angle = end_ns, self._angle + self._speed * span
        return Turned(time, angle, np.full(len(time), self._speed))


class Found(Constant):
    """A shaft whose speed was found in the vibration.

    Parameters
    ----------
    track : SpeedTrack
    """

    def __init__(self, track: SpeedTrack) -> None:
        super().__init__(2.0 * np.pi * float(track.frequency.max()))
        self._track = track

    def turn(self, speed: float) -> None:
        """Keep to the track, whatever a file says."""

    def until(self, begin_ns: int, end_ns: int) -> Turned:
        """Give points as `Constant.until` does, with the angle of the track."""
        even = super().until(begin_ns, end_ns)
        time = np.asarray(even.time_ns * 1e-9, np.float64)
        speed = 2.0 * np.pi * np.interp(time, self._track.time, self._track.frequency)
        return Turned(even.time_ns, self._track.angle(time), speed)


class Measured:
    """Angle of a shaft whose speed is known at points, linear in between.

    Parameters
    ----------
    fastest : float
        [rad/s].
    """

    def __init__(self, fastest: float = 0.0) -> None:
        self._grid_ns = round(1e9 / max(_USUAL_GRID, _POINTS_PER_TURN * fastest / (2.0 * np.pi)))
        self._time = np.empty(0, np.int64)
        self._speed = np.empty(0)
        self._angle = 0.0
        self._next: int | None = None

    def take(self, time_ns: Int, speed: Float) -> Turned:
        """Add points of the speed [rad/s] and give the angle as far as it is known."""
        time = np.concatenate((self._time, time_ns))
        speed = np.concatenate((self._speed, speed))
        if self._next is None and len(time):
            self._next = int(time[0])
        if len(time) < 2 or self._next is None:
            self._time, self._speed = time, speed
            return NOTHING
        step = np.diff(time) * 1e-9
        angle = self._angle + np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step)))
        grid = np.arange(self._next, time[-1] + 1, self._grid_ns, dtype=np.int64)
        place = np.clip(np.searchsorted(time, grid, side="right") - 1, 0, len(step) - 1)
        after = (grid - time[place]) * 1e-9
        slope = np.diff(speed)[place] / step[place]
        found = Turned(
            grid, angle[place] + speed[place] * after + 0.5 * slope * after**2, speed[place] + slope * after
        )
        self._next += len(grid) * self._grid_ns
        self._time, self._speed, self._angle = time[-1:], speed[-1:], float(angle[-1])
        return found

    def restart(self) -> None:
        """Begin anew behind a gap; the angle goes on from where it was."""
        self._time, self._speed, self._next = self._time[:0], self._speed[:0], None


class Pulses:
    """Angle of a shaft from the pulses of a tachometer: even between two pulses.

    Attributes
    ----------
    count, irregular : int
        Pulses so far; intervals that differ by far from the one before, as missing or doubled pulses have.
    slowest, fastest : float
        Over the intervals that do not, [rad/s].
    known_ns : int
        Between pulses, without the holes, [ns].
    first_ns, last_ns : int
        Of the first and last pulse, [ns].
    holes : list of (int, int)
        From the last pulse before to the first one after, [ns]; within them nothing is given.
    """

    def __init__(self, low: float, high: float, level: float | None, per_turn: int) -> None:
        middle = 0.5 * (low + high) if level is None else level
        half = 0.5 * _HYSTERESIS * (high - low)
        self._rise, self._fall = middle + half, middle - half
        self._lowest, self._highest = low - _SPIKE * (high - low), high + _SPIKE * (high - low)
        self._per_turn = per_turn
        self._above = True  # a channel that begins high has no pulse there
        self._last: tuple[int, float] | None = None
        self._pulse: int | None = None
        self._interval = 0.0
        self._latest: Float = np.empty(0)
        self._even: int | None = None
        self.count = 0
        self.irregular = 0
        self.slowest, self.fastest = np.inf, 0.0
        self.known_ns = 0
        self.first_ns = self.last_ns = 0
        self.holes: list[tuple[int, int]] = []

    def restart(self) -> None:
        """Begin anew behind a gap."""
        self._above, self._last, self._pulse, self._interval, self._even = True, None, None, 0.0, None
        self._latest = np.empty(0)

    def take(self, time_ns: Int, values: Float) -> Turned:
        """Add samples of the channel and give the angle up to the last pulse."""
        pulses = self._rises(time_ns, values)
        if len(pulses):
            self.first_ns = self.first_ns if self.count else int(pulses[0])
            self.last_ns = int(pulses[-1])
        self.count += len(pulses)
        before = [] if self._pulse is None else [self._pulse]
        every = np.array([*before, *pulses.tolist()], np.int64)
        if len(every) < 2:
            self._pulse = int(every[-1]) if len(every) else self._pulse
            return NOTHING
        intervals = np.diff(every).astype(np.float64)
        earlier = np.concatenate(([self._interval or intervals[0]], intervals[:-1]))
        usual = self._usual_before(intervals)
        lost = intervals > _LOST * usual
        uneven = (
            (np.abs(intervals / earlier - 1.0) > _IRREGULAR) & ~lost & ~np.concatenate(([False], lost[:-1]))
        )
        self.irregular += int(np.count_nonzero(uneven))
        self._interval = float(usual[-1] if lost[-1] else intervals[-1])
        self._latest = np.where(lost, usual, intervals)[-_LATEST:]
        self.known_ns += int(intervals[~lost].sum())
        self.holes += [(int(every[k]), int(every[k + 1])) for k in np.flatnonzero(lost)]
        first = self.count - len(pulses) - len(before)
        angle = 2.0 * np.pi / self._per_turn * (first + np.arange(len(every)))
        speed = 2.0 * np.pi / self._per_turn / (intervals * 1e-9)
        if (even := speed[~uneven & ~lost & (np.abs(intervals / usual - 1.0) <= _IRREGULAR)]).size:
            self.slowest, self.fastest = (
                min(self.slowest, float(even.min())),
                max(self.fastest, float(even.max())),
            )
        step_ns = round(1e9 / max(_USUAL_GRID, _POINTS_PER_TURN * float(speed.max()) / (2.0 * np.pi)))
        begin = int(every[0]) if self._even is None else self._even
        grid = np.arange(begin, every[-1], max(step_ns, 1), dtype=np.int64)
        place = np.clip(np.searchsorted(every, grid, side="right") - 1, 0, len(intervals) - 1)
        self._even = int(grid[-1]) + step_ns if len(grid) else begin
        self._pulse = int(every[-1])
        grid, place = grid[~lost[place]], place[~lost[place]]
        return Turned(grid, angle[place] + speed[place] * (grid - every[place]) * 1e-9, speed[place])

    def _usual_before(self, intervals: Float) -> Float:
        """Give for each interval the longest of those right before it, none of which was a hole."""
        latest = list(self._latest)
        usual = np.empty(len(intervals))
        for k, interval in enumerate(intervals.tolist()):
            usual[k] = max(latest, default=interval)
            latest = [*latest, usual[k] if interval > _LOST * usual[k] else interval][-_LATEST:]
        return usual

    def _rises(self, time_ns: Int, values: Float) -> Int:
        """Find the moments at which the channel rises through the level, interpolated between samples."""
        if self._last is not None:
            time_ns = np.concatenate(([self._last[0]], time_ns))
            values = np.concatenate(([self._last[1]], values))
        is_spike = (values < self._lowest) | (values > self._highest)
        state = np.where(values >= self._rise, 1, np.where(values <= self._fall, 0, -1))
        state[is_spike] = -1
        known = np.where(state >= 0, np.arange(len(state)), 0)
        np.maximum.accumulate(known, out=known)
        above = np.where(state[known] >= 0, state[known] == 1, self._above)
        earlier = np.concatenate(([self._above], above[:-1]))
        at = np.flatnonzero(above & ~earlier)
        self._above = bool(above[-1])
        self._last = (int(time_ns[-1]), float(values[-1]))
        before = np.maximum(at - 1, 0)
        rise = values[at] - values[before]
        share = np.where(rise > 0.0, (self._rise - values[before]) / np.where(rise > 0.0, rise, 1.0), 1.0)
        return np.asarray(
            time_ns[before] + (share * (time_ns[at] - time_ns[before])).round().astype(np.int64)
        )


NOTHING = Turned(np.empty(0, np.int64), np.empty(0), np.empty(0))

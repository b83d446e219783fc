"""Vibration and shaft of measured files as parts in the order of time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.measured.choice import Chosen
from beardyn_core.measured.sensor_choice import AXES
from beardyn_core.measured.shaft import NOTHING, Constant, Found, Measured, Pulses, Turned
from beardyn_core.measured.survey import LONGEST_STEP, Survey, Surveyed

PART_S = 0.02


@dataclass(frozen=True)
class SensorBlock:
    """A short time of one accelerometer."""

    sensor: str
    sample: int  # running index of its first sample: a gap between two files is a gap in it
    time_ns: Int
    acceleration: Float  # shape [sample, 3], [m/s^2]; NaN on an axis that was not measured


Part = SensorBlock | Turned


@dataclass
class Stream:
    """Iterate it for the parts of all files; each time from the beginning.

    Attributes
    ----------
    warnings : list of str
        What was found on the way.
    """

    survey: Survey
    warnings: A[list[str], "what was found on the way"] = field(default_factory=list)
    _last_turned: A[int | None, "last sample of the speed, [ns]"] = None

    def __iter__(self) -> Iterator[Part]:
        """Give the parts in the order of time."""
        self.warnings.clear()
        self._last_turned = None
        shaft = _shaft_of(self.survey)
        for each in self.survey.files:
            yield from self._file(each, shaft)

    def _file(self, each: Surveyed, shaft: Constant | Measured | Pulses | None) -> Iterator[Part]:
        if isinstance(shaft, Constant):
            shaft.turn(each.chosen.speed.value)
        tables = [self._table(each, name, shaft) for name in each.chosen.tables]
        for part in tables[0] if len(tables) == 1 else heapq.merge(*tables, key=_begin):
            yield part
            if isinstance(shaft, Constant) and isinstance(part, SensorBlock):
                turned = shaft.until(int(part.time_ns[0]), int(part.time_ns[-1]))
                if len(turned.time_ns):
                    yield turned

    def _table(self, each: Surveyed, name: str, shaft: Constant | Measured | Pulses | None) -> Iterator[Part]:
        """Give the parts of one table of a file."""
        chosen, rate = each.chosen, each.tables[name].rate
        names = [channel.name for channel in chosen.tables[name]]
        sensors = [(s.name, *_columns(s.axes, names)) for s in chosen.sensors if s.table == name]
        speed, turning = chosen.speed, None
        if speed.channel is not None and speed.channel.table == name:
            assert isinstance(shaft, Measured | Pulses)
            factor = speed.factor if isinstance(shaft, Measured) else 1.0
            turning = _Turning(shaft, names.index(speed.channel.name), factor, each, rate, self._last_turned)
        length, done = max(1, round(PART_S * rate)), 0
        begin_ns = each.begin_ns + each.tables[name].begin_ns
        first = round(begin_ns * 1e-9 * rate)
        rest = np.empty((0, len(names)))

        def parts(rows: Float) -> Iterator[Part]:
            time = begin_ns + np.round((done + np.arange(len(rows))) * (1e9 / rate)).astype(np.int64)
            yield from _received(rows, first + done, time, sensors, bool(chosen.source.flagged))
            if turning is not None:
                turned = turning.take(time, rows)
                if len(turned.time_ns):
                    yield turned

        for block in chosen.source.blocks(names):
            block = np.concatenate((rest, block)) if len(rest) else block
            whole = len(block) - len(block) % length
            for begin in range(0, whole, length):
                yield from parts(block[begin : begin + length])
                done += length
            rest = block[whole:]
        if len(rest):
            yield from parts(rest)
        if turning is not None:
            self._last_turned = turning.last_ns
        if chosen.source.problems:
            raise InputError(chosen.source.problems)


def _received(
    rows: Float, first: int, time: Int, sensors: list[tuple[str, list[int], list[int], Float]], has_gaps: bool
) -> Iterator[SensorBlock]:
    """Give what accelerometers measured in a short time, in several parts where samples are invalid."""
    for name, axes, columns, factors in sensors:
        acceleration = np.full((len(rows), len(AXES)), np.nan)
        acceleration[:, axes] = rows[:, columns] * factors
        if not has_gaps:
            yield SensorBlock(name, first, time, acceleration)
            continue
        good = np.isfinite(acceleration[:, axes]).all(axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], good, [False]))))
        for begin, end in edges.reshape(-1, 2).tolist():
            yield SensorBlock(name, first + begin, time[begin:end], acceleration[begin:end])


class _Turning:
    """Passes the channel with the speed to the shaft, as far as there is vibration."""

    def __init__(
        self,
        shaft: Measured | Pulses,
        column: int,
        factor: float,
        each: Surveyed,
        rate: float,
        last_ns: int | None,
    ) -> None:
        self._shaft, self._column, self._factor = shaft, column, factor
        self._begin_ns, self._end_ns = each.begin_ns, each.end_ns
        self._longest_ns = LONGEST_STEP * 1e9 / rate
        self._outside: tuple[int, float] | None = None  # the last sample before the vibration
        self._ended = False
        self.last_ns = last_ns

    def take(self, time: Int, rows: Float) -> Turned:
        """Add samples of the table."""
        values = rows[:, self._column] * self._factor
        good = np.isfinite(values)
        time, values = time[good], values[good]
        early = int(np.searchsorted(time, self._begin_ns))
        late = int(np.searchsorted(time, self._end_ns))
        if early:
            self._outside = (int(time[early - 1]), float(values[early - 1]))
        inside, its = time[early:late], values[early:late]
        if isinstance(self._shaft, Measured):
            inside, its = self._with_edges(inside, its, time[late:], values[late:])
        if not len(inside):
            return NOTHING
        if self.last_ns is not None and inside[0] - self.last_ns > self._longest_ns:
            self._shaft.restart()
        self.last_ns = int(inside[-1])
        return self._shaft.take(inside, its)

    def _with_edges(self, inside: Int, its: Float, after: Int, values: Float) -> tuple[Int, Float]:
        """Add the speed at the beginning and the end of the vibration, between samples on both sides."""
        known = (list(inside[:1]) or list(after[:1]), list(its[:1]) or list(values[:1]))
        if self._outside is not None and known[0] and known[0][0] > self._begin_ns:
            begin = np.interp(
                self._begin_ns, [self._outside[0], known[0][0]], [self._outside[1], known[1][0]]
            )
            inside, its = np.concatenate(([self._begin_ns], inside)), np.concatenate(([begin], its))
        if len(inside):
            self._outside = None
        if not self._ended and len(after):
            last = (int(inside[-1]), float(its[-1])) if len(inside) else self._before_end
            self._ended = True
            if last is not None and last[0] < self._end_ns - 1 and after[0] - last[0] <= self._longest_ns:
                end = np.interp(self._end_ns - 1, [last[0], after[0]], [last[1], values[0]])
                inside, its = np.append(inside, self._end_ns - 1), np.append(its, end)
        if len(inside):
            self._before_end = (int(inside[-1]), float(its[-1]))
        return inside, its

    _before_end: tuple[int, float] | None = None


def _begin(part: Part) -> int:
    return int(part.time_ns[0])


def _columns(axes: object, names: list[str]) -> tuple[list[int], list[int], Float]:
    """Give the places of the axes among x, y, z, their columns, and their factors."""
    found = dict(axes)  # type: ignore[call-overload]
    return (
        [AXES.index(axis) for axis in found],
        [names.index(each.channel.name) for each in found.values()],
        np.array([each.factor for each in found.values()]),
    )


def _shaft_of(survey: Survey) -> Constant | Measured | Pulses | None:
    chosen: Chosen = survey.files[0].chosen
    speed, reading = chosen.speed, survey.reading
    if survey.received is not None:
        return Found(survey.received)
    if speed.kind == "constant":
        return Constant(speed.value)
    if speed.channel is None:
        return None
    ranges = [each.tables[_speed_table(each)].ranges[_speed_name(each)] for each in survey.files]
    low, high = min(each.low for each in ranges), max(each.high for each in ranges)
    if speed.kind == "tacho":
        if survey.tacho is not None:
            low, high = survey.tacho.low, survey.tacho.high
        return Pulses(low, high, reading.tacho_level, reading.pulses_per_turn)
    return Measured(max(abs(low), abs(high)) * abs(speed.factor))


def _speed_table(each: Surveyed) -> str:
    assert each.chosen.speed.channel is not None
    return each.chosen.speed.channel.table


def _speed_name(each: Surveyed) -> str:
    assert each.chosen.speed.channel is not None
    return each.chosen.speed.channel.name

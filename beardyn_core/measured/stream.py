"""Vibration and shaft of measured files as parts in the order of time."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float, Int
from beardyn_core.errors import InputError
from beardyn_core.measured.choice import AXES, Chosen
from beardyn_core.measured.shaft import Constant, Found, Measured, Pulses, Turned
from beardyn_core.measured.survey import Survey, Surveyed

PART_S = 0.02


@dataclass(frozen=True)
class Heard:
    """A short time of one accelerometer."""

    sensor: str
    sample: int  # running index of its first sample: a gap between two files is a gap in it
    time_ns: Int
    acceleration: Float  # shape [sample, 3], [m/s^2]; NaN on an axis that was not measured


Part = Heard | Turned


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

    def __iter__(self) -> Iterator[Part]:
        """Give the parts in the order of time."""
        self.warnings.clear()
        shaft = _shaft_of(self.survey)
        for number, each in enumerate(self.survey.files):
            if (
                number
                and self.survey.reading.file_interval is not None
                and not isinstance(shaft, Constant | None)
            ):
                shaft.restart()
            yield from self._file(each, shaft)
        if isinstance(shaft, Pulses):
            self._judge(shaft)

    def _file(self, each: Surveyed, shaft: Constant | Measured | Pulses | None) -> Iterator[Part]:
        if isinstance(shaft, Constant):
            shaft.turn(each.chosen.speed.value)
        tables = [self._table(each, name, shaft) for name in each.chosen.tables]
        for part in tables[0] if len(tables) == 1 else heapq.merge(*tables, key=_begin):
            yield part
            if isinstance(shaft, Constant) and isinstance(part, Heard):
                turned = shaft.until(int(part.time_ns[0]), int(part.time_ns[-1]))
                if len(turned.time_ns):
                    yield turned

    def _table(self, each: Surveyed, name: str, shaft: Constant | Measured | Pulses | None) -> Iterator[Part]:
        """Give the parts of one table of a file."""
        chosen, rate = each.chosen, each.tables[name].rate
        names = [channel.name for channel in chosen.tables[name]]
        sensors = [(s.name, *_columns(s.axes, names)) for s in chosen.sensors if s.table == name]
        speed = chosen.speed
        turning = speed.channel is not None and speed.channel.table == name
        column = names.index(speed.channel.name) if turning and speed.channel is not None else 0
        length, done = max(1, round(PART_S * rate)), 0
        first = round(each.begin_ns * 1e-9 * rate)
        rest = np.empty((0, len(names)))
        for block in chosen.source.blocks(names):
            block = np.concatenate((rest, block)) if len(rest) else block
            whole = len(block) - len(block) % length
            for begin in range(0, whole, length):
                yield from self._parts(
                    block[begin : begin + length], done, first, each.begin_ns, rate, sensors,
                    (column, speed.factor, shaft) if turning else None,
                )  # fmt: skip
                done += length
            rest = block[whole:]
        if len(rest):
            yield from self._parts(
                rest, done, first, each.begin_ns, rate, sensors,
                (column, speed.factor, shaft) if turning else None,
            )  # fmt: skip
        if chosen.source.problems:
            raise InputError(chosen.source.problems)

    def _parts(
        self, rows: Float, done: int, first: int, begin_ns: int, rate: float,
        sensors: list[tuple[str, list[int], list[int], Float]],
        turning: tuple[int, float, Constant | Measured | Pulses | None] | None,
    ) -> Iterator[Part]:  # fmt: skip
        time = begin_ns + np.round((done + np.arange(len(rows))) * (1e9 / rate)).astype(np.int64)
        for name, axes, columns, factors in sensors:
            acceleration = np.full((len(rows), len(AXES)), np.nan)
            acceleration[:, axes] = rows[:, columns] * factors
            yield Heard(name, first + done, time, acceleration)
        if turning is not None:
            column, factor, shaft = turning
            assert isinstance(shaft, Measured | Pulses)
            turned = shaft.take(time, rows[:, column] * (factor if isinstance(shaft, Measured) else 1.0))
            if len(turned.time_ns):
                yield turned

    def _judge(self, pulses: Pulses) -> None:
        if pulses.count < 2:
            self.warnings.append(
                f"the tachometer has {pulses.count} pulses; the speed of the shaft is not known"
            )
        elif pulses.irregular:
            self.warnings.append(
                f"{pulses.irregular} of {pulses.count - 1} intervals between tacho pulses differ by "
                "more than 60 % from the one before; check --tacho-level"
            )


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
    if survey.heard is not None:
        return Found(survey.heard)
    if speed.kind == "constant":
        return Constant(speed.value)
    if speed.channel is None:
        return None
    ranges = [each.tables[_speed_table(each)].ranges[_speed_name(each)] for each in survey.files]
    low, high = min(each.low for each in ranges), max(each.high for each in ranges)
    if speed.kind == "tacho":
        return Pulses(low, high, reading.tacho_level, reading.pulses_per_turn)
    return Measured(max(abs(low), abs(high)) * abs(speed.factor))


def _speed_table(each: Surveyed) -> str:
    assert each.chosen.speed.channel is not None
    return each.chosen.speed.channel.table


def _speed_name(each: Surveyed) -> str:
    assert each.chosen.speed.channel is not None
    return each.chosen.speed.channel.name

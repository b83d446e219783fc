"""The first pass over measured files: rate, range and mistakes of every channel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite, isnan, nan
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.errors import InputError
from beardyn_core.measured.choice import Chosen, choose, speeds_in, time_unit_in
from beardyn_core.measured.clock import Clock
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel
from beardyn_core.measured.telling import gathered, told
from beardyn_core.measured.units import TIME
from beardyn_core.observe.speed import SpeedTrack

_SAME_RATE = 1e-3  # within which two rates are one
_CONTRADICTS = 1e-2  # beyond which a file that says two rates is refused
_SLOWEST = 200.0  # [Hz], below which stamps without a unit are no seconds: 100 kHz in ms would be 100 Hz
LEAST_SAMPLES = 16
LARGEST = 1e6  # [m/s^2]; beyond it the unit or the scale is wrong


@dataclass
class Range:
    """Range of one channel, in the numbers of the file."""

    low: float = np.inf
    high: float = -np.inf
    count: int = 0
    lost: A[int, "numbers that are not finite"] = 0
    first_lost: int = 0
    power: A[float, "sum of the squares about the first number"] = 0.0
    total: A[float, "sum about the first number"] = 0.0
    origin: float = nan

    def take(self, values: Float) -> None:
        """Add the next numbers."""
        good = np.isfinite(values)
        if not good.all():
            if not self.lost:
                self.first_lost = self.count + int(np.argmin(good)) + 1
            self.lost += int(len(values) - good.sum())
            values = values[good]
        self.count += len(good)
        if not len(values):
            return
        if isnan(self.origin):
            self.origin = float(values[0])
        self.low, self.high = min(self.low, float(values.min())), max(self.high, float(values.max()))
        with np.errstate(over="ignore", invalid="ignore"):  # of a damaged file; its range is refused
            about = values - self.origin
            self.total += float(about.sum())
            self.power += float(about @ about)

    @property
    def deviation(self) -> float:
        """Standard deviation."""
        count = self.count - self.lost
        return float(np.sqrt(max(self.power / count - (self.total / count) ** 2, 0.0))) if count else nan


@dataclass(frozen=True)
class Table:
    """What the first pass found of one table of a file."""

    count: int
    rate: A[float, "[Hz]"]
    ranges: Mapping[str, Range]


@dataclass(frozen=True)
class Surveyed:
    """A file that can be read."""

    chosen: Chosen
    tables: Mapping[str, Table]
    begin_ns: A[int, "of its first sample, [ns]"]
    end_ns: A[int, "of where the next sample would be, [ns]"]


@dataclass(frozen=True)
class Survey:
    """Files that can be read, one after the other, as one measurement."""

    files: tuple[Surveyed, ...]
    reading: Reading
    told: tuple[str, ...]
    warnings: tuple[str, ...]
    heard: A[SpeedTrack | None, "speed found in the vibration itself"] = None

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of the accelerometers."""
        return tuple(sensor.name for sensor in self.files[0].chosen.sensors)

    def rate(self, sensor: str) -> float:
        """Give the sampling rate of an accelerometer, [Hz]."""
        first = self.files[0]
        return next(first.tables[each.table].rate for each in first.chosen.sensors if each.name == sensor)

    @property
    def duration(self) -> float:
        """From the first sample to the end of the last, [s]."""
        return self.files[-1].end_ns * 1e-9

    @property
    def has_speed(self) -> bool:
        """Whether the speed of the shaft is known."""
        return self.files[0].chosen.speed.kind != "none" or self.heard is not None


@dataclass
class _Found:
    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def survey(paths: Sequence[Path | str], reading: Reading, needs_speed: bool = False) -> Survey:
    """Read files for the first time.

    Parameters
    ----------
    paths : sequence of Path
        In the order of time.
    needs_speed : bool
        Whether files without the speed of the shaft are refused.

    Raises
    ------
    InputError
        With every mistake in all of them.
    """
    found, chosen = _Found(), []
    for path in paths:
        try:
            chosen.append(choose(Path(path), reading))
        except InputError as error:
            found.problems += error.problems
    if not paths:
        found.problems.append("no measured file is given")
    files: list[Surveyed] = []
    begin = 0
    for each in chosen:
        try:
            tables = {
                name: _table(each, name, channels, reading, found) for name, channels in each.tables.items()
            }
        except InputError as error:
            found.problems += error.problems
            continue
        table = tables[each.sensors[0].table]
        seconds = table.count / table.rate if table.rate > 0.0 else 0.0
        if reading.file_interval is not None:
            begin = round(len(files) * reading.file_interval * 1e9)
            if seconds > reading.file_interval * (1.0 + _SAME_RATE):
                found.problems.append(
                    f"{each.path}: lasts {seconds:.6g} s, longer than "
                    f"file_interval_s {reading.file_interval:g}"
                )
        files.append(Surveyed(each, tables, begin, begin + round(seconds * 1e9)))
        begin = files[-1].end_ns
    _compare(files, found)
    if (
        needs_speed
        and reading.speed_range is None
        and files
        and all(each.chosen.speed.kind == "none" for each in files)
    ):
        has = ", ".join(speeds_in(files[0].chosen.source))
        found.problems.append(
            f"{files[0].chosen.path}: the speed of the shaft is not known, and a monitor needs it; give "
            "one of --speed-rpm, --speed-kmh with --wheel-diameter-mm, --speed-channel"
            f"{f' (the file has {has})' if has else ''}, --tacho-channel, or "
            "--speed-range-rpm to find it in the vibration"
        )
    if found.problems:
        raise InputError(gathered(found.problems, map(Path, paths)))
    warnings = [*(w for each in files for w in each.chosen.warnings), *found.warnings]
    return Survey(tuple(files), reading, told(files), tuple(gathered(warnings, map(Path, paths))))


def _table(chosen: Chosen, name: str, channels: list[Channel], reading: Reading, found: _Found) -> Table:
    """Read one table of a file to its end."""
    names = [channel.name for channel in channels]
    ranges = {channel: Range() for channel in names}
    time = chosen.times.get(name)
    clock = Clock(chosen.seconds)
    chosen.source.problems.clear()
    for block in chosen.source.blocks(names):
        for column, channel in zip(block.T, names, strict=True):
            ranges[channel].take(column)
        if time is not None:
            clock.take(block[:, names.index(time.name)])
    clock.end()
    found.problems += chosen.source.problems
    count = max(each.count for each in ranges.values())
    where = str(chosen.path)
    if count < LEAST_SAMPLES:
        found.problems.append(
            f"{where}: has {count} samples of {names[0]}; at least {LEAST_SAMPLES} are needed"
        )
    elif not chosen.source.problems:
        found.problems += _mistakes(chosen, ranges, time)
    if time is not None:
        found.problems += clock.problems(f"{where}, {time.name}")
    rate = _rate(chosen, channels, time, clock, reading, found)
    return Table(count, rate, ranges)


def _mistakes(chosen: Chosen, ranges: Mapping[str, Range], time: Channel | None) -> list[str]:
    """Find what is wrong with the numbers of channels."""
    problems = []
    factors = {axis.channel.name: axis.factor for sensor in chosen.sensors for axis in sensor.axes.values()}
    for name, each in ranges.items():
        where = f"{chosen.path}, {name}"
        if each.lost:
            problems.append(
                f"{where}: {each.lost} of {each.count} samples are no finite number, the first is sample "
                f"{each.first_lost}; every sample must be one"
            )
        elif time is not None and name == time.name:
            continue
        elif each.low == each.high and (name in factors or chosen.speed.kind == "tacho"):
            what = "the sensor is dead or not connected" if name in factors else "it has no pulses"
            problems.append(f"{where}: every sample is {each.low:g}; {what}")
        elif name in factors and max(abs(each.low), abs(each.high)) * abs(factors[name]) > LARGEST:
            largest = max(abs(each.low), abs(each.high))
            problems.append(
                f"{where}: reaches {largest:g}, which is {largest * abs(factors[name]):.3g} m/s2; allowed is "
                f"up to {LARGEST:g} m/s2: check unit and scale"
            )
    return problems


def _rate(
    chosen: Chosen,
    channels: list[Channel],
    time: Channel | None,
    clock: Clock,
    reading: Reading,
    found: _Found,
) -> float:
    """Decide on the sampling rate: what was said, else what the file says, if it says one thing."""
    claims = {f"the file says of {c.name}": c.rate for c in channels if isfinite(c.rate)}
    if time is not None and isfinite(clock.rate):
        claims[f"the time stamps {time.name} say"] = clock.rate
    own = {sensor.table for sensor in chosen.sensors}
    if reading.rate is not None and channels[0].table in own:
        for what, rate in claims.items():
            if abs(rate - reading.rate) > _SAME_RATE * reading.rate:
                found.warnings.append(
                    f"{chosen.path}: {what} {rate:.6g} Hz; taken are {reading.rate:.6g} Hz, as asked"
                )
        return reading.rate
    if not claims:
        if time is None or not clock.problems(""):
            found.problems.append(
                f"{chosen.path}: does not say at which rate {channels[0].name} was sampled; give "
                "--rate-hz or --time-channel"
            )
        return nan
    (what, rate), *others = claims.items()
    for other, its in others:
        if abs(its - rate) > _CONTRADICTS * rate:
            found.problems.append(
                f"{chosen.path}: {what} {rate:.6g} Hz and {other} {its:.6g} Hz; "
                "give --rate-hz with the right one"
            )
    if time is not None and clock.uncertainty > _SAME_RATE and len(claims) == 1:
        found.warnings.append(
            f"{chosen.path}: the time stamps {time.name} are so coarse that the rate, {rate:.6g} Hz, may be "
            f"wrong by {100.0 * clock.uncertainty:.2g} %; give --rate-hz if it is known"
        )
    slow = channels[0].table in own and len(claims) == 1 and rate < _SLOWEST
    if slow and time is not None and not _says_unit(time, reading):
        found.problems.append(
            f"{chosen.path}: the time stamps {time.name} say {rate:.6g} Hz if they are in s, too slow for a "
            f"vibration; give --time-unit, one of {', '.join(TIME)}, or --rate-hz"
        )
    best = clock.rate if time is not None and isfinite(clock.rate) and not others else rate
    nearest = round(best)
    return float(nearest) if nearest and abs(best - nearest) < 1e-6 * best else best


def _says_unit(time: Channel, reading: Reading) -> bool:
    return bool(time.is_time or reading.time_unit or time_unit_in(time))


def _compare(files: Sequence[Surveyed], found: _Found) -> None:
    """Find files that do not go together."""
    if not files:
        return
    first = files[0]
    for each in files[1:]:
        for sensor, other in zip(first.chosen.sensors, each.chosen.sensors, strict=False):
            one, its = first.tables[sensor.table].rate, each.tables[other.table].rate
            if abs(one - its) > _SAME_RATE * one:
                found.problems.append(
                    f"{each.chosen.path}: is sampled at {its:.6g} Hz and {first.chosen.path} at {one:.6g} "
                    "Hz; files of one recording must have one rate"
                )
            if set(sensor.axes) != set(other.axes):
                found.problems.append(
                    f"{each.chosen.path}: has the axes {', '.join(other.axes)} and {first.chosen.path} "
                    f"{', '.join(sensor.axes)}; files of one recording must have the same"
                )
        if each.chosen.speed.kind != first.chosen.speed.kind:
            found.problems.append(f"{each.chosen.path}: has no speed as {first.chosen.path} has it")

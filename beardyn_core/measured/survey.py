"""The first pass over measured files: rate, range and mistakes of every channel."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite, isnan, nan
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.alignment import Begun, align_files, align_tables, used_delays
from beardyn_core.measured.choice import Chosen, choose, time_unit_in
from beardyn_core.measured.claimed_rate import SAME, Stamps, decide_rate
from beardyn_core.measured.claimed_start import Start, seconds_as_start
from beardyn_core.measured.clock import Clock
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel
from beardyn_core.measured.speed_choice import speeds_in
from beardyn_core.measured.tacho import PulseLevels, Tacho, judge_pulses
from beardyn_core.measured.telling import describe_files, gather_sentences
from beardyn_core.measured.time_column import is_ramp
from beardyn_core.measured.units import ROTATION
from beardyn_core.monitor.speed import SpeedTrack

LEAST_SAMPLES = 16
FASTEST_RPM = 1e6
LONGEST_STEP = 3.0  # times the usual one, from which samples of the speed are a gap
LARGEST = 1e6  # [m/s^2]; beyond it the unit or the scale is wrong
DEAD = "the sensor is dead or not connected"  # end of the sentence where no sample differs


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
    is_ramp: A[bool, "whether its first numbers are those of a time or a counter"] = False

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
            self.is_ramp = is_ramp(values)
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
    start: A[Start | None, "of its first sample, on the clock of the file"] = None
    begin_ns: A[int, "from the beginning of the file, [ns]"] = 0

    @property
    def seconds(self) -> float:
        """How long it lasts."""
        return self.count / self.rate if self.rate > 0.0 else 0.0


@dataclass(frozen=True)
class Surveyed:
    """A file that can be read."""

    chosen: Chosen
    tables: Mapping[str, Table]
    begin_ns: A[int, "of its first sample, [ns]"]
    end_ns: A[int, "of where the next sample would be, [ns]"]
    start: A[Start | None, "of its first sample, by its own clock"] = None


@dataclass(frozen=True)
class Survey:
    """Files that can be read, one after the other, as one measurement."""

    files: tuple[Surveyed, ...]
    reading: Reading
    told: tuple[str, ...]
    warnings: tuple[str, ...]
    received: A[SpeedTrack | None, "speed found in the vibration itself"] = None
    tacho: A[Tacho | None, "what the pulses of the tachometer give"] = None

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
        return self.files[0].chosen.speed.kind != "none" or self.received is not None


@dataclass
class _Found:
    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    levels: PulseLevels = field(default_factory=PulseLevels)


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
        With every mistake in all of them, and everything that must be asked for.
    """
    found, chosen = _Found(), []
    for path in paths:
        try:
            chosen.append(choose(Path(path), reading))
            found.problems += chosen[-1].problems
        except InputError as error:
            found.problems += error.problems
    if not paths:
        found.problems.append("no measured file is given")
    files: list[Surveyed] = []
    for each in chosen:
        try:
            if each.sensors:
                files.append(_survey_file(each, reading, found))
        except InputError as error:
            found.problems += error.problems
    files = _in_time(files, reading, found)
    _compare(files, found)
    if needs_speed and reading.speed_range is None:
        _need_speed(chosen, reading, found)
    tacho = None
    if files and not found.problems and files[0].chosen.speed.kind == "tacho":
        tacho = _tacho(files, reading, found, needs_speed)
    if found.problems:
        raise InputError(gather_sentences(found.problems, map(Path, paths)))
    warnings = [*(w for each in files for w in each.chosen.warnings), *found.warnings]
    return Survey(
        tuple(files),
        reading,
        describe_files(files, tacho),
        tuple(gather_sentences(warnings, map(Path, paths))),
        None,
        tacho,
    )


def _survey_file(chosen: Chosen, reading: Reading, found: _Found) -> Surveyed:
    """Read one file to its end and place its tables in time."""
    tables = {
        name: _table(chosen, name, channels, reading, found) for name, channels in chosen.tables.items()
    }
    own = {sensor.table for sensor in chosen.sensors}
    begun = [
        Begun(
            chosen.tables[name][0].name,
            table.start,
            table.seconds,
            name in own,
            1.0 / table.rate if table.rate > 0.0 else 0.0,
        )
        for name, table in tables.items()
    ]
    delays = used_delays(list(tables), chosen.source.log_delays)
    aligned = align_tables(begun, delays, chosen.source.longest_delay)
    found.problems += [f"{chosen.path}: {each}" for each in aligned.problems]
    found.warnings += [f"{chosen.path}: {each}" for each in aligned.warnings]
    tables = {
        name: replace(table, begin_ns=begin)
        for (name, table), begin in zip(tables.items(), aligned.begin_ns, strict=True)
    }
    end = max(table.begin_ns + round(table.seconds * 1e9) for name, table in tables.items() if name in own)
    made = Surveyed(chosen, tables, 0, end, aligned.start)
    if chosen.speed.kind == "channel":
        _report_lack_of_speed(made, found)
    return made


def _report_lack_of_speed(each: Surveyed, found: _Found) -> None:
    """Warn of vibration without a speed."""
    channel = each.chosen.speed.channel
    assert channel is not None
    table = each.tables[channel.table]
    begin, end = max(table.begin_ns, 0), min(table.begin_ns + round(table.seconds * 1e9), each.end_ns)
    lacking = (each.end_ns - max(end - begin, 0)) * 1e-9
    if table.rate > 0.0 and lacking > max(2.5 / table.rate, 0.01 * each.end_ns * 1e-9):
        found.warnings.append(
            f"{each.chosen.path}: {channel.name} gives a speed for {max(end - begin, 0) * 1e-9:.6g} of "
            f"{each.end_ns * 1e-9:.6g} s, from {begin * 1e-9:.6g} to {end * 1e-9:.6g} s"
        )


def _in_time(files: Sequence[Surveyed], reading: Reading, found: _Found) -> list[Surveyed]:
    """Place files one after the other."""
    if not files:
        return []
    first = files[0]
    rate = first.tables[first.chosen.sensors[0].table].rate
    begun = [
        (each.chosen.path, Begun(str(each.chosen.path), each.start, each.end_ns * 1e-9)) for each in files
    ]
    begins, warnings = align_files(begun, reading.file_interval, 1.5 / rate if rate > 0.0 else 0.0)
    found.warnings += warnings
    for each in files:
        if reading.file_interval is not None and each.end_ns * 1e-9 > reading.file_interval * (1.0 + SAME):
            found.problems.append(
                f"{each.chosen.path}: lasts {each.end_ns * 1e-9:.6g} s, longer than "
                f"file_interval_s {reading.file_interval:g}"
            )
    return [
        replace(each, begin_ns=begin, end_ns=begin + each.end_ns)
        for each, begin in zip(files, begins, strict=True)
    ]


def _need_speed(chosen: Sequence[Chosen], reading: Reading, found: _Found) -> None:
    """Ask for the speed where no file says it."""
    if (
        not chosen
        or reading.speed_channel
        or reading.tacho_channel
        or any(each.speed.kind != "none" for each in chosen)
    ):
        return
    has = ", ".join(speeds_in(chosen[0].source))
    found.problems.append(
        f"{chosen[0].path}: the speed of the shaft is not known, and a monitor needs it; give "
        "one of --speed-rpm, --speed-kmh with --wheel-diameter-mm, --speed-channel"
        f"{f' (the file has {has})' if has else ''}, --tacho-channel, or "
        "--speed-range-rpm to find it in the vibration"
    )


def _tacho(files: Sequence[Surveyed], reading: Reading, found: _Found, needs_speed: bool) -> Tacho | None:
    """Find the level of the tacho's pulses, and what they give."""
    channel = files[0].chosen.speed.channel
    assert channel is not None

    def feed(take: Callable[..., None]) -> None:
        last: int | None = None
        for each in files:
            channel = each.chosen.speed.channel
            assert channel is not None
            table = each.tables[channel.table]
            done = 0
            for block in each.chosen.source.blocks([channel.name]):
                time = (
                    each.begin_ns + table.begin_ns
                    + np.round((done + np.arange(len(block))) * (1e9 / table.rate)).astype(np.int64)
                )  # fmt: skip
                done += len(block)
                kept = (time >= each.begin_ns) & (time < each.end_ns) & np.isfinite(block[:, 0])
                time, values = time[kept], block[kept, 0]
                if not len(time):
                    continue
                if last is not None and time[0] - last > LONGEST_STEP * 1e9 / table.rate:
                    take(None, None)
                take(time, values)
                last = int(time[-1])

    made = judge_pulses(found.levels, reading.tacho_level, reading.pulses_per_turn, feed)
    if made is None:
        return None
    path = files[0].chosen.path
    sentences = [f"{path}: {each}" for each in made.warnings(channel.name, 0, files[-1].end_ns)]
    if made.pulses.count < 2 and needs_speed:
        found.problems += [f"{each}, and a monitor needs it; check --tacho-level" for each in sentences]
    found.warnings += sentences
    return made


def _table(chosen: Chosen, name: str, channels: list[Channel], reading: Reading, found: _Found) -> Table:
    """Read one table of a file to its end."""
    names = [channel.name for channel in channels]
    ranges = {channel: Range() for channel in names}
    time = chosen.times.get(name)
    clock = Clock(chosen.seconds.get(name, 1.0))
    speed = chosen.speed.channel if chosen.speed.kind == "tacho" else None
    chosen.source.problems.clear()
    for block in chosen.source.blocks(names):
        for column, channel in zip(block.T, names, strict=True):
            ranges[channel].take(column)
            if speed is not None and channel == speed.name:
                found.levels.take(column)
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
        _judge_numbers(chosen, ranges, time, reading, found)
    if time is not None:
        found.problems += clock.problems(f"{where}, {time.name}")
    rate, seconds = _rate(chosen, channels, time, clock, reading, found)
    start = next((each.start for each in channels if each.start is not None), None)
    if time is not None and isfinite(clock.first):
        start = seconds_as_start(clock.first * seconds, chosen.source.origins.get(time.name, 0))
    return Table(count, rate, ranges, start)


def _rate(
    chosen: Chosen,
    channels: list[Channel],
    time: Channel | None,
    clock: Clock,
    reading: Reading,
    found: _Found,
) -> tuple[float, float]:
    """Give the sampling rate [Hz] and what the seconds of the time stamps are to be multiplied by."""
    stamps = None
    if time is not None and isfinite(clock.rate):
        stamps = Stamps(
            f"the time stamps {time.name} give",
            clock.rate,
            bool(time.is_time or reading.time_unit or time_unit_in(time)),
            bool(reading.time_unit and not time.is_time),
            clock.uncertainty,
        )
    is_vibration = channels[0].table in {sensor.table for sensor in chosen.sensors}
    claims = [claim for channel in channels for claim in channel.claims]
    asked = reading.rate if is_vibration else None
    decision = decide_rate(claims, stamps, asked, name=channels[0].name, is_vibration=is_vibration)
    if time is None or not clock.problems("") or claims:
        found.problems += [f"{chosen.path}: {each}" for each in decision.problems]
    found.warnings += [f"{chosen.path}: {each}" for each in decision.warnings]
    return decision.rate, decision.seconds


def _judge_numbers(
    chosen: Chosen, ranges: Mapping[str, Range], time: Channel | None, reading: Reading, found: _Found
) -> None:
    """Find what is wrong with the numbers of channels."""
    factors = {axis.channel.name: axis.factor for sensor in chosen.sensors for axis in sensor.axes.values()}
    speed = chosen.speed
    for name, each in ranges.items():
        where = f"{chosen.path}, {name}"
        largest = max(abs(each.low), abs(each.high))
        turning = speed.kind == "channel" and speed.channel is not None and name == speed.channel.name
        if each.lost and each.lost == chosen.source.flagged.get(name, 0) and each.lost < each.count:
            found.warnings.append(
                f"{where}: the file marks {each.lost} of {each.count} samples as invalid, the first is "
                f"sample {each.first_lost}; they are left out as gaps"
            )
        elif each.lost:
            found.problems.append(
                f"{where}: {each.lost} of {each.count} samples are no finite number, the first is sample "
                f"{each.first_lost}; every sample must be one"
            )
        elif time is not None and name == time.name:
            continue
        elif each.low == each.high and (name in factors or speed.kind == "tacho"):
            what = DEAD if name in factors else "it has no pulses"
            found.problems.append(f"{where}: every sample is {each.low:g}; {what}")
        elif name in factors and each.is_ramp:
            what = "rises or falls evenly from sample to sample, as a time or a counter does"
            if reading.channels:
                found.warnings.append(f"{where}: {what}; taken is it as a vibration, as asked")
            else:
                found.problems.append(f"{where}: {what}; give --channels with a vibration")
        elif name in factors and largest * abs(factors[name]) > LARGEST:
            found.problems.append(
                f"{where}: reaches {largest:g}, which is {largest * abs(factors[name]):.3g} m/s2; allowed is "
                f"up to {LARGEST:g} m/s2: check unit and scale"
            )
        elif turning and largest * abs(speed.factor) / ROTATION["rpm"] > FASTEST_RPM:
            found.problems.append(
                f"{where}: reaches {largest:g}, which is {largest * abs(speed.factor) / ROTATION['rpm']:.3g} "
                f"rpm; allowed is up to {FASTEST_RPM:g} rpm: check --speed-unit"
            )


def _compare(files: Sequence[Surveyed], found: _Found) -> None:
    """Find files that do not go together."""
    if not files:
        return
    first = files[0]
    for each in files[1:]:
        for sensor, other in zip(first.chosen.sensors, each.chosen.sensors, strict=False):
            one, its = first.tables[sensor.table].rate, each.tables[other.table].rate
            if abs(one - its) > SAME * one:
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

"""Which channels of a file are axes, speed and time, in which unit and at which rate: told, or refused."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from math import nan
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.measured.claimed_rate import is_plausible
from beardyn_core.measured.formats import Format, open_measured
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Source
from beardyn_core.measured.time_column import is_counter, is_ramp, is_time_name
from beardyn_core.measured.units import ACCELERATION, ROTATION, TIME, TRAVEL, unit_in, usual

AXES = ("x", "y", "z")
USUAL_SENSOR = "accelerometer"
NO_TIME = "none"
_AXIS_NAME = re.compile(
    r"(?:^|[^a-z])(?:a|acc|accel|acceleration|vib|vibration)?[_ .\-]?([xyz])(?:$|[^a-z0-9])", re.I
)
_SHOWN = 12
_SAME_SPEED = 0.01  # within which a number in the file and what was said are one


@dataclass(frozen=True)
class Axis:
    """One axis of an accelerometer."""

    channel: Channel
    factor: A[float, "metres per second squared of one of its numbers"]


@dataclass(frozen=True)
class Sensor:
    """One accelerometer."""

    name: str
    axes: A[Mapping[str, Axis], "by ``x``, ``y`` or ``z``, of one table"]

    @property
    def table(self) -> str:
        """Table of its channels."""
        return next(iter(self.axes.values())).channel.table


@dataclass(frozen=True)
class Speed:
    """Where the speed of the shaft comes from."""

    kind: A[str, "``none``, ``constant``, ``channel`` or ``tacho``"] = "none"
    value: A[float, "of a constant, [rad/s]"] = 0.0
    channel: Channel | None = None
    factor: A[float, "radians per second of one number of the channel"] = 1.0


@dataclass(frozen=True)
class Chosen:
    """A file and what is taken of it."""

    path: Path
    format: Format
    source: Source
    sensors: tuple[Sensor, ...]
    speed: Speed
    times: A[Mapping[str, Channel], "time stamps of a table, by its name"]
    seconds: A[Mapping[str, float], "in a unit of them, by table"]
    problems: A[tuple[str, ...], "what must be asked for; sensors may lack then"]
    told: A[tuple[str, ...], "how the file was understood, in sentences"]
    warnings: A[tuple[str, ...], "where what was said and what the file says differ"]

    @property
    def tables(self) -> dict[str, list[Channel]]:
        """Channels that are read, by table: those of the sensors first, then speed, then time."""
        found: dict[str, list[Channel]] = {}
        for sensor in self.sensors:
            found.setdefault(sensor.table, []).extend(axis.channel for axis in sensor.axes.values())
        if self.speed.channel is not None:
            found.setdefault(self.speed.channel.table, []).append(self.speed.channel)
        for table, channel in self.times.items():
            if table in found:
                found[table].append(channel)
        return {table: list(dict.fromkeys(channels)) for table, channels in found.items()}


@dataclass
class _Choosing:
    path: Path
    source: Source
    reading: Reading
    problems: list[str] = field(default_factory=list)
    told: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def complain(self, sentence: str) -> None:
        self.problems.append(f"{self.path}: {sentence}")


def choose(path: Path, reading: Reading) -> Chosen:
    """Open a file and decide what is taken of it; what is missing or contradicts is among its problems.

    Raises
    ------
    InputError
        It cannot be opened.
    """
    source, kind = open_measured(path, reading)
    work = _Choosing(path, source, reading)
    work.problems += source.problems
    times = _times(work)
    stamps = {channel.name for channel in times.values()}
    speed = _choose_speed(work)
    taken = stamps | ({speed.channel.name} if speed.channel is not None else set())
    candidates = [each for each in source.channels if each.name not in taken and not each.is_time]
    ramps, empty = _ramps(work, candidates, times)
    sensors = _sensors(work, [each for each in candidates if each.name not in ramps], empty)
    _take_ramps_as_time(work, ramps, sensors, times)
    seconds = {table: _seconds(work, channel) for table, channel in times.items()}
    if not sensors:
        _complain_of_silence(work, bool(times) or any(ramps.values()))
    work.warnings += [f"{path}: {warning}" for warning in source.warnings if reading.rate is None]
    told = (f"{kind.name}: {'; '.join(source.notes)}" if source.notes else kind.name, *work.told)
    problems = tuple(dict.fromkeys(work.problems))
    return Chosen(path, kind, source, sensors, speed, times, seconds, problems, told, tuple(work.warnings))


def _ramps(
    work: _Choosing, candidates: Sequence[Channel], times: Mapping[str, Channel]
) -> tuple[dict[str, bool], set[str]]:
    """Find channels that rise or fall evenly as time and counters do, and those that have no number at all.

    Of the first, whether each may be the time.
    """
    tables: dict[str, list[Channel]] = {}
    for each in candidates:
        if each.table not in times or not times[each.table].is_time or each.count is not None:
            tables.setdefault(each.table, []).append(each)
    found: dict[str, bool] = {}
    empty: set[str] = set()
    for channels in tables.values():
        try:
            block = next(iter(work.source.blocks([each.name for each in channels])), None)
        except InputError:  # the first pass says what is wrong
            continue
        for values, each in zip(() if block is None else block.T, channels, strict=False):
            if np.isnan(values).all():
                empty.add(each.name)
            elif is_ramp(values):
                found[each.name] = bool(values[-1] > values[0]) and not is_counter(values)
    return found, empty


def _take_ramps_as_time(
    work: _Choosing, ramps: Mapping[str, bool], sensors: Sequence[Sensor], times: dict[str, Channel]
) -> None:
    """Take the only ramp beside an accelerometer as its time, where none is named."""
    chosen = {axis.channel.name for sensor in sensors for axis in sensor.axes.values()}
    for table in dict.fromkeys(sensor.table for sensor in sensors):
        beside = [
            each for each in work.source.channels
            if each.table == table and each.name in ramps and each.name not in chosen
        ]  # fmt: skip
        for each in beside:
            is_time = (
                ramps[each.name] and table not in times and work.reading.time_channel != NO_TIME
                and (not each.unit or bool(time_unit_in(each)))
            )  # fmt: skip
            if is_time:
                times[table] = each
            what = "is taken as the time" if is_time else "is left out, as a counter or time"
            work.told.append(f"{each.name} rises or falls evenly and {what}")


def _complain_of_silence(work: _Choosing, has_time: bool) -> None:
    """Name what else is missing where no channel could be chosen, so that all is said at once."""
    channels = work.source.channels
    units = {usual(each.unit) or unit_in(each.name, ACCELERATION) for each in channels}
    if not work.reading.unit and not units & set(ACCELERATION):
        work.complain(
            f"does not say the unit of the acceleration; give --unit, one of {', '.join(ACCELERATION)}"
        )
    claimed = any(is_plausible(rate) for each in channels for claim in each.claims for rate in claim.rates)
    if work.reading.rate is None and not has_time and not claimed:
        work.complain("does not say at which rate it was sampled; give --rate-hz or --time-channel")


def _list_names(names: Sequence[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"{', '.join(names[:_SHOWN])}{more}" if names else "none"


def _found(work: _Choosing, option: str, pattern: str) -> Channel | None:
    """Find the channel of a name, of a pattern, or by its number from 1."""
    channels = work.source.channels
    exact = [each for each in channels if each.name == pattern]
    fitting = exact or [each for each in channels if fnmatchcase(each.name, pattern)]
    if not fitting and pattern.isdecimal() and 0 < int(pattern) <= len(channels):
        fitting = [channels[int(pattern) - 1]]
    if len(fitting) == 1:
        return fitting[0]
    names = _list_names([each.name for each in (fitting or channels)])
    if fitting:
        work.complain(f"{option} {pattern!r} fits several channels, {names}; it must be one")
    else:
        work.complain(f"{option} {pattern!r} is no channel of the file; it has {names}")
    return None


def _times(work: _Choosing) -> dict[str, Channel]:
    wanted = work.reading.time_channel
    if wanted == NO_TIME:
        return {}
    found = _found(work, "time_channel", wanted) if wanted else None
    times: dict[str, Channel] = {} if found is None else {found.table: found}
    for channel in work.source.channels:
        named = is_time_name(channel.name) and usual(channel.unit) not in ACCELERATION
        if (channel.is_time or named) and (channel.table not in times or (channel.is_time and not wanted)):
            times[channel.table] = channel
    return times


def _seconds(work: _Choosing, channel: Channel) -> float:
    said = work.reading.time_unit
    if channel.is_time:
        return 1.0
    known = time_unit_in(channel)
    if said and known and said != known:
        work.warnings.append(
            f"{work.path}: the unit of {channel.name} is {known} in the file; taken is {said}, as asked"
        )
    if channel.unit and not known and not said:
        work.complain(
            f"the unit of {channel.name} is {channel.unit!r}; give --time-unit, one of {', '.join(TIME)}"
        )
    return TIME[said or known or "s"]


def time_unit_in(channel: Channel) -> str:
    """Find the unit of time stamps in their name or beside it; '' where the file says none that is known."""
    if usual(channel.unit) in TIME:
        return usual(channel.unit)
    whole = usual(channel.name) if len(channel.name) > 2 else ""  # ``seconds``
    return whole if whole in TIME else unit_in(channel.name, TIME)


def speeds_in(source: Source) -> dict[str, float | None]:
    """Find what seems to be a speed of the shaft by its unit: columns, None, and single numbers."""
    columns = [each.name for each in source.channels if usual(each.unit) == "rpm" or _in_rpm(each.name)]
    return {**dict.fromkeys(columns), **{n: v for n, v in source.numbers.items() if _in_rpm(n)}}


def _in_rpm(name: str) -> bool:
    return bool(unit_in(name, {"rpm": 1.0})) or name.lower() == "rpm"


def _choose_speed(work: _Choosing) -> Speed:
    reading = work.reading
    if reading.speed is not None:
        return _constant(work, reading.speed)
    if reading.vehicle_speed is not None and reading.wheel_diameter is not None:
        return _constant(work, 2.0 * reading.vehicle_speed / reading.wheel_diameter)
    if reading.tacho_channel:
        channel = _found(work, "tacho_channel", reading.tacho_channel)
        return Speed() if channel is None else Speed("tacho", channel=channel)
    if not reading.speed_channel:
        for name, value in speeds_in(work.source).items():
            what = name if value is None else f"{name} = {value:g}"
            work.told.append(f"the file has {what}; --speed-channel {name} takes it as the speed")
        return Speed()
    numbers = {n: v for n, v in work.source.numbers.items() if fnmatchcase(n, reading.speed_channel)}
    channel = None
    if len(numbers) != 1 or any(each.name == reading.speed_channel for each in work.source.channels):
        channel = _found(work, "speed_channel", reading.speed_channel)
        if channel is None:
            if work.source.numbers:
                work.problems[-1] += f", and the numbers {_list_names(list(work.source.numbers))}"
            return Speed()
    name = next(iter(numbers)) if channel is None else channel.name
    factor = _speed_factor(work, name, "" if channel is None else channel.unit)
    if channel is None:
        value = numbers[name] * factor
        if not value > 0.0:
            work.complain(f"{name} is {numbers[name]:g}; a constant speed must be above 0")
        work.told.append(f"the speed is {name} = {numbers[name]:g}")
        return Speed("constant", value)
    return Speed("channel", channel=channel, factor=factor)


def _constant(work: _Choosing, speed: float) -> Speed:
    """Take what was said, and warn of what the file has beside it."""
    for name, value in speeds_in(work.source).items():
        if value is not None and abs(value * ROTATION["rpm"] - speed) <= _SAME_SPEED * speed:
            continue
        what = f"the column {name}" if value is None else f"{name} = {value:g}"
        work.warnings.append(
            f"{work.path}: has {what}; taken is the speed {speed / ROTATION['rpm']:.6g} rpm, as asked"
        )
    return Speed("constant", speed)


def _speed_factor(work: _Choosing, name: str, unit: str) -> float:
    known = {**ROTATION, **TRAVEL}
    in_file = usual(unit) if usual(unit) in known else unit_in(name, known)
    if name.lower() in ("rpm", "hz"):
        in_file = in_file or ("rpm" if name.lower() == "rpm" else "Hz")
    said = work.reading.speed_unit
    if said and in_file and said != in_file:
        work.warnings.append(
            f"{work.path}: the unit of {name} is {in_file} in the file; taken is {said}, as asked"
        )
    taken = said or in_file
    if not taken:
        work.complain(
            f"the unit of {name} is {unit!r}; give --speed-unit, one of {', '.join(known)}"
            if unit
            else f"does not say the unit of {name}; give --speed-unit, one of {', '.join(known)}"
        )
        return 1.0
    if taken in ROTATION:
        return ROTATION[taken]
    if work.reading.wheel_diameter is None:
        work.complain(f"{name} is a speed in {taken}; give --wheel-diameter-mm")
        return 1.0
    return TRAVEL[taken] * 2.0 / work.reading.wheel_diameter


def _sensors(work: _Choosing, candidates: Sequence[Channel], empty: AbstractSet[str]) -> tuple[Sensor, ...]:
    chosen = _asked_channels(work) if work.reading.channels else _guess_channels(work, candidates, empty)
    sensors = []
    for name, axes in chosen.items():
        found = {axis: Axis(channel, _factor(work, channel)) for axis, channel in sorted(axes.items())}
        tables = {channel.table for channel in axes.values()}
        if len(tables) > 1:
            each = "; ".join(f"{channel.name}: {channel.table}" for channel in axes.values())
            work.complain(
                f"the axes of {name} are not sampled together ({each}); give those of one rate and length"
            )
        if found:
            sensors.append(Sensor(name, found))
    for sensor in sensors:
        each = ", ".join(f"{axis} {found.channel.name}" for axis, found in sensor.axes.items())
        factor = next(iter(sensor.axes.values())).factor
        work.told.append(f"{sensor.name}: {each}; one number is {factor:.6g} m/s2")
    return tuple(sensors)


def _asked_channels(work: _Choosing) -> dict[str, dict[str, Channel]]:
    chosen: dict[str, dict[str, Channel]] = {}
    for text in work.reading.channels:
        name, sign, rest = text.partition(":")
        if not sign or "=" in name:
            name, rest = USUAL_SENSOR, text
        name = name.strip()
        if not re.fullmatch(r"[A-Za-z]\w*", name):
            work.complain(f"channels {text!r}: {name!r} is no name of a sensor; use letters, digits and _")
            continue
        axes = chosen.setdefault(name, {})
        for part in rest.split(","):
            axis, sign, pattern = part.partition("=")
            if not sign:
                axis, pattern = "z", part
            if axis.strip() not in AXES or not pattern.strip():
                work.complain(f"channels {text!r}: {part!r} must be x=NAME, y=NAME or z=NAME")
            elif axis.strip() in axes:
                work.complain(f"channels {text!r}: the axis {axis.strip()} of {name} is given twice")
            elif (found := _found(work, "channels", pattern.strip())) is not None:
                if any(found == other for each in chosen.values() for other in each.values()):
                    work.complain(f"channels {text!r}: {found.name} is taken for two axes")
                axes[axis.strip()] = found
    return chosen


def _guess_channels(
    work: _Choosing, candidates: Sequence[Channel], empty: AbstractSet[str]
) -> dict[str, dict[str, Channel]]:
    """Take the only channel, or those that say their axis; an axis without numbers was not measured."""
    candidates = [each for each in candidates if each.axis] or candidates
    if any(usual(each.unit) in ACCELERATION for each in candidates):  # no volts, angles or temperatures
        candidates = [each for each in candidates if not each.unit or usual(each.unit) in ACCELERATION]
    if (columns := _columns_of_an_array(candidates)) and empty & set(columns):
        work.told.append(
            f"{', '.join(each for each in columns if each in empty)} has no number: not measured"
        )
        return {USUAL_SENSOR: {columns[each.name]: each for each in candidates if each.name not in empty}}
    candidates = [each for each in candidates if each.name not in empty]
    if len(candidates) == 1:
        return {USUAL_SENSOR: {candidates[0].axis or "z": candidates[0]}}
    said = {each.name: each.axis or _axis_in(each.name) for each in candidates}
    tables: dict[str, list[Channel]] = {}
    for each in candidates:
        if said[each.name]:
            tables.setdefault(each.table, []).append(each)
    fitting = [
        found
        for found in tables.values()
        if len({said[each.name] for each in found}) == len(found) <= len(AXES)
    ]
    if len(fitting) == 1 and len(tables) == 1:
        return {USUAL_SENSOR: {said[each.name]: each for each in fitting[0]}}
    if columns := _columns_of_an_array(candidates):
        stem = candidates[0].name.rpartition("[")[0]
        work.told.append(f"the three columns of {stem} are taken as x, y and z")
        return {USUAL_SENSOR: {columns[each.name]: each for each in candidates}}
    names = [each.name for each in candidates]
    if names:
        work.complain(
            f"does not say which channel is the acceleration; give --channels z=NAME "
            f"(or x=NAME,y=NAME,z=NAME), it has {_list_names(names)}"
        )
    else:
        work.complain("has no channel beside time and speed; give the file with the acceleration")
    return {}


def _columns_of_an_array(candidates: Sequence[Channel]) -> dict[str, str]:
    """Give the axes of the three columns of one array, by name; none when they are something else."""
    stems = {each.name.rpartition("[")[0] for each in candidates if each.name.endswith("]")}
    if len(candidates) != len(AXES) or len(stems) != 1 or "" in stems:
        return {}
    return {each.name: axis for axis, each in zip(AXES, candidates, strict=True)}


def _axis_in(name: str) -> str:
    found = _AXIS_NAME.search(name)
    return found[1].lower() if found else ""


def _factor(work: _Choosing, channel: Channel) -> float:
    said, scale = work.reading.unit, work.reading.scale
    known = usual(channel.unit) if usual(channel.unit) in ACCELERATION else ""
    known = known or ("" if channel.unit else unit_in(channel.name, ACCELERATION))
    foreign = channel.unit if channel.unit and not known else ""
    if not said and not known:
        what = (
            f"the unit of {channel.name} is {foreign!r}"
            if foreign
            else f"does not say the unit of {channel.name}"
        )
        work.complain(
            f"{what}; give --unit, one of {', '.join(ACCELERATION)}, with --scale for volts and the like"
        )
        return nan
    named = unit_in(channel.name, ACCELERATION)
    if not said and named and named != known:
        work.complain(
            f"the unit of {channel.name} is {known} in the file and {named} in its name; give --unit"
        )
    if said and (foreign or (known and known != said)):
        work.warnings.append(
            f"{work.path}: the unit of {channel.name} is {known or foreign} in the file; taken is "
            f"{said}{f' times {scale:g}' if scale != 1.0 else ''}, as asked"
        )
    return ACCELERATION[said or known] * scale

"""Which channels of a file are axes, speed and time, in which unit and at which rate: given, or refused."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.measured.choosing import Choosing, find_channel
from beardyn_core.measured.claimed_rate import is_plausible
from beardyn_core.measured.formats import Format, open_measured
from beardyn_core.measured.load_channel import LoadChannel, choose_load
from beardyn_core.measured.options import Reading
from beardyn_core.measured.sensor_choice import Sensor, choose_sensors
from beardyn_core.measured.source import Channel, Source
from beardyn_core.measured.speed_choice import Speed, choose_speed
from beardyn_core.measured.time_column import is_counter, is_ramp, is_time_name
from beardyn_core.measured.units import ACCELERATION, TIME, unit_in, usual

NO_TIME = "none"


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
    warnings: A[tuple[str, ...], "where options and file differ"]
    load: A[LoadChannel | None, "vertical load on the journal"] = None

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


def choose(path: Path, reading: Reading) -> Chosen:
    """Open a file and decide what is taken of it; what is missing or contradicts is among its problems.

    Raises
    ------
    InputError
        It cannot be opened.
    """
    source, kind = open_measured(path, reading)
    work = Choosing(path, source, reading)
    work.problems += source.problems
    times = _times(work)
    stamps = {channel.name for channel in times.values()}
    speed = choose_speed(work)
    load = choose_load(work)
    taken = stamps | {
        each.channel.name for each in (speed, load) if each is not None and each.channel is not None
    }
    candidates = [each for each in source.channels if each.name not in taken and not each.is_time]
    ramps, empty = _ramps(work, candidates, times)
    sensors = choose_sensors(work, [each for each in candidates if each.name not in ramps], empty)
    _take_ramps_as_time(work, ramps, sensors, times)
    seconds = {table: _seconds(work, channel) for table, channel in times.items()}
    if not sensors:
        _complain_of_silence(work, bool(times) or any(ramps.values()))
    work.warnings += [f"{path}: {warning}" for warning in source.warnings if reading.rate is None]
    told = (f"{kind.name}: {'; '.join(source.notes)}" if source.notes else kind.name, *work.told)
    problems = tuple(dict.fromkeys(work.problems))
    return Chosen(
        path, kind, source, sensors, speed, times, seconds, problems, told, tuple(work.warnings), load
    )


def _ramps(
    work: Choosing, candidates: Sequence[Channel], times: Mapping[str, Channel]
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
    work: Choosing, ramps: Mapping[str, bool], sensors: Sequence[Sensor], times: dict[str, Channel]
) -> None:
    """Take the only ramp next to an accelerometer as its time, where none is named."""
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


def _complain_of_silence(work: Choosing, has_time: bool) -> None:
    """Name what else is missing where no channel could be chosen, so that all is said at once."""
    channels = work.source.channels
    units = {usual(each.unit) or unit_in(each.name, ACCELERATION) for each in channels}
    if not work.reading.unit and not units & set(ACCELERATION):
        work.complain(
            f"does not state the unit of the acceleration; give --unit, one of {', '.join(ACCELERATION)}"
        )
    claimed = any(is_plausible(rate) for each in channels for claim in each.claims for rate in claim.rates)
    if work.reading.rate is None and not has_time and not claimed:
        work.complain("does not state the rate at which it was sampled; give --rate-hz or --time-channel")


def _times(work: Choosing) -> dict[str, Channel]:
    wanted = work.reading.time_channel
    if wanted == NO_TIME:
        return {}
    found = find_channel(work, "time_channel", wanted) if wanted else None
    times: dict[str, Channel] = {} if found is None else {found.table: found}
    for channel in work.source.channels:
        named = is_time_name(channel.name) and usual(channel.unit) not in ACCELERATION
        if (channel.is_time or named) and (channel.table not in times or (channel.is_time and not wanted)):
            times[channel.table] = channel
    return times


def _seconds(work: Choosing, channel: Channel) -> float:
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
    """Find the unit of time stamps in their name or next to it; '' where the file says none that is known."""
    if usual(channel.unit) in TIME:
        return usual(channel.unit)
    whole = usual(channel.name) if len(channel.name) > 2 else ""  # ``seconds``
    return whole if whole in TIME else unit_in(channel.name, TIME)

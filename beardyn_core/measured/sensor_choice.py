"""Which channels of a file are the axes of accelerometers, and in which unit: given, or guessed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from math import nan
from typing import Annotated as A

from beardyn_core.measured.choosing import Choosing, find_channel, list_names
from beardyn_core.measured.source import Channel
from beardyn_core.measured.units import ACCELERATION, unit_in, usual

AXES = ("x", "y", "z")
USUAL_SENSOR = "accelerometer"
_AXIS_NAME = re.compile(
    r"(?:^|[^a-z])(?:a|acc|accel|acceleration|vib|vibration)?[_ .\-]?([xyz])(?:$|[^a-z0-9])", re.I
)
# along the track, along the axle, upwards; a name with more in it may be a load
_KIND = r"(?:a|acc\w*|vib\w*|beschleunigung|schwingung)?"
_AXIS_WORDS = {
    axis: re.compile(rf"{_KIND}[_ .\-]*(?:{word})[_ .\-]*{_KIND}\s*(?:[\[(].*)?", re.I)
    for axis, word in (
        ("x", "longitudinal|l(?:ä|ae)ngs"),
        ("y", "lateral|transvers(?:e|al)|quer"),
        ("z", "verti[ck]al"),
    )
}


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


def choose_sensors(
    work: Choosing, candidates: Sequence[Channel], empty: AbstractSet[str]
) -> tuple[Sensor, ...]:
    """Decide which channels are the axes of accelerometers, and what one of their numbers is."""
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


def _asked_channels(work: Choosing) -> dict[str, dict[str, Channel]]:
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
            elif (found := find_channel(work, "channels", pattern.strip())) is not None:
                if any(found == other for each in chosen.values() for other in each.values()):
                    work.complain(f"channels {text!r}: {found.name} is taken for two axes")
                axes[axis.strip()] = found
    return chosen


def _guess_channels(
    work: Choosing, candidates: Sequence[Channel], empty: AbstractSet[str]
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
            f"does not state which channel is the acceleration; give --channels z=NAME "
            f"(or x=NAME,y=NAME,z=NAME), it has {list_names(names)}"
        )
    else:
        work.complain("has no channel but time and speed; give the file with the acceleration")
    return {}


def _columns_of_an_array(candidates: Sequence[Channel]) -> dict[str, str]:
    """Give the axes of the three columns of one array, by name; none when they are something else."""
    stems = {each.name.rpartition("[")[0] for each in candidates if each.name.endswith("]")}
    if len(candidates) != len(AXES) or len(stems) != 1 or "" in stems:
        return {}
    return {each.name: axis for axis, each in zip(AXES, candidates, strict=True)}


def _axis_in(name: str) -> str:
    """Give the axis that the name of a channel has, as a letter or in one word; empty without one."""
    if found := _AXIS_NAME.search(name):
        return found[1].lower()
    said = [axis for axis, word in _AXIS_WORDS.items() if word.fullmatch(name)]
    return said[0] if len(said) == 1 else ""


def _factor(work: Choosing, channel: Channel) -> float:
    said, scale = work.reading.unit, work.reading.scale
    known = usual(channel.unit) if usual(channel.unit) in ACCELERATION else ""
    known = known or ("" if channel.unit else unit_in(channel.name, ACCELERATION))
    foreign = channel.unit if channel.unit and not known else ""
    if not said and not known:
        what = (
            f"the unit of {channel.name} is {foreign!r}"
            if foreign
            else f"does not state the unit of {channel.name}"
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

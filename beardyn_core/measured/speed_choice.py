"""Where the speed of the shaft comes from: what was said, a channel, a tacho, or a number in the file."""

from __future__ import annotations

from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Annotated as A

from beardyn_core.measured.choosing import Choosing, find_channel, list_names
from beardyn_core.measured.source import Channel, Source
from beardyn_core.measured.units import ROTATION, TRAVEL, unit_in, usual

_SAME_SPEED = 0.01  # within which a number in the file and what was said are one


@dataclass(frozen=True)
class Speed:
    """Where the speed of the shaft comes from."""

    kind: A[str, "``none``, ``constant``, ``channel`` or ``tacho``"] = "none"
    value: A[float, "of a constant, [rad/s]"] = 0.0
    channel: Channel | None = None
    factor: A[float, "radians per second of one number of the channel"] = 1.0


def speeds_in(source: Source) -> dict[str, float | None]:
    """Find what seems to be a speed of the shaft by its unit: columns, None, and single numbers."""
    columns = [each.name for each in source.channels if usual(each.unit) == "rpm" or _in_rpm(each.name)]
    return {**dict.fromkeys(columns), **{n: v for n, v in source.numbers.items() if _in_rpm(n)}}


def _in_rpm(name: str) -> bool:
    return bool(unit_in(name, {"rpm": 1.0})) or name.lower() == "rpm"


def choose_speed(work: Choosing) -> Speed:
    """Decide where the speed of the shaft comes from; name what the file has where nobody has said."""
    reading = work.reading
    if reading.speed is not None:
        return _constant(work, reading.speed)
    if reading.vehicle_speed is not None and reading.wheel_diameter is not None:
        return _constant(work, 2.0 * reading.vehicle_speed / reading.wheel_diameter)
    if reading.tacho_channel:
        channel = find_channel(work, "tacho_channel", reading.tacho_channel)
        return Speed() if channel is None else Speed("tacho", channel=channel)
    if not reading.speed_channel:
        for name, value in speeds_in(work.source).items():
            what = name if value is None else f"{name} = {value:g}"
            work.told.append(f"the file has {what}; --speed-channel {name} takes it as the speed")
        return Speed()
    numbers = {n: v for n, v in work.source.numbers.items() if fnmatchcase(n, reading.speed_channel)}
    channel = None
    if len(numbers) != 1 or any(each.name == reading.speed_channel for each in work.source.channels):
        channel = find_channel(work, "speed_channel", reading.speed_channel)
        if channel is None:
            if work.source.numbers:
                work.problems[-1] += f", and the numbers {list_names(list(work.source.numbers))}"
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


def _constant(work: Choosing, speed: float) -> Speed:
    """Take what was said, and warn of what the file has next to it."""
    for name, value in speeds_in(work.source).items():
        if value is not None and abs(value * ROTATION["rpm"] - speed) <= _SAME_SPEED * speed:
            continue
        what = f"the column {name}" if value is None else f"{name} = {value:g}"
        work.warnings.append(
            f"{work.path}: has {what}; taken is the speed {speed / ROTATION['rpm']:.6g} rpm, as asked"
        )
    return Speed("constant", speed)


def _speed_factor(work: Choosing, name: str, unit: str) -> float:
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
            else f"does not state the unit of {name}; give --speed-unit, one of {', '.join(known)}"
        )
        return 1.0
    if taken in ROTATION:
        return ROTATION[taken]
    if work.reading.wheel_diameter is None:
        work.complain(f"{name} is a speed in {taken}; give --wheel-diameter-mm")
        return 1.0
    return TRAVEL[taken] * 2.0 / work.reading.wheel_diameter

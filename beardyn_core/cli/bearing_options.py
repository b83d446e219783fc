"""What `beardyn bearing` solves a bearing for: load, play and speed of its options, or their mistakes."""

from __future__ import annotations

import argparse
import math
from typing import NamedTuple

from beardyn_core.api.static_inputs import limit_problem
from beardyn_core.base.errors import InputError
from beardyn_core.cli.quantities import read_quantity

_DEFAULT_LOAD = ("0", "0", "80")  # [kN]


class Operation(NamedTuple):
    """What a bearing is solved for."""

    load: tuple[float, float, float]  # on the cone [N]
    end_play: float | None  # ``None``: the bearing's own [m]
    radial_clearance: float | None  # the same [m]
    speed: float  # of the shaft [rad/s]


def operation_of(args: argparse.Namespace) -> Operation:
    """Read load, play and speed; raise `InputError` with everything that makes no sense."""
    from beardyn_core.base.units import UNITS
    from beardyn_core.scene.operation import MOST_RPM

    problems: list[str] = []

    def read(option: str, text: str, dimension: str) -> float:
        try:
            return read_quantity(option, text, dimension)
        except InputError as error:
            problems.extend(error.problems)
            return math.nan

    fx, fy, fz = (read("--load", text, "force") for text in args.load or _DEFAULT_LOAD)
    end_play = None if args.end_play is None else read("--end-play", args.end_play, "length")
    clearance = args.radial_clearance
    if clearance is not None:
        clearance = read("--radial-clearance", clearance, "length")
    speed = read("--speed", args.speed, "rotation")
    if end_play is not None:
        problems += _end_play_problems(end_play)
    if abs(speed) > UNITS["rpm"].to_si(MOST_RPM):
        problems.append(f"--speed is {args.speed}; it must be at most {MOST_RPM:g} rpm either way")
    if clearance is not None:
        problems += _clearance_problems(clearance)
    if args.laminae is not None and args.laminae < 1:
        problems.append(f"--laminae is {args.laminae}; it must be at least 1")
    for name, given in (("temperature_C", args.temperature), ("contamination", args.contamination)):
        option = f"--{name.removesuffix('_C')}"
        if given is not None and (problem := limit_problem(name, given, option)):
            problems.append(problem)
        if args.lubricant is None and given is not None:
            problems.append(f"{option} is given, but no --lubricant; it is about the lubricant: give both")
    if args.lubricant is not None and speed == 0.0:
        problems.append("--lubricant is given, but --speed is 0; life needs a shaft that turns")
    if problems:
        raise InputError(problems)
    return Operation((fx, fy, fz), end_play, clearance, speed)


def _end_play_problems(end_play: float) -> list[str]:
    """Say why a bearing cannot have an end play, [m]: the limits are those of bearing files."""
    from beardyn_core.bearing.geometry import Bearing

    return _play_problems(Bearing, "end_play", end_play)


def _clearance_problems(clearance: float) -> list[str]:
    """Say why a bearing cannot have a radial clearance, [m]."""
    from beardyn_core.bearing.radial_bearing import RadialBearing

    return _play_problems(RadialBearing, "radial_clearance", clearance)


def _play_problems(noun: type, field: str, play: float) -> list[str]:
    from beardyn_core.base.edge import places

    at = next(place.at for place in places(noun) if place.field == field)
    written, least, most = at.scale.to_edge(play), at.limits["ge"], at.limits["le"]
    if math.isnan(written) or least <= written <= most:  # what is no number has been reported
        return []
    option = f"--{field.replace('_', '-')}"
    return [f"{option} is {written:g} mm; it must be from {least:g} to {most:g}, as in a bearing file"]

"""Options of the commands that judge a bearing: certainty of speed and bearing, limits of temperature."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS

if TYPE_CHECKING:
    from beardyn_core.monitor.chain import MonitorSettings

# of a stated speed, [-]: what is less was not meant in per cent, beyond parts cannot be told apart
_LEAST_UNCERTAINTY, _MOST_UNCERTAINTY = 0.001, 0.1
_LIMITS = {"warm": 90.0, "hot": 120.0}  # those of `MonitorSettings`, [degrees Celsius]
_COLDEST_LIMIT, _HOTTEST_LIMIT = 0.0, 300.0  # [degrees Celsius]


def add_certainty(parser: argparse.ArgumentParser) -> None:
    """Declare what the stated speed and bearing leave open."""
    from beardyn_core.measured.stated_speed import UNCERTAINTY

    group = parser.add_argument_group("certainty", "what the stated speed and bearing leave open")
    group.add_argument(
        "--speed-uncertainty",
        metavar="PERCENT",
        help="of the stated speed, searched over; default 0 with a tachometer, else "
        f"{100 * UNCERTAINTY:g} %%, or what was found where the speed was sought in the vibration",
    )
    group.add_argument(
        "--neighbour",
        metavar="NAME",
        action="append",
        default=[],
        help="another bearing on the same shaft, whose strikes reach the accelerometer; again for each; "
        "default the others of --bearing",
    )


def add_limits(parser: argparse.ArgumentParser) -> None:
    """Declare the limits of temperature."""
    group = parser.add_argument_group(
        "temperature",
        "limits of the vehicle; a scene's, in kelvin: bd.heat_interval(scene).warm_from(air in kelvin)",
    )
    for name, what in (("warm", "called warm"), ("hot", "an alarm, a hot box")):
        group.add_argument(
            f"--{name}",
            type=float,
            metavar="CELSIUS",
            default=_LIMITS[name],
            help=f"temperature of the axlebox from which it is {what}; default %(default)g, which is assumed",
        )


def given_settings(args: argparse.Namespace) -> list[str]:
    """List the options of certainty and temperature that were given."""
    limits = [f"--{name}" for name, usual in _LIMITS.items() if getattr(args, name) != usual]
    uncertain = ["--speed-uncertainty"] if args.speed_uncertainty is not None else []
    return [*uncertain, *(["--neighbour"] if args.neighbour else []), *limits]


def settings_of(args: argparse.Namespace, uncertainty: float) -> MonitorSettings:
    """Make the settings of the monitor; raises `InputError` with every mistake."""
    from beardyn_core.config import load_plate
    from beardyn_core.monitor.chain import MonitorSettings

    problems: list[str] = []
    if args.speed_uncertainty is not None:
        try:
            uncertainty = float(args.speed_uncertainty.rstrip(" %")) / 100.0
        except ValueError:
            uncertainty = -1.0
        if not (uncertainty == 0.0 or _LEAST_UNCERTAINTY <= uncertainty <= _MOST_UNCERTAINTY):
            problems.append(
                f"--speed-uncertainty is {args.speed_uncertainty!r}; it must be 0, or a number from "
                f"{100.0 * _LEAST_UNCERTAINTY:g} to {100.0 * _MOST_UNCERTAINTY:g} in per cent, such as 3 "
                "for 3 %"
            )
    neighbours = []
    for name in args.neighbour:
        try:
            neighbours.append(load_plate(name).frequencies)
        except InputError as error:
            problems += [f"--neighbour {name}: {each}" for each in error.problems]
    for name in _LIMITS:
        if not _COLDEST_LIMIT <= getattr(args, name) <= _HOTTEST_LIMIT:
            problems.append(
                f"--{name} is {getattr(args, name):g}; it must be from {_COLDEST_LIMIT:g} to "
                f"{_HOTTEST_LIMIT:g} degrees Celsius"
            )
    if args.warm > args.hot:
        problems.append(f"--warm is {args.warm:g}; it must be at most --hot, which is {args.hot:g}")
    if problems:
        raise InputError(problems)
    return MonitorSettings(
        speed_uncertainty=uncertainty,
        neighbours=tuple(neighbours),
        warm=args.warm + ZERO_CELSIUS,
        hot=args.hot + ZERO_CELSIUS,
    )

"""Options of `beardyn monitor` that settle what it assumes: certainty of speed, neighbours, temperatures."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS

if TYPE_CHECKING:
    from beardyn_core.monitor.chain import MonitorSettings

# of a stated speed, [-]: what is less was not meant in per cent, beyond parts cannot be distinguished
_LEAST_UNCERTAINTY, _MOST_UNCERTAINTY = 0.001, 0.1
_LIMITS = {"warm": 90.0, "hot": 120.0}  # those of `MonitorSettings`, [degrees Celsius]
_COLDEST_LIMIT, _HOTTEST_LIMIT = 0.0, 300.0  # [degrees Celsius]


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
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
    group = parser.add_argument_group(
        "temperature",
        "limits of the vehicle; a scene's, in kelvin: bd.heat_interval(scene).warm_from(air in kelvin)",
    )
    for name, what in (("warm", "called warm"), ("hot", "an alarm, a hot box")):
        group.add_argument(
            f"--{name}",
            type=float,
            metavar="CELSIUS",
            help=f"temperature of the axlebox from which it is {what}; default {_LIMITS[name]:g}, which is "
            "assumed",
        )


def given_settings(args: argparse.Namespace) -> list[str]:
    """List the options that were given."""
    given = {
        "--speed-uncertainty": args.speed_uncertainty is not None,
        "--neighbour": bool(args.neighbour),
        "--warm": args.warm is not None,
        "--hot": args.hot is not None,
    }
    return [option for option, there in given.items() if there]


def settings_of(args: argparse.Namespace, uncertainty: float) -> MonitorSettings:
    """Make the settings of the monitor.

    Parameters
    ----------
    uncertainty : float
        Of the speed, where no option says it, [-].

    Raises
    ------
    InputError
        With every mistake.
    """
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
    given = {name: getattr(args, name) for name in _LIMITS}
    limits = _LIMITS | {name: limit for name, limit in given.items() if limit is not None}
    for name, limit in limits.items():
        if not _COLDEST_LIMIT <= limit <= _HOTTEST_LIMIT:
            problems.append(
                f"--{name} is {limit:g}; it must be from {_COLDEST_LIMIT:g} to "
                f"{_HOTTEST_LIMIT:g} degrees Celsius"
            )
    if limits["warm"] > limits["hot"]:
        problems.append(f"--warm is {limits['warm']:g}; it must be at most --hot, which is {limits['hot']:g}")
    if problems:
        raise InputError(problems)
    return MonitorSettings(
        speed_uncertainty=uncertainty,
        neighbours=tuple(neighbours),
        warm=limits["warm"] + ZERO_CELSIUS,
        hot=limits["hot"] + ZERO_CELSIUS,
    )

"""``beardyn monitor --trend``: levels over many records against the bearing's own baseline."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from beardyn_core.api.measuring import trend
from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.generated_parser import add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import plate_options, reading_of
from beardyn_core.cli.monitor_settings import given_settings
from beardyn_core.cli.which_bearing import size_options

if TYPE_CHECKING:
    from beardyn_core.monitor.trend import TrendPoint


def add_trend(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    group = parser.add_argument_group("trend", "records of a bearing over its life, however short")
    group.add_argument(
        "--trend",
        action="store_true",
        help="watch the levels of many records against the baseline of the first ones, and alarm; needs "
        "neither speed nor bearing",
    )
    add_parameter(group, trend, "memory", metavar="FILE", suffix="; of --trend")


def run_trend(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.measured.survey import survey
    from beardyn_core.measured.trending import trend_with_memory

    if problems := option_problems(args):
        raise InputError(problems)
    measured = survey(args.files, reading_of(args))
    for sentence in measured.warnings:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    points, watched = trend_with_memory(measured, args.memory)
    if args.json:
        found = [keyed_fields(each) for each in points]
        print(json_text("monitor", {"files": args.files, "trend": found}))
        return 0
    earlier = ""
    for each in points:
        if each.state != earlier:
            print(f"{each.time:10.1f} s  {each.state:8} {_sentence(each)}")
        earlier = each.state
    print(_ending(points, watched.records, watched.settings.baseline))
    return 0


def option_problems(args: argparse.Namespace) -> list[str]:
    """List the options of a monitor that a trend would leave aside."""
    bearing = "watches levels and needs no bearing"
    given = {
        "--bearing": (args.bearing, bearing),
        **dict.fromkeys(plate_options(args), (True, bearing)),
        "--which-bearing": (args.which_bearing, bearing),
        "--box": (args.box, "reads measured files, which have no axleboxes"),
        "--monitor": (args.monitor, "watches levels itself, without a monitor"),
        "--picture": (args.picture, "analyses nothing that could be drawn"),
        "--force": (args.force, "writes no picture"),
        **dict.fromkeys(given_settings(args), (True, "calls no fault and no hot box")),
        **dict.fromkeys(size_options(args), (True, bearing)),
    }
    return [
        f"{option}: --trend {why}; leave one of both out" for option, (value, why) in given.items() if value
    ]


def _sentence(point: TrendPoint) -> str:
    return f"{point.level} is {point.rise:+.1f} dB over its baseline" if point.level else "no baseline yet"


def _ending(points: list[TrendPoint], records: int, needed: int) -> str:
    """Sum up the trend."""
    if not points:
        return "learning: no record is long enough"
    last = points[-1]
    if not last.level:
        return f"learning: {records} of the {needed} records of the baseline"
    since = f" since {last.since:.1f} s" if last.state == "alarm" else ""
    return f"{last.state}{since}: {_sentence(last)}, {records} records"

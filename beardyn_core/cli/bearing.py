"""`beardyn bearing`: geometry, fault frequencies, load distribution, stiffness and life of one bearing."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from beardyn_core.api.statics import equilibrium, life
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.cli.bearing_options import operation_of
from beardyn_core.cli.bearing_report import Case, report_object
from beardyn_core.cli.bearing_table import bearing_table
from beardyn_core.cli.generated_parser import add_parameter, parameters_of
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json
from beardyn_core.cli.quantities import NEGATIVE_QUANTITY

if TYPE_CHECKING:
    from beardyn_core.physics.statics.rating_life import RatingLife

_TEMPERATURE = parameters_of(life)["temperature_C"].default  # of the lubricant, [degrees Celsius]


def add_parser(subparsers: Any) -> None:
    """Add the command to the subparsers of the command line."""
    parser = subparsers.add_parser(
        "bearing",
        help="compute geometry, fault frequencies, load distribution, stiffness, life",
        description="Geometry, fault frequencies, static load distribution, stiffness and life of a bearing. "
        "Numbers are in the units of scene files (kN, mm, rpm, degrees Celsius); another unit is written "
        "behind a number: 80000N, 0.1mm, 50Hz.",
    )
    # Before Python 3.14 argparse takes -1e-5 for an option.
    parser._negative_number_matcher = NEGATIVE_QUANTITY
    add_parameter(parser, equilibrium, "bearing", "bearing", metavar="BEARING")
    force = ("FX_KN", "FY_KN", "FZ_KN")
    add_parameter(parser, equilibrium, "load_kN", "--load", metavar=force, nargs=3, type=str, default=None)
    add_parameter(parser, equilibrium, "end_play_mm", "--end-play", metavar="MM", type=str)
    add_parameter(parser, equilibrium, "radial_clearance_mm", "--radial-clearance", metavar="MM", type=str)
    add_parameter(parser, equilibrium, "tilt")
    add_parameter(parser, equilibrium, "speed_rpm", "--speed", metavar="RPM", type=str, default="0")
    add_parameter(parser, equilibrium, "laminae", metavar="N")
    add_parameter(parser, equilibrium, "rings")
    without = "none, no life"
    add_parameter(parser, life, "lubricant", metavar="NAME", default=None, usual=without)
    add_parameter(
        parser,
        life,
        "temperature_C",
        "--temperature",
        metavar="CELSIUS",
        default=None,
        usual=f"{_TEMPERATURE:g}",
    )
    add_parameter(parser, life, "contamination", metavar="EC")
    parser.add_argument(
        "--coupled-laminae",
        action="store_true",
        help="slices (laminae) sink with each other: edge load; default independent",
    )
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.bearing.any_bearing import change_play
    from beardyn_core.bearing.life import load_doubts
    from beardyn_core.config import load_any_bearing
    from beardyn_core.effects import LaminaCoupling
    from beardyn_core.physics.modal_body import bending_rings
    from beardyn_core.physics.statics.rating_life import life_lines, life_object
    from beardyn_core.physics.statics.static import solve

    load, end_play, clearance, speed = operation_of(args)
    bearing, end_play = change_play(load_any_bearing(args.bearing), end_play, clearance)
    problem, doubt = load_doubts(bearing, load)
    if problem:
        raise InputError(f"--load: {problem}")
    if doubt:
        print(f"beardyn: warning: --load: {doubt}", file=sys.stderr)
    end_play = getattr(bearing, "end_play", None) if end_play is None else end_play
    laminae = bearing.usual_laminae if args.laminae is None else args.laminae
    case = Case(args, bearing, load, end_play, speed, laminae)
    solution = solve(
        bearing,
        load,
        end_play=case.end_play,
        tilt=args.tilt,
        laminae=laminae,
        speed=speed,
        coupling=LaminaCoupling() if args.coupled_laminae else None,
        body=bending_rings(bearing, args.rings),
    )
    rated = _life(case)
    if args.json:
        report = report_object(case, solution)
        print(json_text("bearing", {**report, "life": None if rated is None else life_object(rated)}))
    else:
        print(bearing_table(case, solution))
        without = ["Rating life needs lubricant and speed, such as --lubricant L055 --speed 800"]
        print("\n".join(["", *(without if rated is None else life_lines(rated))]))
    return 0


def _life(case: Case) -> RatingLife | None:
    """Rate the life under the load of the command line; ``None`` without a lubricant."""
    args = case.args
    if args.lubricant is None:
        return None
    from beardyn_core.config import load_lubricant
    from beardyn_core.physics.statics.rating_life import USUAL_CONTAMINATION, LoadClass, rating_life

    return rating_life(
        case.bearing,
        (LoadClass(1.0, case.load, (0.0, 0.0, 0.0), abs(case.speed)),),
        load_lubricant(args.lubricant),
        (_TEMPERATURE if args.temperature is None else args.temperature) + ZERO_CELSIUS,
        end_play=case.end_play,
        tilt=args.tilt,
        contamination=USUAL_CONTAMINATION if args.contamination is None else args.contamination,
    )

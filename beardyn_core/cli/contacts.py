"""``beardyn contacts``: the general contact search against closed forms."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from beardyn_core.base.interrupts import last_words, may_be_left
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import file_problems, folder_problems, write_whole
from beardyn_core.cli.files import check_inputs, made_folder
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_force, add_json

DONE = 0
_BEARING = "HS130x230"
FILES = ("contacts.json", *(f"contacts_{name}.png" for name in ("nine", "sphere", "rolling", "barrel")))


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "contacts",
        help="compare methods that find contact points: root finders, Newton, closed forms",
        description="Find contact points of parametric surfaces and lines by SciPy's root finder, by "
        "Newton's method with numeric and with analytic Jacobian, and in closed form, plain and compiled: "
        "time, iterations, failures and gap errors over random placements and over a whole bearing row; the "
        "nine contacts of a roller; roller ends of too large a radius; a coin and a roller that roll down a "
        "trough; the load distribution of a spherical roller bearing.",
    )
    parser.add_argument(
        "--bearing",
        metavar="NAME",
        default=_BEARING,
        help=f"shipped bearing or YAML file; default {_BEARING}",
    )
    parser.add_argument("--quick", action="store_true", help="fewer placements, shorter runs")
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=Path,
        help="write contacts.json and the pictures here; default none",
    )
    parser.add_argument(
        "--rrd",
        metavar="FILE.rrd",
        type=Path,
        help="write coin and roller as an animation for rerun; default none",
    )
    add_force(parser)
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.config import load_bearing

    with check_inputs(lambda inputs: option_problems(args, inputs)):
        bearing = load_bearing(args.bearing)

    from beardyn_core.base.jit import when_compiling
    from beardyn_core.laboratory.contacts_report import json_object, report
    from beardyn_core.laboratory.findings import find

    def say(what: str) -> None:
        print(f"beardyn: {what}", file=sys.stderr)

    with (
        last_words(lambda: "nothing has been written"),
        may_be_left(),
        when_compiling(lambda: say("compiling the searches, some 20 s once")),
    ):
        found = find(bearing, quick=args.quick, say=say)
    result = json_object(found)
    print(json_text("contacts", result) if args.json else report(found), flush=True)
    if args.output is not None:
        from beardyn_core.laboratory.contacts_picture import write_pictures

        with made_folder(args.output):
            write_whole(
                args.output / FILES[0], json_text("contacts", result, indent=1) + "\n", replace=args.force
            )
            write_pictures(found, args.output, replace=args.force)
    if args.rrd is not None:
        from beardyn_core.laboratory.rerun_rolling import save_rolling

        say(f"{save_rolling(found.rolling, args.rrd, replace=args.force)}: open it with: rerun {args.rrd}")
    return DONE


def option_problems(args: argparse.Namespace, inputs: Sequence[Path] = ()) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    problems = folder_problems("--output", args.output, FILES, inputs=inputs, force=args.force)
    if args.output is not None:
        problems += missing("matplotlib", "--output", "plot")
    if args.rrd is not None:
        problems += missing("rerun", "--rrd", "view")
    if args.rrd is not None and (args.rrd.parent != args.output or args.output.is_dir()):
        # a folder that is missing is made before the file is written
        problems += file_problems("--rrd", args.rrd, inputs=inputs, force=args.force, ending=".rrd")
    return problems

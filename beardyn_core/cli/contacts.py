"""``beardyn contacts``: the general contact search against closed forms."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from beardyn_core.cli.json_output import json_text
from beardyn_core.errors import InputError
from beardyn_core.study.output_folder import folder_problems

DONE = 0
_BEARING = "HS130x230"


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
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else, on stdout")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.config import load_bearing

    problems = option_problems(args)
    try:
        bearing = load_bearing(args.bearing)
    except InputError as error:
        raise InputError([*error.problems, *problems]) from None
    if problems:
        raise InputError(problems)

    from beardyn_core.jit import when_compiling
    from beardyn_core.laboratory.findings import find
    from beardyn_core.study.contacts_report import json_object, report

    def say(what: str) -> None:
        print(f"beardyn: {what}", file=sys.stderr)

    with when_compiling(lambda: say("compiling the searches, some 20 s once")):
        found = find(bearing, quick=args.quick, say=say)
    result = json_object(found)
    if args.output is not None:
        from beardyn_core.study.contacts_picture import write_pictures

        try:
            args.output.mkdir(exist_ok=True)
            (args.output / "contacts.json").write_text(
                json_text("contacts", result, indent=1) + "\n", encoding="utf-8"
            )
            write_pictures(found, args.output)
        except OSError as error:
            raise InputError(
                f"--output {args.output}: cannot be written: {error.strerror or error}"
            ) from None
    if args.rrd is not None:
        from beardyn_core.record.rerun_rolling import save_rolling

        say(f"{save_rolling(found.rolling, args.rrd)}: open it with: rerun {args.rrd}")
    print(json_text("contacts", result) if args.json else report(found))
    return DONE


def option_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    problems = folder_problems(args.output)
    file = args.rrd
    if file is not None:
        if file.is_dir():
            problems.append(f"--rrd {file}: is a folder; give the name of a file")
        elif file.parent == args.output:
            pass  # made before it is written
        elif not file.parent.is_dir():
            problems.append(f"--rrd {file}: the folder {file.parent} does not exist; create it first")
        elif not os.access(file if file.exists() else file.parent, os.W_OK):
            problems.append(f"--rrd {file}: cannot be written; choose a folder you may write to")
    return problems

"""``beardyn report``: what a recording holds; a cut-off one is recovered."""

from __future__ import annotations

import argparse
import json
import sys

from beardyn_core.errors import InputError


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "report",
        help="what a recording holds; recovers one that was cut off",
        description="Say what a recording holds: topics, counts, rates, gaps, scene, faults, status. A file "
        "that was cut off by a crash is copied, as far as it is readable, to NAME.recovered.mcap.",
    )
    parser.add_argument("recording", metavar="run.mcap")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command.

    Returns
    -------
    int
        0 done, 2 bad input.
    """
    from beardyn_core.record.mcap_scanning import recover
    from beardyn_core.record.reporting import report

    try:
        found = report(args.recording)
        recovery = None if found.complete else recover(args.recording)
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    if args.json:
        content = found.to_json()
        content["recovered"] = str(recovery.target) if recovery else None
        print(json.dumps(content))
    else:
        print(found.to_text())
    if recovery is not None:
        print(recovery.sentence(), file=sys.stderr if args.json else sys.stdout)
    return 0

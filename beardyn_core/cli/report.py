"""``beardyn report``: what a recording holds; a cut-off one is recovered."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from beardyn_core.errors import InputError
from beardyn_core.outputs import is_being_written


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "report",
        help="what a recording holds; recovers one that was cut off",
        description="Say what a recording holds: topics, counts, rates, gaps, scene, faults, status. A file "
        "that was cut off by a crash is copied, as far as it is readable, to NAME.recovered.mcap; one that "
        "is there already stays as it is.",
    )
    parser.add_argument("recording", metavar="run.mcap")
    parser.add_argument("--force", action="store_true", help="replace NAME.recovered.mcap when it exists")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command.

    Returns
    -------
    int
        0 done, 2 bad input, or a cut-off file that could not be recovered.
    """
    from beardyn_core.record.mcap_scanning import Recovery, recover, recovered_name
    from beardyn_core.record.reporting import report

    found = report(args.recording)
    recovery: Recovery | None = None
    problems, notes = [], []
    if not found.complete:
        target = recovered_name(args.recording)
        if is_being_written(Path(args.recording)):
            notes.append(f"{args.recording}: another process is writing this file; this is what it holds now")
        elif target.exists() and not args.force:
            notes.append(f"{target}: is there already and stays as it is; --force recovers the file again")
        else:
            try:
                recovery = recover(args.recording, target, replace=args.force)
                notes.append(recovery.sentence())
            except InputError as error:
                problems = error.problems
    if args.json:
        content = found.to_json()
        content["recovered"] = str(recovery.target) if recovery else None
        print(json.dumps(content))
    else:
        print(found.to_text())
    for note in notes:
        print(note, file=sys.stderr if args.json else sys.stdout)
    if problems:
        raise InputError(problems)
    return 0

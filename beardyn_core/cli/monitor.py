"""``beardyn monitor``: what a monitor says over a finished recording."""

from __future__ import annotations

import argparse
import json


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "monitor",
        help="what a monitor, ours or yours, says over a recording",
        description="Let a monitor hear vibration, shaft and load of a recording, and print what it says.",
    )
    parser.add_argument("recording", metavar="run.mcap")
    parser.add_argument(
        "--monitor",
        metavar="MODULE:FUNCTION",
        default="",
        help="your algorithm; its module may be in this folder",
    )
    parser.add_argument("--bearing", help="name plate: shipped bearing or file (that of the recorded scene)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from dataclasses import asdict
    from math import isfinite

    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import load_bearing
    from beardyn_core.errors import InputError
    from beardyn_core.observe.chain import algorithm_named
    from beardyn_core.record.reading import read_run
    from beardyn_core.study.finding import conclude
    from beardyn_core.study.monitored_recording import findings_of

    algorithm = algorithm_named(args.monitor)
    recording = read_run(args.recording)
    if args.bearing:
        bearing = load_bearing(args.bearing)
    elif recording.scene_text:
        bearing = scene_from_text(recording.scene_text, args.recording).bearing
    else:
        raise InputError(f"{args.recording}: does not say which bearing it is of; give --bearing")
    findings = findings_of(recording, bearing, algorithm)
    conclusion = conclude(findings)
    if args.json:
        rows = [
            {
                key: None if isinstance(value, float) and not isfinite(value) else value
                for key, value in asdict(finding).items()
            }
            for finding in findings
        ]
        print(json.dumps({"verdict": conclusion.verdict, "findings": rows}))
        return 0
    for finding in findings:
        print(f"{finding.time:8.2f} s  {finding.verdict:8} {finding.reason}")
    print(f"{conclusion.verdict}: {conclusion.agreeing} of {conclusion.analyses} analyses")
    return 0

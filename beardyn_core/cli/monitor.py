"""``beardyn monitor``: what a monitor says over a finished recording."""

from __future__ import annotations

import argparse
import sys
from contextlib import nullcontext, suppress
from typing import TYPE_CHECKING

from beardyn_core.cli.json_output import json_text, renamed
from beardyn_core.cli.options import add_json, add_monitor

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing

_UNITS = {
    "s": ("time",),
    "Hz": ("found_frequency", "expected_frequency", "shaft_frequency", "band_low", "band_high"),
    "dB": ("signal_to_background", "score", "threshold", "rms_rise"),
    "N": ("load",),
    "m_per_s2": ("rms",),
    "K": ("temperature",),
}
_KEYS = {name: f"{name}_{unit}" for unit, names in _UNITS.items() for name in names}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "monitor",
        help="run a monitor, ours or yours, over a recording",
        description="Pass vibration, shaft and load of a recording to a monitor, and print its verdicts.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to analyse")
    add_monitor(parser)
    parser.add_argument(
        "--bearing",
        metavar="NAME",
        help="name plate: shipped bearing or file; default that of the recorded scene",
    )
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from dataclasses import asdict

    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import load_bearing
    from beardyn_core.errors import InputError
    from beardyn_core.observe.chain import algorithm_named
    from beardyn_core.record.reading import read_run
    from beardyn_core.study.monitored_recording import conclude, findings_of

    algorithm = algorithm_named(args.monitor)
    recording = read_run(args.recording)
    if recording.problem:
        print(f"beardyn: warning: {recording.problem}; monitored is what is there", file=sys.stderr)
    recorded = None
    with suppress(InputError) if args.bearing else nullcontext():
        if recording.scene_text:
            recorded = scene_from_text(recording.scene_text, args.recording).bearing
    bearing = load_bearing(args.bearing) if args.bearing else recorded
    if bearing is None:
        raise InputError(f"{args.recording}: does not say which bearing it is of; give --bearing")
    if recorded is not None and (doubt := other_bearing(bearing, recorded)):
        print(f"beardyn: warning: --bearing {args.bearing}: {doubt}", file=sys.stderr)
    findings = findings_of(recording, bearing, algorithm)
    conclusion = conclude(findings)
    if args.json:
        content = {
            "recording": args.recording,
            "bearing": bearing.name,
            "verdict": conclusion.verdict,
            "agreeing": conclusion.agreeing,
            "analyses": conclusion.analyses,
            "findings": renamed([asdict(finding) for finding in findings], _KEYS),
        }
        print(json_text("monitor", content))
        return 0
    for finding in findings:
        print(f"{finding.time:8.2f} s  {finding.verdict:8} {finding.reason}")
    print(f"{conclusion.verdict}: {conclusion.agreeing} of {conclusion.analyses} analyses")
    return 0


def other_bearing(given: Bearing, recorded: Bearing) -> str:
    """Say how a bearing differs from the recorded one for a monitor; empty when it does not."""
    from dataclasses import astuple

    from beardyn_core.bearing.kinematics import fault_frequencies

    one, other = fault_frequencies(given), fault_frequencies(recorded)
    if astuple(one) == astuple(other) and given.roller_count == recorded.roller_count:
        return ""
    return (
        f"the recording is of {recorded.name}, {recorded.roller_count} rollers in a row, BPFO "
        f"{other.bpfo:.4f} and BPFI {other.bpfi:.4f} per revolution; searched for is what {given.name} would "
        f"show, {given.roller_count} rollers, {one.bpfo:.4f} and {one.bpfi:.4f}"
    )

"""``beardyn report``: what a recording holds, a cut-off one is recovered; a page about an axlebox."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import is_being_written
from beardyn_core.cli.json_output import json_text, rename_keys
from beardyn_core.cli.options import add_box, add_force, add_json
from beardyn_core.cli.report_page import add_page, page_option_problems, run_page

if TYPE_CHECKING:
    from beardyn_core.record.reporting import Report

_KEYS = {
    "path": "recording",
    "begin": "begin_s",
    "end": "end_s",
    "attachments": "attachment_bytes",
    "mean_shaft_speed": "mean_shaft_speed_rad_per_s",
    "monitor": "monitor_reason",
    "faults": "defects",
    "sensor_rates_Hz": "sensor_rate_Hz",
}
_GROWTH = {"start": "start_s", "end": "end_s", "width": "width_grows", "depth": "depth_grows"}
_LENGTHS = ("width", "depth", "length", "offset", "rim_height", "rim_width", "diameter", "clearance")
_DEFECT = {"azimuth": "azimuth_rad", **{name: f"{name}_m" for name in _LENGTHS}}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "report",
        help="show what a recording holds; recover one that was cut off",
        description="Show what a recording holds: topics, counts, rates, gaps, scene, faults, status. A file "
        "that was cut off by a crash is copied, as far as it is readable, to NAME.recovered.mcap; one that "
        "is there already stays as it is. With --html or --pdf: a page for each axlebox instead, with the "
        "verdict of `beardyn monitor`, its evidence, what was assumed and what to do next.",
    )
    parser.add_argument(
        "files",
        nargs="+",
        metavar="FILE",
        help="recording to report on, or its folder of several; with --html or --pdf also measured files as "
        "`beardyn monitor` takes them, or several recordings, the latest last",
    )
    add_box(parser, "the first one, on pages every one")
    add_force(parser, "replace pages, or NAME.recovered.mcap, when they exist; default refuse")
    add_json(parser)
    add_page(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.record.bag_scanning import cut_files
    from beardyn_core.record.mcap_scanning import EmptyRecordingError, recover, recovered_name
    from beardyn_core.record.reporting import report

    if args.html is not None or args.pdf is not None:
        return run_page(args)
    if problems := page_option_problems(args):
        raise InputError(problems)
    recording = args.files[0]
    found = report(recording, args.box)
    recovered: list[Path] = []
    problems = []
    notes: list[str] = []
    for file in () if found.complete else cut_files(recording):
        target = recovered_name(file)
        if is_being_written(file):
            notes.append(f"{file}: another process is writing this file; this is what it holds now")
        elif target.exists() and not args.force:
            notes.append(f"{target}: is there already and stays as it is; --force recovers the file again")
        else:
            try:
                recovery = recover(file, target, replace=args.force)
                notes.append(recovery.sentence())
                recovered.append(recovery.target)
            except EmptyRecordingError as error:  # no loss where other files hold the run
                (notes if found.topics else problems).extend(error.problems)
            except InputError as error:
                problems += error.problems
    if args.json:
        print(json_text("report", json_object(found, recovered)))
    else:
        print(found.to_text())
    for note in notes:
        print(note, file=sys.stderr if args.json else sys.stdout)
    if problems:
        raise InputError(problems)
    return 0


def json_object(found: Report, recovered: Sequence[Path]) -> dict[str, Any]:
    """Gather what ``--json`` prints; the recovered are copies of files that were cut off."""
    from beardyn_core.scene.defect import defect_from

    content = found.to_json()
    return {
        **{_KEYS.get(key, key): value for key, value in content.items()},
        "topics": rename_keys(content["topics"], {"rate": "rate_Hz"}),
        "gaps": rename_keys(content["gaps"], {"time": "time_s"}),
        "faults": [defect_from(defect).described() for defect in content["faults"]],
        "defects": [_defect(defect) for defect in content["faults"]],
        "recovered": recovered[0] if recovered else None,
    }


def _defect(fields: dict[str, Any]) -> dict[str, Any]:
    if fields.get("growth") is None:
        return {_DEFECT.get(key, key): value for key, value in fields.items()}
    return {**_defect({**fields, "growth": None}), "growth": rename_keys(fields["growth"], _GROWTH)}

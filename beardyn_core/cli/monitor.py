"""``beardyn monitor``: what a monitor says over a finished recording, or over measured files."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api.reading import monitor
from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import as_a_whole, file_problems
from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import add_plates, add_reading
from beardyn_core.cli.monitor_settings import add_certainty, add_limits
from beardyn_core.cli.monitored_files import inspect_files, is_recorded, reading_problems
from beardyn_core.cli.options import add_box, add_force, add_json
from beardyn_core.cli.trend import add_trend, run_trend
from beardyn_core.cli.which_bearing import add_which_bearing, run_which_bearing, size_options

if TYPE_CHECKING:
    from beardyn_core.measured.about import Mounted
    from beardyn_core.study.inspection import BearingResults
    from beardyn_core.study.monitored_recording import Finding


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(subparsers, "monitor", monitor)
    add_parameter(parser, monitor, "run", "files", nargs="+", metavar="FILE")
    add_box(parser, "every one")
    add_parameter(parser, monitor, "algorithm", "--monitor", metavar="MODULE:FUNCTION", default="")
    parser.add_argument(
        "--picture",
        type=Path,
        metavar="FILE.png",
        help="draw the envelope spectrum behind each verdict, with the lines of every part; default none",
    )
    add_force(parser, "replace the picture when it exists; default refuse")
    add_json(parser)
    add_plates(parser, "default that of the recording")
    add_certainty(parser)
    add_limits(parser)
    add_trend(parser)
    add_which_bearing(parser)
    add_reading(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code, which the worst bearing decides."""
    from beardyn_core.monitor.chain import algorithm_named
    from beardyn_core.monitor.chain.explanations import PART_NAMES

    if args.trend:
        return run_trend(args)
    if args.memory:
        raise InputError("--memory is that of --trend; give both")
    if args.which_bearing:
        return run_which_bearing(args, recorded=is_recorded(args))
    if sizes := size_options(args):
        raise InputError(f"{', '.join(sizes)}: of --which-bearing; give both, or neither")
    algorithm = algorithm_named(args.monitor)
    recorded = is_recorded(args)
    problems = _picture_problems(args) + reading_problems(args, recorded=recorded)
    if problems:
        raise InputError(problems)
    inspections = inspect_files(args, algorithm, recorded=recorded)
    results = {each.mounted: each.results for each in inspections}
    for each in inspections if recorded and not args.json else ():
        if each.severity is not None:
            print(f"beardyn: {each.mounted.label}: {each.severity.reason}", file=sys.stderr)
    heard = {each.mounted: each.results.findings for each in inspections}
    if args.picture is not None:
        _draw(results, args.picture, replace=args.force)
    if args.json:
        print(json_text("monitor", json_object(args, heard)))
        return _exit_code(heard)
    labelled = len(heard) > 1
    for mounted, findings in heard.items():
        if labelled:
            print(f"{mounted.label}, {mounted.plate.name}:")
        for finding in findings:
            print(f"{finding.time:8.2f} s  {finding.verdict:8} {finding.reason}")
    for mounted, findings in heard.items():
        print(f"{f'{mounted.label} ' if labelled else ''}{_ending(findings)}")
        for part, why in mounted.plate.cannot_tell.items():
            print(f"{f'{mounted.label} ' if labelled else ''}cannot tell, {PART_NAMES[part]}: {why}")
    return _exit_code(heard)


def _exit_code(heard: dict[Mounted, list[Finding]]) -> int:
    """Give the exit code of the worst bearing."""
    from beardyn_core.study.monitored_recording import EXIT_CODES, conclude, worst

    return EXIT_CODES[worst(conclude(findings).verdict for findings in heard.values())]


def _picture_problems(args: argparse.Namespace) -> list[str]:
    """List why the picture cannot be written."""
    inputs = [Path(each) for each in args.files]
    problems = [] if args.picture is None else missing("matplotlib", "--picture", "plot")
    return problems + file_problems("--picture", args.picture, inputs=inputs, force=args.force, ending=".png")


def _draw(results: dict[Mounted, BearingResults], path: Path, *, replace: bool) -> None:
    """Write the picture of all bearings that have a verdict."""
    from beardyn_core.study.monitor_picture import monitor_picture

    shown = {
        mounted.label: (each.concluded, mounted.plate.frequencies)
        for mounted, each in results.items()
        if each.concluded is not None
    }
    if not shown:
        print("beardyn: warning: there is no analysis to draw; no picture is written", file=sys.stderr)
        return
    with as_a_whole(path, replace=replace) as fresh:
        monitor_picture(shown, fresh)


def _ending(findings: list[Finding]) -> str:
    """Sum up the findings of one bearing: a file that ends without an analysis is not diagnosable."""
    from beardyn_core.study.monitored_recording import NOT_DIAGNOSABLE, UNEXPLAINED, WAITING, conclude

    conclusion = conclude(findings)
    if conclusion.finding is not None and conclusion.verdict != WAITING:
        unclear = conclusion.verdict in (NOT_DIAGNOSABLE, UNEXPLAINED)
        why = f"; {conclusion.finding.reason}" if unclear else ""
        return f"{conclusion.verdict}: {conclusion.agreeing} of {conclusion.analyses} analyses{why}"
    reason = findings[-1].reason if findings else "the signal is shorter than the first analysis needs"
    short = len(findings) > 1 and "revolutions" in reason
    many = "; --trend watches the levels of many short records" if short else ""
    return f"{NOT_DIAGNOSABLE}: no analysis; {reason}{many}"


def json_object(args: argparse.Namespace, heard: dict[Mounted, list[Finding]]) -> dict[str, Any]:
    """Gather what ``--json`` prints: the worst bearing, and all of them."""
    from beardyn_core.study.monitored_recording import NOT_DIAGNOSABLE, WAITING, conclude, worst

    every: list[dict[str, Any]] = []
    for mounted, findings in heard.items():
        conclusion = conclude(findings)
        every.append(
            {
                "label": mounted.label,
                "bearing": mounted.plate.name,
                "sensor": mounted.sensor or None,
                "verdict": NOT_DIAGNOSABLE if conclusion.verdict == WAITING else conclusion.verdict,
                "agreeing": conclusion.agreeing,
                "analyses": conclusion.analyses,
                "findings": [keyed_fields(finding) for finding in findings],
                "cannot_tell": mounted.plate.cannot_tell,
            }
        )
    verdict = worst(each["verdict"] for each in every)
    decides = next(each for each in every if each["verdict"] == verdict)
    top = {key: decides[key] for key in ("bearing", "verdict", "agreeing", "analyses", "findings")}
    return {"recording": args.files[0], "files": args.files, **top, "bearings": every}

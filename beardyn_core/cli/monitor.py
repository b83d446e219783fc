"""``beardyn monitor``: what a monitor says over a finished recording, or over measured files."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from itertools import groupby
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api.reading import monitor
from beardyn_core.base.errors import InputError, collect_problems
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import as_a_whole, file_problems
from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.catalogue_line import catalogue_object, catalogue_sentence
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import add_plates, add_reading, misplaced_options, mounted_of
from beardyn_core.cli.monitor_settings import add_settings, settings_of
from beardyn_core.cli.monitored_files import inspect_files, is_recorded
from beardyn_core.cli.options import add_box, add_force, add_json
from beardyn_core.cli.trend import add_trend, run_trend
from beardyn_core.cli.which_bearing import add_which_bearing, run_which_bearing, size_options

if TYPE_CHECKING:
    from beardyn_core.measured.about import Mounted
    from beardyn_core.monitor.chain import Algorithm
    from beardyn_core.study.inspection import BearingResults, Inspection
    from beardyn_core.study.monitored_recording import Finding
    from beardyn_core.study.smallest_spall import SmallestSpalls

# of the finding that stands for all analyses
_WHOLE_KEYS = (
    "confidence",
    "also_fits",
    "stage",
    "stage_reason",
    "spall_width_m",
    "spall_width_low_m",
    "spall_width_high_m",
)


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(subparsers, "monitor", monitor)
    add_parameter(parser, monitor, "run", "files", nargs="+", metavar="FILE")
    add_box(parser, "every one")
    _add_smallest_spall(parser)
    add_parameter(parser, monitor, "algorithm", "--monitor", metavar="MODULE:FUNCTION", default="")
    parser.add_argument(
        "--picture",
        type=Path,
        metavar="FILE.png",
        help="draw the envelope spectrum behind each verdict, with the lines of every part; default none",
    )
    add_force(parser, "replace the picture when it exists; default refuse")
    parser.add_argument("--verbose", action="store_true", help="print a line for every analysis")
    add_json(parser)
    add_plates(parser, "default that of the recording")
    add_settings(parser)
    add_trend(parser)
    add_which_bearing(parser)
    add_reading(parser)
    parser.set_defaults(run=run)


def _add_smallest_spall(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group(
        "smallest spall", "what a healthy verdict leaves open; up to 28 runs of the twin, a minute or more"
    )
    group.add_argument(
        "--smallest-spall",
        action="store_true",
        help="add spalls of the twin to a healthy record, and name the smallest that is found; default not",
    )
    group.add_argument(
        "--twin",
        metavar="SCENE",
        default="",
        help="scene of the axlebox, or of one like it; default that of the recording; of --smallest-spall",
    )
    group.add_argument(
        "--load-kn",
        metavar="VALUE[:UNCERTAINTY]",
        default="",
        help="known vertical load on this journal, kN, such as 80:3 or 80:5%%, half of the 90 %% "
        "interval; default that of the recording, or of the twin; of --smallest-spall",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code, which the worst bearing decides."""
    from beardyn_core.monitor.chain import algorithm_named
    from beardyn_core.monitor.chain.ambiguity import ON_THE_SHAFT
    from beardyn_core.monitor.chain.explanations import PART_NAMES
    from beardyn_core.study.inspection import hidden_parts
    from beardyn_core.study.monitored_recording import conclude

    if (args.trend or args.which_bearing) and (args.smallest_spall or args.twin or args.load_kn):
        raise InputError(
            "--smallest-spall, --twin, --load-kn: of a verdict; not with --trend or --which-bearing"
        )
    if args.trend:
        return run_trend(args)
    recorded = is_recorded(args)
    if args.which_bearing:
        return run_which_bearing(args, recorded=recorded)
    problems = _picture_problems(args) + misplaced_options(args, recorded)
    if args.memory:
        problems.append("--memory is that of --trend; give both")
    if args.twin and not args.smallest_spall:
        problems.append("--twin is that of --smallest-spall; give both")
    if args.load_kn and not args.smallest_spall:
        problems.append("--load-kn is that of --smallest-spall; give both")
    collect_problems(problems, lambda: _known_load(args.load_kn))
    if args.smallest_spall and not recorded:
        problems.append(
            f"--smallest-spall: {args.files[0]} is no recording; `beardyn import` makes one of measured files"
        )
    if sizes := size_options(args):
        problems.append(f"{', '.join(sizes)}: of --which-bearing; give both, or neither")
    algorithm = collect_problems(problems, lambda: algorithm_named(args.monitor))
    bearings = collect_problems(problems, lambda: mounted_of(args))
    collect_problems(problems, lambda: settings_of(args, 0.0))
    collect_problems(problems, lambda: _known_twin(args.twin))
    inspections = inspect_files(args, algorithm, bearings, problems, recorded=recorded)
    results = {each.mounted: each.results for each in inspections}
    smallest = {each.mounted: _smallest_spalls(args, each, algorithm) for each in inspections}
    received = {mounted: each.findings for mounted, each in results.items()}
    if args.picture is not None:
        _draw(args, results)
    if args.json:
        print(json_text("monitor", json_object(args, received, smallest)))
        return _exit_code(received)
    taken = [catalogue_sentence(each.entry) for each in received if each.entry is not None]
    for sentence in dict.fromkeys(taken):  # of several axleboxes once
        print(sentence)
    labelled = len(received) > 1
    for mounted, findings in received.items():
        if labelled:
            print(f"{mounted.label}, {mounted.plate.name}:")
        for line in _lines_of(findings, every=args.verbose):
            print(line)
    for mounted, findings in received.items():
        label = f"{mounted.label} " if labelled else ""
        print(f"{label}{_ending(findings)}")
        whole = conclude(findings).finding
        if whole is not None and whole.stage_reason:
            print(f"{label}size: {whole.stage_reason}")
        if (spalls := smallest[mounted]) is not None:
            print(f"{label}smallest spall: {spalls if isinstance(spalls, str) else spalls.sentence}")
        for part, why in mounted.plate.cannot_tell.items():
            print(f"{label}not judged, {PART_NAMES[part]}: {why}")
        for part in hidden_parts(mounted.plate, findings):
            print(f"{label}not judged: {PART_NAMES[part]}, {ON_THE_SHAFT}")
    return _exit_code(received)


def _lines_of(findings: list[Finding], *, every: bool) -> Iterator[str]:
    """Write a line for every analysis, or for the first of those that agree and one for the others."""
    for verdict, group in groupby(findings, key=lambda finding: finding.verdict):
        alike = list(group)
        for finding in alike if every else alike[:1]:
            yield f"{finding.time:8.2f} s  {finding.verdict:8} {finding.reason}"
        if not every and len(alike) > 1:
            more = f"{len(alike) - 1} more {'analysis' if len(alike) == 2 else 'analyses'}"
            yield f"{alike[-1].time:8.2f} s  {verdict:8} the same in {more}"


def _smallest_spalls(
    args: argparse.Namespace, inspection: Inspection, algorithm: Algorithm | None
) -> SmallestSpalls | str | None:
    """Find the smallest spalls, or why there are none; ``None`` where they are not asked for.

    What goes wrong costs the verdict nothing.
    """
    from beardyn_core.api.sensitivity import smallest_spalls
    from beardyn_core.study.monitored_recording import HEALTHY

    if not args.smallest_spall:
        return None
    if inspection.verdict != HEALTHY:
        return f"not searched, the verdict is {inspection.verdict}"
    mounted = inspection.mounted
    try:
        return smallest_spalls(
            inspection.run,
            args.twin or None,
            bearing=mounted.plate,
            sensor=mounted.sensor,
            algorithm=algorithm,
            settings=inspection.settings,
            load_kn=args.load_kn or None,
        )
    except InputError as error:
        return f"not searched, {'; '.join(error.problems)}"


def _known_load(text: str) -> None:
    """Read the load that is known, so that a mistake in it is reported before anything is analysed."""
    from beardyn_core.follow.known_load import read_load

    if text:
        read_load(text)


def _known_twin(name: str) -> None:
    """Read the scene of the twin, so that a mistake in it is reported before anything is analysed."""
    from beardyn_core.api.making import scene

    if name:
        scene(name)


def _exit_code(received: dict[Mounted, list[Finding]]) -> int:
    """Give the exit code of the worst bearing."""
    from beardyn_core.study.monitored_recording import EXIT_CODES, conclude, worst

    return EXIT_CODES[worst(conclude(findings).verdict for findings in received.values())]


def _picture_problems(args: argparse.Namespace) -> list[str]:
    """List why the picture cannot be written."""
    inputs = [Path(each) for each in args.files]
    problems = [] if args.picture is None else missing("matplotlib", "--picture", "plot")
    return problems + file_problems("--picture", args.picture, inputs=inputs, force=args.force, ending=".png")


def _draw(args: argparse.Namespace, results: dict[Mounted, BearingResults]) -> None:
    """Write the picture of all bearings that have a verdict."""
    from beardyn_core.study.monitor_picture import monitor_picture

    files = f"{Path(args.files[0]).name}{', ...' if len(args.files) > 1 else ''}"
    labels = {mounted: f"{mounted.label}, " if len(results) > 1 else "" for mounted in results}
    shown = {
        f"{files}, {labels[mounted]}bearing {mounted.plate.name}": (
            each.concluded,
            mounted.plate.frequencies,
        )
        for mounted, each in results.items()
        if each.concluded is not None
    }
    if not shown:
        print("beardyn: warning: there is no analysis to draw; no picture is written", file=sys.stderr)
        return
    with as_a_whole(args.picture, replace=args.force) as fresh:
        monitor_picture(shown, fresh)


def _ending(findings: list[Finding]) -> str:
    """Sum up the findings of one bearing: a file that ends without an analysis is not diagnosable."""
    from beardyn_core.monitor.chain.explanations import PART_NAMES
    from beardyn_core.study.monitored_recording import NOT_DIAGNOSABLE, UNEXPLAINED, WAITING, conclude

    conclusion = conclude(findings)
    if conclusion.finding is not None and conclusion.verdict != WAITING:
        unclear = conclusion.verdict in (NOT_DIAGNOSABLE, UNEXPLAINED)
        why = f"; {conclusion.finding.reason}" if unclear else ""
        counts = f"{conclusion.agreeing} of {conclusion.analyses} analyses"
        parts = (conclusion.verdict, *conclusion.finding.also_fits)
        named = " or ".join(PART_NAMES.get(part, part) for part in parts)
        return f"{named}: {counts}{_confidence_text(conclusion.finding)}{why}"
    reason = findings[-1].reason if findings else "the signal is shorter than the first analysis needs"
    short = len(findings) > 1 and "revolutions" in reason
    many = "; --trend watches the levels of many short records" if short else ""
    return f"{NOT_DIAGNOSABLE}: no analysis; {reason}{many}"


def _confidence_text(finding: Finding) -> str:
    return f", confidence {finding.confidence:.2f}" if isfinite(finding.confidence) else ""


def json_object(
    args: argparse.Namespace,
    received: dict[Mounted, list[Finding]],
    smallest: dict[Mounted, SmallestSpalls | str | None],
) -> dict[str, Any]:
    """Gather what ``--json`` prints: the worst bearing, and all of them."""
    from beardyn_core.study.inspection import hidden_parts
    from beardyn_core.study.monitored_recording import NOT_DIAGNOSABLE, WAITING, Finding, conclude, worst

    every: list[dict[str, Any]] = []
    for mounted, findings in received.items():
        conclusion = conclude(findings)
        spall = keyed_fields(conclusion.finding or Finding(conclusion.verdict, "", 0.0))
        every.append(
            {
                "label": mounted.label,
                "bearing": mounted.plate.name,
                "catalogue": catalogue_object(mounted.entry),
                "sensor": mounted.sensor or None,
                "verdict": NOT_DIAGNOSABLE if conclusion.verdict == WAITING else conclusion.verdict,
                "agreeing": conclusion.agreeing,
                "analyses": conclusion.analyses,
                **{key: spall[key] for key in _WHOLE_KEYS},
                "findings": [keyed_fields(finding) for finding in findings],
                "not_judged": [*mounted.plate.cannot_tell, *hidden_parts(mounted.plate, findings)],
                "cannot_tell": mounted.plate.cannot_tell,
            }
        )
        if isinstance(found := smallest[mounted], str):
            every[-1] |= {"smallest_spalls": [], "twin": found}
        elif found is not None:
            every[-1] |= {
                "smallest_spalls": [keyed_fields(each) for each in found.spalls],
                "twin": found.twin,
            }
    verdict = worst(each["verdict"] for each in every)
    decides = next(each for each in every if each["verdict"] == verdict)
    keys = ("bearing", "verdict", "agreeing", "analyses", *_WHOLE_KEYS, "findings", "not_judged")
    top = {key: decides[key] for key in keys}
    return {"recording": args.files[0], "files": args.files, **top, "bearings": every}

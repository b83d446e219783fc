"""``beardyn report --html`` and ``--pdf``: a page about an axlebox, from the files of ``beardyn monitor``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.api.report_pages import report
from beardyn_core.base.errors import InputError, collect_problems
from beardyn_core.cli.generated_parser import add_parameter
from beardyn_core.cli.measured_options import (
    add_plates,
    add_reading,
    misplaced_options,
    mounted_of,
    plate_options,
    reading_of,
    reading_options,
)
from beardyn_core.cli.monitor_settings import add_settings, given_settings, settings_of
from beardyn_core.cli.monitored_files import inspect_files, is_recorded

if TYPE_CHECKING:
    from beardyn_core.study.inspection import Inspection


def add_page(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    group = parser.add_argument_group("page", "a page for who decides, in place of the list of what is there")
    add_parameter(group, report, "html", metavar="FILE.html")
    add_parameter(group, report, "pdf", metavar="FILE.pdf")
    for name in ("train", "axlebox"):
        add_parameter(group, report, name, metavar="NAME", usual="as in the files")
    group.add_argument(
        "--monitor",
        metavar="MODULE:FUNCTION",
        default="",
        help="your algorithm, its module may be in this folder; default the reference chain",
    )
    add_plates(parser, "default that of the recording")
    add_settings(parser)
    add_reading(parser)


def page_option_problems(args: argparse.Namespace) -> list[str]:
    """List the options of a page, and the files, that a command without one would leave aside."""
    given = [
        *(f"--{name}" for name in ("train", "axlebox", "monitor", "bearing") if getattr(args, name)),
        *given_settings(args),
        *plate_options(args),
        *reading_options(args),
    ]
    problems = [f"{each}: is of a page; give --html or --pdf too" for each in given]
    if len(args.files) > 1:
        problems.append(f"{args.files[1]}: without --html or --pdf one recording is reported on; give one")
    return problems


def run_page(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.monitor.chain import algorithm_named
    from beardyn_core.study.report_page.page_writing import page_problems, write_pages

    problems = page_problems(args.html, args.pdf, [Path(each) for each in args.files], force=args.force)
    algorithm = collect_problems(problems, lambda: algorithm_named(args.monitor))
    bearings = collect_problems(problems, lambda: mounted_of(args))
    collect_problems(problems, lambda: settings_of(args, 0.0))
    collect_problems(problems, lambda: reading_of(args))
    if args.json:
        problems.append("--json: a page is no JSON; `beardyn monitor --json` prints the verdicts")
    each_alone = [argparse.Namespace(**{**vars(args), "files": [file]}) for file in args.files]
    recorded = [is_recorded(one) for one in each_alone]
    if any(recorded) and not all(recorded):
        problems.append(
            f"{args.files[recorded.index(True)]}: is a recording, and {args.files[recorded.index(False)]} is "
            "not; give recordings or measured files"
        )
    for one, own in zip(each_alone, recorded, strict=True):
        problems += misplaced_options(one, own)
    if problems:
        raise InputError(problems)
    records: list[list[Inspection]] = (
        [inspect_files(one, algorithm, bearings, problems, recorded=True) for one in each_alone]
        if all(recorded)
        else [inspect_files(args, algorithm, bearings, problems, recorded=False)]
    )
    told = write_pages(
        records, html=args.html, pdf=args.pdf, train=args.train, axlebox=args.axlebox, force=args.force
    )
    for sentence in told:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    for path in (args.html, args.pdf):
        if path is not None:
            print(path)
    return 0

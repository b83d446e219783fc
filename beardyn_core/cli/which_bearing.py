"""``beardyn monitor --which-bearing``: bearings of the catalogue that fit a vibration."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from beardyn_core.api.finding import catalogue
from beardyn_core.base.errors import InputError, collect_problems
from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.catalogue_line import size_text
from beardyn_core.cli.generated_parser import add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import in_options, misplaced_options, plate_options, reading_of

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry
    from beardyn_core.measured.survey import Survey
    from beardyn_core.monitor.bearing_search import BearingSearchResult
    from beardyn_core.record.run import Run

_SHOWN = 12
SIZE_KEYS = ("bore_mm", "outside_mm", "width_mm", "kind", "maker")


def add_which_bearing(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    group = parser.add_argument_group(
        "which bearing", "where the bearing is not known: those of the catalogue whose orders fit"
    )
    group.add_argument(
        "--which-bearing",
        action="store_true",
        help="compare the combs of strikes with every bearing of the catalogue, in place of --bearing; needs "
        "the speed; a healthy bearing has no comb",
    )
    add_sizes(group, "; of --which-bearing")


def add_sizes(target: Any, suffix: str = "") -> None:
    """Declare the dimensions, kind and maker by which bearings are chosen."""
    for key in ("bore_mm", "outside_mm", "width_mm"):
        add_parameter(target, catalogue, key, metavar="MM", dest=f"catalogue_{key}", suffix=suffix)
    flag = "--bearing-kind"
    add_parameter(target, catalogue, "kind", flag, metavar="KIND", dest="catalogue_kind", suffix=suffix)
    add_parameter(target, catalogue, "maker", metavar="MAKER", dest="catalogue_maker", suffix=suffix)


def size_options(args: argparse.Namespace) -> list[str]:
    """List the options of `add_sizes` that were given."""
    return [_option(key) for key in SIZE_KEYS if getattr(args, f"catalogue_{key}") not in (None, "")]


def _option(key: str) -> str:
    return "--bearing-kind" if key == "kind" else f"--{key.replace('_', '-')}"


def chosen_entries(args: argparse.Namespace) -> tuple[CatalogueEntry, ...]:
    """List the bearings of the options; raises `InputError` with every mistake, as options are written."""
    try:
        return catalogue(**{key: getattr(args, f"catalogue_{key}") for key in SIZE_KEYS})
    except InputError as error:
        keys = ["bore_mm", "outside_mm", "width_mm"]
        problems = [in_options(each, keys) for each in error.problems]
        starts = {"kind is": "--bearing-kind is", "maker is": "--maker is"}
        for old, new in starts.items():
            problems = [each.replace(old, new, 1) if each.startswith(old) else each for each in problems]
        raise InputError(problems) from None


def run_which_bearing(args: argparse.Namespace, *, recorded: bool) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.monitor.bearing_search import SEVERAL
    from beardyn_core.study.fitting_bearing import bearing_search, search_in_files, search_in_run

    problems = option_problems(args) + misplaced_options(args, recorded)
    search = collect_problems(problems, lambda: bearing_search(chosen_entries(args)))
    if recorded:
        recording = collect_problems(problems, lambda: _recording_of(args))
        if problems or search is None or recording is None:
            raise InputError(problems)
        if recording.problem:
            print(f"beardyn: warning: {recording.problem}; compared is what is there", file=sys.stderr)
        found = search_in_run(recording, search)
    else:
        measured = collect_problems(problems, lambda: _survey_of(args))
        if problems or search is None or measured is None:
            raise InputError(problems)
        warnings: list[str] = []
        found = search_in_files(measured, search, warnings=warnings)
        for sentence in (*measured.warnings, *warnings):
            print(f"beardyn: warning: {sentence}", file=sys.stderr)
    if args.json:
        print(json_text("monitor", {"files": args.files, "which_bearing": _object(found)}))
    else:
        fewer = found.answer == SEVERAL and not size_options(args)
        print("\n".join(_lines(found)) + ("; --bore-mm and --outside-mm leave fewer" if fewer else ""))
    return 0


def _recording_of(args: argparse.Namespace) -> Run:
    """Read the one axlebox that is compared."""
    from beardyn_core.record.reading import read_run

    path = args.files[0]
    recording = read_run(path, args.box)
    if not args.box and len(recording.boxes) > 1:
        raise InputError(
            f"{path}: has {len(recording.boxes)} axleboxes, and --which-bearing compares the vibration of "
            f"one; give --box with one of {', '.join(recording.boxes)}"
        )
    return recording


def _survey_of(args: argparse.Namespace) -> Survey:
    """Read the measured files for the first time; they must have a speed."""
    from beardyn_core.measured.survey import survey

    measured = survey(args.files, reading_of(args), needs_speed=True)
    if not measured.has_speed:
        raise InputError(
            f"{args.files[0]}: --which-bearing needs the speed of the shaft, and --speed-range-rpm finds "
            "it only with the bearing; give one of --speed-rpm, --speed-kmh, --speed-channel, "
            "--tacho-channel"
        )
    return measured


def option_problems(args: argparse.Namespace) -> list[str]:
    """List the options of a monitor that a search would leave aside."""
    compared = "compares those of the catalogue"
    given = {
        "--bearing": (args.bearing, compared),
        **dict.fromkeys(plate_options(args), (True, compared)),
        "--neighbour": (args.neighbour, compared),
        "--monitor": (args.monitor, "uses the reference chain"),
        "--picture": (args.picture, "gives no verdict that could be drawn"),
        "--speed-uncertainty": (
            args.speed_uncertainty is not None,
            "takes that of the way the speed is known",
        ),
        "--warm": (args.warm is not None, "judges no temperature"),
        "--hot": (args.hot is not None, "judges no temperature"),
        "--force": (args.force, "writes no picture"),
        "--memory": (args.memory, "watches no trend"),
    }
    return [
        f"{option}: --which-bearing {why}; leave one of both out"
        for option, (value, why) in given.items()
        if value
    ]


def _object(found: BearingSearchResult) -> dict[str, Any]:
    whole = keyed_fields(found)
    whole["speeds"] = [keyed_fields(each) for each in found.speeds]
    whole["fits"] = [
        {
            "bearing": fit.name,
            "share": fit.share,
            "largest_deviation": fit.deviation,
            "parts": [{**keyed_fields(each), "deviation": each.deviation} for each in fit.parts],
        }
        for fit in found.fits
    ]
    return whole


def _lines(found: BearingSearchResult) -> list[str]:
    from beardyn_core.config.catalogue import find_bearing

    lines = []
    for fit in found.fits[:_SHOWN]:
        entry = find_bearing(fit.name)
        parts = ", ".join(
            f"{each.part} {each.expected_order:.3f} ({100.0 * each.deviation:+.2f} %)" for each in fit.parts
        )
        lines.append(f"  {fit.name:14} {parts:28} {size_text(entry):22} {entry.kind}")
    if len(found.fits) > _SHOWN:
        lines.append(f"  ... and {len(found.fits) - _SHOWN} more; --json lists all")
    return [*lines, f"{found.answer}: {found.reason}"]

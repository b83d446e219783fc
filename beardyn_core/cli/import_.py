"""``beardyn import``: measured files as a recording."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api.measuring import import_measured
from beardyn_core.base.errors import InputError, collect_problems
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.outputs import recording_problems
from beardyn_core.cli.catalogue_line import catalogue_sentence
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import add_plates, add_reading, mounted_of, reading_of
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from beardyn_core.measured.writing import Imported


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    more = "Prints how a file was understood. `beardyn report`, `monitor` and `export` read the recording."
    parser = add_command(subparsers, "import", import_measured, more)
    add_parameter(parser, import_measured, "files", "files", nargs="+", metavar="FILE")
    add_parameter(parser, import_measured, "recording", "-o", "--output", metavar="run.mcap", required=True)
    add_parameter(parser, import_measured, "force")
    add_json(parser)
    add_plates(parser, "default none; they are kept in the recording")
    add_reading(parser)
    # of the monitor: who asks for it here is directed there
    parser.add_argument("--which-bearing", action="store_true", help=argparse.SUPPRESS)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from tqdm import tqdm

    from beardyn_core.measured.found_speed import with_found_speed
    from beardyn_core.measured.survey import survey
    from beardyn_core.measured.writing import write_measured

    problems = recording_problems("--output", args.output, inputs=args.files, force=args.force)
    if args.which_bearing:
        problems.append(
            "--which-bearing: is an option of `beardyn monitor`, which reads measured files and recordings: "
            f"`beardyn monitor {args.files[0]} --which-bearing`; import without it, or with the bearing that "
            "it names as --bearing"
        )
    reading = collect_problems(problems, lambda: reading_of(args))
    bearings = collect_problems(problems, lambda: mounted_of(args))
    if reading is None or bearings is None:
        raise InputError(problems)
    try:
        measured = with_found_speed(survey(args.files, reading), bearings)
        problems += sensor_problems(measured.sensors, bearings)
    except InputError as error:
        problems += error.problems
    if problems:
        raise InputError(problems)
    for sentence in measured.warnings:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    until = [0.0]
    layout = "{desc} {bar} {n:.2f}/{total:.2f} s [{elapsed}<{remaining}]"
    with tqdm(total=measured.duration, desc="imported", bar_format=layout, disable=None, leave=False) as bar:

        def progress(seconds: float) -> None:
            bar.update(seconds - until[0])
            until[0] = seconds

        with last_words(lambda: _kept(args.output, until[0])):
            made = write_measured(measured, args.output, bearings, force=args.force, progress=progress)
    for sentence in made.warnings:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    if args.json:
        print(json_text("import", json_object(made)))
        return 0
    taken = [catalogue_sentence(each.entry) for each in bearings if each.entry is not None]
    for sentence in (*measured.told, *taken):
        print(sentence)
    print(f"{made.path}: {made.duration:.6g} s, {made.path.stat().st_size / 1e6:.2f} MB")
    return 0


def sensor_problems(sensors: tuple[str, ...], bearings: Any) -> list[str]:
    """Find bearings that are assigned to a sensor that is not there."""
    return [
        f"--bearing {each.label}: there is no sensor {each.sensor!r}; there is {', '.join(sensors)}"
        for each in bearings
        if each.sensor and each.sensor not in sensors
    ]


def json_object(made: Imported) -> dict[str, Any]:
    """Gather what ``--json`` prints."""
    survey = made.survey
    return {
        "recording": made.path,
        "files": [each.chosen.path for each in survey.files],
        "duration_s": made.duration,
        "sensor_rate_Hz": {name: survey.rate(name) for name in survey.sensors},
        "understood": survey.told,
        "warnings": [*survey.warnings, *made.warnings],
    }


def _kept(path: Path, seconds: float) -> str:
    if not seconds:
        return f"{path} holds nothing yet" if path.exists() else "nothing has been written"
    return f"{path} holds the measurement until {seconds:.2f} s, and is closed and readable"

"""The files of a command through a monitor: a recording of the twin, or measured files."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError, collect_problems
from beardyn_core.cli.measured_options import reading_of, reading_options
from beardyn_core.cli.monitor_settings import settings_of

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.measured.about import Mounted
    from beardyn_core.monitor.chain import Algorithm
    from beardyn_core.record.run import Run
    from beardyn_core.study.inspection import Inspection


def is_recorded(args: argparse.Namespace) -> bool:
    """Tell whether the one file is a recording of an axlebox, of which no part is to be taken by channels."""
    from beardyn_core.record.other_messages import is_recording

    path, options = Path(args.files[0]), reading_options(args)
    if len(args.files) > 1 or "--channels" in options:
        return False
    if not options:
        return is_recording(path)
    # a folder, or a file that there is not, may be of another tool
    files = path.glob("*.mcap") if path.is_dir() else (path,)
    return any(each.is_file() and is_recording(each) for each in files)


def inspect_files(
    args: argparse.Namespace,
    algorithm: Algorithm | None,
    bearings: tuple[Mounted, ...] | None,
    problems: list[str],
    *,
    recorded: bool,
) -> list[Inspection]:
    """Let a monitor judge every bearing of the files, of the axlebox that is asked for or of all.

    Parameters
    ----------
    algorithm, bearings : optional
        As the options say; ``None`` where they are wrong.
    problems : list of str
        Found before.
    recorded : bool
        What `is_recorded` says.

    Raises
    ------
    InputError
        With the problems found before, and those of the files.
    """
    inspect = _inspect_recording if recorded else _inspect_measured_files
    return inspect(args, algorithm, bearings, problems)


def _inspect_recording(
    args: argparse.Namespace,
    algorithm: Algorithm | None,
    bearings: tuple[Mounted, ...] | None,
    problems: list[str],
) -> list[Inspection]:
    """Let the monitor analyse a recording, every axlebox of it or the one that is asked for."""
    from beardyn_core.record.reading import read_run
    from beardyn_core.study.inspection import inspect_boxes

    recording = collect_problems(problems, lambda: read_run(args.files[0], args.box))
    if problems or algorithm is None or bearings is None or recording is None:
        raise InputError(problems)
    if recording.problem:
        print(f"beardyn: warning: {recording.problem}; monitored is what is there", file=sys.stderr)
    return inspect_boxes(
        recording, lambda run: _inspect_box(args, run, algorithm, bearings), alone=bool(args.box)
    )


def _inspect_box(
    args: argparse.Namespace, recording: Run, algorithm: Algorithm, bearings: tuple[Mounted, ...]
) -> list[Inspection]:
    """Let the monitor analyse the signals of one axlebox."""
    from beardyn_core.measured.stated_speed import recorded_uncertainty
    from beardyn_core.study.inspection import inspect_run, recorded_plate

    recorded = recorded_plate(recording, lenient=True) if bearings else None
    for each in bearings if recorded is not None else ():
        assert recorded is not None
        if doubt := other_bearing(each.plate, recorded):
            print(f"beardyn: warning: --bearing {each.plate.name}: {doubt}", file=sys.stderr)
    settings = settings_of(args, recorded_uncertainty(recording.measured))
    return inspect_run(recording, bearings, algorithm, settings)


def _inspect_measured_files(
    args: argparse.Namespace,
    algorithm: Algorithm | None,
    bearings: tuple[Mounted, ...] | None,
    problems: list[str],
) -> list[Inspection]:
    """Let the monitor analyse measured files, block by block.

    Raises
    ------
    InputError
        With the problems found before, and those of the files.
    """
    from beardyn_core.cli.import_ import sensor_problems
    from beardyn_core.measured.found_speed import with_found_speed
    from beardyn_core.measured.stated_speed import uncertainty_of
    from beardyn_core.measured.survey import survey
    from beardyn_core.study.inspection import inspect_measured

    if bearings == ():
        numbers = "--roller-count, --roller-diameter-mm, --pitch-diameter-mm"
        problems.append(
            f"{args.files[0]}: does not name its bearing; give --bearing, or {numbers}, or "
            "--bpfo, --bpfi, --bsf, --ftf; --which-bearing compares the catalogue"
        )
    bearings = bearings or ()
    try:
        measured = survey(args.files, reading_of(args), needs_speed=True)
        measured = with_found_speed(measured, bearings) if not problems else measured
        problems += sensor_problems(measured.sensors, bearings)
    except InputError as error:
        problems += error.problems
    if problems or algorithm is None:
        raise InputError(problems)
    told = [*(f"warning: {each}" for each in measured.warnings), *measured.told]
    for sentence in told:
        print(f"beardyn: {sentence}", file=sys.stderr)
    warnings: list[str] = []
    settings = settings_of(args, uncertainty_of(measured))
    found = inspect_measured(measured, bearings, algorithm, settings, warnings)
    for sentence in warnings:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    return found


def other_bearing(given: Bearing | NamePlate, recorded: Bearing | NamePlate) -> str:
    """Say how a bearing differs from the recorded one for a monitor; empty when it does not."""
    from dataclasses import astuple

    one, other = given.frequencies, recorded.frequencies
    if astuple(one) == astuple(other) and given.roller_count == recorded.roller_count:
        return ""
    return (
        f"the recording is of {recorded.name}, {recorded.roller_count} rollers in a row, BPFO "
        f"{other.bpfo:.4f} and BPFI {other.bpfi:.4f} per revolution; searched for is what {given.name} would "
        f"show, {given.roller_count} rollers, {one.bpfo:.4f} and {one.bpfi:.4f}"
    )

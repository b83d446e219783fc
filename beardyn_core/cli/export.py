"""``beardyn export``: signals of a recording for other programs."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.api import exporting
from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.cli.generated_parser import add_command, add_parameter, names
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from beardyn_core.record.run import Run

_VIBRATION_ALONE = (".parquet", ".csv", ".wav")  # what these hold without being asked


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(subparsers, "export", exporting.export)
    add_parameter(parser, exporting.export, "recording", "recording", metavar="run.mcap")
    add_parameter(parser, exporting.export, "output", "-o", "--output", metavar="FILE", required=True)
    add_parameter(
        parser,
        exporting.export,
        "signals",
        metavar="NAMES",
        type=str,
        default=None,
        suffix="; with commas between",
    )
    add_parameter(parser, exporting.export, "box", metavar="NAME")
    add_parameter(parser, exporting.export, "force")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command and return the exit code."""
    import sys

    signals = _signals_of(args)
    if exporting.is_set(args.recording):
        with last_words(lambda: "nothing has been written"):
            return _tell(
                args, exporting.export(args.recording, args.output, signals=signals, force=args.force)
            )
    from beardyn_core.record.reading import read_run

    with last_words(lambda: "nothing has been written"):
        recording = read_run(args.recording, args.box)
    if recording.problem:
        print(f"{recording.problem}; writing what is there", file=sys.stderr)
    if problem := _lacking(recording, signals, args.output):
        raise InputError(problem)
    with last_words(lambda: "files that are written are whole, the others are as they were"):
        written = exporting.export(recording, args.output, signals=signals, force=args.force)
    return _tell(args, written)


def _tell(args: argparse.Namespace, written: list[Path]) -> int:
    """Print what has been written; gives the exit code."""
    if args.json:
        print(json_text("export", {"recording": args.recording, "files": written}))
        return 0
    for path in written:
        print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")
    return 0


def _signals_of(args: argparse.Namespace) -> list[str]:
    """Split the names of the signals; none without the option."""
    given = names(args.signals) or []
    if not all(given):
        raise InputError(
            f"--signals {args.signals!r}: a name is empty; give names with commas between, or leave it out"
        )
    return given


def _lacking(recording: Run, signals: list[str], output: str) -> str:
    """Say which of the signals a recording has no samples of; empty when it has all."""
    from beardyn_core.record import tables
    from beardyn_core.record.exporting import KINDS

    ending = Path(output).suffix.lower()
    if ending not in (*(f".{kind}" for kind in KINDS), ".hdf5"):
        return ""  # it is reported with every name that is not known
    known = tables.signal_names(recording)

    def is_there(name: str) -> bool:
        return name in known and len(tables.signal_of(recording, name)) > 0

    if signals:
        lacking = [name for name in dict.fromkeys(signals) if not is_there(name)]
        told = f"--signals: {recording.label} has no {', no '.join(lacking)}"
    else:
        received = ending not in _VIBRATION_ALONE or any(
            is_there(name) for name in known if name.startswith(tables.VIBRATION)
        )
        lacking = [] if received else [tables.VIBRATION]
        told = f"{recording.label}: has no vibration; give --signals"
    if not lacking:
        return ""
    return f"{told}; it has {', '.join(filter(is_there, known)) or 'nothing'}"

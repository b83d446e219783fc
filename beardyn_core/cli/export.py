"""``beardyn export``: signals of a recording for other programs."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.cli.generated_parser import names
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_force, add_json

if TYPE_CHECKING:
    from beardyn_core.record.run import Run

_VIBRATION_ALONE = (".parquet", ".csv", ".wav")  # what these hold without being asked


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "export",
        help="write signals of a recording as Parquet, CSV, NPZ, HDF5 or WAV",
        description="Write signals of a recording to a file of another format, SI units. Parquet, NPZ "
        "and HDF5 carry the truth of the run; CSV and WAV get a JSON file with it beside them. Parquet, CSV "
        "and WAV hold one table: with several signals each goes to NAME_SIGNAL.ENDING. A set of runs that "
        "`beardyn sweep` has made goes to one file, .h5, .npz or .parquet, with signals and labels.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to read, or folder of a set")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=True,
        help="file to write; its ending is the format: .parquet, .csv, .npz, .h5 or .wav; no default",
    )
    parser.add_argument(
        "--signals",
        metavar="NAMES",
        help="signals, with commas between: vibration, force, force_waveform, shaft, torque, cages, "
        "rollers, bodies, contacts, load, temperature, ...; default every vibration, for .npz and .h5 all",
    )
    add_box(parser)
    add_force(parser)
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command and return the exit code."""
    import sys

    signals = _signals_of(args)
    if Path(args.recording).is_dir() and (Path(args.recording) / "set.json").is_file():
        return _export_set(args, signals)
    from beardyn_core.record.exporting import export
    from beardyn_core.record.reading import read_run

    with last_words(lambda: "nothing has been written"):
        recording = read_run(args.recording, args.box)
    if recording.problem:
        print(f"{recording.problem}; writing what is there", file=sys.stderr)
    if problem := _lacking(recording, signals, args.output):
        raise InputError(problem)
    with last_words(lambda: "files that are written are whole, the others are as they were"):
        written = export(recording, args.output, signals=signals, force=args.force)
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
        return ""  # it is told with every name that is not known
    known = tables.signal_names(recording)

    def is_there(name: str) -> bool:
        return name in known and len(tables.signal_of(recording, name)) > 0

    if signals:
        lacking = [name for name in dict.fromkeys(signals) if not is_there(name)]
        told = f"--signals: {recording.label} has no {', no '.join(lacking)}"
    else:
        heard = ending not in _VIBRATION_ALONE or any(
            is_there(name) for name in known if name.startswith(tables.VIBRATION)
        )
        lacking = [] if heard else [tables.VIBRATION]
        told = f"{recording.label}: has no vibration; give --signals"
    if not lacking:
        return ""
    return f"{told}; it has {', '.join(filter(is_there, known)) or 'nothing'}"


def _export_set(args: argparse.Namespace, signals: list[str]) -> int:
    """Write a set of runs to one file."""
    from beardyn_core.population.exporting import export_set
    from beardyn_core.population.labelled_set import LabelledSet

    with last_words(lambda: "nothing has been written"):
        written = export_set(LabelledSet(args.recording), args.output, signals, args.force)
    if args.json:
        print(json_text("export", {"recording": args.recording, "files": written}))
        return 0
    for path in written:
        print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")
    return 0

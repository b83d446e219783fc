"""``beardyn export``: signals of a recording for other programs."""

from __future__ import annotations

import argparse

from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_force, add_json
from beardyn_core.interrupts import last_words


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "export",
        help="write signals of a recording as Parquet, CSV, NPZ, HDF5 or WAV",
        description="Write signals of a recording to a file of another format, SI units. Parquet, NPZ "
        "and HDF5 carry the truth of the run; CSV and WAV get a JSON file with it beside them. Parquet, CSV "
        "and WAV hold one table: with several signals each goes to NAME_SIGNAL.ENDING.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to read")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=True,
        help="file to write, without default; its ending is the format: .parquet, .csv, .npz, .h5 or .wav",
    )
    parser.add_argument(
        "--signals",
        metavar="NAMES",
        default="",
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

    from beardyn_core.record.exporting import export
    from beardyn_core.record.reading import read_run

    with last_words(lambda: "nothing has been written"):
        recording = read_run(args.recording, args.box)
    if recording.problem:
        print(f"{recording.problem}; writing what is there", file=sys.stderr)
    names = [name.strip() for name in args.signals.split(",") if name.strip()]
    with last_words(lambda: "files that are written are whole, the others are as they were"):
        written = export(recording, args.output, signals=names, force=args.force)
    if args.json:
        print(json_text("export", {"recording": args.recording, "files": written}))
        return 0
    for path in written:
        print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")
    return 0

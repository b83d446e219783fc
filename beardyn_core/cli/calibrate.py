"""``beardyn calibrate``: the scene of one measured axlebox, fitted to its healthy recordings."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems, files_read
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_force, add_json, names

if TYPE_CHECKING:
    from beardyn_core.api.calibrating import Calibration

_INTERRUPTED = 130


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "calibrate",
        help="fit a scene to healthy recordings of one axlebox, write the scene of that axlebox",
        description="Fit what no drawing tells of an axlebox (natural frequencies and damping of the box, "
        "background, noise of the accelerometer, end play) to recordings with a sound bearing: twins run at "
        "the speed of the recordings, and their spectra are compared. Writes the scene with the values that "
        "the recordings determine; what they do not is said and left. Needs the extra `calibrate`. Ctrl-C "
        "ends it with the best so far.",
    )
    parser.add_argument("recordings", metavar="run.mcap", nargs="+", help="healthy recordings of one axlebox")
    parser.add_argument(
        "--scene",
        metavar="SCENE",
        required=True,
        help="sound scene of such an axlebox: what is fitted begins there, the rest stays; no default",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE.yaml", type=Path, help="scene to write; default none, it is told only"
    )
    parser.add_argument(
        "--fit",
        metavar="NAMES",
        help="what is fitted, with commas between: frequency, damping, background, noise, end_play; default "
        "all that the scene has",
    )
    parser.add_argument(
        "--budget",
        metavar="N",
        type=int,
        default=80,
        help="runs of the twin at each speed of the recordings, of a second or more; at least 42, default 80",
    )
    parser.add_argument(
        "--tier",
        choices=("lumped", "quasistatic", "full"),
        default="quasistatic",
        help="of the twin; default quasistatic",
    )
    parser.add_argument(
        "--bearing", metavar="NAME", help="name plate of the bearing; default that of the recording"
    )
    parser.add_argument("--sensor", metavar="NAME", default="", help="accelerometer; default the first")
    add_box(parser)
    add_force(parser, "replace FILE.yaml when it exists; default refuse")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    if problems := option_problems(args):
        raise InputError(problems)
    from beardyn_core.api.calibrating import calibrate
    from beardyn_core.record.reading import read_run

    found = calibrate(
        [read_run(each, args.box) for each in args.recordings],
        args.scene,
        args.output,
        fit=names(args.fit),
        tier=args.tier,
        budget=args.budget,
        bearing=args.bearing,
        sensor=args.sensor,
        force=args.force,
        progress=True,
    )
    if args.json:
        content = {"recordings": args.recordings, "scene": args.output, **json_object(found)}
        print(json_text("calibrate", content))
    else:
        print("\n".join([*found.sentences, *([f"{args.output} written"] if args.output else [])]))
    return _INTERRUPTED if found.found.interrupted else 0


def option_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with scene and output, before recordings are read and effects are chosen."""
    from beardyn_core.config.load import read_scene

    problems: list[str] = []
    with files_read() as inputs:
        try:
            scene = read_scene(args.scene, {("tier",): args.tier}).scene
            if scene.faults:
                problems.append(
                    f"--scene {args.scene}: has a fault ({scene.fault_sentences[0]}); calibrate with the "
                    "sound scene"
                )
            if scene.axleboxes is not None:
                problems.append(f"--scene {args.scene}: has several axleboxes; give the scene of one")
        except InputError as error:
            problems += error.problems
    inputs += map(Path, args.recordings)
    return problems + file_problems("--output", args.output, inputs=inputs, force=args.force, ending=".yaml")


def json_object(found: Calibration) -> dict[str, Any]:
    """Give what `--json` prints of a calibration."""
    before, after = found.residuals
    return {
        "unknowns": [
            {
                "name": each.unknown.name,
                "unit": each.unknown.unit,
                "base": each.base,
                "value": each.value,
                "interval_90": each.interval,
                "share_of_range": each.share,
                "correlated_with": each.partner or None,
                "correlation": each.correlation,
                "reason": each.reason,
            }
            for each in found.fits
        ],
        "not_fitted": found.absent,
        "axes": found.hearing.axes,
        "frequency_Hz": found.hearing.middles,
        "shaft_frequency_Hz": found.speeds,
        "stretches": found.stretches,
        "residual_before_dB": before,
        "residual_after_dB": after,
        "difference_before_dB": found.found.before,
        "difference_after_dB": found.found.after,
        "tolerance_dB": found.found.tolerance,
        "twins": found.found.runs,
        "interrupted": found.found.interrupted,
    }

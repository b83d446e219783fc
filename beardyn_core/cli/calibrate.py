"""``beardyn calibrate``: the scene of one measured axlebox, fitted to its healthy recordings."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api import calibrating
from beardyn_core.api.estimating import estimate
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems, files_read
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_json

if TYPE_CHECKING:
    from beardyn_core.calibration.calibration_result import Calibration

_INTERRUPTED = 130


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    function = calibrating.calibrate
    parser = add_command(subparsers, "calibrate", function, "Ctrl-C ends it with the best so far.")
    add_parameter(parser, function, "runs", "recordings", metavar="run.mcap", nargs="+", type=str)
    add_parameter(parser, function, "scene", metavar="SCENE", required=True, type=str)
    add_parameter(parser, function, "output", "-o", "--output", metavar="FILE.yaml")
    add_parameter(parser, function, "fit", metavar="NAMES")
    add_parameter(parser, function, "budget", metavar="N")
    add_parameter(parser, function, "tier")
    add_parameter(parser, estimate, "bearing", metavar="NAME")
    add_parameter(parser, estimate, "sensor", metavar="NAME")
    add_box(parser)
    add_parameter(parser, function, "force")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    if problems := option_problems(args):
        raise InputError(problems)
    from beardyn_core.record.reading import read_run

    found = calibrating.calibrate(
        [read_run(each, args.box) for each in args.recordings],
        args.scene,
        args.output,
        fit=args.fit,
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
                    "healthy scene"
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
        "axes": found.reception.axes,
        "frequency_Hz": found.reception.middles,
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

"""``beardyn estimate``: load, end play and spall of a recording, each with an interval."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_json

if TYPE_CHECKING:
    from beardyn_core.follow.estimator import Estimates


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "estimate",
        help="estimate load, end play and spall of a recording, each with an interval",
        description="Estimate from vibration and shaft of a recording what no sensor measures: load, end "
        "play, temperature, which part is spalled and how wide, with intervals of 50 and 90 %; what is not "
        "identifiable is told. Measured files become a recording with `beardyn import`.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to estimate from")
    parser.add_argument(
        "--estimator",
        metavar="FILE.npz",
        type=Path,
        help="that `beardyn train` has made; default a shipped one for the bearing",
    )
    parser.add_argument(
        "--bearing", metavar="NAME", help="name plate of the bearing; default that of the recording"
    )
    parser.add_argument("--sensor", metavar="NAME", default="", help="accelerometer; default the first")
    add_box(parser)
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.api.estimating import estimate
    from beardyn_core.record.reading import read_run

    found = estimate(
        read_run(args.recording, args.box), args.estimator, bearing=args.bearing, sensor=args.sensor
    )
    if args.json:
        print(json_text("estimate", {"recording": args.recording, **json_object(found)}))
    else:
        print("\n".join(found.sentences))
    return 0


def json_object(found: Estimates) -> dict[str, Any]:
    """Give what `--json` prints of the estimates."""
    from beardyn_core.follow.regression import LEVELS

    names = [f"{100 * level:.0f}" for level in LEVELS]
    part = found.part
    return {
        "condition": None
        if part is None
        else {
            "name": part.condition,
            "probability": part.probability,
            **{f"set_{name}": each for name, each in zip(names, part.sets, strict=True)},
        },
        "estimates": {
            f"{each.quantity.name}_{each.quantity.unit}": {
                "value": each.value,
                **{
                    f"interval_{name}": each.intervals[k] if each.intervals else None
                    for k, name in enumerate(names)
                },
                "reason": each.reason,
            }
            for each in found.quantities
        },
        "strangeness": found.strangeness,
        "stretches": found.stretches,
    }

"""``beardyn follow``: one bearing over its recordings, stretch by stretch."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.cli.estimate import add_hearing, add_service, service_of
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_json
from beardyn_core.errors import InputError

if TYPE_CHECKING:
    pass


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "follow",
        help="follow load, end play and spall of a bearing over its recordings",
        description="Follow one bearing over its recordings in the order of time: a filter puts together "
        "what every stretch says of load, end play and spall, lets loads wander and spalls grow, and says "
        "what it does not explain. Prints a line for every stretch, and what remains.",
    )
    parser.add_argument(
        "recordings", metavar="run.mcap", nargs="+", help="recordings of one axlebox, in the order of time"
    )
    add_hearing(parser)
    add_box(parser)
    parser.add_argument(
        "--at-km",
        metavar="KM",
        type=float,
        nargs="+",
        help="mileage at the begin of every recording; default each goes on where the one before ended",
    )
    parser.add_argument(
        "--twin",
        metavar="SCENE",
        help="sound scene of this axlebox on its track: runs at the state that is known at the end, and its "
        "third octaves are compared with those heard; default no twin",
    )
    parser.add_argument(
        "--tier",
        choices=("lumped", "quasistatic"),
        default="quasistatic",
        help="of the twin; default quasistatic",
    )
    add_service(parser)
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from dataclasses import replace
    from itertools import pairwise

    from beardyn_core.api.following import follow
    from beardyn_core.follow.forecast import Service
    from beardyn_core.follow.told import residual_object, step_object
    from beardyn_core.record.reading import read_run

    service, law = service_of(args)
    if args.at_km is not None and len(args.at_km) != len(args.recordings):
        raise InputError(
            f"--at-km: has {len(args.at_km)} numbers for {len(args.recordings)} recordings; give one for each"
        )
    for before, after in pairwise(args.at_km or ()):
        if after < before:
            raise InputError(f"--at-km: {after:g} comes after {before:g}; give mileages in the order of time")
    service = service or Service(wheel_diameter=1e-3 * args.wheel_diameter_mm)
    since = None
    if args.at_km is not None:
        since = [1e3 * (each - args.at_km[0]) for each in args.at_km]
        service = replace(service, mileage=1e3 * args.at_km[0])
    found = follow(
        [read_run(each, args.box) for each in args.recordings],
        args.estimator,
        bearing=args.bearing,
        sensor=args.sensor,
        service=service,
        mileages=since,
        law=law,
        lubricant=args.lubricant,
        twin=None if args.twin is None else Path(args.twin),
        tier=args.tier,
    )
    if args.json:
        content = {
            "recordings": args.recordings,
            "steps": [step_object(each) for each in found.steps],
            "residual": None if found.residual is None else residual_object(found.residual),
        }
        print(json_text("follow", content))
    else:
        print("\n".join(found.sentences))
    return 0

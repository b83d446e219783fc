"""``beardyn follow``: one bearing over its recordings, stretch by stretch."""

from __future__ import annotations

import argparse

from beardyn_core.api import following
from beardyn_core.base.errors import InputError
from beardyn_core.cli.estimate import (
    add_load,
    add_reception,
    add_service,
    assumptions_of,
    in_words_of_options,
    service_of,
)
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_json


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    more = "Prints a line for every stretch, and what remains."
    parser = add_command(subparsers, "follow", following.follow, more)
    add_parameter(parser, following.follow, "runs", "recordings", metavar="run.mcap", nargs="+", type=str)
    add_reception(parser)
    add_box(parser)
    parser.add_argument(
        "--at-km",
        metavar="KM",
        type=float,
        nargs="+",
        help="mileage at the begin of every recording; default each goes on where the one before ended",
    )
    add_parameter(parser, following.follow, "twin", metavar="SCENE")
    add_parameter(parser, following.follow, "tier")
    add_load(parser, following.follow, "several")
    add_service(parser, "what remains", "at the first recording, in place of --at-km; default 0")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from itertools import pairwise

    from beardyn_core.follow.estimate_json import lasting_object, residual_object, step_object
    from beardyn_core.record.reading import read_run

    at_km = args.at_km or []
    if at_km and args.mileage_km is not None:
        raise InputError(
            "--at-km, --mileage-km: both give the mileage at the first recording; give one of them"
        )
    if at_km and len(at_km) != len(args.recordings):
        raise InputError(
            f"--at-km: has {len(at_km)} numbers for {len(args.recordings)} recordings; give one for each"
        )
    if at_km and at_km[0] < 0.0:
        raise InputError(f"--at-km: is {at_km[0]:g}; it must be at least 0")
    for before, after in pairwise(at_km):
        if after < before:
            raise InputError(f"--at-km: {after:g} comes after {before:g}; give mileages in the order of time")
    service, law = service_of(args, at_km[0] if at_km else args.mileage_km or 0.0)
    warm, assumptions = assumptions_of(args)
    with in_words_of_options():
        found = following.follow(
            [read_run(each, args.box) for each in args.recordings],
            args.estimator,
            bearing=args.bearing,
            sensor=args.sensor,
            service=service,
            mileages=[1e3 * (each - at_km[0]) for each in at_km] or None,
            law=law,
            lubricant=args.lubricant,
            twin=args.twin,
            tier=args.tier,
            load_kn=args.load_kn,
            load_sensor=args.load_sensor or (),
            axle_load_t=args.axle_load_t,
            temperature_C=warm,
            assumptions=assumptions,
        )
    if args.json:
        content = {
            "recordings": args.recordings,
            "steps": [step_object(each) for each in found.steps],
            "mountings": [lasting_object(each) for each in found.mountings],
            "residual": None if found.residual is None else residual_object(found.residual),
        }
        print(json_text("follow", content))
    else:
        print("\n".join(found.sentences))
    return 0

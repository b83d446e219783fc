"""``beardyn estimate``: load, end play and spall of a recording, each with an interval."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_box, add_json

if TYPE_CHECKING:
    from beardyn_core.follow.estimator import Estimates
    from beardyn_core.follow.forecast import Forecast, Service
    from beardyn_core.follow.growth import GrowthLaw
    from beardyn_core.record.run import Run


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "estimate",
        help="estimate load, end play and spall of a recording, each with an interval",
        description="Estimate from vibration and shaft of a recording what no sensor measures: load, end "
        "play, which part is spalled and how wide, with intervals of 50 and 90 %; what is not identifiable "
        "is told (with the shipped estimators vertical load and temperature). Measured files become a "
        "recording with `beardyn import`.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to estimate from")
    add_hearing(parser)
    add_box(parser)
    add_service(parser, "what remains, with --mileage-km", "so far; default no forecast")
    add_json(parser)
    parser.set_defaults(run=run)


def add_hearing(parser: argparse.ArgumentParser) -> None:
    """Declare what is heard, and by which estimator."""
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


def add_service(parser: argparse.ArgumentParser, about: str, mileage: str) -> None:
    """Declare what a forecast must be told; `about` it and its `mileage` in words."""
    group = parser.add_argument_group("forecast", about)
    group.add_argument("--mileage-km", metavar="KM", type=float, help=mileage)
    group.add_argument(
        "--wheel-diameter-mm", metavar="MM", type=float, default=920.0, help="running diameter; default 920"
    )
    group.add_argument(
        "--widest-mm",
        metavar="MM",
        type=float,
        help="width of a spall at which the bearing is taken out; default 20 mm, or the distance of two "
        "rollers where that is less",
    )
    group.add_argument(
        "--growth-mm2",
        metavar="MM2",
        type=float,
        default=100.0,
        help="growth of a spall in 1000 km, mm2, beyond 250 mm2, median of the fleet; default 100, assumed",
    )
    group.add_argument("--lubricant", metavar="NAME", default="L055", help="of the rating life; default L055")


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.api.estimating import estimate
    from beardyn_core.follow.estimate_json import estimates_object, forecast_object
    from beardyn_core.record.reading import read_run

    service, law = service_of(args, args.mileage_km or 0.0)
    heard = read_run(args.recording, args.box)
    found = estimate(heard, args.estimator, bearing=args.bearing, sensor=args.sensor)
    remains = None if args.mileage_km is None else _forecast(args, heard, found, service, law)
    if args.json:
        content = {"recording": args.recording, **estimates_object(found)}
        content["forecast"] = (
            None if remains is None else {"mileage_m": args.mileage_km * 1e3, **forecast_object(remains)}
        )
        print(json_text("estimate", content))
    else:
        print("\n".join([*found.sentences, *([] if remains is None else remains.sentences)]))
    return 0


def service_of(args: argparse.Namespace, mileage_km: float) -> tuple[Service, GrowthLaw]:
    """Read the options of the forecast, at a mileage."""
    from beardyn_core.follow.forecast import Service
    from beardyn_core.follow.growth import GrowthLaw

    wheel = 1e-3 * args.wheel_diameter_mm
    wrong = [
        f"--{name}: is {value:g}; it must be {least} 0"
        for name, value, least, right in (
            ("mileage-km", args.mileage_km, "at least", args.mileage_km is None or args.mileage_km >= 0.0),
            ("wheel-diameter-mm", args.wheel_diameter_mm, "above", wheel > 0.0),
            ("widest-mm", args.widest_mm, "above", args.widest_mm is None or args.widest_mm > 0.0),
            ("growth-mm2", args.growth_mm2, "above", args.growth_mm2 > 0.0),
        )
        if not right
    ]
    if wrong:
        raise InputError(wrong)
    widest = None if args.widest_mm is None else 1e-3 * args.widest_mm
    return Service(1e3 * mileage_km, wheel, widest), GrowthLaw(rate=args.growth_mm2 * 1e-12)


def _forecast(
    args: argparse.Namespace, heard: Run, found: Estimates, service: Service, law: GrowthLaw
) -> Forecast:
    """Forecast what remains of the bearing of the recording, or of the one that is named."""
    from beardyn_core.api.estimating import forecast

    return forecast(found, heard, service, law, bearing=args.bearing, lubricant=args.lubricant)

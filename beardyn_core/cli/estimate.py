"""``beardyn estimate``: load, end play and spall of a recording, each with an interval."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from beardyn_core.api import estimating
from beardyn_core.base.edge import places
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.cli.generated_parser import add_command, add_field, add_parameter, flag
from beardyn_core.cli.growth_option import add_growth, growth_of, growth_problems
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import in_options
from beardyn_core.cli.options import add_box, add_json
from beardyn_core.follow.life_assumptions import LifeAssumptions
from beardyn_core.follow.service import Service

if TYPE_CHECKING:
    from beardyn_core.follow.growth import GrowthLaw


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    more = "Measured files become a recording with `beardyn import`."
    parser = add_command(subparsers, "estimate", estimating.estimate, more)
    add_parameter(parser, estimating.estimate, "run", "recording", metavar="run.mcap", type=str)
    add_reception(parser)
    add_box(parser)
    add_load(parser, estimating.estimate, "")
    add_service(parser, "what remains, with --mileage-km", "so far; default no forecast")
    add_json(parser)
    parser.set_defaults(run=run)


def add_reception(parser: argparse.ArgumentParser) -> None:
    """Declare what is read, and by which estimator."""
    add_parameter(parser, estimating.estimate, "estimator", metavar="FILE.npz")
    add_parameter(parser, estimating.estimate, "bearing", metavar="NAME")
    add_parameter(parser, estimating.estimate, "sensor", metavar="NAME")


def add_load(parser: argparse.ArgumentParser, function: Callable[..., Any], several: str) -> None:
    """Declare a vertical load that is known, and what its rating life takes; `several`: of one number."""
    group = parser.add_argument_group("known load", "vertical load on this journal, for the rating life")
    add_parameter(
        group, function, "load_kn", metavar="VALUE[:UNCERTAINTY]", type=str, nargs="+" if several else None
    )
    add_parameter(
        group,
        function,
        "load_sensor",
        metavar="SENSOR",
        type=str,
        action="append",
        default=None,
        usual="none",
    )
    add_parameter(group, estimating.estimate, "axle_load_t", metavar="EMPTY:FULL")
    for place in (each for each in places(LifeAssumptions) if each.field in ("temperature", "contamination")):
        low, high = (place.at.scale.to_edge(each) for each in place.default)
        group.add_argument(
            flag(place.key),
            metavar="LOW:HIGH",
            help=f"{place.words}; ends of 90 %%; default {low:g}:{high:g}, assumed",
        )


def assumptions_of(
    args: argparse.Namespace,
) -> tuple[tuple[float, float] | None, LifeAssumptions]:
    """Read what the rating life takes: the temperature that is stated [degrees Celsius], and what is assumed.

    Raises
    ------
    InputError
        With every mistake.
    """
    found: dict[str, tuple[float, float] | None] = {}
    wrong = []
    for name in ("temperature_C", "contamination"):
        text = getattr(args, name.lower())
        found[name] = None
        if text is None:
            continue
        try:
            low, high = (float(each) for each in text.split(":"))
        except ValueError:
            low, high = 1.0, 0.0
        if low <= high:
            found[name] = low, high
        else:
            wrong.append(f"{flag(name)}: is {text!r}; write LOW:HIGH, two numbers in rising order")
    if wrong:
        raise InputError(wrong)
    given: dict[str, Any] = {}
    if (clean := found["contamination"]) is not None:
        given["contamination"] = clean
    if (warm := found["temperature_C"]) is not None:
        given["temperature"] = (warm[0] + ZERO_CELSIUS, warm[1] + ZERO_CELSIUS)
    try:
        return warm, LifeAssumptions(**given)
    except InputError as error:
        raise InputError([in_options(each, list(found)) for each in error.problems]) from None


def add_service(parser: argparse.ArgumentParser, about: str, mileage: str) -> None:
    """Declare what a forecast needs to know; `about` it and its `mileage` in words."""
    group = parser.add_argument_group("forecast", about)
    group.add_argument("--mileage-km", metavar="KM", type=float, help=mileage)
    for place in places(Service)[1:]:
        add_field(group, place)
    add_growth(group)
    add_parameter(group, estimating.forecast, "lubricant", metavar="NAME")


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.follow.estimate_json import estimates_object, forecast_object
    from beardyn_core.record.reading import read_run

    service, law = service_of(args, args.mileage_km or 0.0)
    warm, assumptions = assumptions_of(args)
    received = read_run(args.recording, args.box)
    with in_words_of_options():
        found = estimating.estimate(
            received, args.estimator, bearing=args.bearing, sensor=args.sensor, load_kn=args.load_kn,
            load_sensor=args.load_sensor or (), axle_load_t=args.axle_load_t,
            wheel_diameter=service.wheel_diameter,
        )  # fmt: skip
    wanted = args.mileage_km is not None or found.known_load is not None
    remains = (
        estimating.forecast(
            found, received, service, law, bearing=args.bearing, lubricant=args.lubricant, temperature_C=warm,
            assumptions=assumptions,
        )
        if wanted
        else None
    )  # fmt: skip
    if args.json:
        content = {"recording": args.recording, **estimates_object(found)}
        content["forecast"] = (
            None if remains is None else {"mileage_m": service.mileage, **forecast_object(remains)}
        )
        print(json_text("estimate", content))
    else:
        print("\n".join([*found.sentences, *([] if remains is None else remains.sentences)]))
    return 0


def service_of(args: argparse.Namespace, mileage_km: float) -> tuple[Service, GrowthLaw]:
    """Read the options of the forecast, at a mileage."""
    wrong = []
    if args.mileage_km is not None and not args.mileage_km >= 0.0:
        wrong.append(f"--mileage-km: is {args.mileage_km:g}; it must be at least 0")
    wrong += growth_problems(args)
    known = places(Service)[1:]
    given = {
        place.field: place.at.scale.to_si(value)
        for place in known
        if (value := getattr(args, place.key)) is not None
    }
    try:
        service = Service(0.0 if wrong else 1e3 * mileage_km, **given)
    except InputError as error:
        wrong += [
            in_options(each, [place.key for place in known]).removeprefix("service: ")
            for each in error.problems
        ]
    if wrong:
        raise InputError(wrong)
    return service, growth_of(args)


@contextmanager
def in_words_of_options() -> Iterator[None]:
    """Write parameters in the sentences of a mistake as the options that they are."""
    try:
        yield
    except InputError as error:
        keys = ["load_kn", "load_sensor", "axle_load_t"]
        raise InputError([in_options(each, keys) for each in error.problems]) from None

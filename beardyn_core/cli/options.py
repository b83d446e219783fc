"""Options that several commands have, with one wording."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from pathlib import Path
from typing import Any

from beardyn_core.api.simulating import simulate
from beardyn_core.cli.generated_parser import add_parameter, names

_LAST_PORT = 65_535


def add_choice(parser: ArgumentParser) -> None:
    """Add effects and tier, and what `auto` chooses them for; `gather_choices` reads them."""
    add_parameter(parser, simulate, "effects", metavar="NAME")
    add_parameter(parser, simulate, "tier", metavar="T")
    parser.add_argument(
        "--accuracy",
        metavar="PERCENT",
        type=float,
        help="accuracy that auto is chosen for, %%; default the scene's, or 5",
    )
    parser.add_argument(
        "--quantities",
        metavar="NAMES",
        help="quantities that the accuracy applies to, with commas between: force, deflection, "
        "roller_load, torque, vibration, cage_speed; default the scene's",
    )
    parser.add_argument(
        "--vibration-to",
        metavar="HZ",
        type=float,
        help="highest third octave of the vibration, Hz; default the scene's, or what its sensors measure",
    )


def gather_choices(args: Namespace) -> dict[str, Any]:
    """Gather the options of `add_choice` as `beardyn_core.choice.load_scene` takes them."""
    return {
        "effects": args.effects,
        "tier": args.tier,
        "accuracy_percent": args.accuracy,
        "quantities": names(args.quantities),
        "vibration_to": args.vibration_to,
    }


def add_box(parser: ArgumentParser, usual: str = "the first one") -> None:
    """Add the axlebox of a recording of several."""
    parser.add_argument(
        "--box",
        metavar="NAME",
        help=f"axlebox of a recording of several, such as axle_1_left; default {usual}",
    )


def add_monitor(parser: ArgumentParser) -> None:
    """Add the monitor of one's own."""
    parser.add_argument(
        "--monitor",
        metavar="MODULE:FUNCTION",
        default="",
        help="your algorithm, its module may be in this folder; default the reference chain",
    )


def add_force(parser: ArgumentParser, what: str = "replace files that exist; default refuse") -> None:
    """Add the permission to replace files."""
    parser.add_argument("--force", action="store_true", help=what)


def port(text: str) -> int:
    """Read the number of a port, as the ``type`` of an option."""
    if not text.strip().isdecimal() or not 1 <= int(text) <= _LAST_PORT:
        raise ArgumentTypeError(f"is {text!r}; it must be a whole number from 1 to {_LAST_PORT}")
    return int(text)


def add_tls(parser: ArgumentParser) -> None:
    """Add the files that a scheduler at tls:// is reached with; `tls_of` reads them."""
    for name, what in (("ca", "of the authority"), ("cert", "of this client"), ("key", "its private key")):
        parser.add_argument(
            f"--tls-{name}", metavar="FILE", type=Path, help=f"PEM file {what}, for tls://; default none"
        )


def tls_of(args: Namespace) -> dict[str, Path]:
    """Gather the files of `add_tls` that are given."""
    given = {"ca": args.tls_ca, "cert": args.tls_cert, "key": args.tls_key}
    return {name: path for name, path in given.items() if path is not None}


def add_verbose(parser: ArgumentParser, what: str) -> None:
    """Add the long answer."""
    parser.add_argument("--verbose", action="store_true", help=f"print more: {what}")


def add_json(parser: ArgumentParser) -> None:
    """Add the output for programs."""
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else, on stdout")

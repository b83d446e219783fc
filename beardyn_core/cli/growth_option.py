"""The option of the law of growth of spalls, and what it makes of it."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.follow.growth import GrowthLaw


def add_growth(parser: Any) -> None:
    """Declare the rate of growth."""
    parser.add_argument(
        "--growth-mm2",
        metavar="MM2",
        type=float,
        default=100.0,
        help="growth of a spall in 1000 km, mm2, beyond 250 mm2, median of the fleet; default 100, assumed",
    )


def growth_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with it."""
    return [] if args.growth_mm2 > 0.0 else [f"--growth-mm2: is {args.growth_mm2:g}; it must be above 0"]


def growth_of(args: argparse.Namespace) -> GrowthLaw:
    """Make the law.

    Raises
    ------
    InputError
        The rate is none.
    """
    from beardyn_core.follow.growth import GrowthLaw

    if problems := growth_problems(args):
        raise InputError(problems)
    return GrowthLaw(rate=args.growth_mm2 * 1e-12)

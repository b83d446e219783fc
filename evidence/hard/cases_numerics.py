"""Discretisation: laminae, time steps, hidden chatter."""

from __future__ import annotations

from typing import Any

from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, Status
from evidence.hard.case import HardCase, Limit, steady

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
CARRIED = (Limit("mean_force", 0.98 * 8e4, 1.01 * 8e4),)


def _numerics(**keys: int) -> dict[str, Any]:
    return {"numerics": keys}


_TOO_LARGE = tuple(
    HardCase(
        f"step_times_{factor}",
        "numerics",
        f"a step of {factor} times the usual one, {factor * 9.8:.0f} us: {what}",
        "chatter monitor, penetration and NaN bits: it must not pass as fine",
        run_as="coarse step",
        load=steady(RADIAL, SPEED),
        factor=float(factor),
        limits=(Limit("chatter_index", low=LARGEST_CHATTER_INDEX),) if bits == Status.CHATTER else (),
        must_report=bits,
        may_report=Status.CHATTER | Status.PENETRATION | Status.RIB_EDGE | Status.OFF_RIB,
        refined=False,
        fast=factor == 6,
    )
    for factor, bits, what in (
        (6, Status.CHATTER, "forces right to 0.6 %, friction flipping from step to step"),
        (7, Status.CHATTER | Status.NOT_FINITE, "friction at its limit in alternating directions, or worse"),
        (32, Status.NOT_FINITE, "everything blows up"),
    )
)

CASES = (
    HardCase(
        "one_lamina",
        "numerics",
        "one lamina holds no tilt: rollers topple within milliseconds",
        "refused by the configuration: full needs two laminae",
        run_as="refused scene",
        changes=_numerics(laminae=1),
        sentence="a single lamina holds no tilt",
        refined=False,
        fast=True,
    ),
    HardCase(
        "two_laminae",
        "numerics",
        "the fewest laminae that hold a tilt",
        "as above",
        changes=_numerics(laminae=2),
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
    HardCase(
        "forty_laminae",
        "numerics",
        "laminae of 1.25 mm: stiff edges, sums of many small terms",
        "the force law depends on the load per length, not on the number of laminae",
        changes=_numerics(laminae=40),
        load=steady(RADIAL, SPEED),
        duration=0.2,
        limits=CARRIED,
    ),
    HardCase(
        "forty_laminae_full",
        "numerics",
        "the same with coupled laminae and every effect",
        "as above",
        changes={"effects": "full", **_numerics(laminae=40)},
        load=steady(RADIAL, SPEED),
        duration=0.12,
        limits=(Limit("mean_force", 0.97 * 8e4, 1.02 * 8e4),),
    ),
    HardCase(
        "largest_step",
        "numerics",
        "39 us, the largest step a scene may ask for, at 150 kN and 180 rad/s",
        "converged, or the chatter monitor reports that it is not",
        changes=_numerics(steps_per_sample=1),
        load=steady((0.0, 0.0, 1.5e5), 180.0),
        duration=0.3,
        may_report=Status.CHATTER,
    ),
    HardCase(
        "largest_step_dry",
        "numerics",
        "39 us with dry friction",
        "as above",
        changes={"effects": "dry", **_numerics(steps_per_sample=1)},
        load=steady((0.0, 0.0, 1.5e5), 180.0),
        duration=0.3,
        may_report=Status.CHATTER,
    ),
    HardCase(
        "smallest_step",
        "numerics",
        "0.6 us, the smallest step: rounding of 32 768 tiny increments a block",
        "increments in double precision; momentum and energy are counted, not assumed",
        changes=_numerics(steps_per_sample=64),
        load=steady(RADIAL, SPEED),
        duration=0.06,
        limits=CARRIED,
        refined=False,
    ),
    *_TOO_LARGE,
    HardCase(
        "explicit_2_us",
        "numerics",
        "finite is not stable: explicit steps of 2 us, mean force right, friction flipping every step",
        "the chatter monitor; a log of every second step shows nothing",
        run_as="explicit",
        factor=2e-6,
        limits=(Limit("chatter_index", low=0.2), Limit("cage_speed_ratio", 0.999, 1.001)),
        must_report=Status.CHATTER,
        refined=False,
        fast=True,
    ),
    HardCase(
        "explicit_0.1_us",
        "numerics",
        "the same explicit method inside its limit: the monitor must stay silent",
        "second difference of a smooth force is nearly 0",
        run_as="explicit",
        factor=1e-7,
        limits=(Limit("chatter_index", high=0.01), Limit("cage_speed_ratio", 0.999, 1.001)),
        refined=False,
    ),
)

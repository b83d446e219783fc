"""Speed: standing, starting, turning round, racing."""

from __future__ import annotations

import math

from beardyn_core.physics.tiers.status import Status
from evidence.hard.case import HardCase, Limit, Point, steady, through

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
KRPM_PER_S = 1000.0 * 2.0 * math.pi / 60.0

# Nothing turns and next to nothing is lost: the floor of the residual is 0.1 J, and what is not accounted
# for is microjoules.
STANDING = (Limit("energy_residual", high=1e-2),)


def _swing(amplitude: float, frequency: float, seconds: float) -> tuple[Point, ...]:
    """Make a shaft swing: speed as a sine, 40 samples a period."""
    count = round(40 * frequency * seconds)
    return through(
        *(
            Point(index / (40.0 * frequency), RADIAL, amplitude * math.sin(2.0 * math.pi * index / 40.0))
            for index in range(count + 1)
        )
    )


CASES = (
    HardCase(
        "standstill",
        "speed",
        "no speed: no film, no entrainment, friction at zero slip, cage ratio 0/0",
        "regularised friction; film and ratios have floors",
        load=steady(RADIAL, 0.0),
        duration=0.3,
        limits=(*STANDING, Limit("cage_speed", -0.05, 0.05), Limit("mean_torque", -0.05, 0.05)),
        fast=True,
    ),
    HardCase(
        "standstill_full",
        "speed",
        "the same with every effect: film tractions at zero entrainment, seals and rolling at rest",
        "logarithms of speed and film have floors; friction sees the rings' velocity at the end of the step",
        changes={"effects": "full"},
        load=steady(RADIAL, 0.0),
        duration=0.3,
        limits=(Limit("cage_speed", -0.05, 0.05),),
        fast=True,
    ),
    HardCase(
        "start_from_standstill",
        "speed",
        "from rest to 1165 rpm in 0.1 s: films build up, rollers are dragged along",
        "secant friction follows any slip; the load zone keeps the rollers rolling",
        load=through(Point(0.0, RADIAL, 0.0), Point(0.1, RADIAL, 0.0), Point(0.2, RADIAL, SPEED)),
        duration=0.4,
        limits=(Limit("cage_speed_ratio", 0.98, 1.01),),
    ),
    HardCase(
        "start_dry",
        "speed",
        "the same without lubricant: stick and slip",
        "regularised Coulomb friction, implicit",
        changes={"effects": "dry"},
        load=through(Point(0.0, RADIAL, 0.0), Point(0.1, RADIAL, 0.0), Point(0.2, RADIAL, SPEED)),
        duration=0.4,
        limits=(Limit("cage_speed_ratio", 0.98, 1.01),),
    ),
    HardCase(
        "reversal_through_zero",
        "speed",
        "1165 rpm forward to 1165 rpm backward in 0.2 s: every slip changes sign, pockets change sides",
        "friction odd in slip and smooth through zero",
        load=through(Point(0.0, RADIAL, SPEED), Point(0.06, RADIAL, SPEED), Point(0.26, RADIAL, -SPEED)),
        duration=0.4,
        limits=(Limit("cage_speed", -1.02 * 0.4285 * SPEED, -0.97 * 0.4285 * SPEED),),
    ),
    HardCase(
        "reversal_full",
        "speed",
        "the same with every effect: all films collapse and build up again",
        "films are functions of the size of the entrainment with a floor",
        changes={"effects": "full"},
        load=through(Point(0.0, RADIAL, SPEED), Point(0.06, RADIAL, SPEED), Point(0.26, RADIAL, -SPEED)),
        duration=0.4,
        limits=(Limit("cage_speed", -1.02 * 0.4285 * SPEED, -0.97 * 0.4285 * SPEED),),
    ),
    HardCase(
        "swinging_shaft",
        "speed",
        "5 Hz swing of +-5 degrees: ten reversals a second, never a full turn",
        "as for one reversal",
        load=_swing(math.radians(5.0) * 2.0 * math.pi * 5.0, 5.0, 0.4),
        duration=0.4,
    ),
    HardCase(
        "zero_slip",
        "speed",
        "unloaded, at rest, dry: slip exactly 0, its direction 0/0",
        "friction is a rate times slip, never a direction",
        changes={"effects": "dry"},
        load=steady((0.0, 0.0, 0.0), 0.0),
        duration=0.2,
        limits=(*STANDING, Limit("peak_force", high=1600.0)),
        fast=True,
    ),
    HardCase(
        "creep_1_rpm",
        "speed",
        "1 rpm: boundary lubrication everywhere, slips of micrometres a second",
        "boundary share of the mixed traction; regularisation bounds the rate",
        load=steady(RADIAL, 0.1047),
        duration=0.3,
    ),
    HardCase(
        "speed_10_krpm_per_s",
        "speed",
        "the shaft gains 10 krpm a second and loses them again: rollers must be spun up by friction alone",
        "implicit friction; cages follow their rollers",
        load=through(
            Point(0.0, RADIAL, SPEED),
            Point(0.06, RADIAL, SPEED),
            Point(0.21, RADIAL, SPEED + 0.15 * 10.0 * KRPM_PER_S),
            Point(0.36, RADIAL, SPEED),
        ),
        duration=0.42,
        limits=(Limit("cage_speed_ratio", 0.98, 1.02),),
    ),
    HardCase(
        "speed_10_krpm_per_s_light",
        "speed",
        "the same under 1 kN: friction may not suffice, rollers skid",
        "skid is physical: slips and losses stay in the audit",
        changes={"effects": "full"},
        load=through(
            Point(0.0, (0.0, 0.0, 1e3), SPEED),
            Point(0.06, (0.0, 0.0, 1e3), SPEED),
            Point(0.21, (0.0, 0.0, 1e3), SPEED + 0.15 * 10.0 * KRPM_PER_S),
            Point(0.36, (0.0, 0.0, 1e3), SPEED),
        ),
        duration=0.42,
        limits=(Limit("cage_speed_ratio", 0.0, 1.5),),
        may_report=Status.CAGE_FAST,  # the shaft slows down faster than its cages
    ),
    HardCase(
        "overspeed_14000_rpm",
        "speed",
        "14 300 rpm, ten times any train: centrifugal force beyond the load, gyroscopic moments",
        "exact rotation of the orbit frame, static start with centrifugal force",
        load=steady(RADIAL, 1500.0),
        duration=0.3,
    ),
)

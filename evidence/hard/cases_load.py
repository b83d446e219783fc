"""Loads: none, tiny, reversing, striking, enormous, no number at all."""

from __future__ import annotations

import math

from beardyn_core.physics.tiers.status import Status
from evidence.hard.case import HardCase, Limit, Point, steady, through

SPEED = 122.0
GRAVITY = 9.80665
NOTHING = (0.0, 0.0, 0.0)
RADIAL = (0.0, 0.0, 8.0e4)
# box and journal of the base scene, which a strike of the wheel accelerates together
STRUCK_MASS = 907.0


def _strikes(acceleration_g: float, count: int, spacing: float, first: float = 0.05) -> tuple[Point, ...]:
    """Add triangles of 1 ms to 80 kN."""
    points = [Point(0.0, RADIAL, SPEED)]
    peak = (0.0, 0.0, RADIAL[2] + acceleration_g * GRAVITY * STRUCK_MASS)
    for number in range(count):
        at = first + number * spacing
        points += [Point(at, RADIAL, SPEED), Point(at + 5e-4, peak, SPEED), Point(at + 1e-3, RADIAL, SPEED)]
    return through(*points)


def _reversing(amplitude: float, frequency: float, seconds: float) -> tuple[Point, ...]:
    """Make a sine through zero, sampled 40 times a period."""
    count = round(40 * frequency * seconds)
    return through(
        *(
            Point(
                index / (40.0 * frequency),
                (0.0, 0.0, amplitude * math.cos(2.0 * math.pi * index / 40.0)),
                SPEED,
            )
            for index in range(count + 1)
        )
    )


# 2 % of the usual load: weights, centrifugal forces and their impacts, at every sample
NO_FORCE = (Limit("peak_force", high=1600.0),)
# under a strike a roller leans on the rib with its rim
STRUCK = {"effects": {"preset": "standard", "rib": {"roller_end": True}}, "mounting": {"cup": "suspended"}}
PLAY = {"end_play_mm": 0.2}
SUSPENDED = {"mounting": {"cup": "suspended"}}

CASES = (
    HardCase(
        "zero_load",
        "load",
        "no roller is loaded: division by load, friction capacity 0, rollers that drift out",
        "load floors in chatter index and film; centrifugal force holds the rollers to the cup",
        load=steady(NOTHING, SPEED),
        duration=0.4,
        limits=NO_FORCE,
        fast=True,
    ),
    HardCase(
        "zero_load_with_play",
        "load",
        "nothing touches anything: static equilibrium without a contact, endless bouncing",
        "the static solver carries the cone through its play; contact damping",
        changes=PLAY,
        load=steady(NOTHING, SPEED),
        duration=0.4,
        limits=NO_FORCE,
    ),
    HardCase(
        "microload_1_N",
        "load",
        "contacts of a few newton: infinite slope of the 10/9 law's derivative at zero",
        "the force is continuous with its slope; the implicit solve uses the tangent at the step's start",
        load=steady((0.0, 0.0, 1.0), SPEED),
        duration=0.4,
        limits=NO_FORCE,
    ),
    HardCase(
        "microload_skid",
        "load",
        "traction below drag: the cage slows down, slips of metres a second",
        "traction bounded by mu N; skid is physical and shown as cage speed",
        changes={"effects": "full", **PLAY},
        load=steady((0.0, 0.0, 30.0), 300.0),
        duration=0.5,
        limits=(Limit("cage_speed_ratio", 0.0, 1.02),),
    ),
    HardCase(
        "load_reversal",
        "load",
        "+50 kN to -50 kN in 10 ms through 0.2 mm of play: free flight, then an impact of the other side",
        "contacts only press; the energy of the impact is in the audit",
        changes=PLAY,
        load=through(
            Point(0.0, (0.0, 0.0, 5e4), SPEED),
            Point(0.06, (0.0, 0.0, 5e4), SPEED),
            Point(0.07, (0.0, 0.0, -5e4), SPEED),
        ),
        duration=0.4,
        limits=(Limit("mean_force", 4.9e4, 5.2e4),),
    ),
    HardCase(
        "load_reversal_50_Hz",
        "load",
        "+-40 kN at 50 Hz through the play: 100 impacts a second",
        "as for one reversal; the audit must not drift with the number of impacts",
        changes=PLAY,
        load=_reversing(4e4, 50.0, 0.5),
        duration=0.5,
    ),
    HardCase(
        "axial_reversal",
        "load",
        "+-20 kN along the axle in 20 ms: the rows change places, ribs unload and load again",
        "two-sided rib and row contacts; the static start is in one of both states only",
        changes=PLAY,
        load=through(
            Point(0.0, (0.0, 2e4, 5e4), SPEED),
            Point(0.1, (0.0, 2e4, 5e4), SPEED),
            Point(0.12, (0.0, -2e4, 5e4), SPEED),
            Point(0.2, (0.0, -2e4, 5e4), SPEED),
            Point(0.22, (0.0, 2e4, 5e4), SPEED),
        ),
        duration=0.4,
    ),
    HardCase(
        "axial_load_only",
        "load",
        "30 kN along the axle: one row has no load at all, its rollers are free",
        "the free row is held by centrifugal force and pockets",
        changes=PLAY,
        load=steady((0.0, 3e4, 0.0), SPEED),
        duration=0.3,
    ),
    HardCase(
        "axial_load_through_0.8_mm",
        "load",
        "18 kN along the axle through 0.8 mm of play, at rest: rollers of the free row beyond their pockets",
        "the cage starts where its rollers are; before, 33 J of squeezed pockets shook the bearing by 10 kN",
        changes={"end_play_mm": 0.8},
        load=steady((0.0, 1.76e4, 0.0), 0.14),
        duration=0.2,
        limits=(Limit("peak_force", high=1.05 * 1.76e4), Limit("stored", high=1.0)),
    ),
    HardCase(
        "impacts_200_g",
        "load",
        "six strikes of 200 g on the unsprung mass, 1 ms each, 50 ms apart: 1.9 MN at the peak",
        "implicit normal contact; the journal's inertia takes most of a strike",
        changes=STRUCK,
        load=_strikes(200.0, 6, 0.05),
        duration=0.4,
        may_report=Status.CHATTER | Status.RIB_EDGE,
    ),
    HardCase(
        "impacts_200_g_full",
        "load",
        "the same train with every effect: ribs lift off, the cup rings, pocket films are squeezed",
        "bounded squeeze resistance; bending modes stepped inside their stability limit",
        changes={"effects": "full", **SUSPENDED},
        load=_strikes(200.0, 4, 0.05),
        duration=0.3,
        may_report=Status.CHATTER | Status.RIB_EDGE,
    ),
    HardCase(
        "wheel_flat_300_kmh",
        "load",
        "a fresh 35 mm flat at 300 km/h: 29 strikes a second on wheel, rail and bearing",
        "rail model at 20 kHz, load at 10 kHz; the rim of the roller end carries on the rib",
        scene="wheel_flat",
        changes={"operation": {"speed_profile": [{"time_s": 0, "speed_kmh": 300}]}},
        duration=0.4,
        may_report=Status.RIB_EDGE,
    ),
    HardCase(
        "load_1_MN",
        "load",
        "1 MN, seven times the static rating life load: rollers deep in the raceways",
        "the law holds up to 200 um of approach; beyond it the run ends",
        load=steady((0.0, 0.0, 1e6), SPEED),
        duration=0.2,
        limits=(Limit("mean_force", 0.99e6, 1.01e6),),
    ),
    HardCase(
        "load_1_MN_stepped_on",
        "load",
        "1 MN put on within 2 ms on a bearing with play",
        "implicit normal contact, damping in the audit",
        changes=PLAY,
        load=through(
            Point(0.0, (0.0, 0.0, 1e4), SPEED),
            Point(0.06, (0.0, 0.0, 1e4), SPEED),
            Point(0.062, (0.0, 0.0, 1e6), SPEED),
        ),
        duration=0.2,
        may_report=Status.RIB_EDGE,
    ),
    HardCase(
        "load_8_MN",
        "load",
        "a load no bearing carries: the contact law far beyond its validity",
        "penetration bit: the run ends with a sentence and a readable last block",
        run_as="end",
        load=steady((0.0, 0.0, 8e6), SPEED),
        sentence="pressed more than 200 um into a raceway",
        refined=False,
        fast=True,
    ),
    HardCase(
        "load_NaN_at_start",
        "load",
        "NaN as the first load: a static equilibrium of NaN",
        "every piece of load is looked at before it is used",
        run_as="end",
        load=steady((0.0, 0.0, math.nan), SPEED),
        sentence="NaN or an infinite number",
        refined=False,
        fast=True,
    ),
    HardCase(
        "load_NaN_in_mid_run",
        "load",
        "one NaN in a stream of good loads poisons every state for good",
        "the piece is refused and counted; the run goes on with the next good one",
        run_as="refused load",
        load=steady((math.nan, 0.0, 8e4), SPEED),
        sentence="NaN or an infinite number",
        limits=(Limit("differing", high=0),),
        duration=0.16,
        refined=False,
        fast=True,
    ),
    HardCase(
        "load_infinite",
        "load",
        "an infinite moment in a stream of good loads",
        "as for NaN",
        run_as="refused load",
        load=steady(RADIAL, SPEED, (math.inf, 0.0, 0.0)),
        sentence="NaN or an infinite number",
        limits=(Limit("differing", high=0),),
        duration=0.16,
        refined=False,
    ),
    HardCase(
        "load_absurd",
        "load",
        "1e12 N and 1e5 rad/s: finite, and no load of any train",
        "limits of the load buffer",
        run_as="refused load",
        load=steady((0.0, 0.0, 1e12), 1e5),
        sentence="the load is absurd",
        limits=(Limit("differing", high=0),),
        duration=0.16,
        refined=False,
    ),
)

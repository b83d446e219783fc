"""Geometry: play, preload, tilt, rib, cage, numbers of rollers."""

from __future__ import annotations

import math
from typing import Any

from beardyn_core.integrate.status import Status
from evidence.hard.case import HardCase, Limit, Point, steady, through

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
CARRIED = (Limit("mean_force", 0.98 * 8e4, 1.01 * 8e4),)
SEIZED = {"polar_inertia_kg_m2": 1e4, "mass_kg": 0.4}


def _rollers(count: int) -> dict[str, Any]:
    return {"bearing": {"roller_count": count}}


CASES = (
    HardCase(
        "end_play_0.8_mm",
        "geometry",
        "two rollers carry all: a poor start of the static solution diverges",
        "static Newton with a longest step; it carries the cone through its play",
        changes={"end_play_mm": 0.8, "mounting": {"cup": "suspended"}},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        fast=True,
    ),
    HardCase(
        "preload_0.2_mm",
        "geometry",
        "200 um of preload, ten times what is mounted: every roller heavily loaded all round",
        "implicit normal contact; penetration bit",
        changes={"end_play_mm": -0.2},
        load=steady(RADIAL, SPEED),
        duration=0.3,
    ),
    HardCase(
        "preload_0.5_mm",
        "geometry",
        "the largest preload a scene may ask for",
        "as above",
        changes={"end_play_mm": -0.5},
        load=steady(RADIAL, SPEED),
        duration=0.2,
    ),
    HardCase(
        "tilt_0.5_degrees",
        "geometry",
        "a moment tilts the journal by 0.5 degrees through 2 mm of play: rollers bear on their edges",
        "laminae carry the edge load; large-tilt ring axes; rib edges carry and are reported",
        changes={"end_play_mm": 2.0, "mounting": {"journal_tilt": "free"}},
        load=through(
            Point(0.0, (0.0, 0.0, 2e4), SPEED),
            Point(0.06, (0.0, 0.0, 2e4), SPEED),
            Point(0.2, (0.0, 0.0, 2e4), SPEED, (1.35e5, 0.0, 0.0)),
        ),
        duration=0.4,
        limits=(Limit("tilt", math.radians(0.5), math.radians(1.0)),),
        may_report=Status.RIB_EDGE,
        known_failure=(
            "The leaning bars of the cage resist rollers that tilt in their pockets, and on the way to half "
            "a degree a roller leaves the face of its rib: the run ends with that sentence. With upright "
            "bars, or with bars that lean by 0.2 rad instead of 0.44, it goes through."
        ),
    ),
    HardCase(
        "moment_20_kN_m",
        "geometry",
        "20 kN m on a journal without play: edge loads of hundreds of kilonewtons",
        "penetration bit",
        changes={"mounting": {"journal_tilt": "free"}},
        load=through(
            Point(0.0, RADIAL, SPEED),
            Point(0.06, RADIAL, SPEED),
            Point(0.16, RADIAL, SPEED, (2e4, 0.0, 0.0)),
        ),
        duration=0.3,
        may_report=Status.RIB_EDGE,
    ),
    HardCase(
        "sphere_beyond_apex",
        "geometry",
        "sphere radius beyond the apex distance: the contact of Santos (2017) ran off the rib",
        "refused by the configuration with the numbers that contradict",
        run_as="refused scene",
        changes={"bearing": {"sphere_ratio": 1.02}},
        sentence="sphere_ratio is 1.02",
        refined=False,
        fast=True,
    ),
    HardCase(
        "sphere_beyond_apex_forced",
        "geometry",
        "the same put in past the check",
        "the contact is beyond the roller's end: the run ends with a sentence",
        run_as="end",
        forced={"sphere_ratio": 1.02},
        load=steady(RADIAL, SPEED),
        sentence="a roller presses on its rib beyond the edge of its large end",
        may_report=Status.CHATTER | Status.RIB_EDGE,
        refined=False,
    ),
    HardCase(
        "sphere_beyond_apex_rim",
        "geometry",
        "the same with every effect: the rim of the roller end carries instead of the sphere",
        "rim contact",
        changes={"effects": "full"},
        forced={"sphere_ratio": 1.02},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=(Limit("skew", high=math.radians(2.0)),),
        may_report=Status.RIB_EDGE,
        known_failure=(
            "An impossible bearing whose rollers slide on their rims: the audit books a tenth more rib loss "
            "than there is, and torque moves by 4 % with half the step. The rib edge is reported."
        ),
    ),
    HardCase(
        "broken_rib_skew",
        "geometry",
        "the rib face is broken off below the contact and what is left grips (0.5): rollers skew",
        "the edge carries and is reported; pocket and opposite contacts stop the skew",
        changes={"effects": {"preset": "standard", "rib": {"friction": 0.5, "roller_end": True}}},
        forced={"rib_height": 1.4e-3},
        load=steady((0.0, 1.5e4, 8e4), SPEED),
        duration=0.3,
        limits=(Limit("skew", high=math.radians(3.0)),),
        must_report=Status.RIB_EDGE,
    ),
    HardCase(
        "grabbing_rib",
        "geometry",
        "a sound rib with friction 0.5: the largest skew moment",
        "secant friction of the rib in the implicit solve",
        changes={"effects": {"preset": "standard", "rib": {"friction": 0.5}}},
        load=steady((0.0, 1.5e4, 8e4), SPEED),
        duration=0.3,
        limits=(Limit("skew", high=math.radians(3.0)),),
    ),
    HardCase(
        "no_rib",
        "geometry",
        "no rib at all: nothing but pockets and friction holds the rollers along their axes",
        "the rollers run out of the load zone; the run goes on, or says why not",
        changes={"effects": {"preset": "standard", "rib": False}},
        load=steady((0.0, 0.0, 8e4), SPEED),
        duration=0.2,
        limits=(Limit("skew", high=math.radians(30.0)),),
        refined=False,
    ),
    HardCase(
        "pocket_clearance_refused",
        "geometry",
        "no clearance in the pockets: rollers clamped by two stiff springs",
        "refused by the configuration",
        run_as="refused scene",
        changes={"bearing": {"cage": {"circumferential_clearance_mm": 0}}},
        sentence="circumferential_clearance",
        refined=False,
    ),
    HardCase(
        "pocket_clearance_0",
        "geometry",
        "the same put in past the check: every pocket touches front and rear",
        "pocket springs below the stability limit of the explicit cage",
        forced={"cage.circumferential_clearance": 0.0},
        load=steady(RADIAL, SPEED),
        duration=0.3,
    ),
    HardCase(
        "pocket_clearance_2_mm",
        "geometry",
        "2 mm in every pocket: hard impacts between rollers and cage",
        "damping of the pockets",
        changes={"bearing": {"cage": {"circumferential_clearance_mm": 2.0}}, "end_play_mm": 0.2},
        load=steady(RADIAL, SPEED),
        duration=0.4,
    ),
    HardCase(
        "cage_seized",
        "geometry",
        "the cages stand while the shaft turns: every roller is held back and slides at 5 m/s",
        "friction bounded by mu N; the heat is in the audit",
        changes={
            "bearing": {"cage": {"polar_inertia_kg_m2": 1e4}},
            "effects": {"preset": "standard", "cage": {"initial_speed_ratio": 0.0}},
        },
        load=steady((0.0, 0.0, 2e4), SPEED),
        duration=0.3,
        limits=(Limit("cage_speed_ratio", -0.05, 0.05),),
    ),
    HardCase(
        "roller_missing",
        "geometry",
        "one roller is not there: its lane must neither carry nor weigh",
        "mask of the lane",
        changes={"missing_rollers": [{"row": 0, "roller": 0}]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
    HardCase(
        "rollers_13",
        "geometry",
        "13 rollers a row, prime: lanes that do not fill",
        "filler lanes shadow a real roller and are masked out of all sums",
        changes=_rollers(13),
        load=steady(RADIAL, SPEED),
        duration=0.2,
        limits=CARRIED,
        fast=True,
    ),
    HardCase(
        "rollers_19",
        "geometry",
        "19 rollers a row, prime and one lane group more",
        "as above",
        changes=_rollers(19),
        load=steady(RADIAL, SPEED),
        duration=0.2,
        limits=CARRIED,
    ),
    HardCase(
        "rollers_15",
        "geometry",
        "15 rollers a row, odd and no prime",
        "as above",
        changes=_rollers(15),
        load=steady(RADIAL, SPEED),
        duration=0.2,
        limits=CARRIED,
    ),
    HardCase(
        "rollers_4",
        "geometry",
        "4 rollers a row, the fewest allowed: the load zone is a single roller, the journal falls between",
        "as above",
        changes=_rollers(4),
        load=steady((0.0, 0.0, 2e4), SPEED),
        duration=0.2,
        may_report=Status.RIB_EDGE,
    ),
)

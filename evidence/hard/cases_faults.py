"""Faults: spalls, wrong rollers."""

from __future__ import annotations

from typing import Any

from beardyn_core.physics.tiers.status import Status
from evidence.hard.case import HardCase, Limit, steady

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
# Load less 84 N of weights; 0.1 m/s of the journal's 900 kg over the second half, 0.15 s, are 600 N.
CARRIED = (Limit("mean_force", 0.99 * 8e4, 1.01 * 8e4),)


def _cup(**keys: Any) -> dict[str, Any]:
    return {"kind": "spall", "on": "cup", "row": 0, **keys}


SEVERAL: list[dict[str, Any]] = [
    _cup(azimuth_deg=-10, width_mm=6, depth_um=100, length_mm=25),
    _cup(azimuth_deg=10, width_mm=3, depth_um=60, length_mm=10, offset_mm=15),
    _cup(azimuth_deg=0, row=1, width_mm=10, depth_um=150),
    {"kind": "dent", "on": "cone", "row": 0, "width_mm": 3, "depth_um": 40, "rim_height_um": 10},
    {"kind": "elliptic", "on": "cone", "row": 1, "azimuth_deg": 40, "width_mm": 8, "depth_um": 80},
    {"kind": "spall", "on": "roller", "row": 0, "roller": 3, "width_mm": 4, "depth_um": 60},
    {"kind": "spall", "on": "roller", "row": 1, "roller": 5, "width_mm": 4, "depth_um": 60},
]

CASES = (
    HardCase(
        "spall_deep",
        "faults",
        "a spall of 2 mm depth: the roller falls in, loses contact and strikes the far edge",
        "the roller's own path over the edges; lost contact is no force",
        changes={"defects": [_cup(width_mm=6, depth_um=2000)]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
        may_report=Status.RIB_EDGE,
    ),
    HardCase(
        "spall_wider_than_the_pitch",
        "faults",
        "50 mm wide, more than the rollers' pitch, over the whole length: two rollers in it at a time",
        "path tables of any reach",
        changes={
            "defects": [_cup(width_mm=50, depth_um=200)],
            "effects": {"preset": "standard", "rib": {"roller_end": True}},
        },
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
        may_report=Status.RIB_EDGE,
    ),
    HardCase(
        "spall_within_a_lamina",
        "faults",
        "2 mm long where a lamina is 8 mm: a part of one lamina",
        "each lamina has the share of it that is covered; damaged and healthy springs side by side",
        changes={"defects": [_cup(width_mm=6, depth_um=100, length_mm=2, offset_mm=3)]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
    HardCase(
        "spall_longer_than_a_lamina",
        "faults",
        "13 mm long with an end inside a lamina: one whole lamina and parts of two",
        "as above",
        changes={"defects": [_cup(width_mm=6, depth_um=100, length_mm=13, offset_mm=5)]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
    HardCase(
        "spall_one_lamina",
        "faults",
        "a spall narrower than the only lamina there is, at the fastest tier",
        "as above; with one lamina a roller does not tilt",
        changes={
            "tier": "lumped",
            "defects": [_cup(width_mm=6, depth_um=100, length_mm=10)],
            "numerics": {"laminae": 1},
        },
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
    HardCase(
        "spalls_on_everything",
        "faults",
        "seven spalls and dents on cup, cone and two rollers at once",
        "patches add up; edges of one may lie inside another",
        changes={"defects": SEVERAL, "effects": {"preset": "standard", "rib": {"roller_end": True}}},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
        may_report=Status.RIB_EDGE | Status.CHATTER,
    ),
    HardCase(
        "oversize_50_um",
        "faults",
        "one roller 50 um too large: it carries what five carried, twice a cage revolution and alone",
        "implicit normal contact; penetration bit",
        changes={"defects": [{"kind": "diameter", "row": 0, "roller": 0, "diameter_um": 50}]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
    ),
    HardCase(
        "undersize_200_um",
        "faults",
        "one roller 200 um too small: it never carries and is pushed by the cage",
        "free rollers are held to the cup by centrifugal force",
        changes={"defects": [{"kind": "diameter", "row": 0, "roller": 0, "diameter_um": -200}]},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=CARRIED,
    ),
)

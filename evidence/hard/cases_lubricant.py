"""Lubricant: cold, hot, starved, none."""

from __future__ import annotations

from beardyn_core.physics.tiers.status import Status
from evidence.hard.case import HardCase, Limit, steady

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
ROLLING = (Limit("cage_speed_ratio", 0.9, 1.02),)

CASES = (
    HardCase(
        "oil_at_minus_40_C",
        "lubricant",
        "viscosity a thousand times the usual: films of tens of micrometres, drag like glue",
        "film range bit above 10 um; film friction is never more than dry asperities'",
        changes={"effects": "full", "temperature_C": -40},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        may_report=Status.FILM_RANGE,
    ),
    HardCase(
        "oil_at_minus_40_C_start",
        "lubricant",
        "standard effects at -40 C under a light load",
        "as above",
        changes={"temperature_C": -40},
        load=steady((0.0, 0.0, 2e3), SPEED),
        duration=0.3,
        may_report=Status.FILM_RANGE,
    ),
    HardCase(
        "oil_at_120_C",
        "lubricant",
        "films thinner than the roughness: all contacts in boundary lubrication",
        "boundary share of the tractions",
        changes={"effects": "full", "temperature_C": 120},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=ROLLING,
    ),
    HardCase(
        "starved",
        "lubricant",
        "films at 2 % of the flooded ones",
        "the film parameter is a number above 0 by construction; logarithms of films have floors",
        changes={"effects": {"preset": "standard", "film": {"starvation": 0.02}}},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=ROLLING,
        fast=True,
    ),
    HardCase(
        "starved_to_nothing",
        "lubricant",
        "a film of one millionth",
        "as above",
        changes={"effects": {"preset": "standard", "film": {"starvation": 1e-6}}},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=ROLLING,
    ),
    HardCase(
        "dry",
        "lubricant",
        "Coulomb friction 0.1 in every contact: the stiffest friction there is",
        "secant friction in the implicit solve",
        changes={"effects": "dry"},
        load=steady(RADIAL, SPEED),
        duration=0.3,
        limits=ROLLING,
        fast=True,
    ),
    HardCase(
        "dry_and_sharp",
        "lubricant",
        "friction 0.3 with its corner rounded over 0.5 mm/s: friction rates of 1e8 1/s",
        "as above; if it chatters the monitor reports it",
        changes={
            "effects": {"preset": "dry", "traction": {"friction": 0.3, "regularisation_speed_m_per_s": 5e-4}}
        },
        load=steady(RADIAL, SPEED),
        duration=0.3,
        may_report=Status.CHATTER,
    ),
    HardCase(
        "dry_heavy_and_fast",
        "lubricant",
        "150 kN at 180 rad/s, dry: where an explicit step of 0.5 us already has the wrong torque",
        "as above",
        changes={"effects": "dry"},
        load=steady((0.0, 0.0, 1.5e5), 180.0),
        duration=0.3,
        limits=ROLLING,
    ),
)

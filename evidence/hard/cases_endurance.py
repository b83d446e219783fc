"""Endurance: an hour, a minute, restarts to the last bit."""

from __future__ import annotations

from evidence.hard.case import HardCase, Limit, Point, steady, through

SPEED = 122.0
RADIAL = (0.0, 0.0, 8.0e4)
SAME = (Limit("differing", high=0),)
MOVING = {"end_play_mm": 0.1, "mounting": {"cup": "suspended", "journal_tilt": "free"}}
WANDERING = through(
    Point(0.0, (0.0, 2e3, 7e4), SPEED),
    Point(0.05, (2e3, -3e3, 9e4), SPEED + 2.0),
    Point(0.09, (-2e3, 5e3, 5e4), SPEED - 3.0),
    Point(0.13, (0.0, 0.0, 8e4), SPEED),
)
HOUR = through(
    *(
        Point(
            60.0 * minute, (0.0, 3e3 * (minute % 3 - 1), 6e4 + 1e4 * (minute % 4)), 60.0 + 20.0 * (minute % 5)
        )
        for minute in range(61)
    )
)


def _restart(name: str, fast: bool = False, **changes: object) -> HardCase:
    return HardCase(
        f"restart_{name}",
        "endurance",
        "a run continued from a snapshot is another run",
        "a snapshot holds everything the rest depends on",
        run_as="restart",
        changes={**MOVING, **changes},
        load=WANDERING,
        duration=0.2,
        limits=SAME,
        refined=False,
        fast=fast,
    )


CASES = (
    _restart("standard", fast=True),
    _restart("full", effects="all"),
    _restart("dry", effects="dry"),
    _restart("lumped", fast=True, tier="lumped"),
    _restart("quasistatic", fast=True, tier="quasistatic"),
    _restart(
        "growing_spall",
        defects=[
            {
                "kind": "spall",
                "on": "cup",
                "row": 0,
                "width_mm": 6,
                "depth_um": 100,
                "growth": {"from_s": 0.05, "to_s": 0.15},
            }
        ],
    ),
    HardCase(
        "hour_lumped",
        "endurance",
        "one hour at the fastest tier: drift, angles that lose digits, memory that grows",
        "angles in double precision; blocks own what they hold",
        changes={"tier": "lumped", "mounting": {"cup": "suspended"}},
        load=HOUR,
        duration=3600.0,
        limits=(Limit("cage_speed_ratio", 0.999, 1.001),),
        refined=False,
        long=True,
    ),
    HardCase(
        "minute_full",
        "endurance",
        "one minute of the full tier: energy, frames and speeds must not drift",
        "frames renormalised every step; works and energies counted",
        changes={"end_play_mm": 0.1, "mounting": {"cup": "suspended"}},
        load=steady(RADIAL, SPEED),
        duration=60.0,
        limits=(Limit("energy_residual", high=1e-3), Limit("cage_speed_ratio", 0.98, 1.005)),
        refined=False,
        long=True,
    ),
)

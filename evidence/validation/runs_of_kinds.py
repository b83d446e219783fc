"""Runs of cylindrical and spherical roller bearings against solutions that share no code with them.

References are those of `kind_solutions`: springs of whole rollers for barrels, slices of the standard for
cylinders.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.profile import Profile
from beardyn_core.config import load_any_bearing
from beardyn_core.sensors.block import Block
from evidence.validation.anchor import Anchor
from evidence.validation.kind_solutions import LAMINAE, cylindrical, hertz_rows, spherical, standard_loads
from evidence.validation.roller_kinds import HERTZ, STANDARD, TOPIC
from test.runs import blocks_of
from test.tiers.steady import steady_scene

LOAD, RPM = 60e3, 600.0  # [N], [1/min]
RUNS = (
    ("WJ130x240", "full"),
    ("WJ180x320", "quasistatic"),
    ("SRB120x260", "full"),
    ("SRB130x280", "quasistatic"),
)
ROLLING = "pure rolling: half the shaft speed times 1 - (d/D) cos(a)"


@lru_cache
def steady_blocks(name: str, tier: str) -> tuple[Block, ...]:
    """Run a bearing under `LOAD`, the later half of it; cylinders have the profile of the standard."""
    scene = steady_scene(name, tier, (0.0, 0.0, 1e-3 * LOAD), RPM, numerics={"laminae": LAMINAE})
    if isinstance(scene.bearing, CylindricalBearing):
        scene = replace(scene, bearing=replace(scene.bearing, profile=Profile("iso_16281")))
    blocks = blocks_of(scene, 0.4)
    return blocks[len(blocks) // 2 :]


def run_over_solution(name: str, tier: str) -> float:
    """Compare the largest roller load of a run, a mean over time, with solutions over all places."""
    contacts = np.concatenate([block.contacts for block in steady_blocks(name, tier)])
    heaviest = np.linalg.norm(contacts[..., 0, 3:6], axis=-1).max(axis=(1, 2)).mean()
    bearing = load_any_bearing(name)
    phases = np.arange(8) / 8 * 2.0 * math.pi / bearing.roller_count
    solved = [
        standard_loads(cylindrical(name), LOAD, phase).max()
        if isinstance(bearing, CylindricalBearing)
        else hertz_rows(spherical(name), np.array([0.0, 0.0, LOAD]), phase).max()
        for phase in phases
    ]
    return float(heaviest / np.mean(solved))


def cage_over_rolling(name: str, tier: str) -> float:
    """Compare the speed of the cages of a run with that of pure rolling."""
    bearing = load_any_bearing(name)
    ratio = bearing.roller_diameter * math.cos(bearing.contact_angle) / bearing.pitch_diameter
    rolling = 0.5 * (1.0 - ratio) * RPM * math.pi / 30.0
    speed = np.concatenate([block.cage_speed for block in steady_blocks(name, tier)])
    return float(speed.mean() / rolling)


ANCHORS: tuple[Anchor, ...] = (
    *(
        Anchor(
            TOPIC,
            f"largest roller load of a run, {name}, tier {tier}, {LOAD / 1e3:g} kN, {RPM:g} 1/min",
            1.0,
            "",
            STANDARD if name.startswith("WJ") else HERTZ,
            partial(run_over_solution, name, tier),
            tolerance=0.03,
        )
        for name, tier in RUNS
    ),
    *(
        Anchor(
            TOPIC,
            f"cage speed of a run over pure rolling, {name}, tier {tier}, {LOAD / 1e3:g} kN",
            1.0,
            "",
            ROLLING,
            partial(cage_over_rolling, name, tier),
            tolerance=0.006,
        )
        for name, tier in RUNS
    ),
)

"""Runs of one scene in any tier, and kernels of a tier driven at a held pose."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.choice import load_scene
from beardyn_core.effects import EffectSet, Gravity, LineFilm
from beardyn_core.physics.statics.static import StaticSolution, solve
from beardyn_core.rail.build import load_history
from beardyn_core.scene.scene import Scene
from test.runs import blocks_of

Float = NDArray[np.float64]
FAST = ("lumped", "quasistatic")


@cache
def scene_of(name: str, tier: str) -> Scene:
    """A shipped scene in a tier, with enough oil, a dry rib and no drag."""
    effects = replace(EffectSet(), film=LineFilm(supply="flooded"))
    return replace(load_scene(name, tier=tier), effects=effects)


@dataclass(frozen=True)
class Means:
    """Means over the second half of a run: force on the cup, cone against cup, largest cup load, torque."""

    force: Float
    deflection: Float
    largest: float
    torque: float
    status: int


@cache
def means(name: str, tier: str, duration: float = 0.6) -> Means:
    """Means of a run of a shipped scene."""
    blocks = blocks_of(scene_of(name, tier), duration)
    half = blocks[len(blocks) // 2 :]
    pose = np.concatenate([block.body_pose[:, :2, :3] for block in half])
    cup = np.concatenate([np.linalg.norm(block.contacts[..., 0, 3:6], axis=-1) for block in half])
    status = 0
    for block in blocks:
        status |= block.status
    return Means(
        np.concatenate([block.force for block in half]).mean(axis=0),
        (pose[:, 1] - pose[:, 0]).mean(axis=0),
        float(cup.max(axis=(1, 2)).mean()),
        float(np.concatenate([block.shaft_torque for block in half]).mean()),
        status,
    )


@cache
def static_mean(name: str, phases: int = 12) -> tuple[Float, float, float]:
    """Displacement, largest cup load and sum of the rib loads of the static solution under the rollers' share
    of the first load, means over the pitch of the rollers."""
    scene = scene_of(name, "full")
    first = load_history(scene.operation, scene.mounting, 0.1, scene.seed)
    bearing = scene.bearing
    carried = 9.80665 * 2 * (bearing.roller_count * bearing.roller_mass + bearing.cage.mass)
    force = first.wrench[0, :3] - np.array([0.0, 0.0, carried])
    found: list[StaticSolution] = [
        solve(
            bearing,
            force,
            end_play=scene.end_play,
            laminae=scene.numerics.laminae,
            speed=float(first.shaft_speed[0]),
            roller_phase=2.0 * np.pi * phase / phases / bearing.roller_count,
        )
        for phase in range(phases)
    ]
    return (
        np.mean([each.displacement for each in found], axis=0),
        float(np.mean([each.cup_load.max() for each in found])),
        float(np.mean([each.rib_load.sum() for each in found])),
    )


def heavy(scene: Scene) -> Scene:
    """A journal too heavy to move within a test: its pose is what the test sets."""
    return replace(
        scene,
        mounting=replace(scene.mounting, cup="held", journal_mass=1e15, journal_inertia=1e15),
        effects=replace(scene.effects, gravity=Gravity(0.0)),
    )

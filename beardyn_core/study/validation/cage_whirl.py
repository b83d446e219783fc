"""Whirl of the cages: how far and how fast their centres go round, by speed and load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.model.cage_params import cage_params
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

Float = NDArray[np.float64]


@dataclass(frozen=True)
class WhirlCase:
    """A constant load and speed.

    Parameters
    ----------
    shaft_speed : float
        [rad/s].
    axial_load, radial_load : float
        On the journal along +y and +z, [N].
    """

    shaft_speed: float
    axial_load: float
    radial_load: float = 0.0


@dataclass(frozen=True)
class Whirl:
    """Motion of the cage of the loaded row, by case.

    Parameters
    ----------
    cases : tuple of WhirlCase
    amplitude : float64 array, shape [case]
        Root mean square distance of the cage's centre from its mean place, across the axis, [m].
    reach : float64 array, shape [case]
        Largest distance of the cage's centre from the bearing's axis, [m].
    frequency : float64 array, shape [case]
        Mean speed of the centre around its mean place over the nominal cage speed, [-].
    slip : float64 array, shape [case]
        1 less the cage's speed over the nominal, [-].
    spacing : float64 array, shape [case]
        Root mean square deviation of the roller spacing along the pitch circle from an even one, [m].
    play : float
        Half the clearance of a roller in its pocket across the leaning bar, [m].
    """

    cases: tuple[WhirlCase, ...]
    amplitude: Float
    reach: Float
    frequency: Float
    slip: Float
    spacing: Float
    play: float


def cage_whirl(
    scene: Scene, cases: Sequence[WhirlCase], *, duration: float = 0.6, settled: float = 0.3
) -> Whirl:
    """Run each case and look at the cage of the row that carries the axial load.

    Parameters
    ----------
    scene : Scene
        Bearing, effects and mounting; its own operation is not used. Its cages must be free.
    cases : sequence of WhirlCase
    duration, settled : float
        Simulated time, and the part of it at the beginning that is not looked at, [s].

    Returns
    -------
    Whirl
    """
    found = np.array([_measures(scene, case, duration, settled) for case in cases])
    cage = cage_params(scene, 1e-5)
    if cage is None:
        raise ValueError("a scene without a cage has no whirl; give it one under effects")
    amplitude, reach, frequency, slip, spacing = found.T
    play = cage.bar_cosine * cage.half_clearance
    return Whirl(tuple(cases), amplitude, reach, frequency, slip, spacing, play)


def _measures(scene: Scene, case: WhirlCase, duration: float, settled: float) -> tuple[float, ...]:
    bearing = scene.bearing
    twin = Twin(replace(scene, sensors=()))
    wrench = np.array([0.0, case.axial_load, case.radial_load, 0.0, 0.0, 0.0])
    times = np.array([0, round((duration + 1.0) * 1e9)], dtype=np.int64)
    twin.start(
        LoadHistory(times, np.repeat(wrench[None], 2, 0), np.full(2, case.shaft_speed), np.zeros((2, 3)))
    )
    blocks = [twin.advance() for _ in range(round(duration * 1e9 / twin.block_ns))]
    load = np.concatenate([block.contacts[..., 0, 3:6] for block in blocks])
    row = int(np.argmax(np.linalg.norm(load, axis=-1).sum(axis=(0, 2))))
    first = round(settled / duration * len(blocks))
    kept = blocks[first:]
    nominal = cage_speed(bearing, case.shaft_speed)
    centre = np.concatenate([block.body_pose[:, 2 + row, :3] for block in kept])[:, [2, 0]]  # z, then x
    offset = centre - centre.mean(axis=0)
    time = np.concatenate([block.snapshot_time_ns for block in kept]) * 1e-9
    turned = np.unwrap(np.arctan2(offset[:, 1], offset[:, 0]))
    speed = np.polyfit(time, turned, 1)[0]
    rate = np.concatenate([block.cage_speed[:, row] for block in kept]).mean()
    angle = np.concatenate([block.roller_angle[:, row] for block in kept])
    gaps = np.diff(np.concatenate([angle, angle[:, :1] + 2.0 * np.pi], axis=1), axis=1)
    uneven = (gaps - 2.0 * np.pi / bearing.roller_count) * 0.5 * bearing.pitch_diameter
    return (
        float(np.sqrt((offset**2).sum(axis=1).mean())),
        float(np.hypot(centre[:, 0], centre[:, 1]).max()),
        float(speed / nominal),
        float(1.0 - rate / nominal),
        float(np.sqrt((uneven**2).mean())),
    )

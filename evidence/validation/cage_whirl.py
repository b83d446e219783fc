"""Whirl of the cages: how far and how fast their centres go round, by speed and load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.effects import Cage
from beardyn_core.physics.bodies.layout import CAGE_BODY, POSITION
from beardyn_core.physics.cage.parameters import cage_params
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
        How far a cage may go before it meets evenly spaced rollers: half the pocket's clearance across the
        leaning bar, [m].
    radial_play : float
        How far it may go when the rollers make way: until the bars lie on a roller from outside, [m].
    """

    cases: tuple[WhirlCase, ...]
    amplitude: Float
    reach: Float
    frequency: Float
    slip: Float
    spacing: Float
    play: float
    radial_play: float


def cage_whirl(
    scene: Scene,
    cases: Sequence[WhirlCase],
    *,
    duration: float = 1.5,
    settled: float = 0.75,
    start_offset: float = 0.5,
) -> Whirl:
    """Run each case and look at the cage of the row that carries the axial load.

    Parameters
    ----------
    scene : Scene
        Bearing, effects and mounting; its own operation is not used. Its cages must be free.
    cases : sequence of WhirlCase
    duration, settled : float
        Simulated time, and the part of it at the beginning that is not looked at, [s].
    start_offset : float
        Place of the cages' centres at the start, towards +x, over the play: from an even start under axial
        load alone nothing but rounding sets a cage in motion, which takes seconds.

    Returns
    -------
    Whirl
    """
    cage = cage_params(scene, 1e-5)
    if cage is None or not isinstance(scene.effects.cage, Cage):
        raise ValueError("only a free cage whirls; give the scene one under effects")
    play = cage.bar_cosine * cage.half_clearance
    found = np.array([_measures(scene, case, duration, settled, start_offset * play) for case in cases])
    amplitude, reach, frequency, slip, spacing = found.T
    radial_play = play / cage.bar_sine if cage.bar_sine > 0.0 else float("inf")
    return Whirl(tuple(cases), amplitude, reach, frequency, slip, spacing, play, radial_play)


def _measures(
    scene: Scene, case: WhirlCase, duration: float, settled: float, offset_at_start: float
) -> tuple[float, ...]:
    bearing = scene.bearing
    twin = Twin(replace(scene, sensors=()))
    wrench = np.array([0.0, case.axial_load, case.radial_load, 0.0, 0.0, 0.0])
    times = np.array([0, round((duration + 1.0) * 1e9)], dtype=np.int64)
    twin.start(
        LoadHistory(times, np.repeat(wrench[None], 2, 0), np.full(2, case.shaft_speed), np.zeros((2, 3)))
    )
    start = twin.snapshot()
    start.state.bodies[CAGE_BODY:, POSITION] = offset_at_start
    twin.restore(start)
    for _ in range(round(settled * 1e9 / twin.block_ns)):
        twin.advance()
    kept = [twin.advance() for _ in range(round((duration - settled) * 1e9 / twin.block_ns))]
    load = np.linalg.norm(kept[-1].contacts[..., 0, 3:6], axis=-1)
    row = int(np.argmax(load.sum(axis=(0, 2))))
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

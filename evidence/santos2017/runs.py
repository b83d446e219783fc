"""A short run with the force of every time step."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.bodies.layout import SIGNAL_FORCE
from beardyn_core.rail.build import load_history
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin

Float = NDArray[np.float64]

SETTLED = 0.010  # the published force has converged by then [s]
STEP_AT = 0.002  # when the load of ``santos_step`` comes on [s]
_AFTER = 0.1  # of load history beyond the run [s]
_AT_ONCE_NS = 5_000


@dataclass(frozen=True)
class StepRecord:
    """A run with the force of every time step.

    Parameters
    ----------
    scene : Scene
    time : float64 array, shape [step]
        At the end of each step, [s].
    force : float64 array, shape [step, 3]
        Of the inner ring on the rollers: the force on the cup and the weight of rollers and cages; what
        accelerates the rollers is neglected, [N].
    blocks : tuple of Block
    wall_time : float
        Of the time steps and what is observed of them, without compiling, [s].
    """

    scene: Scene
    time: Float
    force: Float
    blocks: tuple[Block, ...]
    wall_time: float

    def radial_after(self, start: float) -> Float:
        """Make a force along z from a time on, [N]."""
        return self.force[self.time >= start, 2]

    def cage_turn(self, duration: float) -> float:
        """Turn of the inboard cage within the first part of the run, [rad]."""
        angle = np.unwrap(np.concatenate([block.cage_angle[:, 0] for block in self.blocks]))
        instants = np.concatenate([block.trend_time_ns for block in self.blocks]) * 1e-9
        last = int(np.searchsorted(instants, duration + 1e-9)) - 1
        return float((angle[last] - angle[0]) / (instants[last] - instants[0]) * duration)

    @property
    def axial_range(self) -> float:
        """Range of the inner ring's place along the axle, [m]."""
        return float(np.ptp(np.concatenate([block.body_pose[:, 1, 1] for block in self.blocks])))


def record(scene: Scene, load: LoadHistory | None = None) -> StepRecord:
    """Run a scene and keep every time step.

    Parameters
    ----------
    scene : Scene
    load : LoadHistory, optional
        The scene's own when left out.

    Returns
    -------
    StepRecord
        Over whole blocks of the twin, at least the scene's duration.
    """
    twin = Twin(scene)
    twin.warm()
    if load is None:
        load = load_history(scene.operation, scene.mounting, scene.duration + _AFTER, scene.seed)
    twin.start(load)
    signals, blocks = [], []
    began = time.perf_counter()
    while twin.next_end_ns * 1e-9 < scene.duration + twin.block_ns * 1e-9 * (1.0 - 1e-6):
        blocks.append(twin.advance())
        signals.append(twin.step_signals.copy())
    wall = time.perf_counter() - began
    force = np.concatenate(signals)[:, SIGNAL_FORCE : SIGNAL_FORCE + 3]
    force[:, 2] += weight_carried(scene)
    instants = np.linspace(0.0, blocks[-1].end_ns * 1e-9, len(force) + 1)[1:]
    return StepRecord(scene, instants, force, tuple(blocks), wall)


def weight_carried(scene: Scene) -> float:
    """Return the weight of rollers and cages, [N]."""
    cages = scene.rows * scene.bearing.cage.mass if scene.effects.cage else 0.0
    gravity = scene.effects.gravity.acceleration if scene.effects.gravity else 0.0
    return gravity * (scene.roller_total * scene.bearing.roller_mass + cages)


def at_once(scene: Scene, force: float, speed: float) -> LoadHistory:
    """Put the radial load on at `STEP_AT` within 5 us, which excites all that can ring.

    Parameters
    ----------
    scene : Scene
        For its duration.
    force : float
        [N].
    speed : float
        Of the shaft, [rad/s].
    """
    start = round(STEP_AT * 1e9)
    end = math.ceil((scene.duration + _AFTER) * 1e9)
    wrench = np.zeros((4, 6))
    wrench[2:, 2] = force
    times = np.array([0, start, start + _AT_ONCE_NS, end])
    return LoadHistory(times, wrench, np.full(4, speed), np.zeros((4, 3)))

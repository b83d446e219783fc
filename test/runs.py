"""Runs of the twin: loads, blocks and their trends; shipped scenes are run once in a process."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.effects import Cage
from beardyn_core.run import blocks
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.scenes import SPEED

Float = NDArray[np.float64]
SETTLED_S = 0.2


@dataclass(frozen=True)
class Record:
    """The trends of a run, 400 Hz, and what its blocks said."""

    scene: Scene
    blocks: tuple[Block, ...]

    @property
    def time(self) -> Float:
        return np.concatenate([block.trend_time_ns for block in self.blocks]) * 1e-9

    def trend(self, name: str) -> Float:
        return np.concatenate([getattr(block, name) for block in self.blocks])

    @property
    def force_waveform(self) -> Float:
        return np.concatenate([block.force_waveform for block in self.blocks])

    @property
    def residual(self) -> float:
        audit = self.blocks[-1].audit
        assert audit is not None
        return audit.residual

    @property
    def status(self) -> int:
        return int(np.bitwise_or.reduce([block.status for block in self.blocks]))

    @property
    def whole_cage_revolutions(self) -> slice:
        """The last whole revolutions of cage 0 after `SETTLED_S`."""
        angle = self.trend("cage_angle")[:, 0]
        settled = int(np.searchsorted(self.time, SETTLED_S))
        turns = math.floor(abs(angle[-1] - angle[settled]) / (2.0 * math.pi))
        assert turns >= 1, "the run is too short for a cage revolution"
        left = np.abs(angle[-1] - angle)
        first = int(np.flatnonzero(left <= 2.0 * math.pi * turns)[0])
        return slice(first, None)

    def mean(self, name: str) -> Float:
        """Over whole cage revolutions."""
        result: Float = self.trend(name)[self.whole_cage_revolutions].mean(axis=0)
        return result

    @property
    def cage_speed_ratio(self) -> Float:
        """Of both rows, over whole cage revolutions; nominal 1."""
        frequencies = fault_frequencies(self.scene.bearing)
        ratio: Float = self.mean("cage_speed") / (frequencies.ftf * float(self.mean("shaft_speed")))
        return ratio


def record(scene: Scene, duration: float) -> Record:
    """Run a scene under its own load."""
    return Record(scene, tuple(blocks(scene, duration)))


@cache
def shipped(name: str, duration: float = 0.6, cage_ratio: float = 1.0, steps_per_sample: int = 4) -> Record:
    """A shipped scene, from another cage speed or with another step."""
    scene = load_scene(name)
    assert isinstance(scene.effects.cage, Cage)
    effects = replace(scene.effects, cage=replace(scene.effects.cage, initial_speed_ratio=cage_ratio))
    numerics = replace(scene.numerics, steps_per_sample=steps_per_sample)
    return record(replace(scene, effects=effects, numerics=numerics), duration)


def constant_load(
    force: tuple[float, float, float], speed: float, duration: float = 10.0, *moment: float
) -> LoadHistory:
    """One load and one speed."""
    wrench = np.array([*force, *(moment or (0.0, 0.0, 0.0))])
    times = np.array([0, round(duration * 1e9)], dtype=np.int64)
    return LoadHistory(times, np.repeat(wrench[None], 2, axis=0), np.full(2, speed), np.zeros((2, 3)))


def stepped_load(points: list[tuple[float, tuple[float, float, float], float]]) -> LoadHistory:
    """Points of time [s], force on the journal [N] and shaft speed [rad/s], linear in between."""
    times = np.array([round(time * 1e9) for time, _, _ in points], dtype=np.int64)
    wrench = np.array([[*force, 0.0, 0.0, 0.0] for _, force, _ in points])
    return LoadHistory(times, wrench, np.array([s for _, _, s in points]), np.zeros((len(points), 3)))


def started(scene: Scene, load: LoadHistory) -> Twin:
    """A twin at t = 0."""
    twin = Twin(scene)
    twin.start(load)
    return twin


def blocks_of(scene: Scene, duration: float) -> tuple[Block, ...]:
    """Blocks of a run."""
    return tuple(blocks(scene, duration))


def advance_blocks(scene: Scene, load: LoadHistory, count: int) -> tuple[Block, ...]:
    """Blocks of a run from balance under a load."""
    twin = started(scene, load)
    return tuple(twin.advance() for _ in range(count))


def record_under(scene: Scene, load: LoadHistory, count: int = 10) -> Record:
    """Run a scene under a load for some blocks."""
    return Record(scene, advance_blocks(scene, load, count))


def wandering_load(samples: int = 801) -> LoadHistory:
    """2 kHz samples of a load and a bogie that move."""
    time = np.arange(samples) * 500_000
    t = time * 1e-9
    wrench = np.zeros((samples, 6), dtype=np.float64)
    wrench[:, 0] = 2e3 * np.sin(2.0 * np.pi * 11.0 * t)
    wrench[:, 1] = 5e3 * np.sin(2.0 * np.pi * 3.0 * t)
    wrench[:, 2] = 7e4 + 2e4 * np.sin(2.0 * np.pi * 37.0 * t)
    bogie = np.zeros((samples, 3))
    bogie[:, 2] = 1e-3 * np.sin(2.0 * np.pi * 5.0 * t)
    speed = np.asarray(SPEED + 2.0 * t, dtype=np.float64)
    return LoadHistory(time.astype(np.int64), wrench, speed, bogie)


def assert_same(one: Block, two: Block) -> None:
    """All but the wall time, to the last bit."""
    others = two.arrays()
    for name, array in one.arrays().items():
        np.testing.assert_array_equal(array, others[name], err_msg=name)
    for field in fields(Block):
        a: Any = getattr(one, field.name)
        if field.name not in ("wall_s", "pictures", "vibration") and not isinstance(a, np.ndarray):
            assert a == getattr(two, field.name), field.name

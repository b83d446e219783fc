"""Runs of the twin that several tests look at; each is made once in a test session."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.effects import Cage
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block

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

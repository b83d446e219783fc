"""From the blocks of a run to its arrays, with the same names, rates and shapes as those of a recording."""

# ruff: noqa: D102 (a method gives the array of `Run` of its name)

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float, Int
from beardyn_core.physics.thermal import NODES
from beardyn_core.record import arrays
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import (
    ACCELERATION_AXES,
    DIAGNOSTICS_EVERY,
    TEMPERATURE_EVERY,
    block_diagnostic,
)
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.sensors.block import Block, Vibration, body_names

_NOTHING = np.zeros(0, np.int64)


class BlockSource:
    """The arrays of a run, put together from its blocks in the order of time."""

    def __init__(self, blocks: Sequence[Block], description: RunDescription | None) -> None:
        self._blocks = blocks
        self._description = description

    def _join_blocks(self, part: Callable[[Block], NDArray[np.generic]]) -> Float:
        """Join an array of all blocks along the time."""
        return np.concatenate([np.asarray(part(block)) for block in self._blocks])

    def _times(self, part: Callable[[Block], Int]) -> Int:
        return np.asarray(self._join_blocks(part), np.int64)

    def force(self) -> arrays.Signal:
        return self._trend(lambda block: block.force, WRENCH_AXES, "N, N m")

    def force_waveform(self) -> arrays.Signal:
        times = self._times(lambda block: block.waveform_time_ns)
        values = self._join_blocks(lambda block: block.force_waveform)
        sample = self._times(lambda block: block.waveform_sample + np.arange(len(block.waveform_time_ns)))
        return arrays.Signal(times, values, WRENCH_AXES, "N, N m", sample)

    def sensors(self) -> dict[str, arrays.Signal]:
        several = list(zip(*(block.vibration for block in self._blocks), strict=True))
        known = self._description
        names = [f"accelerometer_{k}" for k in range(len(several))] if known is None else known.sensor_names
        return {name: _sensor(parts) for name, parts in zip(names, several, strict=False)}

    def specific_force(self) -> arrays.Signal:
        return self._trend(lambda block: block.specific_force, ACCELERATION_AXES, "m/s^2")

    def _trend(self, part: Callable[[Block], Float], components: tuple[str, ...], unit: str) -> arrays.Signal:
        times = self._times(lambda block: block.trend_time_ns)
        return arrays.Signal(times, self._join_blocks(part), components, unit, _NOTHING)

    def shaft(self) -> arrays.Turning:
        times = self._times(lambda block: block.trend_time_ns)
        angle = self._join_blocks(lambda block: block.shaft_angle)
        return arrays.Turning(times, angle, self._join_blocks(lambda block: block.shaft_speed))

    def torque(self) -> arrays.Signal:
        values = self._join_blocks(lambda block: _every(block, block.shaft_torque))
        return arrays.Signal(self._orbit_times(), values, (), "N m", _NOTHING)

    def cages(self) -> arrays.Turning:
        angle = self._join_blocks(lambda block: _every(block, block.cage_angle))
        speed = self._join_blocks(lambda block: _every(block, block.cage_speed))
        return arrays.Turning(self._orbit_times(), angle, speed)

    def rollers(self) -> arrays.Turning:
        angle = self._join_blocks(lambda block: _every(block, block.roller_angle))
        speed = self._join_blocks(lambda block: _every(block, block.roller_speed))
        return arrays.Turning(self._orbit_times(), angle, speed)

    def _orbit_times(self) -> Int:
        return self._times(lambda block: _every(block, block.trend_time_ns))

    def bodies(self) -> arrays.Bodies:
        pose = self._join_blocks(lambda block: block.body_pose)
        twist = self._join_blocks(lambda block: block.body_twist)
        times = self._times(lambda block: block.snapshot_time_ns)
        sample = self._times(lambda block: block.snapshot_sample + np.arange(len(block.snapshot_time_ns)))
        known = self._description
        names = body_names((pose.shape[1] - 4) // 2) if known is None else known.body_names
        return arrays.Bodies(times, names, pose, twist, sample)

    def contacts(self) -> arrays.Contacts:
        times = self._times(lambda block: block.snapshot_time_ns)
        return arrays.contacts_of(times, self._join_blocks(lambda block: block.contacts))

    def load(self) -> arrays.Load:
        """Give `Run.load`: the load history up to the end, or without one the load at 400 Hz."""
        history = None if self._description is None else self._description.load
        if history is None:
            times = self._times(lambda block: block.trend_time_ns)
            wrench = self._join_blocks(lambda block: block.load)
            speed = self._join_blocks(lambda block: block.shaft_speed)
            return arrays.Load(times, wrench, speed, np.zeros((len(times), 3)), np.arange(len(times)))
        used = history.until(self._blocks[-1].end_ns)
        return arrays.Load(used.time_ns, used.wrench, used.shaft_speed, used.bogie, np.arange(len(used)))

    def temperature(self) -> arrays.Signal:
        found = [
            (block.end_ns, block.temperature)
            for block in self._blocks
            if block.temperature is not None and block.index % TEMPERATURE_EVERY == 0
        ]
        values = np.array([values for _, values in found], np.float64).reshape(-1, len(NODES))
        return arrays.Signal(np.array([stamp for stamp, _ in found], np.int64), values, NODES, "K", _NOTHING)

    def diagnostics(self) -> arrays.Diagnostics:
        return tuple(
            (block.end_ns, (block_diagnostic(block),))
            for block in self._blocks
            if block.index % DIAGNOSTICS_EVERY == 0 or block.status != 0
        )

    def results(self) -> arrays.Diagnostics:
        """Give `Run.results`: none, for no monitor ran next to it."""
        return ()

    def plot_values(self) -> dict[str, arrays.Signal]:
        """Give `Run.plot_values`: none, for neither monitor nor follower ran with it."""
        return {}

    def followed(self) -> arrays.Told:
        """Give `Run.followed`: nothing, for no follower ran next to it."""
        return ()

    residuals = followed

    def source_time(self) -> tuple[tuple[int, int], ...]:
        """Give `Run.source_time`: nothing, for stamps are simulated time."""
        return ()

    def duration(self) -> float:
        return (self._blocks[-1].end_ns - self._blocks[0].start_ns) * 1e-9


def _sensor(parts: Sequence[Vibration]) -> arrays.Signal:
    """Join the readings of one accelerometer."""
    times = np.concatenate([part.time_ns for part in parts])
    values = np.concatenate([part.acceleration for part in parts])
    sample = np.concatenate([part.sample + np.arange(len(part.time_ns)) for part in parts])
    return arrays.Signal(times, values, ACCELERATION_AXES, "m/s^2", sample)


def _every(block: Block, values: NDArray[Any]) -> NDArray[Any]:
    """Take every second trend sample of a block, counted over the run: 200 Hz of 400."""
    return values[block.trend_sample % 2 :: 2]

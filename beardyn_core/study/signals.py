"""Channels of a run's blocks joined over time, and windows of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.arrays import Float
from beardyn_core.observe.block import CONTACT_KINDS, Block

_CUP_BODY, _CONE_BODY, _FIRST_ROLLER = 0, 1, 4  # order of `Twin.body_names`
_CUP_CONTACT = CONTACT_KINDS.index("cup")
_FORCE = slice(3, 6)  # of `CONTACT_FIELDS`


@dataclass(frozen=True)
class Signals:
    """Channels of a stretch of a run."""

    trend_time: A[Float, "shape [trend], of the channels at 400 Hz, [s]"]
    force: A[Float, "shape [trend, 3], of the rollers on the cup, [N]"]
    torque: A[Float, "shape [trend], of the bearing on the shaft, [N m]"]
    shaft_angle: A[Float, "shape [trend], [rad]"]
    cage_speed: A[Float, "shape [trend, row], [rad/s]"]
    snapshot_time: A[Float, "shape [snapshot], of the channels at 200 Hz, [s]"]
    deflection: A[Float, "shape [snapshot, 3], of the cone against the cup, [m]"]
    roller_azimuth: A[Float, "shape [snapshot, row, roller], from +z towards +x, [rad]"]
    roller_load: A[Float, "shape [snapshot, row, roller], between cup and roller, [N]"]
    wave_time: A[Float, "shape [sample], of the acceleration, [s]"]
    acceleration: A[Float, "shape [sample, 3], read by the first accelerometer, [m/s^2]"]

    def between(self, start: float, end: float) -> Signals:
        """Cut out the samples from a time to before another one, [s]."""
        trend, snapshot, wave = (
            slice(*np.searchsorted(times, (start - 1e-9, end - 1e-9)))
            for times in (self.trend_time, self.snapshot_time, self.wave_time)
        )
        cuts = 5 * [trend] + 4 * [snapshot] + 2 * [wave]  # in the order of the fields
        return Signals(*(values[cut] for values, cut in zip(vars(self).values(), cuts, strict=True)))


class SignalCollector:
    """Collects the channels of every block that the measures of a run need."""

    def __init__(self) -> None:
        self._parts: list[tuple[NDArray[Any], ...]] = []

    def add(self, block: Block) -> None:
        """Keep the channels of a block."""
        rows, rollers = block.roller_angle.shape[1:]
        pose = block.body_pose
        places = pose[:, _FIRST_ROLLER:, :3] - pose[:, _CUP_BODY, None, :3]
        azimuth = np.arctan2(places[..., 0], places[..., 2]).reshape(-1, rows, rollers)
        self._parts.append(
            (
                block.trend_time_ns * 1e-9,
                block.force[:, :3],
                block.shaft_torque,
                block.shaft_angle,
                block.cage_speed,
                block.snapshot_time_ns * 1e-9,
                pose[:, _CONE_BODY, :3] - pose[:, _CUP_BODY, :3],
                azimuth,
                np.linalg.norm(block.contacts[..., _CUP_CONTACT, _FORCE], axis=-1),
                block.waveform_time_ns * 1e-9,
                block.acceleration[0] if len(block.acceleration) else np.zeros((0, 3)),
            )
        )

    def signals(self) -> Signals:
        """Join all blocks in one piece."""
        return Signals(*(np.concatenate(parts) for parts in zip(*self._parts, strict=True)))

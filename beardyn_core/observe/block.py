"""The block: about 20 ms of every channel, the only thing that crosses a Python boundary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Int = NDArray[np.int64]

CONTACT_KINDS = ("cup", "cone", "rib", "pocket")
CONTACT_FIELDS = ("x", "y", "z", "fx", "fy", "fz", "slip", "film")

# The residual is relative to the losses, but to no less than this [J].
SMALLEST_LOSS = 0.1


@dataclass(frozen=True)
class EnergyAudit:
    """Energy terms since the start of the run, each from its own force times velocity, [J].

    Parameters
    ----------
    external : float
        Work of the load, the shaft drive, gravity and the bogie motion.
    dissipated : float
        Work lost in all sources of `losses`.
    numerical : float
        Dissipation of the time step itself, listed apart.
    stored : float
        Change of kinetic and elastic energy.
    losses : tuple of floats
        The dissipated energy by source, in the order of ``model.layout.LOSS_NAMES``; empty when not told.
    """

    external: float
    dissipated: float
    numerical: float
    stored: float
    losses: tuple[float, ...] = ()

    @property
    def residual(self) -> float:
        """Part of the energy that the audit cannot account for, relative to the dissipation."""
        missing = self.external - self.dissipated - self.numerical - self.stored
        return abs(missing) / max(self.dissipated, SMALLEST_LOSS)


class Later:
    """A member of a block that is worked out at the first look; a function without arguments does it.

    The function must own what it reads: it may be called after the next blocks, and from any thread.
    """

    def __init__(self, function: Callable[[], Float]) -> None:
        self.function = function


def later(function: Callable[[], Float]) -> Float:
    """A `Later`, to hand to `Block` in place of an array."""
    return cast(Any, Later(function))


class _Worked:
    """Descriptor of a block's member that may be a `Later`."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, block: Any, _owner: type) -> Any:
        if block is None:
            return self
        found = block.__dict__[self._name]
        if isinstance(found, Later):
            # two threads may both come here: they work out the same
            found = block.__dict__[self._name] = found.function()
        return found

    def __set__(self, block: Any, given: Any) -> None:
        block.__dict__[self._name] = given


@dataclass(frozen=True)
class Block:
    """One block of simulated time, world axes, SI.

    `body_pose`, `body_twist` and `contacts` are worked out when somebody looks at them.

    Parameters
    ----------
    index : int
        Running number of the block.
    start_ns, end_ns : int
        Simulated time at its first and after its last step, [ns].
    waveform_sample : int
        Running index of the first waveform sample.
    waveform_time_ns : int64 array, shape [sample]
        True time of each waveform sample; the delay of the anti-alias filter is compensated, [ns].
    force_waveform : float64 array, shape [sample, 6]
        Force and moment of the rollers on the cup at the bearing centre, [N, N m].
    acceleration : float64 array, shape [sensor, sample, 3]
        Specific force read by each accelerometer: +g on z at rest, [m/s^2].
    trend_sample : int
        Running index of the first trend sample (400 Hz).
    trend_time_ns : int64 array, shape [trend], [ns]
    force : float64 array, shape [trend, 6], [N, N m]
    load : float64 array, shape [trend, 6]
        Load on the journal, [N, N m].
    specific_force : float64 array, shape [trend, 3]
        First accelerometer decimated for plots, [m/s^2].
    shaft_angle, shaft_speed, shaft_torque : float64 array, shape [trend], [rad, rad/s, N m]
    cage_angle, cage_speed : float64 array, shape [trend, row], [rad, rad/s]
    roller_angle, roller_speed : float64 array, shape [trend, row, roller]
        Orbit angle (from +z towards +x) and speed, [rad, rad/s].
    snapshot_sample : int
        Running index of the first snapshot (200 Hz).
    snapshot_time_ns : int64 array, shape [snapshot], [ns]
    body_pose : float64 array, shape [snapshot, body, 7]
        x, y, z, qx, qy, qz, qw of each body; order of ``Twin.body_names``.
    body_twist : float64 array, shape [snapshot, body, 6]
        vx, vy, vz, wx, wy, wz, [m/s, rad/s].
    contacts : float64 array, shape [snapshot, row, roller, kind, 8]
        For each of `CONTACT_KINDS` the `CONTACT_FIELDS`: point, force of the roller's partner on the
        roller, slip speed and film thickness, [m, N, m/s, m]. No contact: force exactly zero.
    status : int
        Bit flags of `integrate.status`.
    audit : EnergyAudit or None
    wall_s : float
        Wall time the block took to compute, [s].
    temperature : float64 array or None, shape [node]
        Of `model.heat.NODES` at the end of the block, with the thermal effect, [K].
    """

    index: int
    start_ns: int
    end_ns: int
    waveform_sample: int
    waveform_time_ns: Int
    force_waveform: Float
    acceleration: Float
    trend_sample: int
    trend_time_ns: Int
    force: Float
    load: Float
    specific_force: Float
    shaft_angle: Float
    shaft_speed: Float
    shaft_torque: Float
    cage_angle: Float
    cage_speed: Float
    roller_angle: Float
    roller_speed: Float
    snapshot_sample: int
    snapshot_time_ns: Int
    body_pose: Float
    body_twist: Float
    contacts: Float
    status: int
    audit: EnergyAudit | None
    wall_s: float
    temperature: Float | None = None


for _name in ("body_pose", "body_twist", "contacts"):
    setattr(Block, _name, _Worked(_name))

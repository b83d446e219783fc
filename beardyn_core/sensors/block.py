"""The block: 20 ms of every channel, or a multiple of it; nothing else crosses a Python boundary."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Annotated as A
from typing import Protocol

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.physics.thermal import BOX_NODE
from beardyn_core.scene.sensor import RATES

CONTACT_KINDS = ("cup", "cone", "rib", "pocket")
CONTACT_FIELDS = ("x", "y", "z", "fx", "fy", "fz", "slip", "film", "largest")
LARGEST = CONTACT_FIELDS.index("largest")
WATCHED = 3  # kinds whose largest load is kept: all but the pocket

# The residual is relative to the losses, but to no less than this [J].
SMALLEST_LOSS = 0.1


@dataclass(frozen=True)
class EnergyAudit:
    """Energy terms since the start of the run, each from its own force times velocity, [J]."""

    external: A[float, "work of the load, the shaft drive, gravity and the bogie motion"]
    dissipated: A[float, "work lost in all sources of `losses`"]
    numerical: A[float, "dissipation of the time step itself, listed apart"]
    stored: A[float, "change of kinetic and elastic energy"]
    losses: A[
        tuple[float, ...],
        "the dissipated energy by source, in the order of ``bodies.losses.LOSS_NAMES``; empty when not known",
    ] = ()

    @classmethod
    def of(cls, since: Float) -> EnergyAudit:
        """Make the audit from the kernel's sums since the start of the run, shape [ENERGY_TERMS]."""
        lost = since[layout.ENERGY_LOST : layout.ENERGY_LOST + LOSSES]
        return cls(
            external=float(since[layout.ENERGY_EXTERNAL]),
            dissipated=float(lost.sum()),
            numerical=float(since[layout.ENERGY_NUMERICAL]),
            stored=float(since[layout.ENERGY_ELASTIC] + since[layout.ENERGY_KINETIC]),
            losses=tuple(lost.tolist()),
        )

    @property
    def residual(self) -> float:
        """Part of the energy that the audit cannot account for, relative to the dissipation."""
        missing = self.external - self.dissipated - self.numerical - self.stored
        return abs(missing) / max(self.dissipated, SMALLEST_LOSS)


def body_names(roller_count: int) -> tuple[str, ...]:
    """Name the bodies in the order of `Block.body_pose`, for rows of so many rollers."""
    rollers = (f"roller_{row}_{k}" for row in range(2) for k in range(roller_count))
    return ("cup", "cone", "cage_0", "cage_1", *rollers)


class Pictures(Protocol):
    """Bodies and contacts at some instants, computed when first used.

    It must own what it reads: it may be asked after the next blocks, and from any thread.
    """

    def pose(self) -> Float:
        """See `Block.body_pose`."""

    def twist(self) -> Float:
        """See `Block.body_twist`."""

    def contacts(self) -> Float:
        """See `Block.contacts`."""

    def largest_loads(self) -> Float:
        """See `Block.largest_loads`."""


@dataclass(frozen=True)
class Vibration:
    """Readings of one accelerometer during a block."""

    rate: A[float, "[Hz]"]
    sample: A[int, "running index of the first sample"]
    time_ns: A[Int, "shape [sample], true time: the delay of the anti-alias filter is compensated, [ns]"]
    acceleration: A[Float, "shape [sample, 3], specific force: +g on z at rest, [m/s^2]"]


@dataclass(frozen=True)
class Block:
    """One block of simulated time, world axes, SI."""

    index: A[int, "running number of the block, counted in 20 ms; of the first one where it holds several"]
    start_ns: A[int, "simulated time at its first step, [ns]"]
    end_ns: A[int, "after its last step, [ns]"]
    waveform_sample: A[int, "running index of the first waveform sample"]
    waveform_time_ns: A[Int, "shape [sample], true time of the waveform samples, as of `Vibration`, [ns]"]
    force_waveform: A[Float, "shape [sample, 6], rollers on the cup, at the bearing centre, [N, N m]"]
    vibration: A[tuple[Vibration, ...], "of each accelerometer, in the order of the scene"]
    trend_sample: A[int, "running index of the first trend sample (400 Hz)"]
    trend_time_ns: A[Int, "shape [trend], [ns]"]
    force: A[Float, "shape [trend, 6], [N, N m]"]
    load: A[Float, "shape [trend, 6], load on the journal, [N, N m]"]
    specific_force: A[Float, "shape [trend, 3], first accelerometer decimated for plots, [m/s^2]"]
    shaft_angle: A[Float, "shape [trend], [rad]"]
    shaft_speed: A[Float, "shape [trend], [rad/s]"]
    shaft_torque: A[Float, "shape [trend], [N m]"]
    cage_angle: A[Float, "shape [trend, row], [rad]"]
    cage_speed: A[Float, "shape [trend, row], [rad/s]"]
    roller_angle: A[Float, "shape [trend, row, roller], orbit angle from +z towards +x, [rad]"]
    roller_speed: A[Float, "shape [trend, row, roller], orbit speed, [rad/s]"]
    snapshot_sample: A[int, "running index of the first snapshot (200 Hz)"]
    snapshot_time_ns: A[Int, "shape [snapshot], [ns]"]
    pictures: A[Pictures, "bodies and contacts: see `body_pose`, `body_twist` and `contacts`"]
    status: A[int, "bit flags of `physics.tiers.status`"]
    audit: EnergyAudit | None
    wall_s: A[float, "wall time the block took to compute, [s]"]
    temperature: A[
        Float | None,
        "shape [node], of `physics.thermal.NODES` at the end of the block, with the thermal effect, [K]",
    ] = None

    def __repr__(self) -> str:
        """Give number, time and what it holds, in one line."""
        rates = ", ".join(f"{each.rate / 1e3:g} kHz" for each in self.vibration)
        return (
            f"Block {self.index}: {self.start_ns * 1e-9:.2f} to {self.end_ns * 1e-9:.2f} s, "
            f"{len(self.trend_time_ns)} trend samples, {len(self.snapshot_time_ns)} snapshots, "
            f"sensors: {rates or 'none'}, status {self.status}"
        )

    def arrays(self) -> dict[str, Float | Int]:
        """List every array by its name, those included that are computed when they are first used."""
        every = {field.name: getattr(self, field.name) for field in fields(self)}
        found = {name: value for name, value in every.items() if isinstance(value, np.ndarray)}
        found |= {name: getattr(self, name) for name in ("body_pose", "body_twist", "contacts")}
        for number, vibration in enumerate(self.vibration):
            found[f"vibration {number}"], found[f"vibration {number}, time"] = (
                vibration.acceleration,
                vibration.time_ns,
            )
        return found

    def later(self, by_ns: int) -> Block:
        """Shift all its times, as to those of another clock, [ns]; the indices stay."""
        if by_ns == 0:
            return self
        return replace(
            self,
            start_ns=self.start_ns + by_ns,
            end_ns=self.end_ns + by_ns,
            waveform_time_ns=self.waveform_time_ns + by_ns,
            vibration=tuple(replace(each, time_ns=each.time_ns + by_ns) for each in self.vibration),
            trend_time_ns=self.trend_time_ns + by_ns,
            snapshot_time_ns=self.snapshot_time_ns + by_ns,
        )

    @cached_property
    def acceleration(self) -> Float:
        """Readings at `waveform_time_ns`, of the accelerometers but those at 51.2 kHz, as the scene has them.

        Shape [sensor, sample, 3], [m/s^2].
        """
        vibration = [each.acceleration for each in self.vibration if each.rate <= RATES[0]]
        return np.stack(vibration) if vibration else np.empty((0, len(self.waveform_time_ns), 3))

    @property
    def box_temperature(self) -> float | None:
        """Temperature of the axlebox at the end of the block, without the thermal effect none, [K]."""
        return None if self.temperature is None else float(self.temperature[BOX_NODE])

    @property
    def largest_loads(self) -> Float:
        """Largest loads of any roller with cup, cone and rib in any step of the block, shape [3], [N]."""
        return self.pictures.largest_loads()

    # two threads may both come to what follows: they work out the same

    @cached_property
    def body_pose(self) -> Float:
        """Place and orientation of each body, shape [snapshot, body, 7].

        x, y, z, qx, qy, qz, qw in the order of ``Twin.body_names``.
        """
        return self.pictures.pose()

    @cached_property
    def body_twist(self) -> Float:
        """Motion of each body, shape [snapshot, body, 6]: vx, vy, vz, wx, wy, wz, [m/s, rad/s]."""
        return self.pictures.twist()

    @cached_property
    def contacts(self) -> Float:
        """Contacts of each roller, shape [snapshot, row, roller, kind, 9].

        For each of `CONTACT_KINDS` the `CONTACT_FIELDS`: point, force of the roller's partner on the
        roller, slip speed and film thickness, [m, N, m/s, m]; no contact: all exactly zero. Then the largest
        load in any step since the snapshot before, [N]; of pockets it is not kept: 0.
        """
        return self.pictures.contacts()

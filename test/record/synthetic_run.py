"""A kinematically right run without dynamics: blocks to feed the recording room with.

Rollers and cages move as pure rolling demands; loads follow a load zone at the top of the cup; the
accelerometer receives every roller that passes the middle of a cup spall.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from beardyn_core.record.description import BearingShape, RunDescription
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.patch import Patch
from beardyn_core.sensors.block import CONTACT_FIELDS, CONTACT_KINDS, Block, EnergyAudit, Vibration
from test.arrays import quaternion_product

SHAPE = BearingShape(
    name="HS130x230",
    roller_count=17,
    pitch_diameter=0.185,
    roller_diameter=0.0267,
    roller_length=0.052,
    contact_angle=np.deg2rad(10.5),
    row_spacing=0.075,
    bore=0.130,
    outer_diameter=0.230,
    width=0.160,
    rib_contact_height=0.0025,
)
SIDE = (-1.0, 1.0)
BLOCK_NS = 20_000_000
WAVEFORM_HZ = 25_600.0


def body_names(roller_count: int) -> tuple[str, ...]:
    rollers = (f"roller_{row}_{k}" for row in range(2) for k in range(roller_count))
    return ("cup", "cone", "cage_0", "cage_1", *rollers)


def description(duration: float = 1.0, sensors: tuple[str, ...] = ("axlebox_top",)) -> RunDescription:
    time_ns = np.arange(0, round(duration * 2000) + 1, dtype=np.int64) * 500_000
    wrench = np.zeros((len(time_ns), 6))
    wrench[:, 2] = 80e3 + 5e3 * np.sin(2 * np.pi * 3.0 * time_ns * 1e-9)
    load = LoadHistory(time_ns, wrench, np.full(len(time_ns), 120.0), np.zeros((len(time_ns), 3)))
    frequencies = SHAPE.fault_frequencies
    return RunDescription(
        scene="synthetic",
        scene_text="name: synthetic\nbearing: HS130x230\n",
        shape=SHAPE,
        body_names=body_names(SHAPE.roller_count),
        sensor_names=sensors,
        defects=(Patch("cup", 0, 0.0, 0.012, 2e-4, 0.02),),
        truth={
            "scene": "synthetic",
            "faults": [{"on": "cup", "row": 0}],
            "fault_frequencies_per_rev": frequencies,
            "seed": 1,
            "effects": ["gravity"],
        },
        load=load,
    )


class Taken:
    """Pictures that are there already."""

    def __init__(self, pose: np.ndarray, twist: np.ndarray, contacts: np.ndarray) -> None:
        self._parts = pose, twist, contacts

    def pose(self) -> np.ndarray:
        return self._parts[0]

    def twist(self) -> np.ndarray:
        return self._parts[1]

    def contacts(self) -> np.ndarray:
        return self._parts[2]

    def largest_loads(self) -> np.ndarray:
        found: np.ndarray = self._parts[2][..., :3, -1].max(axis=(0, 1, 2))
        return found


class SyntheticRun:
    """Blocks of pure rolling at a constant shaft speed.

    Parameters
    ----------
    shaft_speed : float
        [rad/s].
    sensor_count : int
    seed : int
        Of the sensor noise.
    """

    def __init__(self, shaft_speed: float = 120.0, sensor_count: int = 1, seed: int = 1) -> None:
        self.shaft_speed = shaft_speed
        self.sensor_count = sensor_count
        self._random = np.random.default_rng(seed)
        self._cage_ratio = np.sin(SHAPE.cone_angle) / (np.sin(SHAPE.cone_angle) + np.sin(SHAPE.cup_angle))
        self._spin_ratio = np.sin(SHAPE.cup_angle) / np.sin(SHAPE.half_angle)

    def blocks(self, count: int) -> Iterator[Block]:
        for index in range(count):
            yield self.block(index)

    def block(self, index: int) -> Block:
        start = index * BLOCK_NS
        waveform_sample, trend_sample, snapshot_sample = 512 * index, 8 * index, 4 * index
        waveform_ns = np.round((waveform_sample + np.arange(512)) * 1e9 / WAVEFORM_HZ).astype(np.int64)
        trend_ns = (trend_sample + np.arange(8, dtype=np.int64)) * 2_500_000
        snapshot_ns = (snapshot_sample + np.arange(4, dtype=np.int64)) * 5_000_000
        waveform, trend = waveform_ns * 1e-9, trend_ns * 1e-9
        angle = self._orbit(trend)
        cage_speed = self._cage_ratio * self.shaft_speed
        acceleration = np.stack([self._acceleration(waveform) for _ in range(self.sensor_count)])
        pose, twist, contacts = self._snapshots(snapshot_ns * 1e-9)
        return Block(
            index=index,
            start_ns=start,
            end_ns=start + BLOCK_NS,
            waveform_sample=waveform_sample,
            waveform_time_ns=waveform_ns,
            force_waveform=self._force(waveform),
            vibration=tuple(
                Vibration(WAVEFORM_HZ, waveform_sample, waveform_ns, values) for values in acceleration
            ),
            trend_sample=trend_sample,
            trend_time_ns=trend_ns,
            force=self._force(trend),
            load=self._force(trend),
            specific_force=acceleration[0, ::64],
            shaft_angle=np.asarray(self.shaft_speed * trend, np.float64),
            shaft_speed=np.full(8, self.shaft_speed),
            shaft_torque=np.full(8, -5.0),
            cage_angle=np.repeat(cage_speed * trend[:, None], 2, axis=1),
            cage_speed=np.full((8, 2), cage_speed) * (1.0 + 0.002 * np.sin(40 * trend[:, None])),
            roller_angle=np.repeat(angle[:, None, :], 2, axis=1),
            roller_speed=np.full((8, 2, SHAPE.roller_count), cage_speed),
            snapshot_sample=snapshot_sample,
            snapshot_time_ns=snapshot_ns,
            pictures=Taken(pose, twist, contacts),
            status=0,
            audit=EnergyAudit(10.0 * (index + 1), 9.99 * (index + 1), 0.0, 0.0),
            wall_s=0.02,
        )

    def _orbit(self, time: np.ndarray) -> np.ndarray:
        start = 2 * np.pi * np.arange(SHAPE.roller_count) / SHAPE.roller_count
        return start + self._cage_ratio * self.shaft_speed * time[:, None]

    @staticmethod
    def _roller_load(angle: np.ndarray, time: np.ndarray) -> np.ndarray:
        zone = np.maximum(1.0 - (1.0 - np.cos(angle)) / 0.9, 0.0)
        return 9.8e3 * (1.0 + 0.08 * np.sin(2 * np.pi * 3.0 * time))[:, None] * zone ** (10.0 / 9.0)

    def _force(self, time: np.ndarray) -> np.ndarray:
        angle = self._orbit(time)
        load = self._roller_load(angle, time)
        force = np.zeros((len(time), 6))
        force[:, 0] = 2 * np.sum(load * np.sin(angle), axis=1)
        force[:, 2] = 2 * np.sum(load * np.cos(angle), axis=1)
        return force

    def _acceleration(self, time: np.ndarray) -> np.ndarray:
        passing = self._cage_ratio * self.shaft_speed * SHAPE.roller_count / (2 * np.pi)
        since = np.mod(time * passing, 1.0) / passing
        burst = 60.0 * np.exp(-since / 8e-4) * np.sin(2 * np.pi * 3400.0 * since)
        signal = self._random.normal(0.0, 1.5, (len(time), 3))
        signal[:, 2] += 9.80665 + burst
        return signal

    def _snapshots(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        count, bodies = SHAPE.roller_count, 4 + 2 * SHAPE.roller_count
        pose, twist = np.zeros((len(time), bodies, 7)), np.zeros((len(time), bodies, 6))
        contacts = np.zeros((len(time), 2, count, len(CONTACT_KINDS), len(CONTACT_FIELDS)))
        cage_speed = self._cage_ratio * self.shaft_speed
        pose[..., 6] = 1.0
        for body, speed in ((1, self.shaft_speed), (2, cage_speed), (3, cage_speed)):
            pose[:, body, 3:] = _quaternion(np.array([0.0, 1.0, 0.0]), speed * time)
            twist[:, body, 4] = speed
        pose[:, 2, 1], pose[:, 3, 1] = -SHAPE.row_spacing / 2, SHAPE.row_spacing / 2
        angle = self._orbit(time)
        load = self._roller_load(angle, time)
        radial = np.stack((np.sin(angle), np.zeros_like(angle), np.cos(angle)), axis=-1)
        tangent = np.stack((np.cos(angle), np.zeros_like(angle), -np.sin(angle)), axis=-1)
        for row, side in enumerate(SIDE):
            axial = np.array([0.0, side, 0.0])
            along = radial * np.sin(SHAPE.contact_angle) + axial * np.cos(SHAPE.contact_angle)
            outward = radial * np.cos(SHAPE.contact_angle) - axial * np.sin(SHAPE.contact_angle)
            spin = -side * self._spin_ratio * cage_speed
            here = slice(4 + row * count, 4 + (row + 1) * count)
            centre = radial * SHAPE.pitch_diameter / 2 + axial * SHAPE.row_spacing / 2
            frame = np.stack((along, np.cross(outward, along), outward), axis=-1)
            pose[:, here, :3] = centre
            turned = _quaternion(np.array([1.0, 0.0, 0.0]), spin * time)[:, None, :]
            pose[:, here, 3:] = quaternion_product(
                _quaternion_of(frame), np.broadcast_to(turned, (*angle.shape, 4))
            )
            twist[:, here, :3] = tangent * cage_speed * SHAPE.pitch_diameter / 2
            twist[:, here, 3:] = along * spin + np.array([0.0, cage_speed, 0.0])
            for kind, sign, tilt in ((0, 1.0, SHAPE.half_angle), (1, -1.0, -SHAPE.half_angle)):
                normal = outward * np.cos(tilt) - sign * along * np.sin(abs(tilt))
                contacts[:, row, :, kind, :3] = centre + sign * normal * SHAPE.roller_diameter / 2
                contacts[:, row, :, kind, 3:6] = -sign * normal * load[..., None]
                contacts[:, row, :, kind, 6] = 0.02
                contacts[:, row, :, kind, 7] = 1e-6
            rib = centre + along * SHAPE.roller_length / 2 - outward * 0.011
            contacts[:, row, :, 2, :3] = rib
            contacts[:, row, :, 2, 3:6] = -along * 0.052 * load[..., None]
        return pose, twist, contacts


def _quaternion(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    half = 0.5 * angle[..., None]
    return np.concatenate((np.sin(half) * axis, np.cos(half)), axis=-1)


def _quaternion_of(frame: np.ndarray) -> np.ndarray:
    """Quaternion of rotation matrices; through the eigenvector that stays exact at every angle."""
    m = frame
    k = np.empty((*m.shape[:-2], 4, 4))
    k[..., 0, :] = np.stack(
        (
            m[..., 0, 0] - m[..., 1, 1] - m[..., 2, 2],
            m[..., 0, 1] + m[..., 1, 0],
            m[..., 0, 2] + m[..., 2, 0],
            m[..., 2, 1] - m[..., 1, 2],
        ),
        axis=-1,
    )
    k[..., 1, 1:] = np.stack(
        (
            m[..., 1, 1] - m[..., 0, 0] - m[..., 2, 2],
            m[..., 1, 2] + m[..., 2, 1],
            m[..., 0, 2] - m[..., 2, 0],
        ),
        axis=-1,
    )
    k[..., 2, 2:] = np.stack(
        (m[..., 2, 2] - m[..., 0, 0] - m[..., 1, 1], m[..., 1, 0] - m[..., 0, 1]), axis=-1
    )
    k[..., 3, 3] = m[..., 0, 0] + m[..., 1, 1] + m[..., 2, 2]
    return np.linalg.eigh(k, UPLO="U")[1][..., -1]

"""A block as the messages of the topic table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Int
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.thermal import NODES
from beardyn_core.record.clouds import CloudTemplate, column_dtype, fill, points_of
from beardyn_core.record.messages import Diagnostic, Template, header, make
from beardyn_core.record.topics import FRAME, IMU, JOINTS, TEMPERATURE, WRENCH, vibration_topic
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.sensors.block import CONTACT_FIELDS, LARGEST, Block, EnergyAudit
from beardyn_core.sensors.summary import NUMERICAL

TEMPERATURE_EVERY = 10  # blocks
DIAGNOSTICS_EVERY = 10
USUAL_NAME = "beardyn twin"
POSE_AXES = ("x", "y", "z", "qx", "qy", "qz", "qw")
ACCELERATION_AXES = ("ax", "ay", "az")
TWIST_AXES = ("vx", "vy", "vz", "wx", "wy", "wz")
WAVEFORM = column_dtype(tuple((axis, "f4") for axis in WRENCH_AXES))
VIBRATION = column_dtype(tuple((axis, "f4") for axis in ACCELERATION_AXES))
BODIES = column_dtype((("body", "u2"), *((n, "f4") for n in POSE_AXES + TWIST_AXES)))
CONTACTS = column_dtype(
    (("row", "u1"), ("roller", "u1"), ("kind", "u1"), *((name, "f4") for name in CONTACT_FIELDS))
)


def _vector(values: NDArray[np.float64]) -> Any:
    return make("geometry_msgs/msg/Vector3", x=values[0], y=values[1], z=values[2])


def force_template(frame: str) -> Template:
    """Prepare messages of ``force``: slot ``wrench``."""

    def build(wrench: NDArray[np.float64]) -> Any:
        content = make("geometry_msgs/msg/Wrench", force=_vector(wrench[:3]), torque=_vector(wrench[3:]))
        return make(WRENCH, header=header(0, frame), wrench=content)

    return Template(build, {"wrench": 6})


def imu_template(frame: str) -> Template:
    """Prepare messages of ``imu``: slot ``acceleration``; orientation and rate are marked as not known.

    References
    ----------
    REP-145: specific force in the frame of the sensor; the first covariance of what is not measured is -1.
    """
    unknown = np.zeros(9)
    unknown[0] = -1.0

    def build(acceleration: NDArray[np.float64]) -> Any:
        return make(
            IMU,
            header=header(0, frame),
            orientation=make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=0.0, w=1.0),
            orientation_covariance=unknown,
            angular_velocity=_vector(np.zeros(3)),
            angular_velocity_covariance=unknown,
            linear_acceleration=_vector(acceleration),
            linear_acceleration_covariance=np.zeros(9),
        )

    return Template(build, {"acceleration": 3})


def temperature_template(frame: str) -> Template:
    """Prepare messages of ``temperature`` of the part that the frame names: slot ``celsius``."""

    def build(celsius: NDArray[np.float64]) -> Any:
        return make(TEMPERATURE, header=header(0, frame), temperature=celsius[0], variance=0.0)

    return Template(build, {"celsius": 1})


def joint_template(names: tuple[str, ...], frame: str, effort: bool) -> Template:
    """Prepare messages of joint states: slots ``position``, ``velocity`` and, when asked for, ``effort``."""
    slots = {"position": len(names), "velocity": len(names), **({"effort": len(names)} if effort else {})}

    def build(**numbers: NDArray[np.float64]) -> Any:
        return make(
            JOINTS,
            header=header(0, frame),
            name=list(names),
            position=numbers["position"],
            velocity=numbers["velocity"],
            effort=numbers.get("effort", np.zeros(0)),
        )

    return Template(build, slots)


SHAFT_JOINT = ("shaft",)


def orbit_joints(roller_count: int) -> tuple[str, ...]:
    """List the joint names of ``joint_states``."""
    rollers = (f"roller_{row}_{k}" for row in range(2) for k in range(roller_count))
    return ("cage_0", "cage_1", *rollers, "shaft")


class Batch(NamedTuple):
    """Messages of one topic in the order of time, all of the same length."""

    topic: A[str, "its name in the table"]
    stamps_ns: A[Int, "shape [message], [ns]"]
    rows: A[NDArray[np.uint8], "CDR, shape [message, byte]"]


def single(topic: str, stamp_ns: int, cdr: bytes) -> Batch:
    """Make a batch of one message."""
    return Batch(topic, np.array([stamp_ns], np.int64), np.frombuffer(cdr, np.uint8)[None])


class BlockEncoder:
    """Blocks of one run as CDR messages of the topic table.

    Parameters
    ----------
    roller_count : int
        Rollers per row.
    sensor_names : tuple of str
        Accelerometers, in the order of `Block.vibration`.
    frame : str
        Frame of every header; accelerometers and parts have theirs below it, ``<frame>/<sensor>``.
    """

    def __init__(self, roller_count: int, sensor_names: tuple[str, ...], frame: str = FRAME) -> None:
        self._rollers = 2 * roller_count
        self._sensor_names = sensor_names
        self._force = force_template(frame)
        frames = [f"{frame}/{name}" for name in sensor_names]
        self._imu = imu_template(frames[0] if frames else frame)
        self._shaft = joint_template(SHAFT_JOINT, frame, effort=False)
        self._joints = joint_template(orbit_joints(roller_count), frame, effort=True)
        self._waveform = CloudTemplate(WAVEFORM, frame)
        self._vibration = [CloudTemplate(VIBRATION, each) for each in frames]
        self._bodies = CloudTemplate(BODIES, frame)
        self._contacts = CloudTemplate(CONTACTS, frame)
        self._temperatures = [temperature_template(f"{frame}/{node}") for node in NODES]

    def encode(self, block: Block, pictures: bool = True) -> Iterator[tuple[str, int, bytes]]:
        """Encode a block as messages: topic name, stamp [ns], CDR bytes; each topic in the order of time."""
        for batch in self.batches(block, pictures):
            for stamp, row in zip(batch.stamps_ns.tolist(), batch.rows, strict=True):
                yield batch.topic, stamp, row.tobytes()

    def batches(self, block: Block, pictures: bool = True) -> Iterator[Batch]:
        """Encode a block as messages, those of a topic together; bodies and contacts if asked for."""
        if len(block.trend_time_ns):
            yield from self._trend(block)
        if len(block.waveform_time_ns):
            yield from self._waveforms(block)
        if pictures and len(block.snapshot_time_ns):
            yield from self._snapshots(block)
        if block.temperature is not None and block.index % TEMPERATURE_EVERY == 0:
            stamp = np.array([block.end_ns], dtype=np.int64)
            for template, kelvin in zip(self._temperatures, block.temperature, strict=True):
                yield Batch(
                    "temperature", stamp, template.rows(stamp, celsius=np.array([[kelvin - ZERO_CELSIUS]]))
                )

    def _trend(self, block: Block) -> Iterator[Batch]:
        times = block.trend_time_ns
        turned, turning = block.shaft_angle[:, None], block.shaft_speed[:, None]
        yield Batch("force", times, self._force.rows(times, wrench=block.force))
        yield Batch("imu", times, self._imu.rows(times, acceleration=block.specific_force))
        yield Batch("shaft", times, self._shaft.rows(times, position=turned, velocity=turning))
        every = slice(block.trend_sample % 2, None, 2)
        count = len(times[every])
        position, velocity = (
            np.hstack((cages[every], rollers[every].reshape(count, self._rollers), shaft[every, None]))
            for cages, rollers, shaft in (
                (block.cage_angle, block.roller_angle, block.shaft_angle),
                (block.cage_speed, block.roller_speed, block.shaft_speed),
            )
        )
        effort = np.zeros_like(position)
        effort[:, -1] = block.shaft_torque[every]
        rows = self._joints.rows(times[every], position=position, velocity=velocity, effort=effort)
        yield Batch("joint_states", times[every], rows)

    def _waveforms(self, block: Block) -> Iterator[Batch]:
        times = block.waveform_time_ns
        stamp = int(times[0])
        points = points_of(WAVEFORM, block.waveform_sample, times, stamp)
        fill(points, WRENCH_AXES, block.force_waveform)
        yield single("force_waveform", stamp, self._waveform.encode(points, stamp))
        for sensor, vibration in enumerate(block.vibration):
            if not len(vibration.time_ns):
                continue
            stamp = int(vibration.time_ns[0])
            points = points_of(VIBRATION, vibration.sample, vibration.time_ns, stamp)
            fill(points, ACCELERATION_AXES, vibration.acceleration)
            cdr = self._vibration[sensor].encode(points, stamp)
            yield single(vibration_topic(sensor, self._sensor_names), stamp, cdr)

    def _snapshots(self, block: Block) -> Iterator[Batch]:
        times = block.snapshot_time_ns
        stamp = int(times[0])
        bodies = block.body_pose.shape[1]
        points = points_of(BODIES, 0, np.repeat(times, bodies), stamp)
        samples = (block.snapshot_sample + np.arange(len(times))) & 0xFFFFFFFF
        points["sample"] = np.repeat(samples, bodies)
        points["body"] = np.tile(np.arange(bodies), len(times))
        numbers = np.concatenate((block.body_pose, block.body_twist), axis=2).reshape(-1, 13)
        fill(points, POSE_AXES + TWIST_AXES, numbers)
        yield single("bodies", stamp, self._bodies.encode(points, stamp))

        contacts = block.contacts
        pressed = (contacts[..., 3:6] != 0.0).any(axis=-1) | (contacts[..., LARGEST] > 0.0)
        snapshot, row, roller, kind = np.nonzero(pressed)
        points = points_of(CONTACTS, 0, times[snapshot], stamp)
        points["sample"] = samples[snapshot]
        points["row"], points["roller"], points["kind"] = row, roller, kind
        fill(points, CONTACT_FIELDS, contacts[pressed])
        yield single("contacts", stamp, self._contacts.encode(points, stamp))


def block_diagnostic(block: Block, name: str = USUAL_NAME) -> Diagnostic:
    """Report how a block was computed: real-time factor, status bits, energy residual, losses by source."""
    span = (block.end_ns - block.start_ns) * 1e-9
    values = [
        ("block", str(block.index)),
        ("real_time_factor", f"{span / max(block.wall_s, 1e-9):.4g}"),
        ("status", str(block.status)),
    ]
    if block.audit is not None:
        values.append(("energy_residual", f"{block.audit.residual:.3e}"))
        values += _losses(block.audit)
    sentence = "running" if block.status == 0 else f"the model left its validity, status {block.status}"
    return Diagnostic(name, 0 if block.status == 0 else 2, sentence, tuple(values))


def loss_key(source: str) -> str:
    """Name the diagnostic key of the energy lost in a source since the start of the run."""
    return f"lost_{source}_J"


def _losses(audit: EnergyAudit) -> list[tuple[str, str]]:
    """List the energy lost by source up to the start of the block, [J]; sources without loss are left out."""
    if not audit.losses:
        return []
    lost = (*zip(LOSS_NAMES, audit.losses, strict=True), (NUMERICAL, audit.numerical))
    return [(loss_key(source), f"{energy:.9g}") for source, energy in lost if energy != 0.0]

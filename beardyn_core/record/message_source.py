"""The arrays of a run, decoded from its messages when they are first used."""

# ruff: noqa: D102 (a method gives the array of `Run` of its name)

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.physics.thermal import NODES
from beardyn_core.record import arrays
from beardyn_core.record.clouds import cloud_times, cloud_to_arrays
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import (
    ACCELERATION_AXES,
    POSE_AXES,
    TWIST_AXES,
    force_template,
    imu_template,
    joint_template,
)
from beardyn_core.record.load_stream import decode_load, joined_load
from beardyn_core.record.messages import (
    Template,
    decode,
    decode_diagnostics,
    decode_told,
    header_stamp,
    time_reference,
)
from beardyn_core.record.plot_values import BOUNDS, VALUES, VECTOR, vector_template
from beardyn_core.record.topics import IMU, JOINTS, TEMPERATURE, WRENCH, vibration_topic
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.sensors.block import CONTACT_FIELDS, CONTACT_KINDS, LARGEST

ROWS = 2


class MessageSource:
    """The arrays of a run, decoded from its messages.

    Parameters
    ----------
    sensor_names : tuple of str
        Accelerometers of a run without a description, in the order of their topics.
    box : str
        Name of one axlebox of several, whose diagnostics begin with it.
    """

    def __init__(
        self,
        cdrs: Mapping[str, Sequence[bytes]],
        description: RunDescription | None,
        sensor_names: tuple[str, ...] = (),
        box: str = "",
    ) -> None:
        self._cdrs, self._box = cdrs, box
        self._description = description
        self._sensor_names = sensor_names if description is None else description.sensor_names

    def _of(self, name: str) -> Sequence[bytes]:
        return self._cdrs.get(name, ())

    def force(self) -> arrays.Signal:
        return _stamped_signal(
            self._of("force"), WRENCH, force_template, "wrench", wrench_values, WRENCH_AXES, "N, N m"
        )

    def force_waveform(self) -> arrays.Signal:
        return _waveform(self._of("force_waveform"), WRENCH_AXES, "N, N m")

    def sensors(self) -> dict[str, arrays.Signal]:
        known = self._sensor_names
        topics = {vibration_topic(number, known): name for number, name in enumerate(known)}
        found = sorted(n for n in self._cdrs if n == "vibration" or n.startswith("vibration/"))
        order = [name for name in topics if name in found] + [name for name in found if name not in topics]
        return {
            topics.get(name, name.rpartition("/")[2]): _waveform(self._of(name), ACCELERATION_AXES, "m/s^2")
            for name in order
            if self._of(name)
        }

    def specific_force(self) -> arrays.Signal:
        return _stamped_signal(
            self._of("imu"), IMU, imu_template, "acceleration", _imu_values, ACCELERATION_AXES, "m/s^2"
        )

    def shaft(self) -> arrays.Turning:
        joints = _joints(self._of("shaft"))
        column = slice(0, 1) if joints.names else slice(0)
        return arrays.Turning(
            joints.time_ns, joints.position[:, column].ravel(), joints.velocity[:, column].ravel()
        )

    @cached_property
    def _orbit(self) -> _Joints:
        return _joints(self._of("joint_states"))

    def torque(self) -> arrays.Signal:
        orbit, nothing = self._orbit, np.zeros(0, np.int64)
        if "shaft" not in orbit.names or not orbit.effort.shape[1]:
            return arrays.no_signal((), "N m")
        return arrays.Signal(orbit.time_ns, orbit.effort[:, orbit.names.index("shaft")], (), "N m", nothing)

    def cages(self) -> arrays.Turning:
        orbit = self._orbit
        columns = [orbit.names.index(name) for name in ("cage_0", "cage_1") if name in orbit.names]
        if not len(orbit.time_ns):
            return arrays.Turning(orbit.time_ns, np.zeros((0, ROWS)), np.zeros((0, ROWS)))
        return arrays.Turning(orbit.time_ns, orbit.position[:, columns], orbit.velocity[:, columns])

    def rollers(self) -> arrays.Turning:
        orbit = self._orbit
        columns = [k for k, name in enumerate(orbit.names) if name.startswith("roller_")]
        shape = (len(orbit.time_ns), ROWS, len(columns) // ROWS)
        return arrays.Turning(
            orbit.time_ns,
            orbit.position[:, columns].reshape(shape),
            orbit.velocity[:, columns].reshape(shape),
        )

    @cached_property
    def _bodies(self) -> arrays.Bodies:
        points, time_ns = _clouds(self._of("bodies"))
        names = () if self._description is None else self._description.body_names
        if not len(points):
            nothing = np.zeros(0, np.int64)
            return arrays.Bodies(
                nothing, names, np.zeros((0, len(names), 7)), np.zeros((0, len(names), 6)), nothing
            )
        count = int(points["body"].max()) + 1
        numbers = _columns(points, POSE_AXES + TWIST_AXES).reshape(-1, count, 13)
        return arrays.Bodies(
            time_ns[::count],
            names or tuple(f"body_{k}" for k in range(count)),
            numbers[..., :7],
            numbers[..., 7:],
            points["sample"][::count].astype(np.int64),
        )

    def bodies(self) -> arrays.Bodies:
        return self._bodies

    def contacts(self) -> arrays.Contacts:
        """Give `Run.contacts`, at the snapshots of the bodies where the file has them."""
        points, time_ns = _clouds(self._of("contacts"))
        sample, times = self._bodies.sample, self._bodies.time_ns
        if not len(sample) and len(points):
            found, first = np.unique(points["sample"], return_index=True)
            sample, times = found.astype(np.int64), time_ns[first]
        rollers = 0 if self._description is None else self._description.roller_count
        if not rollers and len(points):
            rollers = int(points["roller"].max()) + 1
        shape = (len(sample), ROWS, rollers, len(CONTACT_KINDS), len(CONTACT_FIELDS))
        numbers = np.zeros(shape)
        fields = [name for name in CONTACT_FIELDS if name in (points.dtype.names or CONTACT_FIELDS)]
        if len(points) and len(sample):
            place = np.minimum(np.searchsorted(sample, points["sample"]), len(sample) - 1)
            known = sample[place] == points["sample"]
            here = points[known]
            there = place[known], here["row"], here["roller"], here["kind"], slice(len(fields))
            numbers[there] = _columns(here, fields)
        numbers[..., len(fields) :] = np.nan  # earlier versions have not the largest load
        numbers[~np.isin(sample, points["sample"]), ..., LARGEST] = np.nan  # a message that is missing
        return arrays.contacts_of(times, numbers)

    def load(self) -> arrays.Load:
        parts = [decode_load(cdr) for cdr in self._of("load/blocks")]
        load = joined_load([part for part, _ in parts])
        sample = np.concatenate([np.zeros(0, np.int64), *(sample for _, sample in parts)])
        return arrays.Load(load.time_ns, load.wrench, load.shaft_speed, load.bogie, sample)

    def temperature(self) -> arrays.Signal:
        """Give `Run.temperature`: one sample where all parts have one."""
        found: dict[int, dict[str, float]] = defaultdict(dict)
        for cdr in self._of("temperature"):
            message = decode(TEMPERATURE, cdr)
            part = message.header.frame_id.rpartition("/")[2]
            found[header_stamp(cdr)][part] = float(message.temperature) + ZERO_CELSIUS
        rows = {stamp: parts for stamp, parts in sorted(found.items()) if all(n in parts for n in NODES)}
        values = np.array([[parts[name] for name in NODES] for parts in rows.values()]).reshape(
            -1, len(NODES)
        )
        return arrays.Signal(np.array(list(rows), np.int64), values, NODES, "K", np.zeros(0, np.int64))

    def diagnostics(self) -> arrays.Diagnostics:
        every = (decode_diagnostics(cdr) for cdr in self._of("/diagnostics"))
        if not self._box:
            return tuple(every)
        own = (
            (stamp, tuple(each for each in statuses if each.name.startswith(f"{self._box}/")))
            for stamp, statuses in every
        )
        return tuple((stamp, statuses) for stamp, statuses in own if statuses)

    def results(self) -> arrays.Diagnostics:
        return tuple(decode_diagnostics(cdr) for cdr in self._of("monitor/result"))

    def plot_values(self) -> dict[str, arrays.Signal]:
        return {
            each.name: _stamped_signal(
                self._of(each.topic), VECTOR, vector_template, "vector", _vector_values, BOUNDS, each.unit
            )
            for each in VALUES
            if self._of(each.topic)
        }

    def followed(self) -> arrays.Told:
        """Give `Run.followed`; the last word, which repeats what was said, is left out."""
        told = (decode_told(cdr) for cdr in self._of("follower/estimate"))
        return tuple(each for each in told if not each.get("final"))

    def residuals(self) -> arrays.Told:
        return tuple(decode_told(cdr) for cdr in self._of("follower/residual"))

    def source_time(self) -> tuple[tuple[int, int], ...]:
        return tuple((header_stamp(cdr), time_reference(cdr)) for cdr in self._of("source_time"))

    def duration(self) -> float:
        """Give `Run.duration`: a block ends with its last snapshot."""
        snapshots = self._bodies.time_ns
        times = snapshots if len(snapshots) > 1 else self.shaft().time_ns
        if self._description is None and len(snapshots) < 2:  # a tachometer may begin late and end early
            times = next((each.time_ns for each in self.sensors().values() if len(each) > 1), times)
        return float(times[-1] - 2 * times[0] + times[1]) * 1e-9 if len(times) > 1 else 0.0


@dataclass(frozen=True)
class _Joints:
    """Joint states over time, arrays [sample, joint]."""

    names: tuple[str, ...]
    time_ns: Int
    position: Float
    velocity: Float
    effort: Float


def _clouds(cdrs: Sequence[bytes]) -> tuple[NDArray[Any], Int]:
    if not cdrs:
        return np.zeros(0, np.dtype([("sample", "<u4"), ("t", "<u4")])), np.zeros(0, np.int64)
    parts = [cloud_to_arrays(cdr) for cdr in cdrs]
    times = [cloud_times(cdr, part) for cdr, part in zip(cdrs, parts, strict=True)]
    return np.concatenate(parts), np.concatenate(times)


def _columns(points: NDArray[Any], names: Sequence[str]) -> Float:
    if not len(points):
        return np.zeros((0, len(names)))
    return np.stack([points[name].astype(np.float64) for name in names], axis=1)


def _waveform(cdrs: Sequence[bytes], names: tuple[str, ...], unit: str) -> arrays.Signal:
    points, time_ns = _clouds(cdrs)
    return arrays.Signal(time_ns, _columns(points, names), names, unit, points["sample"].astype(np.int64))


def _times(rows: NDArray[Any]) -> Int:
    return rows["sec"].astype(np.int64) * 1_000_000_000 + rows["nanosec"]


def wrench_values(message: Any) -> list[float]:
    """List force and moment of a ``geometry_msgs/WrenchStamped``, [N, N m]."""
    force, torque = message.wrench.force, message.wrench.torque
    return [force.x, force.y, force.z, torque.x, torque.y, torque.z]


def _imu_values(message: Any) -> list[float]:
    value = message.linear_acceleration
    return [value.x, value.y, value.z]


def _vector_values(message: Any) -> list[float]:
    vector = message.vector
    return [vector.x, vector.y, vector.z]


def _stamped_signal(
    cdrs: Sequence[bytes],
    msgtype: str,
    template: Any,
    slot: str,
    numbers: Callable[[Any], list[float]],
    names: tuple[str, ...],
    unit: str,
) -> arrays.Signal:
    if not cdrs:
        return arrays.no_signal(names, unit)
    nothing = np.zeros(0, np.int64)
    maker: Template = template(decode(msgtype, cdrs[0]).header.frame_id)
    rows = maker.decode(cdrs)
    if rows is not None:
        return arrays.Signal(_times(rows), rows[slot].astype(np.float64), names, unit, nothing)
    times = np.array([header_stamp(cdr) for cdr in cdrs], np.int64)
    values = np.array([numbers(decode(msgtype, cdr)) for cdr in cdrs], float)
    return arrays.Signal(times, values, names, unit, nothing)


def _joints(cdrs: Sequence[bytes]) -> _Joints:
    if not cdrs:
        return _Joints((), np.zeros(0, np.int64), *(np.zeros((0, 0)) for _ in range(3)))
    first = decode(JOINTS, cdrs[0])
    names = tuple(first.name)
    rows = joint_template(names, first.header.frame_id, len(first.effort) > 0).decode(cdrs)
    if rows is not None:
        effort = rows["effort"] if "effort" in (rows.dtype.names or ()) else np.zeros((len(rows), 0))
        return _Joints(names, _times(rows), rows["position"].copy(), rows["velocity"].copy(), effort.copy())
    efforts = len(first.effort)
    stamped = [(header_stamp(cdr), decode(JOINTS, cdr)) for cdr in cdrs]
    stamped = [each for each in stamped if tuple(each[1].name) == names and len(each[1].effort) == efforts]
    parts = (
        [getattr(message, part) for _, message in stamped] for part in ("position", "velocity", "effort")
    )
    times = np.array([stamp for stamp, _ in stamped], np.int64)
    return _Joints(names, times, *(np.array(part, float) for part in parts))

"""A recording as arrays."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.errors import InputError
from beardyn_core.record.clouds import cloud_times, cloud_to_arrays
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import POSE_AXES, TWIST_AXES, force_template, imu_template, joint_template
from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.mcap_scanning import END_RECORD, McapScan
from beardyn_core.record.mcap_writing import COMPLETE, DESCRIPTION_FILE, SCENE_FILE
from beardyn_core.record.messages import Diagnostic, Template, decode, decode_diagnostics, decode_string
from beardyn_core.record.topics import IMU, JOINTS, NAMESPACE, WRENCH, namespace_of, relative_name
from beardyn_core.scene.load import WRENCH_AXES, LoadHistory

Float = NDArray[np.float64]
Int = NDArray[np.int64]


@dataclass(frozen=True)
class Samples:
    """Numbers over time.

    Parameters
    ----------
    sample : int64 array, shape [sample]
        Running index; empty for topics that carry none.
    time_ns : int64 array, shape [sample], [ns]
    values : float64 array, shape [sample, ...]
    """

    sample: Int
    time_ns: Int
    values: Float

    def __len__(self) -> int:
        return len(self.time_ns)

    @property
    def seconds(self) -> Float:
        """Time of each sample, [s]."""
        return np.asarray(self.time_ns * 1e-9, np.float64)


@dataclass(frozen=True)
class Joints:
    """Joint states over time, one column per joint.

    Parameters
    ----------
    names : tuple of str
    time_ns : int64 array, shape [sample], [ns]
    position, velocity, effort : float64 array, shape [sample, joint], [rad, rad/s, N m]
    """

    names: tuple[str, ...]
    time_ns: Int
    position: Float
    velocity: Float
    effort: Float

    def __len__(self) -> int:
        return len(self.time_ns)

    def column(self, name: str) -> int:
        """Find the index of a joint."""
        return self.names.index(name)


@dataclass(frozen=True)
class Bodies:
    """Snapshots of all bodies.

    Parameters
    ----------
    sample, time_ns : int64 array, shape [snapshot], [-, ns]
    pose : float64 array, shape [snapshot, body, 7]
        x, y, z, qx, qy, qz, qw, [m, -].
    twist : float64 array, shape [snapshot, body, 6], [m/s, rad/s]
    """

    sample: Int
    time_ns: Int
    pose: Float
    twist: Float

    def __len__(self) -> int:
        return len(self.time_ns)


@dataclass(frozen=True)
class Run:
    """A recording.

    Parameters
    ----------
    path : Path
    complete : bool
        The file was closed properly.
    problem : str
        Where and why reading stopped; empty when complete.
    status : str or None
        How the run ended: ``complete`` as asked, else a sentence; ``None`` when the file does not say.
    description : RunDescription or None
    scene_text : str
        Resolved YAML of the scene.
    force : Samples
        Force and moment of the rollers on the cup at 400 Hz, shape [sample, 6], [N, N m].
    force_waveform : Samples
        The same at full rate.
    vibration : mapping of topic name to Samples
        Specific force of each accelerometer at full rate, shape [sample, 3], [m/s^2].
    specific_force : Samples
        First accelerometer at 400 Hz, shape [sample, 3], [m/s^2].
    shaft, orbit : Joints
        Tachometer; cages, rollers and the shaft's torque.
    bodies : Bodies
    contacts : structured array, shape [contact]
        Columns of the ``contacts`` topic.
    contact_time_ns : int64 array, shape [contact], [ns]
    load : LoadHistory
        Load on the journal.
    load_sample : int64 array, shape [sample]
    diagnostics, results : tuple of (stamp [ns], statuses)
        From ``/diagnostics`` and ``monitor/result``.
    """

    path: Path
    complete: bool
    problem: str
    status: str | None
    description: RunDescription | None
    scene_text: str
    force: Samples
    force_waveform: Samples
    vibration: Mapping[str, Samples]
    specific_force: Samples
    shaft: Joints
    orbit: Joints
    bodies: Bodies
    contacts: NDArray[Any]
    contact_time_ns: Int
    load: LoadHistory
    load_sample: Int
    diagnostics: tuple[tuple[int, tuple[Diagnostic, ...]], ...]
    results: tuple[tuple[int, tuple[Diagnostic, ...]], ...]

    @property
    def truth(self) -> Mapping[str, Any]:
        """Ground truth; empty when the file has none."""
        return self.description.truth if self.description is not None else {}

    def described(self) -> RunDescription:
        """Return the description, or refuse a recording without one.

        Raises
        ------
        InputError
            The file has none.
        """
        if self.description is None:
            raise InputError(
                f"{self.path}: the recording does not say which bearing it is of (no {DESCRIPTION_FILE} "
                "and no topic truth); record the topic truth too"
            )
        return self.description


@contextmanager
def damage_told(path: Path) -> Iterator[None]:
    """Turn whatever goes wrong with bytes that nobody vouches for into a sentence about the file.

    Chunks with checksums do not come this far when they are damaged; messages without, or of somebody
    else's making, may hold anything.
    """
    try:
        yield
    except (InputError, OSError):
        raise
    except Exception as error:
        raise InputError(
            f"{path}: what is in it cannot be used ({type(error).__name__}: {error}); it is damaged, or "
            "not a recording of an axlebox"
        ) from error


def read_run(path: Path | str, namespace: str | None = None) -> Run:
    """Read the arrays of a recording; of a cut-off one everything up to the last complete chunk.

    Parameters
    ----------
    path : Path
    namespace : str, optional
        Of the axlebox to read; by default the first one in the file.

    Raises
    ------
    InputError
        The file is absent, not MCAP, or holds not one usable message of the namespace.
    """
    scan = McapScan(path)
    recorded: dict[str, list[bytes]] = defaultdict(list)
    for message in scan.messages():
        recorded[message.topic].append(message.cdr)
    if namespace is None:
        namespace = next((space for space in map(namespace_of, recorded) if space is not None), NAMESPACE)
    cdrs: dict[str, list[bytes]] = defaultdict(list)
    cdrs.update({relative_name(path, namespace): messages for path, messages in recorded.items()})
    if not any(name != path for name, path in zip(cdrs, recorded, strict=True)):
        found = f"it has {', '.join(sorted(recorded))}" if recorded else scan.problem or "it has no messages"
        raise InputError(f"{scan.path}: no messages under the namespace {namespace}; {found}")
    with damage_told(scan.path):
        return _run(scan, cdrs)


def _run(scan: McapScan, cdrs: Mapping[str, list[bytes]]) -> Run:
    description = _description(scan, cdrs)
    scene_text = scan.attachments.get(SCENE_FILE, b"").decode(errors="replace")
    return run_of_messages(
        cdrs,
        description,
        path=scan.path,
        complete=scan.complete,
        problem=scan.problem,
        status=scan.metadata[END_RECORD]["status"] or COMPLETE if END_RECORD in scan.metadata else None,
        scene_text=scene_text or (description.scene_text if description else ""),
    )


def run_of_messages(
    cdrs: Mapping[str, Sequence[bytes]],
    description: RunDescription | None,
    *,
    path: Path = Path("live"),
    complete: bool = True,
    problem: str = "",
    status: str | None = None,
    scene_text: str = "",
) -> Run:
    """Gather the arrays of messages by the name of their topic, from a file or from a live graph."""

    def of(name: str) -> Sequence[bytes]:
        return cdrs.get(name, ())

    contacts, contact_time = _clouds(of("contacts"))
    load, load_sample = _load(of("load/blocks"))
    return Run(
        path=path,
        complete=complete,
        problem=problem,
        status=status,
        description=description,
        scene_text=scene_text,
        force=_stamped(of("force"), WRENCH, force_template, "wrench", _wrench_values, 6),
        force_waveform=_waveform(of("force_waveform"), WRENCH_AXES),
        vibration={
            name: _waveform(of(name), ("ax", "ay", "az"))
            for name in sorted(cdrs)
            if (name == "vibration" or name.startswith("vibration/")) and cdrs[name]
        },
        specific_force=_stamped(of("imu"), IMU, imu_template, "acceleration", _imu_values, 3),
        shaft=_joints(of("shaft")),
        orbit=_joints(of("joint_states")),
        bodies=_bodies(of("bodies")),
        contacts=contacts,
        contact_time_ns=contact_time,
        load=load,
        load_sample=load_sample,
        diagnostics=tuple(decode_diagnostics(cdr) for cdr in of("/diagnostics")),
        results=tuple(decode_diagnostics(cdr) for cdr in of("monitor/result")),
    )


def _description(scan: McapScan, cdrs: Mapping[str, list[bytes]]) -> RunDescription | None:
    truth = cdrs.get("truth", ())
    if DESCRIPTION_FILE in scan.attachments:
        with suppress(InputError):  # damaged: the topic says the same
            return RunDescription.from_json(scan.attachments[DESCRIPTION_FILE].decode(errors="replace"))
    return RunDescription.from_json(decode_string(truth[0])) if truth else None


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


def _waveform(cdrs: Sequence[bytes], names: Sequence[str]) -> Samples:
    points, time_ns = _clouds(cdrs)
    return Samples(points["sample"].astype(np.int64), time_ns, _columns(points, names))


def _bodies(cdrs: Sequence[bytes]) -> Bodies:
    points, time_ns = _clouds(cdrs)
    if not len(points):
        nothing = np.zeros(0, np.int64)
        return Bodies(nothing, nothing, np.zeros((0, 0, 7)), np.zeros((0, 0, 6)))
    count = int(points["body"].max()) + 1
    numbers = _columns(points, POSE_AXES + TWIST_AXES).reshape(-1, count, 13)
    return Bodies(
        points["sample"][::count].astype(np.int64), time_ns[::count], numbers[..., :7], numbers[..., 7:]
    )


def _load(cdrs: Sequence[bytes]) -> tuple[LoadHistory, Int]:
    parts = [decode_load(cdr) for cdr in cdrs]
    if not parts:
        nothing = np.zeros((0, 6)), np.zeros(0), np.zeros((0, 3))
        return LoadHistory(np.zeros(0, np.int64), *nothing), np.zeros(0, np.int64)
    history = LoadHistory(
        np.concatenate([part.time_ns for part, _ in parts]),
        np.concatenate([part.wrench for part, _ in parts]),
        np.concatenate([part.shaft_speed for part, _ in parts]),
        np.concatenate([part.bogie for part, _ in parts]),
    )
    return history, np.concatenate([sample for _, sample in parts])


def _times(rows: NDArray[Any]) -> Int:
    return rows["sec"].astype(np.int64) * 1_000_000_000 + rows["nanosec"]


def _stamp(message: Any) -> int:
    return int(message.header.stamp.sec) * 1_000_000_000 + int(message.header.stamp.nanosec)


def _wrench_values(message: Any) -> list[float]:
    force, torque = message.wrench.force, message.wrench.torque
    return [force.x, force.y, force.z, torque.x, torque.y, torque.z]


def _imu_values(message: Any) -> list[float]:
    value = message.linear_acceleration
    return [value.x, value.y, value.z]


def _stamped(
    cdrs: Sequence[bytes], msgtype: str, template: Any, slot: str, values: Any, width: int
) -> Samples:
    nothing = np.zeros(0, np.int64)
    if not cdrs:
        return Samples(nothing, nothing, np.zeros((0, width)))
    maker: Template = template(decode(msgtype, cdrs[0]).header.frame_id)
    rows = maker.decode(cdrs)
    if rows is not None:
        return Samples(nothing, _times(rows), rows[slot].astype(np.float64))
    messages = [decode(msgtype, cdr) for cdr in cdrs]
    times = np.array([_stamp(message) for message in messages], np.int64)
    return Samples(nothing, times, np.array([values(message) for message in messages], float))


def _joints(cdrs: Sequence[bytes]) -> Joints:
    if not cdrs:
        return Joints((), np.zeros(0, np.int64), *(np.zeros((0, 0)) for _ in range(3)))
    first = decode(JOINTS, cdrs[0])
    names = tuple(first.name)
    rows = joint_template(names, first.header.frame_id, len(first.effort) > 0).decode(cdrs)
    if rows is not None:
        effort = rows["effort"] if "effort" in (rows.dtype.names or ()) else np.zeros((len(rows), 0))
        return Joints(names, _times(rows), rows["position"].copy(), rows["velocity"].copy(), effort.copy())
    messages = [decode(JOINTS, cdr) for cdr in cdrs]
    messages = [message for message in messages if tuple(message.name) == names]
    return Joints(
        names,
        np.array([_stamp(message) for message in messages], np.int64),
        np.array([message.position for message in messages], float),
        np.array([message.velocity for message in messages], float),
        np.array([message.effort for message in messages], float),
    )

"""Numbers in the messages of MCAP files of other tools, by topic and member."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, is_dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
from mcap.records import Channel, Schema
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from beardyn_core.base.arrays import Float
from beardyn_core.record.bag_scanning import is_folder_of_files
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.mcap_scanning import MAGIC, McapScan
from beardyn_core.record.topics import namespace_of, relative_name, topic

TIME = "time"
_STAMP, _NOTES, _LISTS = "header.stamp", "__notes__", "__lists__"  # next to the members of a message
_CHANNEL_WORDS = ("chan", "axis", "axes", "component", "column", "col", "sensor")
_SAMPLE_WORDS = ("sample", "time", "row", "point", "frame", "length")
_BLOCK = 65_536
_LONGEST_LIST = 3  # components of a vector; a longer list in a message is a stretch of samples


def is_recording(path: Path | str) -> bool:
    """Tell whether a path means a recording of an axlebox, not a file of another tool.

    A folder, and an MCAP file that there is not, count as one: reading it says what is wrong.
    """
    path = Path(path)
    if not path.is_file() or is_folder_of_files(path):
        return path.is_dir() or path.suffix.lower() == ".mcap"
    with path.open("rb") as file:
        if file.read(len(MAGIC)) != MAGIC:
            return False
    scan = McapScan(path)
    for message in scan.messages():
        space = namespace_of(message.topic)
        if space is None:
            continue
        with suppress(KeyError):
            if topic(relative_name(message.topic, space)).type == message.type:
                return True
    return not scan.channels


@dataclass
class Found:
    """What the messages of a topic have."""

    type: str
    members: A[dict[str, None], "numbers by their path in a message, in its order"] = field(
        default_factory=dict
    )
    lists: A[dict[str, int], "members that are lists without a layout, with their length"] = field(
        default_factory=dict
    )
    first_ns: A[int, "stamp of its first message, of the header or else of the log, [ns]"] = 0
    log_delay_ns: A[int, "of its first message, from the stamp to the log, [ns]"] = 0
    span_ns: A[int, "from its first message to the second, [ns]"] = 0
    has_blocks: A[bool, "whether a message has many samples"] = False

    def unit(self, member: str) -> str:
        """Tell the unit of a member where its message defines it."""
        known = self.type.endswith(("/Imu", "/Accel", "/AccelStamped")) and member.startswith(
            ("linear_acceleration.", "accel.linear.", "linear.")
        )
        return "m/s2" if known else ""

    def axis(self, member: str) -> str:
        """Tell the axis of an acceleration where its message defines it."""
        return member[-1] if self.unit(member) and member[-1] in "xyz" else ""


class Topics:
    """Topics of a file that hold numbers.

    Attributes
    ----------
    found : dict
        By name of the topic.
    problems, notes : list and tuple of str
        Why the file stops early; what is in it that cannot be decoded.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self.found: dict[str, Found] = {}
        self.problems: list[str] = []
        self._decoders: dict[int, Callable[[bytes], Any] | None] = {}
        unknown: dict[str, str] = {}
        notes: list[str] = []
        scan = McapScan(path)
        for message in scan.raw_messages():
            channel = scan.channels[message.channel_id]
            known = self.found.get(channel.topic)
            if channel.topic in unknown or (known is not None and known.span_ns):
                continue
            schema = scan.schemas[channel.schema_id]
            values = self._decode_message(channel, schema, message.data)
            if values is None:
                unknown[channel.topic] = f"{schema.name} as {channel.message_encoding}"
            elif known is not None:
                known.span_ns = abs(_stamp_of(values, message.log_time) - known.first_ns)
            elif values:
                stamp = _stamp_of(values, message.log_time)
                notes += [f"{channel.topic}: {note}" for note in values.pop(_NOTES, ())]
                members = {name: None for name in values if name != _STAMP}
                lists = {name: len(values[name]) for name in values.get(_LISTS, ())}
                members.pop(_LISTS, None)
                blocks = any(len(values[name]) > 1 for name in members)
                self.found[channel.topic] = Found(
                    schema.name, members, lists, stamp, message.log_time - stamp, has_blocks=blocks
                )
        if scan.problem:
            self.problems.append(scan.problem)
        each = ", ".join(f"{topic} ({what})" for topic, what in unknown.items())
        self.notes = (*([f"not decoded: {each}"] if unknown else []), *notes)

    def blocks(self, topic: str, members: Sequence[str]) -> Iterator[Float]:
        """Give members of the messages of a topic with the time, shape [sample, member].

        The time is that of the header of a message, or that of the log, in seconds from the first; samples
        inside of a message are spread evenly up to the next.
        """
        rows: list[Float] = []
        count, first, step = 0, None, 0.0
        waiting: tuple[float, Float, Float | None] | None = None
        wanted = [member for member in members if member != TIME]
        for stamp, values, offsets in self._samples(topic, wanted):
            first = stamp if first is None else first
            time = (stamp - first) * 1e-9
            if waiting is not None:
                rows.append(_place_samples(waiting, time - waiting[0], members))
                count += len(rows[-1])
                if count >= _BLOCK:
                    yield np.concatenate(rows)
                    rows, count = [], 0
                step = (time - waiting[0]) / max(len(waiting[1]), 1)
            waiting = (time, values, offsets)
        if waiting is not None:
            rows.append(_place_samples(waiting, step * len(waiting[1]), members))
        if rows:
            yield np.concatenate(rows)

    def _samples(self, topic: str, members: Sequence[str]) -> Iterator[tuple[int, Float, Float | None]]:
        """Give stamp [ns], samples, shape [sample, member], and their times after the stamp [s] if known."""
        scan = McapScan(self._path)
        for message in scan.raw_messages():
            channel = scan.channels[message.channel_id]
            if channel.topic != topic:
                continue
            values = self._decode_message(channel, scan.schemas[channel.schema_id], message.data) or {}
            count = max((len(values[name]) for name in members if name in values), default=1)
            out = np.full((count, len(members)), np.nan)
            for k, name in enumerate(members):
                if name in values and len(values[name]) == count:
                    out[:, k] = values[name]
            begin = _stamp_of(values, message.log_time)
            offsets = values.get("t")
            yield begin, out, None if offsets is None or len(offsets) != count else offsets * 1e-9

    def _decode_message(self, channel: Channel, schema: Schema, data: bytes) -> dict[str, Any] | None:
        """Give the numbers of a message by their path, arrays; None for what cannot be decoded."""
        if channel.id not in self._decoders:
            self._decoders[channel.id] = _decoder(channel, schema)
        decoder = self._decoders[channel.id]
        if decoder is None:
            return None
        try:
            return decoder(data)
        except Exception:  # the decoders break in any way on bytes of another type
            return None


def _stamp_of(values: dict[str, Any], log_time: int) -> int:
    """Give the stamp of the header of a message, without one that of the log, [ns]."""
    stamp = values.get(_STAMP)
    return log_time if stamp is None else int(stamp[0]) * 10**9 + int(stamp[1])


def _place_samples(part: tuple[float, Float, Float | None], span: float, members: Sequence[str]) -> Float:
    """Give the samples of a message with their time where it is wanted."""
    begin, values, offsets = part
    count = len(values)
    times = begin + (np.arange(count) * (span / max(count, 1)) if offsets is None else offsets)
    columns = iter(values.T)
    return np.stack([times if name == TIME else next(columns) for name in members], axis=1)


def _decoder(channel: Channel, schema: Schema) -> Callable[[bytes], Any] | None:
    if channel.message_encoding == "json":
        return lambda data: _flat(json.loads(data))
    if channel.message_encoding != "cdr" or schema.encoding not in ("ros2msg", "ros2idl", ""):
        return None
    name = schema.name if "/msg/" in schema.name else schema.name.replace("/", "/msg/", 1)
    if name == CLOUD:
        return _cloud
    store = get_typestore(Stores.ROS2_JAZZY)
    if schema.encoding == "ros2msg" and schema.data:
        try:
            types = get_types_from_msg(schema.data.decode(), name)
            store.register({key: value for key, value in types.items() if key not in store.types})
        except Exception:  # a definition that is none
            return None
    if name not in store.types:
        return None
    return lambda data: _flat(store.deserialize_cdr(data, name))


def _cloud(data: bytes) -> dict[str, Any]:
    """Give the fields of a cloud: its points are samples."""
    points = cloud_points(data)
    seconds, nanoseconds = struct.unpack_from("<iI", data, 4)
    found: dict[str, Any] = {_STAMP: (seconds, nanoseconds)}
    for name in points.dtype.names or ():
        if points[name].ndim == 1 and points[name].dtype.kind in "fiu":
            found[name] = points[name].astype(np.float64)
    offsets = found.get("t")
    if offsets is not None and points["t"].dtype.kind == "f" and 0.0 < np.ptp(offsets) < len(offsets):
        # less than a nanosecond from point to point
        found["t"] = offsets * 1e9
        found[_NOTES] = ("t of its points is taken in seconds; in the clouds of ROS it is in nanoseconds",)
    return found


def _flat(message: Any, above: str = "") -> dict[str, Any]:
    """List the numbers of a message by their path."""
    found: dict[str, Any] = {}
    members = vars(message) if is_dataclass(message) else message
    if not isinstance(members, dict):
        return {}
    shape = _layout(members)
    for name, value in members.items():
        path = f"{above}{name}"
        if name.startswith("__") or (shape is not None and name in ("layout", "shape")):
            continue
        if name == "stamp" and above == "header.":
            part = vars(value) if is_dataclass(value) else value
            if isinstance(part, dict) and "sec" in part:
                found[_STAMP] = (part["sec"], part.get("nanosec", part.get("nsec", 0)))
        elif isinstance(value, bool | str):
            continue
        elif isinstance(value, int | float):
            found[path] = np.array([value], np.float64)
        elif isinstance(value, list | tuple | np.ndarray):
            _add(found, _list_columns(path, value, shape if name == "data" else None))
        elif isinstance(value, dict) or is_dataclass(value):
            _add(found, _flat(value, f"{path}."))
    return found


def _add(found: dict[str, Any], more: dict[str, Any]) -> None:
    lists = (*found.get(_LISTS, ()), *more.pop(_LISTS, ()))
    found |= more
    if lists:
        found[_LISTS] = lists


@dataclass(frozen=True)
class _Layout:
    """How the list ``data`` of a message is to be laid out."""

    shape: tuple[int, ...]
    begin: int
    labels: tuple[str, ...]


def _layout(members: dict[str, Any]) -> _Layout | None:
    """Find the layout that a message has next to its data: of a ``MultiArray``, or a ``shape``."""
    layout = members.get("layout")
    inside = vars(layout) if is_dataclass(layout) else layout
    if isinstance(inside, dict) and inside.get("dim"):
        dims = [vars(each) if is_dataclass(each) else each for each in inside["dim"]]
        return _Layout(
            tuple(int(each["size"]) for each in dims),
            int(inside.get("data_offset", 0)),
            tuple(str(each.get("label", "")).lower() for each in dims),
        )
    shape = members.get("shape")
    if isinstance(shape, list | tuple | np.ndarray) and len(shape) and "data" in members:
        return _Layout(tuple(int(each) for each in shape), 0, ("",) * len(shape))
    return None


def _list_columns(path: str, value: Any, layout: _Layout | None = None) -> dict[str, Any]:
    """Give the columns of a list: as its layout has them, the components of a vector, or samples."""
    if not len(value):
        return {}
    if isinstance(value[0], list | tuple | np.ndarray):
        try:
            numbers = np.asarray(value, np.float64)
        except (TypeError, ValueError):
            return {}
        return _columns(path, numbers, ("",) * numbers.ndim)
    if not isinstance(value[0], int | float | np.number):
        return {}
    numbers = np.asarray(value, np.float64)
    if layout is not None:
        count = int(np.prod(layout.shape))
        if len(numbers) != layout.begin + count:
            raise ValueError(f"{path} has {len(numbers)} numbers, its layout {layout.begin + count}")
        return _columns(path, numbers[layout.begin :].reshape(layout.shape), layout.labels)
    if len(numbers) > _LONGEST_LIST:
        return {path: numbers, _LISTS: (path,)}
    return {f"{path}[{k}]": numbers[k : k + 1] for k in range(len(numbers))}


def _columns(path: str, numbers: Float, labels: tuple[str, ...]) -> dict[str, Any]:
    """Give the channels of an array; time runs along the axis that is called so, else along the longer."""
    kept = [k for k, size in enumerate(numbers.shape) if size > 1]
    labels, numbers = tuple(labels[k] for k in kept), numbers.squeeze()
    if numbers.ndim < 2:
        return {path: np.atleast_1d(numbers)}
    if numbers.ndim > 2:
        raise ValueError(f"{path} has {numbers.ndim} axes")
    across = [any(word in label for word in _CHANNEL_WORDS) for label in labels]
    along = [any(word in label for word in _SAMPLE_WORDS) for label in labels]
    if across != [False, False] or along != [False, False]:
        lying = across[0] or along[1]
    else:
        lying = numbers.shape[1] > numbers.shape[0]
    columns = numbers if lying else numbers.T
    return {f"{path}[{k}]": column for k, column in enumerate(columns)}

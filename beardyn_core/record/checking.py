"""Whether a message is what its topic promises, before anybody computes with it.

Whoever may write to a topic can write anything. What is refused here would stop a reader; numbers that are
merely strange (NaN, a far stamp) are left to whoever knows what they mean.
"""

from __future__ import annotations

import struct
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import LONGEST_TEXT, read_object
from beardyn_core.record.cloud_layout import MalformedError, cloud_points, text_at
from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.encoding import POSE_AXES, TWIST_AXES
from beardyn_core.record.messages import CLOCK, DIAGNOSTICS, STRING, TIME, decode, decode_string
from beardyn_core.record.plot_values import VECTOR
from beardyn_core.record.topics import (
    IMU,
    JOINTS,
    POLYGON,
    TEMPERATURE,
    TIME_REFERENCE,
    TWIST,
    WRENCH,
    Topic,
    topic,
)
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.sensors.block import CONTACT_FIELDS, CONTACT_KINDS, LARGEST

_NUMBERS = {WRENCH: 6, TWIST: 6, IMU: 37, TEMPERATURE: 2, VECTOR: 3}  # float64 behind the header
_COLUMNS = {
    "force_waveform": WRENCH_AXES,
    "vibration": ("ax", "ay", "az"),
    "bodies": ("body", *POSE_AXES, *TWIST_AXES),
    "contacts": ("row", "roller", "kind", *CONTACT_FIELDS[:LARGEST]),  # earlier versions have not the largest
    "load/blocks": (*WRENCH_AXES, "shaft_speed"),
}
_WHOLE = ("sample", "t", "body", "row", "roller", "kind")
_LITTLE = b"\x00\x01"
_ROWS = 2
_SECOND = 1_000_000_000
_PADDING = 3
_POINT_BYTES = 12  # three float32
LONGEST_NAME = 200


@dataclass(frozen=True)
class _Joints:
    """Structure of joint states: everything but stamp and numbers."""

    size: int
    fixed: tuple[tuple[int, int, bytes], ...]

    def fits(self, cdr: bytes) -> bool:
        return len(cdr) == self.size and all(cdr[begin:end] == part for begin, end, part in self.fixed)


class MessageChecker:
    """Checks the messages of one axlebox.

    Parameters
    ----------
    body_count, roller_count : int
        Of the run, a row's rollers; 0: not known.
    """

    def __init__(self, body_count: int = 0, roller_count: int = 0) -> None:
        self.body_count = body_count
        self.roller_count = roller_count
        self._joints: dict[str, _Joints] = {}
        self._checks: dict[str, Callable[[Topic, bytes], None]] = {
            CLOUD: self._check_cloud,
            JOINTS: self._check_joints,
            STRING: _check_text,
            **dict.fromkeys((DIAGNOSTICS, TIME_REFERENCE), _check_decoding),
            POLYGON: _check_samples,
            **dict.fromkeys((TIME, CLOCK), _check_time),
            **dict.fromkeys(_NUMBERS, _check_numbers),
        }

    def problem(self, entry: Topic, cdr: bytes) -> str:
        """Describe why a message cannot be taken; empty when it can.

        Parameters
        ----------
        entry : Topic
            What the topic promises.
        cdr : bytes
        """
        try:
            if cdr[:2] != _LITTLE:
                raise MalformedError("it is not little-endian CDR")
            self._checks[entry.type](entry, cdr)
        except MalformedError as error:
            return str(error)
        except (struct.error, UnicodeDecodeError, IndexError):
            return f"it is no {entry.type}"
        return ""

    def _check_cloud(self, entry: Topic, cdr: bytes) -> None:
        _check_stamp(cdr)
        points = cloud_points(cdr)
        name = "vibration" if entry.name.startswith("vibration/") else entry.name
        members: Mapping[str, Any] = points.dtype.fields or {}
        for column in ("sample", "t", *_COLUMNS[name]):
            if column not in members:
                raise MalformedError(f"the field '{column}' is not there, it has {', '.join(members)}")
            kind = members[column][0]
            if kind.shape or (column in _WHOLE and kind.kind not in "iu"):
                raise MalformedError(f"the field '{column}' is not one {_wanted_columns(column)} a point")
        if name == "bodies":
            self._check_bodies(points["body"])
        elif name == "contacts" and len(points):
            limits = (("row", _ROWS), ("kind", len(CONTACT_KINDS)), ("roller", self.roller_count))
            for column, limit in limits:
                if limit and not 0 <= points[column].min() <= points[column].max() < limit:
                    raise MalformedError(f"the field '{column}' leaves 0 to {limit - 1}")

    def _check_bodies(self, body: np.ndarray) -> None:
        count = self.body_count or (int(body.max()) + 1 if len(body) else 1)
        if len(body) % count or not (body.reshape(-1, count) == np.arange(count)).all():
            raise MalformedError(f"a snapshot in it does not have the bodies 0 to {count - 1} in their order")

    def _check_joints(self, entry: Topic, cdr: bytes) -> None:
        _check_stamp(cdr)
        known = self._joints.get(entry.name)
        if known is None or not known.fits(cdr):
            self._joints[entry.name] = _joints_of(entry, cdr)


def take_out_malformed(
    cdrs: dict[str, list[bytes]], types: Mapping[str, str], checker: MessageChecker, only: Sequence[str] = ()
) -> Counter[str]:
    """Take messages out that are not what their topic promises.

    Parameters
    ----------
    cdrs : dict of str to list of bytes
        Messages by name in the topic table; changed.
    types : mapping of str to str
        ROS message type that each topic was recorded with.
    checker : MessageChecker
    only : sequence of str
        Topics to check; empty: all.

    Returns
    -------
    Counter
        How many were taken out, by topic.
    """
    found: Counter[str] = Counter()
    for name in only or list(cdrs):
        if name not in cdrs:
            continue
        with suppress(KeyError):  # a topic of somebody else
            entry = topic(name)
            good = [
                cdr for cdr in cdrs[name] if types[name] == entry.type and not checker.problem(entry, cdr)
            ]
            if len(good) < len(cdrs[name]):
                found[name] = len(cdrs[name]) - len(good)
                cdrs[name] = good
    return found


def _joints_of(entry: Topic, cdr: bytes) -> _Joints:
    """Read the structure of joint states: names, and as many positions and velocities; effort or none."""
    at, _ = text_at(cdr, 12)
    at = (at + 3) & ~3
    (count,) = struct.unpack_from("<I", cdr, at)
    at += 4
    if not 0 < count <= len(cdr):
        raise MalformedError(f"it has {count} joints")
    names = []
    for _ in range(count):
        at, name = text_at(cdr, (at + 3) & ~3)
        names.append(name)
    if len(set(names)) < count or sum(name.startswith("roller_") for name in names) % _ROWS:
        raise MalformedError("the names of its joints are doubled, or a row has other rollers than the other")
    begin, fixed = 12, []
    for part in ("position", "velocity", "effort"):
        at = (at + 3) & ~3
        (length,) = struct.unpack_from("<I", cdr, at)
        at += 4
        if length != count and (part != "effort" or length):
            raise MalformedError(f"it has {count} joints and {length} numbers of {part}")
        fixed.append((begin, at, cdr[begin:at]))
        if length:
            at = _align_float(at) + 8 * length
        begin = at
    if not at <= len(cdr) <= at + _PADDING:
        raise MalformedError(f"it has {len(cdr)} bytes, its joints take {at}")
    return _Joints(len(cdr), tuple(fixed))


def _check_numbers(entry: Topic, cdr: bytes) -> None:
    _check_stamp(cdr)
    end, _ = text_at(cdr, 12)
    size = _align_float(end) + 8 * _NUMBERS[entry.type]
    if not size <= len(cdr) <= size + _PADDING:
        raise MalformedError(f"it has {len(cdr)} bytes, a {entry.type} with its frame has {size}")


def _check_samples(entry: Topic, cdr: bytes) -> None:
    _check_stamp(cdr)
    end, _ = text_at(cdr, 12)
    end = (end + 3) & ~3
    (count,) = struct.unpack_from("<I", cdr, end)
    size = end + 4 + count * _POINT_BYTES
    if not size <= len(cdr) <= size + _PADDING:
        raise MalformedError(f"it has {len(cdr)} bytes, a {entry.type} of {count} points has {size}")


def _check_time(_entry: Topic, cdr: bytes) -> None:
    _check_stamp(cdr)
    if not 12 <= len(cdr) <= 12 + _PADDING:
        raise MalformedError(f"it has {len(cdr)} bytes, a time has 12")


def _check_decoding(entry: Topic, cdr: bytes) -> None:
    try:
        decode(entry.type, cdr)
    except Exception as error:  # the decoder breaks in any way on bytes of another type
        raise MalformedError(f"it is no {entry.type} ({type(error).__name__})") from error


def _check_text(entry: Topic, cdr: bytes) -> None:
    """Check a text: each of the table is one JSON object."""
    if len(cdr) > LONGEST_TEXT:
        raise MalformedError(f"it has {len(cdr)} bytes; a text has up to {LONGEST_TEXT}")
    _check_decoding(entry, cdr)
    try:
        found = read_object(decode_string(cdr))
    except InputError as error:
        raise MalformedError(str(error)) from None
    for key in ("run_id", "scene"):
        name = found.get(key, "")
        if not isinstance(name, str) or len(name) > LONGEST_NAME or not (name.isprintable()):
            raise MalformedError(f"its key '{key}' is no name of at most {LONGEST_NAME} characters")


def _check_stamp(cdr: bytes) -> None:
    (nanoseconds,) = struct.unpack_from("<I", cdr, 8)
    if nanoseconds >= _SECOND:
        raise MalformedError(f"its stamp has {nanoseconds} nanoseconds in a second")


def _align_float(at: int) -> int:
    """Round up to where a float64 may stand; alignment counts behind the four bytes of the encapsulation."""
    return ((at + 3) & ~7) + 4


def _wanted_columns(column: str) -> str:
    return "whole number" if column in _WHOLE else "number"

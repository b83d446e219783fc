"""ROS messages as CDR bytes without ROS: the type store, and templates for small messages."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import read_object, strict_text

TIME = "builtin_interfaces/msg/Time"
HEADER = "std_msgs/msg/Header"
STRING = "std_msgs/msg/String"
CLOCK = "rosgraph_msgs/msg/Clock"
DIAGNOSTICS = "diagnostic_msgs/msg/DiagnosticArray"

_SECOND = 1_000_000_000
_ENCAPSULATION = b"\x00\x01\x00\x00"
_STAMP = struct.Struct("<iI")
_LENGTH = struct.Struct("<I")
_FRAME_AT = 12  # behind the encapsulation and the stamp


@cache
def typestore() -> Typestore:
    """Load the type store of the message definitions at the first call."""
    return get_typestore(Stores.ROS2_JAZZY)


def make(msgtype: str, **members: Any) -> Any:
    """Make a message of a type by its members."""
    return typestore().types[msgtype](**members)


def time(stamp_ns: int) -> Any:
    """Make ``builtin_interfaces/Time`` of a time in nanoseconds."""
    seconds, nanoseconds = divmod(int(stamp_ns), _SECOND)
    return make(TIME, sec=seconds, nanosec=nanoseconds)


def header(stamp_ns: int, frame: str) -> Any:
    """Make ``std_msgs/Header`` of a time in nanoseconds and a frame."""
    return make(HEADER, stamp=time(stamp_ns), frame_id=frame)


def serialize(message: Any) -> bytes:
    """Encode a message as CDR (little endian, with encapsulation header)."""
    return bytes(typestore().serialize_cdr(message, message.__msgtype__))


def decode(msgtype: str, cdr: bytes) -> Any:
    """Decode a message from its CDR bytes; for any type of the topic table."""
    return typestore().deserialize_cdr(cdr, msgtype)


def header_stamp(cdr: bytes) -> int:
    """Read the stamp of a message that begins with a header (or is a time), without decoding it, [ns]."""
    seconds, nanoseconds = _STAMP.unpack_from(cdr, 4)
    return int(seconds) * _SECOND + int(nanoseconds)


def header_frame(cdr: bytes) -> str:
    """Read the frame of a message that begins with a header, without decoding it."""
    (length,) = _LENGTH.unpack_from(cdr, _FRAME_AT)
    begin = _FRAME_AT + _LENGTH.size
    return cdr[begin : begin + max(length - 1, 0)].decode("utf-8", errors="replace")


def encode_time(stamp_ns: int) -> bytes:
    """Encode ``builtin_interfaces/Time`` (the content of ``load/consumed``) as CDR."""
    return _ENCAPSULATION + _STAMP.pack(*divmod(int(stamp_ns), _SECOND))


def time_reference(cdr: bytes) -> int:
    """Read the other time of a ``sensor_msgs/TimeReference``, [ns]."""
    other = decode("sensor_msgs/msg/TimeReference", cdr).time_ref
    return int(other.sec) * _SECOND + int(other.nanosec)


encode_clock = encode_time  # ``rosgraph_msgs/Clock`` is one time: the same bytes


def encode_string(text: str) -> bytes:
    """Encode ``std_msgs/String`` as CDR."""
    return serialize(make(STRING, data=text))


def decode_string(cdr: bytes) -> str:
    """Decode the text of a ``std_msgs/String``."""
    return str(decode(STRING, cdr).data)


def encode_told(content: Mapping[str, Any]) -> bytes:
    """Encode one strict JSON object as a ``std_msgs/String``."""
    return encode_string(strict_text(content))


def decode_told(cdr: bytes) -> Mapping[str, Any]:
    """Decode the JSON object of a ``std_msgs/String``.

    Raises
    ------
    InputError
        Its text is no JSON object.
    """
    try:
        return read_object(decode_string(cdr))
    except InputError as error:
        raise InputError(f"a message that should be a JSON object is none: {error}") from None


@dataclass(frozen=True)
class Diagnostic:
    """One status of a diagnostics message."""

    name: str
    level: A[int, "0 OK, 1 warning, 2 error, 3 stale, as in diagnostic_msgs/DiagnosticStatus"]
    message: A[str, "a sentence"]
    values: A[tuple[tuple[str, str], ...], "(key, value)"] = ()

    def value(self, key: str) -> str | None:
        """Look up the value of a key, ``None`` when absent."""
        return dict(self.values).get(key)


def encode_diagnostics(stamp_ns: int, frame: str, statuses: Sequence[Diagnostic]) -> bytes:
    """Encode a ``diagnostic_msgs/DiagnosticArray`` as CDR."""
    entries = [
        make(
            "diagnostic_msgs/msg/DiagnosticStatus",
            level=status.level,
            name=status.name,
            message=status.message,
            hardware_id=frame,
            values=[make("diagnostic_msgs/msg/KeyValue", key=k, value=v) for k, v in status.values],
        )
        for status in statuses
    ]
    return serialize(make(DIAGNOSTICS, header=header(stamp_ns, frame), status=entries))


def decode_diagnostics(cdr: bytes) -> tuple[int, tuple[Diagnostic, ...]]:
    """Stamp [ns] and statuses of a ``diagnostic_msgs/DiagnosticArray``."""
    message = decode(DIAGNOSTICS, cdr)
    return header_stamp(cdr), tuple(
        Diagnostic(s.name, int(s.level), s.message, tuple((v.key, v.value) for v in s.values))
        for s in message.status
    )


class Template:
    """Many messages of one stamped type that differ in the stamp and in blocks of numbers only.

    The message is serialised once with marks in place of the numbers; after that a message costs a
    copy and a few stores, all messages of a block together.

    Parameters
    ----------
    build : callable
        Makes the message from one float64 array per slot.
    slots : mapping of str to int
        Name and length of each block of float64 numbers, each contiguous in the message.
    """

    def __init__(self, build: Callable[..., Any], slots: Mapping[str, int]) -> None:
        self._build = build
        marks: dict[str, NDArray[np.float64]] = {}
        first = 1.0
        for name, length in slots.items():
            marks[name] = np.pi * np.arange(first, first + length)
            first += length
        message = build(**marks)
        self.msgtype: str = message.__msgtype__
        pattern = serialize(message)
        names, formats, offsets = ["sec", "nanosec"], ["<i4", "<u4"], [4, 8]
        for name, mark in marks.items():
            offset = pattern.find(mark.tobytes())
            if offset < 0:
                raise ValueError(f"slot {name!r} is not contiguous in {self.msgtype}")
            names.append(name)
            formats.append(f"({len(mark)},)<f8")
            offsets.append(offset)
        self._dtype = np.dtype(
            {"names": names, "formats": formats, "offsets": offsets, "itemsize": len(pattern)}
        )
        row = np.frombuffer(pattern, np.uint8).copy()
        fixed = np.ones(len(row), bool)
        for name, offset in zip(names, offsets, strict=True):
            width = self._dtype[name].itemsize
            row[offset : offset + width] = 0
            fixed[offset : offset + width] = False
        self._row = row
        self._fixed = fixed

    def rows(self, stamps_ns: NDArray[np.int64], **values: NDArray[np.float64]) -> NDArray[np.uint8]:
        """Encode one message per stamp as CDR, shape [message, byte].

        Parameters
        ----------
        stamps_ns : int64 array, shape [message], [ns]
        **values : float64 arrays, shape [message, length of the slot]
        """
        rows = np.empty((len(stamps_ns), len(self._row)), np.uint8)
        rows[:] = self._row
        view = rows.reshape(-1).view(self._dtype)
        view["sec"] = stamps_ns // _SECOND
        view["nanosec"] = stamps_ns % _SECOND
        for name, value in values.items():
            view[name] = value
        return rows

    def encode(self, stamps_ns: NDArray[np.int64], **values: NDArray[np.float64]) -> list[bytes]:
        """Encode one message per stamp as CDR; arguments as of `rows`."""
        return [row.tobytes() for row in self.rows(stamps_ns, **values)]

    def decode(self, cdrs: Sequence[bytes]) -> NDArray[Any] | None:
        """Decode stamps and slots of many messages as a structured array.

        ``None`` when a message was not made from this template (another frame, other names): the
        caller then decodes one by one.
        """
        size = len(self._row)
        if any(len(cdr) != size for cdr in cdrs):
            return None
        rows = np.frombuffer(b"".join(cdrs), np.uint8).reshape(-1, size)
        if (rows[:, self._fixed] != self._row[self._fixed]).any():
            return None
        return rows.reshape(-1).view(self._dtype)

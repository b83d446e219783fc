"""Columns of a ``sensor_msgs/PointCloud2`` from its CDR bytes: checked, without a copy, at a glance.

Clouds of one sender differ in stamp, width and data only. What stands before and behind those is read once
and compared afterwards.
"""

from __future__ import annotations

import struct
from collections import deque
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

_COUNT = struct.Struct("<I")
_FORMATS = {
    number: np.dtype(f"<{code}")
    for number, code in enumerate(("i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8"), start=1)
}
_LITTLE = b"\x00\x01"
_MOST_FIELDS = 256
_KEPT = 32


class MalformedError(ValueError):
    """A message is not what its type says; the text says why."""


@dataclass(frozen=True)
class CloudLayout:
    """Where the parts of a cloud stand in its bytes."""

    before: A[bytes, "from the frame to the height"]
    width_at: int
    between: A[bytes, "from the fields to the bytes of a point"]
    row_at: A[int, "bytes of a row, then bytes of all data"]
    dtype: A[np.dtype[Any], "one member a field"]

    def fits(self, cdr: bytes) -> bool:
        """Check whether a message has this layout."""
        return (
            cdr[12 : self.width_at] == self.before
            and cdr[self.width_at + 4 : self.row_at] == self.between
            and cdr[:2] == _LITTLE
            and len(cdr) > self.row_at + 8
        )


_known: deque[CloudLayout] = deque(maxlen=_KEPT)


def cloud_points(cdr: bytes) -> NDArray[Any]:
    """Read any ``sensor_msgs/PointCloud2`` as a structured array that looks into its bytes.

    Parameters
    ----------
    cdr : bytes

    Returns
    -------
    structured array, shape [point]
        Read-only, one member per field.

    Raises
    ------
    MalformedError
        Fields, sizes and data do not fit each other.
    """
    layout = next((each for each in _known if each.fits(cdr)), None)
    if layout is None:
        layout = _layout_of(cdr)
        _known.appendleft(layout)
    (width,) = _COUNT.unpack_from(cdr, layout.width_at)
    row, length = struct.unpack_from("<II", cdr, layout.row_at)
    (height,) = _COUNT.unpack_from(cdr, layout.width_at - 4)
    begin, step = layout.row_at + 8, layout.dtype.itemsize
    if begin + length >= len(cdr) or length != row * height:
        there = min(length, len(cdr) - begin - 1)
        raise MalformedError(f"it claims {height} row(s) of {row} bytes and has {there} bytes of data")
    if width * step > row or (height > 1 and width * step != row):
        raise MalformedError(f"{width} points of {step} bytes do not fill rows of {row} bytes")
    return np.frombuffer(cdr, layout.dtype, width * height, begin)


def _layout_of(cdr: bytes) -> CloudLayout:
    try:
        return _read_layout(cdr)
    except (struct.error, UnicodeDecodeError) as error:
        raise MalformedError("it ends before the cloud does, or its text is none") from error
    except (ValueError, TypeError, OverflowError) as error:
        raise MalformedError(f"its fields contradict each other ({error})") from error


def _read_layout(cdr: bytes) -> CloudLayout:
    if cdr[:2] != _LITTLE:
        raise MalformedError("it is not little-endian CDR")
    at, _ = text_at(cdr, 12)
    height_at = _align_field(at)
    width_at = height_at + 4
    count, at = _COUNT.unpack_from(cdr, width_at + 4)[0], width_at + 8
    if not 0 < count <= _MOST_FIELDS:
        raise MalformedError(f"it has {count} fields")
    names: list[str] = []
    formats: list[Any] = []
    offsets: list[int] = []
    for _ in range(count):
        at, name = text_at(cdr, _align_field(at))
        at = _align_field(at)
        offset, datatype, _, _, _, repeats = struct.unpack_from("<IBBBBI", cdr, at)
        at += 12
        if datatype not in _FORMATS:
            raise MalformedError(f"field '{name}' has the data type {datatype}; allowed are 1 to 8")
        if repeats > 1 << 20:
            raise MalformedError(f"field '{name}' holds {repeats} numbers")
        names.append(name)
        formats.append((_FORMATS[datatype], (repeats,)) if repeats > 1 else _FORMATS[datatype])
        offsets.append(offset)
    big = cdr[at : at + 1] not in (b"\x00", b"")
    step_at = _align_field(at + 1)
    (step,) = _COUNT.unpack_from(cdr, step_at)
    _COUNT.unpack_from(cdr, step_at + 8)
    if step == 0:
        raise MalformedError("a point has no bytes")
    dtype = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": step})
    return CloudLayout(
        cdr[12:width_at],
        width_at,
        cdr[width_at + 4 : step_at + 4],
        step_at + 4,
        dtype.newbyteorder(">") if big else dtype,
    )


def text_at(cdr: bytes, at: int) -> tuple[int, str]:
    """Read a string of a message; return where it ends and its text."""
    (length,) = _COUNT.unpack_from(cdr, at)
    end = at + 4 + length
    # an empty text has a length of 1: its end counts
    if length == 0 or end > len(cdr) or cdr[end - 1] != 0:
        raise MalformedError("a text in it has no end")
    return end, cdr[at + 4 : end - 1].decode()


def _align_field(at: int) -> int:
    return (at + 3) & ~3

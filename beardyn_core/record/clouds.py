"""Blocks of samples as ``sensor_msgs/PointCloud2``: self-describing named columns.

Every cloud has ``sample``, a running index whose gaps prove loss, and ``t``, nanoseconds after the
header's stamp.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.messages import header, header_stamp, make, serialize

CLOUD = "sensor_msgs/msg/PointCloud2"

_DATATYPES = {"i1": 1, "u1": 2, "i2": 3, "u2": 4, "i4": 5, "u4": 6, "f4": 7, "f8": 8}
_STAMP = struct.Struct("<iI")
_LENGTH = struct.Struct("<I")


def column_dtype(columns: tuple[tuple[str, str], ...]) -> np.dtype[Any]:
    """Build the aligned structured type of named columns (NumPy codes), ``sample`` and ``t`` in front."""
    members = [("sample", "<u4"), ("t", "<u4"), *((name, f"<{code}") for name, code in columns)]
    return np.dtype(members, align=True)


class CloudTemplate:
    """Cloud messages of one layout of a point and one frame."""

    def __init__(self, dtype: np.dtype[Any], frame: str) -> None:
        self.dtype = dtype
        pattern = serialize(_cloud(np.zeros(0, dtype), 0, frame))
        # An empty cloud ends with is_bigendian, point_step, row_step, the length of data, is_dense.
        self._head = bytearray(pattern[:-1])
        self._tail = pattern[-1:]
        frame_size = len(frame.encode()) + 1
        self._width_at = 4 + -(-(12 + frame_size) // 4) * 4 + 4

    def encode(self, points: NDArray[Any], stamp_ns: int) -> bytes:
        """Encode a cloud as CDR.

        Parameters
        ----------
        points : structured array of the template's dtype
        stamp_ns : int
            Time that ``t`` counts from, [ns].
        """
        head = bytearray(self._head)
        data = points.tobytes()
        _STAMP.pack_into(head, 4, *divmod(int(stamp_ns), 1_000_000_000))
        _LENGTH.pack_into(head, self._width_at, len(points))
        _LENGTH.pack_into(head, len(head) - 8, len(data))
        _LENGTH.pack_into(head, len(head) - 4, len(data))
        return b"".join((head, data, self._tail))

    def encode_rows(self, points: NDArray[Any], stamps_ns: NDArray[np.int64]) -> NDArray[np.uint8]:
        """Encode clouds of as many points each at once, with the bytes that `encode` makes of each.

        Parameters
        ----------
        points : structured array of the template's dtype, shape [cloud, point], C-contiguous
        stamps_ns : int64 array, shape [cloud]
            Times that ``t`` counts from, [ns].

        Returns
        -------
        uint8 array, shape [cloud, byte]
        """
        count, data = points.shape[0], points.view(np.uint8).reshape(points.shape[0], -1)
        first = np.frombuffer(self.encode(points[0], int(stamps_ns[0])), np.uint8)
        begin = len(self._head)
        rows = np.empty((count, len(first)), np.uint8)
        rows[:, :begin], rows[:, -1] = first[:begin], first[-1]
        rows[:, begin : begin + data.shape[1]] = data
        for row, stamp in zip(rows, stamps_ns.tolist(), strict=True):
            _STAMP.pack_into(row.data, 4, *divmod(stamp, 1_000_000_000))
        return rows


def points_of(
    dtype: np.dtype[Any], first_sample: int, time_ns: NDArray[np.int64], stamp_ns: int | NDArray[np.int64]
) -> NDArray[Any]:
    """Make points with ``sample`` and ``t`` filled, for times [ns] from a stamp on, at or before each.

    The samples run from ``first_sample`` on; the caller fills the other columns.
    """
    points = np.zeros(len(time_ns), dtype)
    points["sample"] = np.arange(first_sample, first_sample + len(time_ns)) & 0xFFFFFFFF
    points["t"] = time_ns - stamp_ns
    return points


def fill(points: NDArray[Any], names: Sequence[str], numbers: NDArray[np.float64]) -> None:
    """Write an array, shape [point, column], to the columns of these names: of one type, side by side."""
    fields = points.dtype.fields
    assert fields is not None
    kind, first, *_ = fields[names[0]]
    begin = first // kind.itemsize
    columns = points.view(kind).reshape(len(points), points.dtype.itemsize // kind.itemsize)
    columns[:, begin : begin + len(names)] = numbers


def encode_points(points: NDArray[Any], stamp_ns: int, frame: str) -> bytes:
    """Encode a single cloud as CDR; `CloudTemplate` is faster for many."""
    return serialize(_cloud(points, stamp_ns, frame))


def cloud_to_arrays(cdr: bytes) -> NDArray[Any]:
    """Read any ``sensor_msgs/PointCloud2`` as a structured array, one column per field.

    Returns
    -------
    structured array, shape [point]
        Index it by the field's name: ``cloud_to_arrays(cdr)["ax"]``. Read-only: a look into the bytes.

    Raises
    ------
    MalformedError
        Fields, sizes and data do not fit each other.
    """
    return cloud_points(cdr)


def cloud_times(cdr: bytes, points: NDArray[Any]) -> NDArray[np.int64]:
    """Compute the time of each point of a cloud, shape [point], [ns]."""
    return header_stamp(cdr) + points["t"].astype(np.int64)


def _cloud(points: NDArray[Any], stamp_ns: int, frame: str) -> Any:
    dtype = points.dtype
    kind = "sensor_msgs/msg/PointField"
    fields = [
        make(kind, name=name, offset=offset, datatype=_DATATYPES[member.str[1:]], count=1)
        for name, (member, offset, *_) in (dtype.fields or {}).items()
    ]
    return make(
        CLOUD,
        header=header(stamp_ns, frame),
        height=1,
        width=len(points),
        fields=fields,
        is_bigendian=False,
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * len(points),
        data=np.frombuffer(points.tobytes(), np.uint8),
        is_dense=True,
    )

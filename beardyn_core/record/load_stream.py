"""Load on the journal as messages of ``load/blocks``, float64 so that a replay is bit-identical."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.record import clouds
from beardyn_core.record.topics import FRAME
from beardyn_core.scene.load import WRENCH_AXES, LoadHistory

BOGIE_AXES = ("ux", "uy", "uz")
LOAD = clouds.column_dtype(tuple((name, "f8") for name in (*WRENCH_AXES, "shaft_speed", *BOGIE_AXES)))
LONGEST_NS = 0xFFFFFFFF


def encode_load(history: LoadHistory, first_sample: int, frame: str = FRAME) -> bytes:
    """Encode one message of ``load/blocks`` as CDR; an empty history ends the stream.

    Parameters
    ----------
    history : LoadHistory
        At most 4.29 s, which is what ``t`` can count.
    first_sample : int
        Running index of the first sample since the start of the stream.
    """
    if not len(history):
        return _template(frame).encode(_points(history, first_sample, 0), 0)
    return encode_loads(history, first_sample, len(history), frame).tobytes()


def encode_loads(history: LoadHistory, first_sample: int, each: int, frame: str) -> NDArray[np.uint8]:
    """Encode messages of so many samples each at once, shape [message, byte]; as `encode_load` of each.

    Parameters
    ----------
    history : LoadHistory
        As many samples as messages hold, whole.
    first_sample : int
        Running index of the first sample since the start of the stream.
    each : int
        Samples of a message.
    """
    stamps = history.time_ns[::each]
    if np.any(history.time_ns[each - 1 :: each] - stamps > LONGEST_NS):
        raise ValueError("one message of load/blocks holds at most 4.29 s: send the history in parts")
    points = _points(history, first_sample, np.repeat(stamps, each))
    return _template(frame).encode_rows(points.reshape(-1, each), stamps)


def _points(history: LoadHistory, first_sample: int, stamp: int | NDArray[np.int64]) -> NDArray[Any]:
    points = clouds.points_of(LOAD, first_sample, history.time_ns, stamp)
    clouds.fill(points, WRENCH_AXES, history.wrench)
    points["shaft_speed"] = history.shaft_speed
    clouds.fill(points, BOGIE_AXES, history.bogie)
    return points


@cache
def _template(frame: str) -> clouds.CloudTemplate:
    return clouds.CloudTemplate(LOAD, frame)


def decode_load(cdr: bytes) -> tuple[LoadHistory, NDArray[np.int64]]:
    """Decode load history and running sample indices of one message of ``load/blocks``.

    A cloud without bogie displacement means zero displacement.
    """
    points = clouds.cloud_to_arrays(cdr)
    names = points.dtype.names or ()
    zero = np.zeros(len(points))
    history = LoadHistory(
        clouds.cloud_times(cdr, points),
        np.stack([points[axis].astype(float) for axis in WRENCH_AXES], axis=1),
        points["shaft_speed"].astype(float),
        np.stack([points[a].astype(float) if a in names else zero for a in BOGIE_AXES], axis=1),
    )
    return history, points["sample"].astype(np.int64)


def joined_load(parts: Sequence[LoadHistory]) -> LoadHistory:
    """Join the load of several messages."""
    empty = LoadHistory(np.zeros(0, np.int64), np.zeros((0, 6)), np.zeros(0), np.zeros((0, 3)))
    fields = ("time_ns", "wrench", "shaft_speed", "bogie")
    return LoadHistory(*(np.concatenate([getattr(part, f) for part in (empty, *parts)]) for f in fields))

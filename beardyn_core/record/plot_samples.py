"""Every sample of a block of vibration in a message whose array Foxglove plots.

A ``geometry_msgs/PolygonStamped`` has a stamp and a list of three numbers each: ax, ay, az of one sample
after the other. It repeats ``vibration``, whose columns no plot reads.
"""

from __future__ import annotations

import struct

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.record.cloud_layout import cloud_points, text_at
from beardyn_core.record.encoding import ACCELERATION_AXES
from beardyn_core.record.messages import decode
from beardyn_core.record.topics import POLYGON

_COUNT = struct.Struct("<I")
_FRAME_AT = 12  # behind the encapsulation and the stamp


def encode_samples(cloud: bytes) -> bytes:
    """Encode the samples of a ``vibration`` message, with its stamp and frame, as ``vibration_samples``."""
    points = cloud_points(cloud)
    samples = np.empty((len(points), len(ACCELERATION_AXES)), "<f4")
    for column, axis in enumerate(ACCELERATION_AXES):
        samples[:, column] = points[axis]
    end, _ = text_at(cloud, _FRAME_AT)
    head = cloud[:end].ljust((end + 3) & ~3, b"\0")  # stamp and frame stand at the beginning of both types
    return b"".join((head, _COUNT.pack(len(samples)), samples.tobytes()))


def decode_samples(cdr: bytes) -> Float:
    """Decode the samples of ``vibration_samples``, shape [sample, axis], [m/s^2]."""
    points = decode(POLYGON, cdr).polygon.points
    return np.array([(point.x, point.y, point.z) for point in points], float).reshape(-1, 3)

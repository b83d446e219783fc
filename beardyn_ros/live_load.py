"""Load of one moment as the messages of the live mode."""

from __future__ import annotations

import numpy as np

from beardyn_core.record.messages import header, make, serialize
from beardyn_core.record.topics import FRAME, TWIST, WRENCH


def encode_wrench(wrench: np.ndarray, stamp_ns: int, frame: str = FRAME) -> bytes:
    """Encode one ``load/wrench`` as CDR, shape [6], [N, N m]."""
    force = make("geometry_msgs/msg/Vector3", x=wrench[0], y=wrench[1], z=wrench[2])
    torque = make("geometry_msgs/msg/Vector3", x=wrench[3], y=wrench[4], z=wrench[5])
    content = make("geometry_msgs/msg/Wrench", force=force, torque=torque)
    return serialize(make(WRENCH, header=header(stamp_ns, frame), wrench=content))


def encode_shaft(speed: float, stamp_ns: int, frame: str = FRAME) -> bytes:
    """Encode one ``load/shaft`` as CDR, [rad/s] about +y."""
    zero = make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
    turning = make("geometry_msgs/msg/Vector3", x=0.0, y=speed, z=0.0)
    content = make("geometry_msgs/msg/Twist", linear=zero, angular=turning)
    return serialize(make(TWIST, header=header(stamp_ns, frame), twist=content))

"""Frames of an axlebox: their names, place and orientation in each other, transforms as tf2 messages.

One tree for each axlebox. The frame of an axlebox has its origin at the bearing centre: x forwards, y left
along the axle, z up (REP-103). Parts and sensors have frames below it, ``<frame>/cone``,
``<frame>/axlebox_top``.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, isfinite, sin
from re import fullmatch
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError
from beardyn_core.record.messages import header, make, serialize
from beardyn_core.record.topics import FRAME

TRANSFORMS = "tf2_msgs/msg/TFMessage"
_STAMP = struct.Struct("<iI")


def frame_of(namespace: str, frame_id: str = "") -> str:
    """Choose the frame of an axlebox: as given, or its namespace without the leading slash.

    Parameters
    ----------
    namespace : str
        Of the node, ``/car/axle_1_left``.
    frame_id : str
        The parameter; '' for the namespace.

    Raises
    ------
    InputError
        The name is none that tf2 takes.
    """
    name = frame_id or namespace.strip("/") or FRAME
    if not fullmatch(r"[A-Za-z0-9_.-]+(/[A-Za-z0-9_.-]+)*", name):
        raise InputError(
            f"parameter 'frame_id': '{name}' is no name of a frame; letters, digits, _ . - and single "
            "slashes in between are allowed, none at the start (tf2 refuses it)"
        )
    return name


@dataclass(frozen=True)
class Pose:
    """Place and orientation.

    Parameters
    ----------
    xyz : tuple of float, [m]
    rpy : tuple of float
        Roll about x, then pitch about y, then yaw about z, about fixed axes, [rad].
    """

    xyz: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def quaternion(self) -> tuple[float, float, float, float]:
        """Rotation as x, y, z, w."""
        (cr, cp, cy), (sr, sp, sy) = ([turn(0.5 * angle) for angle in self.rpy] for turn in (cos, sin))
        return (
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        )


ORIGIN = Pose()


def pose_from(text: str) -> Pose:
    """Read ``x y z roll pitch yaw``, [m], [rad]; '' is the origin.

    Raises
    ------
    InputError
        Not six finite numbers.
    """
    words = text.replace(",", " ").split()
    if not words:
        return ORIGIN
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != 6 or not all(isfinite(number) for number in numbers):
        raise InputError(
            f"parameter 'pose_in_parent': '{text}' must be six numbers, x y z in m and roll pitch yaw in rad"
        )
    x, y, z, roll, pitch, yaw = numbers
    return Pose((x, y, z), (roll, pitch, yaw))


def _transform(stamp_ns: int, parent: str, child: str, xyz: Any, quaternion: Any) -> Any:
    x, y, z, w = quaternion
    return make(
        "geometry_msgs/msg/TransformStamped",
        header=header(stamp_ns, parent),
        child_frame_id=child,
        transform=make(
            "geometry_msgs/msg/Transform",
            translation=make("geometry_msgs/msg/Vector3", x=xyz[0], y=xyz[1], z=xyz[2]),
            rotation=make("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w),
        ),
    )


def encode_fixed(frames: Sequence[tuple[str, str, Pose]]) -> bytes:
    """Encode transforms that do not change: parent, child and pose of each, as CDR."""
    return serialize(
        make(
            TRANSFORMS,
            transforms=[
                _transform(0, parent, child, pose.xyz, pose.quaternion) for parent, child, pose in frames
            ],
        )
    )


class TurningFrames:
    """Frames that turn about +y of one parent, encoded from their angles.

    Parameters
    ----------
    parent : str
    children : sequence of str
    """

    def __init__(self, parent: str, children: Sequence[str]) -> None:
        # stamps and quaternions that stand nowhere else mark their places in the message
        stamps = [1_000_000_007 * (k + 1) for k in range(len(children))]
        marks = [np.pi * np.arange(4.0 * k + 1.0, 4.0 * k + 5.0) for k in range(len(children))]
        content = [
            _transform(stamp, parent, child, (0.0, 0.0, 0.0), mark)
            for stamp, child, mark in zip(stamps, children, marks, strict=True)
        ]
        pattern = serialize(make(TRANSFORMS, transforms=content))
        self._row = np.frombuffer(pattern, np.uint8).copy()
        self._stamps = [pattern.index(_STAMP.pack(*divmod(stamp, 1_000_000_000))) for stamp in stamps]
        self._turns = [pattern.index(mark.tobytes()) for mark in marks]

    def encode(self, stamp_ns: int, angles: NDArray[np.float64]) -> bytes:
        """Encode all frames at one time, angles in the order of the children, [rad], as CDR."""
        row = self._row.copy()
        stamp = np.frombuffer(_STAMP.pack(*divmod(stamp_ns, 1_000_000_000)), np.uint8)
        half = 0.5 * angles
        zero = np.zeros_like(half)
        turns = np.stack([zero, np.sin(half), zero, np.cos(half)], axis=1)
        for at, place, turn in zip(self._stamps, self._turns, turns, strict=True):
            row[at : at + 8] = stamp
            row[place : place + 32] = turn.view(np.uint8)
        return row.tobytes()

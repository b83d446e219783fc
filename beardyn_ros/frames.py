"""Names of frames, one tree for each axlebox, and a place of it in the frame of a vehicle.

The frame of an axlebox has its origin at the bearing centre: x forwards, y left along the axle, z up
(REP-103). Parts and sensors have frames below it, ``<frame>/cone``, ``<frame>/axlebox_top``.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, sin
from re import fullmatch

from beardyn_core.errors import InputError
from beardyn_core.record.topics import FRAME
from beardyn_ros.parameters import NodeParameter

FRAME_ID = NodeParameter(
    "frame_id",
    "",
    "frame of the axlebox, origin at the bearing centre; empty: the namespace, so that several boxes differ",
)


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
    """Place and orientation, as in URDF.

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
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if not words:
        return ORIGIN
    if len(numbers) != 6 or not all(isfinite(number) for number in numbers):
        raise InputError(
            f"parameter 'pose_in_parent': '{text}' must be six numbers, x y z in m and roll pitch yaw in rad"
        )
    x, y, z, roll, pitch, yaw = numbers
    return Pose((x, y, z), (roll, pitch, yaw))

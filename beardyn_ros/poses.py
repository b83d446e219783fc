"""Place and orientation of one frame in another, as in URDF."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, isfinite, sin

from beardyn_core.base.errors import InputError


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

"""Poses, twists and contacts by array formulas, as a reference for the compiled ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    ANGLE,
    ANGULAR,
    AXIAL,
    AXIS,
    CAGE_BODY,
    CONTACT_OUTPUT,
    CUP_BODY,
    LARGEST,
    LINEAR,
    MOMENTUM,
    OUTPUT_ARM,
    OUTPUT_FIELDS,
    OUTPUT_FILM,
    OUTPUT_FORCE,
    OUTPUT_SLIP,
    POSITION,
    RADIUS,
    RATE,
    SPIN,
    TILT,
    TURN,
    VELOCITY,
)
from beardyn_core.physics.tiers.parameters import RollerParams
from test.arrays import quaternion_product

Float = NDArray[np.float64]
SIDE = np.array([-1.0, 1.0])
_Y = np.array([0.0, 1.0, 0.0])


class RollerViews:
    """Roller states of several instants in world axes; leading shape [time, row, roller].

    Parameters
    ----------
    rollers : float64 array, shape [time, block, ROLLER_FIELDS, lane]
    bodies : float64 array, shape [time, 4, BODY_STATES]
    arrangement : Arrangement
    roller : RollerParams
    """

    def __init__(self, rollers: Float, bodies: Float, arrangement: Arrangement, roller: RollerParams) -> None:
        self._fields = arrangement.to_rollers(np.moveaxis(rollers, 2, 0))
        self._bodies = bodies
        self._roller = roller
        angle = self._fields[ANGLE]
        zero = np.zeros_like(angle)
        self._outward = np.stack([np.sin(angle), zero, np.cos(angle)], axis=-1)
        self._ahead = np.stack([np.cos(angle), zero, -np.sin(angle)], axis=-1)
        self._side = np.broadcast_to(SIDE[:, None], angle.shape)[..., None]

    def _vector(self, first: int) -> Float:
        r, t, a = self._fields[first], self._fields[first + 1], self._fields[first + 2]
        return self._outward * r[..., None] + self._ahead * t[..., None] + _Y * self._side * a[..., None]

    def _axial_vector(self, first: int) -> Float:
        r, t, a = self._fields[first], self._fields[first + 1], self._fields[first + 2]
        across = self._outward * r[..., None] + self._ahead * t[..., None]
        return self._side * across + _Y * a[..., None]

    @property
    def orbit_angle(self) -> Float:
        """Azimuth of each roller, [rad]."""
        return self._fields[ANGLE]

    @property
    def orbit_speed(self) -> Float:
        """Orbit speed of each roller, [rad/s]."""
        return self._fields[VELOCITY + 1] / self._fields[RADIUS]

    @property
    def axis(self) -> Float:
        """Roller axis towards the large end."""
        return self._vector(AXIS)

    @property
    def centre(self) -> Float:
        """Centre of mass, [m]."""
        place = self._outward * self._fields[RADIUS][..., None]
        place = place + _Y * self._side * self._fields[AXIAL][..., None]
        return place + self._bodies[:, CUP_BODY, None, None, POSITION : POSITION + 3]

    def pose(self) -> Float:
        """Mid-length and quaternion x, y, z, w: body x along the axis, z facing the cup at zero spin."""
        along = self.axis
        facing = self._outward - along * np.sum(self._outward * along, axis=-1, keepdims=True)
        facing /= np.linalg.norm(facing, axis=-1, keepdims=True)
        frame = np.stack([along, np.cross(facing, along), facing], axis=-1)
        half = 0.5 * (self._side[..., 0] * self._fields[SPIN])
        zero = np.zeros_like(half)
        turned = np.stack([np.sin(half), zero, zero, np.cos(half)], axis=-1)
        middle = self.centre - self._roller.mass_offset * along
        return np.concatenate([middle, quaternion_product(quaternion_of(frame), turned)], axis=-1)

    def twist(self) -> Float:
        """Velocity of the centre of mass and angular velocity, [m/s], [rad/s]."""
        momentum, axis = self._axial_vector(MOMENTUM), self._side * self.axis
        along = np.sum(momentum * axis, axis=-1, keepdims=True)
        extra = along * (1.0 / self._roller.axial_inertia - 1.0 / self._roller.transverse_inertia)
        omega = momentum / self._roller.transverse_inertia + extra * axis
        return np.concatenate([self._vector(VELOCITY), omega], axis=-1)

    def contacts(self) -> Float:
        """`CONTACT_FIELDS` of each of the four contacts, shape [time, row, roller, kind, 9]."""
        kinds = []
        centre = self.centre
        for kind in range(4):
            first = CONTACT_OUTPUT + kind * OUTPUT_FIELDS
            force = self._vector(first + OUTPUT_FORCE)
            point = centre + self._vector(first + OUTPUT_ARM)
            scalars = np.stack(
                [self._fields[first + OUTPUT_SLIP], self._fields[first + OUTPUT_FILM]], axis=-1
            )
            kinds.append(np.concatenate([point, force, scalars], axis=-1))
        contacts, zero = np.stack(kinds, axis=-2), np.zeros_like(self._fields[0])
        touching = np.any(contacts[..., 3:6] != 0.0, axis=-1, keepdims=True)
        largest = np.sqrt(np.stack([*self._fields[LARGEST : LARGEST + 3], zero], axis=-1))[..., None]
        return np.concatenate([np.where(touching, contacts, 0.0), largest], axis=-1)


def ring_pose(bodies: Float, cage_place: float) -> Float:
    """Place and quaternion of cup, cone and cages, shape [time, 4, 7]."""
    place = bodies[..., POSITION : POSITION + 3].copy()
    place[:, CAGE_BODY:, 1] += SIDE * cage_place
    tilt = bodies[..., TILT : TILT + 3]
    angle = np.linalg.norm(tilt, axis=-1, keepdims=True)
    # sin(a/2)/a, finite at zero
    tilted = np.concatenate([0.5 * np.sinc(angle / (2.0 * np.pi)) * tilt, np.cos(0.5 * angle)], axis=-1)
    half = 0.5 * bodies[..., TURN]
    zero = np.zeros_like(half)
    turned = np.stack([zero, np.sin(half), zero, np.cos(half)], axis=-1)
    return np.concatenate([place, quaternion_product(tilted, turned)], axis=-1)


def ring_twist(bodies: Float) -> Float:
    """Velocity and angular velocity of cup, cone and cages, shape [time, 4, 6]."""
    omega = bodies[..., ANGULAR : ANGULAR + 3] + _Y * bodies[..., RATE, None]
    return np.concatenate([bodies[..., LINEAR : LINEAR + 3], omega], axis=-1)


def quaternion_of(frame: Float) -> Float:
    """Quaternion x, y, z, w of rotation matrices ``[..., 3, 3]`` whose columns are the turned axes.

    References
    ----------
    Shepperd (1978): divide by the largest of the four components.
    """
    m = np.moveaxis(frame, (-2, -1), (0, 1))
    squares = np.stack(
        [
            1.0 + m[0, 0] - m[1, 1] - m[2, 2],
            1.0 - m[0, 0] + m[1, 1] - m[2, 2],
            1.0 - m[0, 0] - m[1, 1] + m[2, 2],
            1.0 + m[0, 0] + m[1, 1] + m[2, 2],
        ]
    )
    xy, xz, yz = m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1]
    wx, wy, wz = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
    rows = np.array(
        [
            [squares[0], xy, xz, wx],
            [xy, squares[1], yz, wy],
            [xz, yz, squares[2], wz],
            [wx, wy, wz, squares[3]],
        ]
    )
    best = np.argmax(squares, axis=0)
    chosen = np.take_along_axis(rows, best[None, None], axis=0)[0]
    chosen = np.moveaxis(chosen, 0, -1)
    return chosen / np.linalg.norm(chosen, axis=-1, keepdims=True)

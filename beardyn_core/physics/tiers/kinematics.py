"""World poses, twists and contact forces from the kernel's state."""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.lanes.vectors import add, add_scaled, cross, dot, scale
from beardyn_core.physics.tiers.parameters import RollerParams

BODIES = 4
KINDS = 4
# Columns of an instant; the angles and then the speeds of all rollers follow.
INSTANT_LOAD, INSTANT_SHAFT, INSTANT_CAGES, INSTANT_ROLLERS = 0, 6, 8, 12


class Instants(Protocol):
    """Rollers at some instants, computed when first used."""

    def __getitem__(self, times: slice) -> Instants:
        """Take some of the instants."""

    def whole(self) -> Float:
        """Return the state of the kernel, shape [time, block, ROLLER_FIELDS, lane]."""

    def orbits(self) -> Float:
        """Return the same state, with no more of it than `write_instants` needs."""

    def hardest(self) -> Instants:
        """Take the instant with the largest load of a roller since the snapshot before."""


class Snapshots:
    """Bodies and contacts at some instants, computed when first used.

    Parameters
    ----------
    rollers : float64 array, shape [time, block, ROLLER_FIELDS, lane], or Instants
    bodies : float64 array, shape [time, 4, BODY_STATES]
        Nobody changes them any more.
    count : int
        Rollers of a row.
    cage_place : float
        Axial place of a cage's centre of mass from the middle plane, [m].
    """

    def __init__(
        self, rollers: Float | Instants, bodies: Float, count: int, roller: RollerParams, cage_place: float
    ) -> None:
        self._kept, self._bodies, self._count = rollers, bodies, count
        self._roller, self._cage_place = roller, cage_place

    @property
    def _rollers(self) -> Float:
        kept = self._kept
        if not isinstance(kept, np.ndarray):
            kept = self._kept = kept.whole()
        return kept

    def pose(self) -> Float:
        """Compute place and quaternion x, y, z, w of cup, cone, cages and rollers, shape [time, body, 7].

        A roller's place is its mid-length, its body axis x along its axis, z facing the cup at zero spin.
        """
        out = np.empty((len(self._bodies), BODIES + 2 * self._count, 7))
        _poses(self._rollers, self._bodies, self._count, self._roller.mass_offset, self._cage_place, out)
        return out

    def twist(self) -> Float:
        """Compute velocity of the mass centre and angular velocity, [m/s], [rad/s], shape [time, body, 6]."""
        out = np.empty((len(self._bodies), BODIES + 2 * self._count, 6))
        axial, transverse = self._roller.axial_inertia, self._roller.transverse_inertia
        _twists(self._rollers, self._bodies, self._count, axial, transverse, out)
        return out

    def largest_loads(self) -> Float:
        """Find the largest loads of any roller with cup, cone and rib since the first one began, [3], [N]."""
        kept = self._kept if isinstance(self._kept, np.ndarray) else self._kept.hardest().whole()
        squares = kept[:, :, layout.LARGEST : layout.LARGEST + layout.LARGEST_FIELDS]
        return np.asarray(np.sqrt(squares.max(axis=(0, 1, 3))))

    def contacts(self) -> Float:
        """Compute the `CONTACT_FIELDS` of each of the four contacts, shape [time, row, roller, kind, 9]."""
        out = np.empty((len(self._bodies), 2, self._count, KINDS, 9))
        _contacts(self._rollers, self._bodies, self._count, out)
        return out


@entry
def write_instants(rollers: Any, bodies: Any, loads: Any, stride: Any, count: Any, out: Any) -> None:
    """Write the values of some instants from which the trends are computed.

    Parameters
    ----------
    rollers : float64 array, shape [time, block, ROLLER_FIELDS, lane]
    bodies : float64 array, shape [time, 4, BODY_STATES]
    loads : float64 array, shape [row, column]
        Load of instant t in row ``(t + 1) * stride``.
    stride, count : int
        Rows from instant to instant; rollers of a row of the bearing.
    out : float64 array, shape [time, INSTANT_ROLLERS + 4 * count]
        Written.
    """
    for t in range(bodies.shape[0]):
        for i in range(6):
            out[t, INSTANT_LOAD + i] = loads[(t + 1) * stride, i]
        out[t, INSTANT_SHAFT] = bodies[t, layout.CONE_BODY, layout.TURN]
        out[t, INSTANT_SHAFT + 1] = bodies[t, layout.CONE_BODY, layout.RATE]
        for row in range(2):
            out[t, INSTANT_CAGES + row] = bodies[t, layout.CAGE_BODY + row, layout.TURN]
            out[t, INSTANT_CAGES + 2 + row] = bodies[t, layout.CAGE_BODY + row, layout.RATE]
            for k in range(count):
                block, lane = _place(rollers, count, row, k)
                at = INSTANT_ROLLERS + row * count + k
                out[t, at] = rollers[t, block, layout.ANGLE, lane]
                orbit = rollers[t, block, layout.VELOCITY + 1, lane] / rollers[t, block, layout.RADIUS, lane]
                out[t, at + 2 * count] = orbit


@inline
def _place(rollers: Any, count: Any, row: Any, k: Any) -> Any:
    """Find block and lane of a roller; see `physics.bodies.arrangement`."""
    half = rollers.shape[3] // 2
    if half == 0:
        return row * count + k, 0
    return k // half, k % half + row * half


@inline
def _directions(rollers: Any, t: Any, block: Any, lane: Any, row: Any) -> Any:
    """Find the radial and tangential unit vectors at a roller, and the side of its row."""
    angle = rollers[t, block, layout.ANGLE, lane]
    cosine, sine = math.cos(angle), math.sin(angle)
    return (sine, 0.0, cosine), (cosine, 0.0, -sine), 2.0 * row - 1.0


@inline
def _polar(rollers: Any, t: Any, block: Any, lane: Any, first: Any, directions: Any) -> Any:
    """Turn three components in the orbit frame into a world vector."""
    outward, ahead, side = directions
    across = add(
        scale(rollers[t, block, first, lane], outward), scale(rollers[t, block, first + 1, lane], ahead)
    )
    return across[0], side * rollers[t, block, first + 2, lane], across[2]


@inline
def _centre(rollers: Any, bodies: Any, t: Any, block: Any, lane: Any, directions: Any) -> Any:
    """Find the centre of mass in the world, [m]."""
    outward, _ahead, side = directions
    radius = rollers[t, block, layout.RADIUS, lane]
    return (
        radius * outward[0] + bodies[t, layout.CUP_BODY, layout.POSITION],
        side * rollers[t, block, layout.AXIAL, lane] + bodies[t, layout.CUP_BODY, layout.POSITION + 1],
        radius * outward[2] + bodies[t, layout.CUP_BODY, layout.POSITION + 2],
    )


@entry
def _poses(rollers, bodies, count, mass_offset, cage_place, out):
    for t in range(bodies.shape[0]):
        for body in range(BODIES):
            _ring_pose(
                bodies[t, body],
                (2.0 * body - 5.0) * cage_place if body >= layout.CAGE_BODY else 0.0,
                out[t, body],
            )
        for row in range(2):
            for k in range(count):
                block, lane = _place(rollers, count, row, k)
                directions = _directions(rollers, t, block, lane, row)
                outward = directions[0]
                along = _polar(rollers, t, block, lane, layout.AXIS, directions)
                facing = add_scaled(outward, -dot(outward, along), along)
                facing = scale(1.0 / math.sqrt(dot(facing, facing)), facing)
                half = 0.5 * directions[2] * rollers[t, block, layout.SPIN, lane]
                turn = quaternion_product(
                    quaternion_of(along, cross(facing, along), facing),
                    (math.sin(half), 0.0, 0.0, math.cos(half)),
                )
                centre = _centre(rollers, bodies, t, block, lane, directions)
                middle = add_scaled(centre, -mass_offset, along)
                _write_pose(out[t, BODIES + row * count + k], middle, turn)


@inline
def _ring_pose(body: Any, lift: Any, out: Any) -> None:
    tilt = (body[layout.TILT], body[layout.TILT + 1], body[layout.TILT + 2])
    angle = math.sqrt(dot(tilt, tilt))
    # sin(a/2)/a, finite at zero
    share = math.sin(0.5 * angle) / angle if angle > 0.0 else 0.5
    tilted = (share * tilt[0], share * tilt[1], share * tilt[2], math.cos(0.5 * angle))
    half = 0.5 * body[layout.TURN]
    turn = quaternion_product(tilted, (0.0, math.sin(half), 0.0, math.cos(half)))
    _write_pose(
        out, (body[layout.POSITION], body[layout.POSITION + 1] + lift, body[layout.POSITION + 2]), turn
    )


@inline
def _write_pose(out: Any, place: Any, turn: Any) -> None:
    for i in range(3):
        out[i] = place[i]
    for i in range(4):
        out[3 + i] = turn[i]


@entry
def _twists(rollers, bodies, count, axial_inertia, transverse_inertia, out):
    for t in range(bodies.shape[0]):
        for body in range(BODIES):
            for i in range(3):
                out[t, body, i] = bodies[t, body, layout.LINEAR + i]
                out[t, body, 3 + i] = bodies[t, body, layout.ANGULAR + i]
            out[t, body, 4] += bodies[t, body, layout.RATE]
        for row in range(2):
            for k in range(count):
                block, lane = _place(rollers, count, row, k)
                directions = _directions(rollers, t, block, lane, row)
                side = directions[2]
                # angular momentum is an axial vector: a mirrored row turns the other way
                momentum = scale(side, _polar(rollers, t, block, lane, layout.MOMENTUM, directions))
                axis = scale(side, _polar(rollers, t, block, lane, layout.AXIS, directions))
                extra = dot(momentum, axis) * (1.0 / axial_inertia - 1.0 / transverse_inertia)
                omega = add_scaled(scale(1.0 / transverse_inertia, momentum), extra, axis)
                velocity = _polar(rollers, t, block, lane, layout.VELOCITY, directions)
                for i in range(3):
                    out[t, BODIES + row * count + k, i] = velocity[i]
                    out[t, BODIES + row * count + k, 3 + i] = omega[i]


@entry
def _contacts(rollers, bodies, count, out):
    for t in range(bodies.shape[0]):
        for row in range(2):
            for k in range(count):
                block, lane = _place(rollers, count, row, k)
                directions = _directions(rollers, t, block, lane, row)
                centre = _centre(rollers, bodies, t, block, lane, directions)
                for kind in range(KINDS):
                    first = layout.CONTACT_OUTPUT + kind * layout.OUTPUT_FIELDS
                    force = _polar(rollers, t, block, lane, first + layout.OUTPUT_FORCE, directions)
                    here = out[t, row, k, kind]
                    here[:] = 0.0
                    if force[0] != 0.0 or force[1] != 0.0 or force[2] != 0.0:
                        point = add(
                            centre, _polar(rollers, t, block, lane, first + layout.OUTPUT_ARM, directions)
                        )
                        for i in range(3):
                            here[i], here[3 + i] = point[i], force[i]
                        here[6] = rollers[t, block, first + layout.OUTPUT_SLIP, lane]
                        here[7] = rollers[t, block, first + layout.OUTPUT_FILM, lane]
                    if kind < layout.LARGEST_FIELDS:
                        here[8] = math.sqrt(rollers[t, block, layout.LARGEST + kind, lane])


@inline
def quaternion_product(a: Any, b: Any) -> Any:
    """Multiply quaternions x, y, z, w: the turn `b` followed by `a`."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + bw * ax + (ay * bz - az * by),
        aw * by + bw * ay + (az * bx - ax * bz),
        aw * bz + bw * az + (ax * by - ay * bx),
        aw * bw - (ax * bx + ay * by + az * bz),
    )


@inline
def quaternion_of(x: Any, y: Any, z: Any) -> Any:
    """Find the quaternion x, y, z, w of a rotation given by the turned axes.

    References
    ----------
    Shepperd (1978): divide by the largest of the four components.
    """
    squares = (1.0 + x[0] - y[1] - z[2], 1.0 - x[0] + y[1] - z[2], 1.0 - x[0] - y[1] + z[2])
    trace = 1.0 + x[0] + y[1] + z[2]
    xy, xz, yz = y[0] + x[1], z[0] + x[2], z[1] + y[2]
    wx, wy, wz = y[2] - z[1], z[0] - x[2], x[1] - y[0]
    largest = max(squares[0], squares[1], squares[2], trace)
    if largest == squares[0]:
        found = (squares[0], xy, xz, wx)
    elif largest == squares[1]:
        found = (xy, squares[1], yz, wy)
    elif largest == squares[2]:
        found = (xz, yz, squares[2], wz)
    else:
        found = (wx, wy, wz, trace)
    shrink = 1.0 / math.sqrt(
        found[0] * found[0] + found[1] * found[1] + found[2] * found[2] + found[3] * found[3]
    )
    return shrink * found[0], shrink * found[1], shrink * found[2], shrink * found[3]

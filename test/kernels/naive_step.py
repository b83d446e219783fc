"""Slow, obvious reference of a whole roller step: Cartesian coordinates of a row, dense 6 x 6 algebra."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from test.kernels.naive import (
    Motion,
    closed_form_point,
    cone_normal,
    pocket_wrench,
    raceway_wrench,
    rib_wrench,
)

Float = NDArray[np.float64]


@dataclass
class RollerState:
    """A roller in Cartesian coordinates of its row's frame, from the cup's origin."""

    centre: Float
    axis: Float
    velocity: Float
    momentum: Float


@dataclass(frozen=True)
class Ring:
    """A ring in Cartesian coordinates of a row's frame; cage: `axis` is its small rotation.

    ``velocity`` and ``omega`` are those that contacts see, ``drift`` is what the origin has just moved with.
    """

    origin: Float
    axis: Float
    velocity: Float
    omega: Float
    drift: Float
    turn: float = 0.0


def turned(angle: float, vector: Float) -> Float:
    """Rotate about the third axis."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]])


def rotated(rotation: Float, vector: Float) -> Float:
    """Rotate by a rotation vector, Rodrigues' formula."""
    angle = float(np.linalg.norm(rotation))
    if angle == 0.0:
        return vector
    n = rotation / angle
    result: Float = (
        math.cos(angle) * vector
        + math.sin(angle) * np.cross(n, vector)
        + (1.0 - math.cos(angle)) * float(n @ vector) * n
    )
    return result


def step_roller(
    state: RollerState,
    rings: tuple[Ring, Ring, Ring],
    pocket: float,
    frictions: tuple[Any, Any],
    p: Any,
    losses: tuple[tuple[int, Any], ...] = (),
) -> tuple[RollerState, list[Float]]:
    """One step as `physics.tiers.roller` documents it, in Cartesian coordinates with dense 6 x 6 algebra.

    Returns the new state and the wrenches (about the ring's origin) on cup, cone and cage. ``frictions`` make
    the friction law of cup and cone from the entrainment speed: ``frictions[ring](speed)(k, load, slip)``.
    ``losses`` are further contacts, ring and ``law(motion, orbit_rate)`` that gives a wrench.
    """
    h, roller, effects = p.step, p.roller, p.effects
    cup, cone, cage = rings
    centre = state.centre + h * (state.velocity - cup.drift)
    angle_before = math.atan2(state.centre[1], state.centre[0])
    azimuth = math.atan2(centre[1], centre[0])
    turn = (azimuth - angle_before + math.pi) % (2.0 * math.pi) - math.pi
    axis = rotated(h * state.momentum / roller.transverse_inertia, state.axis)
    # velocities belong to half a step before: carried along the orbit to the place of the contacts
    velocity = turned(0.5 * turn, state.velocity)
    momentum = turned(0.5 * turn, state.momentum)
    inertia = roller.transverse_inertia * np.eye(3)
    inertia += (roller.axial_inertia - roller.transverse_inertia) * np.outer(axis, axis)
    omega = np.linalg.solve(inertia, momentum)

    def motion_against(ring: Ring, ring_axis: Float) -> Motion:
        return Motion(centre - ring.origin, axis, velocity, omega, ring_axis, ring.velocity, ring.omega)

    damping_time = effects.damping.time_constant
    contacts = []
    for ring, raceway, law in ((cup, p.cup, frictions[0]), (cone, p.cone, frictions[1])):
        motion = motion_against(ring, ring.axis)
        speed = entrainment(motion, raceway, roller, turn / h)
        contacts.append(
            raceway_wrench(
                motion,
                raceway,
                roller,
                p.laminae,
                friction=law(speed),
                damping_time=damping_time,
                spring_time=p.spring_time,
                step=h,
            )
        )
    contacts.append(
        rib_wrench(
            motion_against(cone, cone.axis), effects.rib, damping_time=damping_time, spring_time=p.spring_time
        )
    )
    third = np.array([0.0, 0.0, 1.0])
    pocket_motion = motion_against(cage, third)
    advance = azimuth - (cage.turn + pocket)
    contacts.append(pocket_wrench(pocket_motion, cage.axis, advance, azimuth, roller, effects.cage))

    owners = [0, 1, 1, 2, *(ring for ring, _ in losses)]
    contacts += [law(motion_against(rings[ring], rings[ring].axis), turn / h) for ring, law in losses]

    weight = np.array([-roller.mass * effects.gravity.acceleration, 0.0, 0.0])
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = roller.mass * np.eye(3)
    matrix[3:, 3:] = inertia
    matrix += sum(h * contact.resistance for contact in contacts)
    force = sum((contact.force for contact in contacts), weight)
    moment = sum((contact.moment for contact in contacts), np.zeros(3))
    orbit = np.array([0.0, 0.0, turn / h])
    right = np.concatenate(
        [force - roller.mass * np.cross(orbit, velocity), moment - np.cross(orbit, momentum)]
    )
    # with the explicit step contacts keep the force of its beginning
    change = np.linalg.solve(matrix, h * right) if p.explicit is None else np.zeros(6)
    reactions = [np.zeros(6), np.zeros(6), np.zeros(6)]
    total = np.concatenate([weight, np.zeros(3)])
    for contact, index in zip(contacts, owners, strict=True):
        settled = np.concatenate([contact.force, contact.moment]) - contact.resistance @ change
        total = total + settled
        at = centre - rings[index].origin
        about_origin = settled[3:] + np.cross(at, settled[:3])
        reactions[index] = reactions[index] - np.concatenate([settled[:3], about_origin])
    after = RollerState(
        centre,
        axis,
        state.velocity + h / roller.mass * total[:3],
        state.momentum + h * total[3:],
    )
    return after, reactions


def entrainment(motion: Motion, raceway: Any, roller: Any, orbit_rate: float) -> float:
    """Size of the mean surface speed against the moving contact point, around the ring at mid-contact."""
    return abs(signed_entrainment(motion, raceway, roller, orbit_rate))


def signed_entrainment(motion: Motion, raceway: Any, roller: Any, orbit_rate: float) -> float:
    """Mean surface speed against the moving contact point, positive with the ring's positive turn."""
    where = (motion.centre, motion.axis, roller.radius, motion.ring_axis, roller.apex, raceway)
    point = closed_form_point(*where)
    normal = cone_normal(point, motion.ring_axis, roller.apex, raceway)
    outward = raceway.side * (normal - (normal @ motion.ring_axis) * motion.ring_axis)
    outward /= np.linalg.norm(outward)
    around = np.cross(motion.ring_axis, outward)
    ring = float((motion.ring_velocity + np.cross(motion.ring_omega, point)) @ around)
    surface = float((motion.velocity + np.cross(motion.omega, point - motion.centre)) @ around)
    radius = float(np.hypot(point[0], point[1]))
    contact = float(motion.ring_velocity @ around) + orbit_rate * radius
    return 0.5 * (ring + surface) - contact

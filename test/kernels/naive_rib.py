"""Slow references of the rib: search over the face and over the rim, friction and film formula by formula."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from test.kernels.naive import Motion, Wrench

Float = NDArray[np.float64]


def _frame(ring_axis: Float, towards: Float) -> tuple[Float, Float]:
    """Radial direction of a point about the ring axis, and the direction around."""
    radial = towards - (towards @ ring_axis) * ring_axis
    radial /= np.linalg.norm(radial)
    return radial, np.cross(ring_axis, radial)


def face_point(height: float, turn: float, ring_axis: Float, radial: Float, around: Float, rib: Any) -> Float:
    """Point of the rib face, set back by the rounding of its edges."""
    back = rib.distance + rib.window.rounding
    axial = back * rib.normal_axial - height * rib.normal_radial
    distance = back * rib.normal_radial + height * rib.normal_axial
    point: Float = axial * ring_axis + distance * (math.cos(turn) * radial + math.sin(turn) * around)
    return point


def depth_by_search(centre: Float, axis: Float, ring_axis: Float, rib: Any) -> tuple[float, Float]:
    """How deep the sphere is in the rib with rounded edges, and the nearest point of the face set back."""
    sphere = centre + rib.sphere_place * axis
    radial, around = _frame(ring_axis, sphere)
    window = rib.window

    def distance(height: float, turn: float) -> float:
        return float(np.linalg.norm(face_point(height, turn, ring_axis, radial, around, rib) - sphere))

    def nearest_turn(height: float) -> float:
        found = minimize_scalar(
            partial(distance, height), bounds=(-0.1, 0.1), method="bounded", options={"xatol": 1e-12}
        )
        return float(found.x)

    inside = minimize_scalar(
        lambda height: distance(height, nearest_turn(height)),
        bounds=(window.low, window.high), method="bounded", options={"xatol": 1e-13},
    )  # fmt: skip
    height = min(
        (window.low, float(inside.x), window.high), key=lambda height: distance(height, nearest_turn(height))
    )
    turn = nearest_turn(height)
    point = face_point(height, turn, ring_axis, radial, around, rib)
    return rib.sphere_radius + window.rounding - distance(height, turn), point


def rim_depth_by_search(centre: Float, axis: Float, ring_axis: Float, rib: Any) -> tuple[float, Float]:
    """Deepest point of the rim of the roller end behind the unlimited cone of the face."""
    first = np.cross(axis, [0.3, -0.8, 0.2])
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)

    def point(angle: float) -> Float:
        turned = math.cos(angle) * first + math.sin(angle) * second
        found: Float = centre + rib.end.place * axis + rib.end.radius * turned
        return found

    def depth(angle: float) -> float:
        at = point(angle)
        along = float(at @ ring_axis)
        distance = float(np.linalg.norm(at - along * ring_axis))
        return along * rib.normal_axial + distance * rib.normal_radial - rib.distance

    angles = np.linspace(-np.pi, np.pi, 721)
    start = max(angles, key=depth)
    found = minimize_scalar(
        lambda turn: -1e3 * depth(start + turn), bounds=(-0.02, 0.02), method="bounded",
        options={"xatol": 1e-10},
    )  # fmt: skip
    return depth(start + found.x), point(start + found.x)


def film_thickness(load: float, speed: float, contact: Any, lubricant: Any, starvation: float) -> float:
    """Hamrock and Dowson with every group spelled out; lubricant: viscosity, pressure viscosity."""
    viscosity, pressure_viscosity = lubricant
    e_prime, along, across = contact.contact_modulus, contact.radius_y, contact.radius_x
    u = viscosity * abs(speed) / (e_prime * along)
    g = pressure_viscosity * e_prime
    w = load / (e_prime * along**2)
    k = 1.0339 * (across / along) ** 0.636
    h = 2.69 * u**0.67 * g**0.53 * w**-0.067 * (1.0 - 0.61 * math.exp(-0.73 * k)) * along
    return float(starvation * h)


def entrainment(motion: Motion, point: Float, orbit_rate: float) -> float:
    """Mean surface speed around the ring against a contact that orbits."""
    _, around = _frame(motion.ring_axis, point)
    cone = motion.ring_velocity + np.cross(motion.ring_omega, point)
    roller = motion.velocity + np.cross(motion.omega, point - motion.centre)
    contact = motion.ring_velocity + orbit_rate * np.cross(motion.ring_axis, point)
    return float((0.5 * (cone + roller) - contact) @ around)


def wrench(
    motion: Motion, depth: float, normal: Float, arm: Float, rib: Any, friction: Any, reach: float
) -> Wrench:
    """Wrench of a rib contact at a given place without damping.

    ``friction(load, speed)`` is the friction force at a slip speed; ``reach`` the radius at which spin acts.
    """
    total = Wrench.none()
    if depth <= 0.0:
        return total
    total.energy = rib.stiffness * depth**2.5 / 2.5
    load = rib.stiffness * depth**1.5
    slip = motion.slip(motion.centre + arm)
    sliding = slip - float(slip @ normal) * normal
    spin = float((motion.omega - motion.ring_omega) @ normal)
    speed = math.sqrt(float(sliding @ sliding) + (reach * spin) ** 2)
    per_speed = friction(load, speed) / speed
    total.push(-load * normal - per_speed * sliding, arm)
    total.moment = total.moment - per_speed * reach**2 * spin * normal
    return total

"""Slow, obvious reference of lubricated pockets, cheaper cages and lands: plain formulas and integrals."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from test.kernels.naive import Motion, Wrench

Float = NDArray[np.float64]


def _trapezoid(values: Float, places: Float) -> float:
    return float(0.5 * ((values[1:] + values[:-1]) * np.diff(places)).sum())


def wedge_load(viscosity: float, mean_speed: float, radius: float, gap: float) -> float:
    """Load per length of a cylinder rolling on a plane, film ruptured where p = p' = 0, [N/m]."""
    x = math.sqrt(2.0 * radius * gap) * np.tan(np.linspace(-1.57, 1.2, 400_001))
    h = gap + x**2 / (2.0 * radius)
    steps = np.diff(x)

    def pressure(exit_place: float) -> Float:
        thickness = gap + exit_place**2 / (2.0 * radius)
        slope = 12.0 * viscosity * mean_speed * (h - thickness) / h**3
        p: Float = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * steps)])
        return p

    low, high = 0.0, float(x[-1])
    for _ in range(60):  # the exit moves until the pressure is zero there
        middle = 0.5 * (low + high)
        at_exit = float(np.interp(middle, x, pressure(middle)))
        low, high = (middle, high) if at_exit > 0.0 else (low, middle)
    p = np.where(x < low, pressure(low), 0.0)
    return _trapezoid(p, x)


def squeeze_resistance(viscosity: float, radius: float, gap: float) -> float:
    """Load per length over speed of approach of a cylinder on a plane, [N s/m^2]."""
    x = math.sqrt(2.0 * radius * gap) * np.tan(np.linspace(-1.5707, 1.5707, 400_001))
    h = gap + x**2 / (2.0 * radius)
    # (h^3 p' / 12 eta)' = -v, symmetric: p' = -12 eta v x / h^3
    slope = -12.0 * viscosity * x / h**3
    p = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    return _trapezoid(p, x)


def shear_resistance(viscosity: float, radius: float, gap: float) -> float:
    """Shear force per length over sliding speed of a cylinder near a plane, [N s/m^2]."""
    x = math.sqrt(2.0 * radius * gap) * np.tan(np.linspace(-1.5707, 1.5707, 400_001))
    return _trapezoid(viscosity / (gap + x**2 / (2.0 * radius)), x)


def wall_loads(
    depth: float, rate: float, rolling: float, sliding: float, radius: float, cage: Any, film: Any
) -> tuple[float, float]:
    """Load of one wall [N], and its friction over the sliding speed [N s/m]."""
    way = max(abs(rate) * cage.step, 1e-15)  # a contact that begins or ends within it
    inside = depth if depth >= way else 0.5 * depth * (1.0 + depth / way)
    pressed = cage.stiffness * inside + cage.damping * rate if depth > 0.0 else 0.0
    load, viscous = max(pressed, 0.0), 0.0
    solid = load
    if film is not None:
        gap = max(-depth, film.thinnest)
        layer = max(1.0 - gap * film.inverse_layer, 0.0)
        resistance = film.squeeze * layer * (radius / gap) ** 1.5
        resistance = 1.0 / (1.0 / resistance + film.share) if resistance > 0.0 else 0.0
        load = max(pressed + film.wedge * layer * rolling * radius / gap + resistance * rate, 0.0)
        solid = min(max(pressed, 0.0), load)
        viscous = film.shear * layer * math.sqrt(radius / gap)
    return load, cage.friction * solid / math.hypot(sliding, cage.regularisation) + viscous


def pocket_wrench(
    motion: Motion, tilt: Float, advance: float, azimuth: float, roller: Any, cage: Any
) -> Wrench:
    """Roller in its pocket whatever the kind of cage; arguments as `naive.pocket_wrench`."""
    total = Wrench.none()
    at = azimuth - advance
    third = np.array([0.0, 0.0, 1.0])
    plain = np.array([math.cos(at), math.sin(at), 0.0])
    outward = plain + np.cross(tilt, plain)
    ahead = np.array([-math.sin(at), math.cos(at), 0.0])
    ahead = ahead + np.cross(tilt, ahead)
    pocket_axis = cage.axis_radial * plain + cage.axis_axial * third
    pocket_axis = pocket_axis + np.cross(tilt, pocket_axis)
    if cage.kinematic is not None:
        for x in (-cage.bar_place, cage.bar_place):
            arm = x * motion.axis
            offset = float(ahead @ (motion.centre + arm))
            rate = float(motion.slip(motion.centre + arm) @ ahead)
            total.push(-(cage.kinematic.stiffness * offset + cage.kinematic.damping * rate) * ahead, arm)
            total.energy += 0.5 * cage.kinematic.stiffness * offset**2
        return total

    def touch(normal: Float, arm: Float, depth: float, radius: float, film: Any) -> None:
        slip = motion.slip(motion.centre + arm)
        rate = float(slip @ normal)
        sliding = slip - rate * normal
        rolling = abs(float(slip @ np.cross(motion.axis, normal)))
        load, friction = wall_loads(depth, rate, rolling, float(np.linalg.norm(sliding)), radius, cage, film)
        total.push(-load * normal - friction * sliding, arm)
        total.energy += 0.5 * cage.stiffness * max(depth, 0.0) ** 2

    senses: tuple[float, ...] = (1.0, -1.0)
    for x in (-cage.bar_place, cage.bar_place):
        disc = motion.centre + x * motion.axis
        offset = float(ahead @ disc)
        if cage.rotating is not None:
            senses = (1.0,) if offset > 0.0 else (-1.0,)
        for sense in senses:
            normal = sense * cage.bar_cosine * ahead + cage.bar_sine * outward
            radius = roller.radius + x * roller.taper
            across = cage.bar_sine * (float(outward @ disc) - cage.roller_height - x * cage.axis_radial)
            depth = across + sense * cage.bar_cosine * offset - cage.bar_cosine * cage.half_clearance
            touch(normal, x * motion.axis + radius * normal, depth, radius, cage.film)
    if cage.rotating is None:
        side = 1.0 if float(pocket_axis @ motion.centre) > cage.roller_place else -1.0
        arm = side * roller.half_length * motion.axis
        reach = side * (float(pocket_axis @ (motion.centre + arm)) - cage.roller_place)
        touch(
            side * pocket_axis, arm, reach - roller.half_length - cage.half_end_clearance, roller.radius, None
        )
    return total


def short_bearing_force(
    viscosity: float,
    radius: float,
    width: float,
    clearance: float,
    ratio: float,
    opening: float,
    whirl: float,
) -> tuple[float, float]:
    """Radial (outward) and forward force on the inner body, by integrating the short bearing's pressure, [N].

    ``opening`` is d(ratio)/dt, ``whirl`` the ratio times the whirl speed less half the sum of the spins,
    [1/s]. The film fills the half of the clearance that the wedge closes.
    """
    theta = np.linspace(
        0.0, 2.0 * math.pi, 200_001
    )  # from the direction of the eccentricity, the thinnest place
    h = clearance * (1.0 - ratio * np.cos(theta))
    # closing speed of the wall where it stands, in the frame that turns at half the sum of the spins
    rate = -clearance * (opening * np.cos(theta) + whirl * np.sin(theta))
    # h^3 p'' / 12 eta = rate along the axis, zero at both ends: mean over the width
    mean = -viscosity * rate * width**2 / h**3
    filled = np.sin(theta) * whirl > 0.0
    push = -np.where(filled, mean, 0.0) * radius * width
    return _trapezoid(push * np.cos(theta), theta), _trapezoid(push * np.sin(theta), theta)

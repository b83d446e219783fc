"""Slow, obvious references of rolling resistance and drag within a step."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from test.kernels.naive import Motion, Wrench, closed_form_point, cone_normal, raceway_wrench
from test.kernels.naive_step import entrainment

Float = NDArray[np.float64]


def rotary_damper(direction: Float, rate: float, omega: Float) -> Wrench:
    """Couple against the angular velocity about a direction."""
    wrench = Wrench.none()
    wrench.moment = -rate * float(omega @ direction) * direction
    wrench.resistance[3:, 3:] = rate * np.outer(direction, direction)
    return wrench


def rolling_wrench(
    motion: Motion,
    raceway: Any,
    p: Any,
    couple: Callable[[float, float], float],
    regularisation: float,
    orbit_rate: float,
) -> Wrench:
    """Couple of ``couple(load, entrainment_speed)`` against the rolling about the ring's generator."""
    load = float(np.linalg.norm(raceway_wrench(motion, raceway, p.roller, p.laminae).force))
    if load == 0.0:
        return Wrench.none()
    point = closed_form_point(
        motion.centre, motion.axis, p.roller.radius, motion.ring_axis, p.roller.apex, raceway
    )
    normal = cone_normal(point, motion.ring_axis, p.roller.apex, raceway)
    around = np.cross(motion.ring_axis, normal)
    generator = np.cross(around, normal) / np.linalg.norm(around)
    relative = motion.omega - motion.ring_omega
    speed = entrainment(motion, raceway, p.roller, orbit_rate)
    rate = couple(load, speed) / math.hypot(float(relative @ generator), regularisation)
    return rotary_damper(generator, rate, relative)


def drag_wrench(
    motion: Motion, drag_area: float, churning: Callable[[float], float], density: float
) -> Wrench:
    """Drag along the orbit and a couple ``churning(spin)`` against the spin; the ring is the cup."""
    relative = motion.omega - motion.ring_omega
    spin = float(relative @ motion.axis)
    wrench = rotary_damper(motion.axis, churning(abs(spin)) / abs(spin), relative)
    along = np.array([-motion.centre[1], motion.centre[0], 0.0]) / math.hypot(*motion.centre[:2])
    flow = float(motion.slip(motion.centre) @ along)
    rate = 0.5 * density * drag_area * abs(flow)
    wrench.push(-rate * flow * along, np.zeros(3))
    wrench.resist(along, np.zeros(3), rate)
    return wrench

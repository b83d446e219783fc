"""Slow, obvious references of rolling resistance and drag within a step."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.oil_layer import layer_couple_shares, layer_thickness
from beardyn_core.bearing.rolling_resistance import (
    RollingContact,
    aihara_line,
    biboulet_houpert_line,
    rigid_line,
    zhou_hoeprich_line,
)
from beardyn_core.bearing.starvation import couple_shares
from beardyn_core.bearing.starved_rolling import OilSupply, flooded_film, rigid_film
from test.kernels.naive import Motion, Wrench, closed_form_point, cone_normal, raceway_wrench
from test.kernels.naive_step import signed_entrainment

Float = NDArray[np.float64]


_POWER_LAWS = {"aihara": aihara_line, "zhou_hoeprich": zhou_hoeprich_line}
FORMS = (*_POWER_LAWS, "biboulet_houpert")


def rolling_couple(form: str, contact: RollingContact, supply: OilSupply) -> float:
    """Isothermal couple with the oil it finds, [N m]; elastic laws are limited by rigid surfaces."""
    if supply.layer is None:
        rigid, elastic = couple_shares(supply.film_share)
    else:
        layer = layer_thickness(supply.layer, contact.viscosity, contact.entrainment_speed)
        flooded = max(flooded_film(contact, supply.formula), rigid_film(contact))
        rigid, elastic = layer_couple_shares(flooded / layer)
    if form == "biboulet_houpert":
        return biboulet_houpert_line(contact, rigid, elastic)
    return min(elastic * _POWER_LAWS[form](contact), rigid * rigid_line(contact))


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
    radius: float,
    smallest_speed: float,
    orbit_rate: float,
) -> Wrench:
    """Shear on the surface of the roller and pressure through its axis, as they act, with F_R = M / 2R.

    ``radius``: the equivalent one; the shear is against the entrainment, the pressure with it.
    """
    wrench = Wrench.none()
    pressed = raceway_wrench(motion, raceway, p.roller, p.laminae, spring_time=p.spring_time, step=p.step)
    load = float(np.linalg.norm(pressed.force))
    if load == 0.0:
        return wrench
    point = closed_form_point(
        motion.centre, motion.axis, p.roller.radius, motion.ring_axis, p.roller.apex, raceway
    )
    normal = cone_normal(point, motion.ring_axis, p.roller.apex, raceway)
    around = np.cross(motion.ring_axis, normal)
    around *= np.sign(raceway.side) / np.linalg.norm(around)
    speed = signed_entrainment(motion, raceway, p.roller, orbit_rate)
    shear = couple(load, abs(speed)) / (2.0 * radius) * speed / math.hypot(speed, smallest_speed)
    wrench.push(-shear * around, point - motion.centre)
    to_axis = p.roller.radius * math.hypot(1.0, p.roller.taper)  # along the normal
    wrench.push(2.0 * radius / to_axis * shear * around, point - motion.centre - to_axis * normal)
    return wrench


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

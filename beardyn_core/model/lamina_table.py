"""Table of what the laminae of a roller have of their own."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.contact_parameters import (
    LAMINA_DROP,
    LAMINA_FILM,
    LAMINA_PLACE,
    LAMINA_PRESSURE,
    LAMINA_RADIUS,
    LAMINA_ROWS,
    LAMINA_STIFFNESS,
)
from beardyn_core.model.film_factor import log2_film_factor
from beardyn_core.scene.scene import Scene


def lamina_places(bearing: Bearing, count: int) -> NDArray[np.float64]:
    """Abscissae of the laminae from mid-length, towards the large end, shape [lamina], [m]."""
    return ((np.arange(count) + 0.5) / count - 0.5) * bearing.effective_length


def equivalent_radius(bearing: Bearing, place: NDArray[np.float64], ring: str) -> NDArray[np.float64]:
    """Radius of the equivalent cylinder in rolling direction, roller against ring, shape [lamina], [m]."""
    cone_distance = bearing.apex_distance + place
    roller = cone_distance * math.tan(bearing.half_angle) / math.cos(bearing.half_angle)
    angle = bearing.cup_angle if ring == "cup" else bearing.cone_angle
    raceway = cone_distance / math.cos(bearing.half_angle) * math.tan(angle)
    side = -1.0 if ring == "cup" else 1.0
    return 1.0 / (1.0 / roller + side / raceway)


def lamina_table(scene: Scene) -> NDArray[np.float64]:
    """Table of lamina constants, shape [LAMINA_ROWS, lamina]; abscissae from the centre of mass."""
    bearing, count = scene.bearing, scene.numerics.laminae
    place = lamina_places(bearing, count)
    length = bearing.effective_length / count
    modulus = bearing.material.contact_modulus
    table = np.zeros((LAMINA_ROWS, count))
    table[LAMINA_PLACE] = place - bearing.roller_mass_offset
    table[LAMINA_DROP] = bearing.profile.lamina_drop(
        count, bearing.effective_length, bearing.roller_diameter, modulus
    )
    table[LAMINA_STIFFNESS] = line_contact_factor(bearing.material, bearing.effective_length) / count
    table[LAMINA_RADIUS] = (bearing.apex_distance + place) * math.tan(bearing.half_angle)
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    pressure_viscosity = scene.lubricant.pressure_viscosity_at(scene.temperature)
    for ring, name in enumerate(("cup", "cone")):
        radius = equivalent_radius(bearing, place, name)
        table[LAMINA_FILM + ring] = [
            log2_film_factor(r, length, modulus, viscosity, pressure_viscosity, scene.effects.film)
            for r in radius
        ]
        # square of the mean Hertz pressure at 1 N: p_mean = pi/4 sqrt(q E* / (pi R)), E* = E'/2
        table[LAMINA_PRESSURE + ring] = (math.pi / 4) ** 2 * 0.5 * modulus / (math.pi * radius * length)
    return table

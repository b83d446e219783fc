"""Laminae of a roller: the table of what each has of its own."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import barrel_ellipse, line_contact_factor
from beardyn_core.bearing.film_thickness import line_film
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.effects import LineFilm
from beardyn_core.physics.bodies import layout
from beardyn_core.scene.scene import Scene


def for_springs(table: NDArray[np.float64]) -> NDArray[np.float64]:
    """Repeat a table [..., lamina] to [..., 2 x lamina]: near a patch a lamina is two springs."""
    return np.ascontiguousarray(np.concatenate([table, table], axis=-1))


def lamina_places(bearing: RollerBearing, count: int) -> NDArray[np.float64]:
    """Work out the abscissae of the laminae from mid-length, towards the large end, shape [lamina], [m]."""
    return ((np.arange(count) + 0.5) / count - 0.5) * bearing.effective_length


def equivalent_radius(bearing: RollerBearing, place: NDArray[np.float64], ring: str) -> NDArray[np.float64]:
    """Work out the equivalent cylinder's radius in rolling direction, roller against ring, [lamina], [m]."""
    if isinstance(bearing, RadialBearing):
        return np.full(np.shape(place), bearing.rolling_radius(ring))
    assert isinstance(bearing, Bearing)
    cone_distance = bearing.apex_distance + place
    roller = cone_distance * math.tan(bearing.half_angle) / math.cos(bearing.half_angle)
    angle = bearing.cup_angle if ring == "cup" else bearing.cone_angle
    raceway = cone_distance / math.cos(bearing.half_angle) * math.tan(angle)
    side = -1.0 if ring == "cup" else 1.0
    return 1.0 / (1.0 / roller + side / raceway)


def contact_radii(bearing: RollerBearing, on: str, count: int) -> Float:
    """Take radii of cylinders on a plane in place of the laminae's contacts with a surface, [lamina], [m].

    A patch of a roller meets both rings: there a radius is the roller's own.
    """
    places = lamina_places(bearing, count)
    if on == "roller":
        return bearing.radius_at(places)
    return equivalent_radius(bearing, places, on)


def surface_radius(bearing: RollerBearing, on: str) -> float:
    """Work out the radius that turns an azimuth of cup, cone or roller into an arc at mid-length, [m]."""
    radii = {"cup": bearing.cup_radius, "cone": bearing.cone_radius, "roller": 0.5 * bearing.roller_diameter}
    return radii[on]


def lamina_pressure(bearing: RollerBearing, lamina_load: Float, ring: str) -> Float:
    """Work out the Hertz pressure of the laminae of raceway contacts with ``cup`` or ``cone``.

    Parameters
    ----------
    lamina_load : float64 array, shape [..., lamina]
        [N].

    Returns
    -------
    float64 array, shape [..., lamina]
        p0 = sqrt(q E* / (pi R)), [Pa].
    """
    count = lamina_load.shape[-1]
    per_length = lamina_load * count / bearing.effective_length
    radius = equivalent_radius(bearing, lamina_places(bearing, count), ring)
    return np.asarray(np.sqrt(per_length * 0.5 * bearing.material.contact_modulus / (math.pi * radius)))


def log2_film_factor(
    radius: float,
    lamina_length: float,
    contact_modulus: float,
    viscosity: float,
    pressure_viscosity: float,
    options: LineFilm | None,
) -> float:
    """Work out the binary logarithm of the film thickness at 1 N on the lamina and 1 m/s, [log2 m]."""
    film = LineFilm(supply="flooded") if options is None else options
    thickness = line_film(
        1.0 / lamina_length, 1.0, radius, contact_modulus, viscosity, pressure_viscosity, film.formula
    )
    return math.log2(film.constant_share * thickness)


def _stiffness(bearing: RollerBearing) -> float:
    """Take the factor of a whole contact, [N/m^(10/9)]; of barrels that of all slices at most, [N/m]."""
    if isinstance(bearing, SphericalBearing):
        stiffest = max(barrel_ellipse(bearing, ring).stiffness for ring in ("cup", "cone"))
        return stiffest * bearing.effective_length
    return line_contact_factor(bearing.material, bearing.effective_length)


def lamina_table(scene: Scene) -> NDArray[np.float64]:
    """Tabulate lamina constants, shape [LAMINA_ROWS, lamina]; abscissae from the centre of mass."""
    bearing, count = scene.bearing, scene.numerics.laminae
    place = lamina_places(bearing, count)
    length = bearing.effective_length / count
    modulus = bearing.material.contact_modulus
    table = np.zeros((layout.LAMINA_ROWS, count))
    table[layout.LAMINA_PLACE] = place - bearing.roller_mass_offset
    table[layout.LAMINA_DROP] = bearing.lamina_drop(count)
    table[layout.LAMINA_STIFFNESS] = _stiffness(bearing) / count
    table[layout.LAMINA_RADIUS] = bearing.radius_at(place)
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    pressure_viscosity = scene.lubricant.pressure_viscosity_at(scene.temperature)
    for ring, name in enumerate(("cup", "cone")):
        radius = equivalent_radius(bearing, place, name)
        table[layout.LAMINA_FILM + ring] = [
            log2_film_factor(r, length, modulus, viscosity, pressure_viscosity, scene.effects.film)
            for r in radius
        ]
        # square of the mean Hertz pressure at 1 N: p_mean = pi/4 sqrt(q E* / (pi R)), E* = E'/2
        table[layout.LAMINA_PRESSURE + ring] = (
            (math.pi / 4) ** 2 * 0.5 * modulus / (math.pi * radius * length)
        )
    return table

"""Largest Hertz pressure of the contacts of a roller, from their loads alone."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import ExactPointContact, exact_rib_contact
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.rib_face import flat_rib_contact
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.physics.lamina_table import equivalent_radius

_LINE, _POINT = 1.0 / 2.0, 1.0 / 3.0  # pressure grows with this power of the load


class PressureLaw(NamedTuple):
    """Pressure of one kind of contact over its load."""

    at_one_newton: float  # [Pa]
    exponent: float

    def of(self, load: Float) -> Float:
        """Compute the largest pressure under a load [N], [Pa]."""
        return np.asarray(self.at_one_newton * np.asarray(load) ** self.exponent)


NO_PRESSURE = PressureLaw(math.nan, 1.0)


def pressure_law(bearing: RollerBearing, kind: str) -> PressureLaw:
    """Find how the largest Hertz pressure of a contact grows with its load.

    Parameters
    ----------
    bearing : RollerBearing
        Of any kind.
    kind : str
        ``cup``, ``cone`` or ``rib``; others, and a rib that the bearing lacks, give NaN. The rib is that of
        the cone. Runs of cylindrical bearings keep the rib of either ring that is pressed most: for one of
        the cup the pressure is up to 8 % high.

    Notes
    -----
    The load of a raceway is spread evenly along the effective length of the rollers: profile, tilt and edges
    raise the pressure, and slices (laminae) show by how much, see `lamina_pressure`. Barrels and ribs have
    the whole contact ellipse.

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, Eq. 4.45 for lines, p0 = sqrt(q E* / (pi R)), and 4.24 for
    ellipses, p0 = 3 Q / (2 pi a b).
    """
    if kind == "rib":
        if isinstance(bearing, Bearing):
            return _point_law(exact_rib_contact(bearing))
        if not isinstance(bearing, CylindricalBearing):
            return NO_PRESSURE
        return _point_law(flat_rib_contact(bearing, "cone" if bearing.cone_rib_sides else "cup"))
    if kind not in ("cup", "cone"):
        return NO_PRESSURE
    modulus = bearing.material.contact_modulus
    if isinstance(bearing, SphericalBearing):
        radii = bearing.rolling_radius(kind), bearing.profile_radius(kind)
        return _point_law(ExactPointContact(*radii, modulus))
    radius = float(equivalent_radius(bearing, np.zeros(1), kind)[0])
    return PressureLaw(math.sqrt(0.5 * modulus / (math.pi * radius * bearing.effective_length)), _LINE)


def largest_pressure(bearing: RollerBearing, cup_load: float, cone_load: float) -> float:
    """Compute the larger one of the pressures on cup and cone under a load on each [N], [Pa]."""
    pressed = (("cup", cup_load), ("cone", cone_load))
    return max(float(pressure_law(bearing, ring).of(np.array(load))) for ring, load in pressed)


def _point_law(contact: ExactPointContact) -> PressureLaw:
    larger, smaller = contact.semi_axes(1.0)
    return PressureLaw(1.5 / (math.pi * larger * smaller), _POINT)

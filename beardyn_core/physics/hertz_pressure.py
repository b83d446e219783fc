"""Largest Hertz pressure of the contacts of a roller, from their loads alone."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import (
    LINE_EXPONENT,
    ExactPointContact,
    exact_rib_contact,
    line_contact_factor,
    power_law,
)
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.rib_face import flat_rib_contact
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.physics.lamina_table import equivalent_radius, lamina_pressure

_LINE, _POINT = 1.0 / 2.0, 1.0 / 3.0  # pressure grows with this power of the load
_SLICES = 40
_APPROACHES = np.geomspace(1.0e-9, 1.0e-3, 181)  # [m], of a newton or less to more than a bearing carries


class PressureRise(NamedTuple):
    """How much a profile raises the pressure of a line contact, over the load."""

    log_load: Float  # [approach], natural logarithm of the load [N]
    factor: Float  # [approach], over the pressure of the load spread evenly

    def of(self, load: Float) -> Float:
        """Compute the factor under a load [N]."""
        smallest = math.exp(self.log_load[0])
        return np.asarray(np.interp(np.log(np.maximum(load, smallest)), self.log_load, self.factor))


class PressureLaw(NamedTuple):
    """Pressure of one kind of contact over its load."""

    at_one_newton: float  # [Pa]
    exponent: float
    rise: PressureRise | None = None

    def of(self, load: Float) -> Float:
        """Compute the largest pressure under a load [N], [Pa]."""
        even = np.asarray(self.at_one_newton * np.asarray(load) ** self.exponent)
        return even if self.rise is None else even * self.rise.of(np.asarray(load))


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
    The load of a raceway is spread along the effective length of the rollers as their profile spreads it
    between parallel rings, evenly where they are straight. Tilt and edges raise the pressure further, and the
    slices (laminae) of statics show by how much, see `lamina_pressure`. Barrels and ribs have the whole
    contact ellipse.

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
    return _line_law(bearing, kind)


def largest_pressure(bearing: RollerBearing, cup_load: float, cone_load: float) -> float:
    """Compute the larger one of the pressures on cup and cone under a load on each [N], [Pa]."""
    pressed = (("cup", cup_load), ("cone", cone_load))
    return max(float(pressure_law(bearing, ring).of(np.array(load))) for ring, load in pressed)


@lru_cache(maxsize=64)
def _line_law(bearing: RollerBearing, ring: str) -> PressureLaw:
    """Find the law of a raceway; with a profile from slices like those of the statics, pressed alike."""
    radius = float(equivalent_radius(bearing, np.zeros(1), ring)[0])
    modulus = bearing.material.contact_modulus
    even = PressureLaw(math.sqrt(0.5 * modulus / (math.pi * radius * bearing.effective_length)), _LINE)
    drop = bearing.lamina_drop(_SLICES)
    if not drop.any():
        return even
    stiffness = line_contact_factor(bearing.material, bearing.effective_length) / _SLICES
    approach = drop.min() + _APPROACHES[:, None]
    slices = power_law(approach - drop, stiffness, LINE_EXPONENT)[0]
    load = slices.sum(axis=-1)
    factor = lamina_pressure(bearing, slices, ring).max(axis=-1) / even.of(load)
    return even._replace(rise=PressureRise(np.log(load), factor))


def _point_law(contact: ExactPointContact) -> PressureLaw:
    larger, smaller = contact.semi_axes(1.0)
    return PressureLaw(1.5 / (math.pi * larger * smaller), _POINT)

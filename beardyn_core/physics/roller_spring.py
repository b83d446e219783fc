"""A roller between its raceways as one spring along the cup's normal: of statics and of the fast tiers."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import (
    LINE_EXPONENT,
    POINT_EXPONENT,
    barrel_ellipse,
    line_contact_factor,
)
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing


class SpringParams(NamedTuple):
    """A roller between its raceways as one spring along the cup's normal.

    With the ninth root s of the approach D the cup load is ``D s (c0 + c1 s + ...)``.
    """

    series: Any  # [8]
    lever: float  # arm of the cup's normal about the bearing centre [m]
    cone_share: float  # cone load over cup load
    rib_share: float  # rib load over cup load
    rib_centrifugal: float  # rib load over centrifugal force, at a given cup load
    idle: float  # cup load of a roller that the cone does not press, over centrifugal force
    give: float  # least approach over cup load: that of the stiffest spring [m/N]
    reach: float  # half of the length that holds a tilt of the rings [m]


def place_on_cup(bearing: RollerBearing) -> tuple[float, float]:
    """Work out radius and axial place, from the middle, of where a roller touches the cup, [m]."""
    return bearing.cup_place


def roller_tangent(bearing: RollerBearing) -> float:
    """Work out the stiffness of a roller between cup and cone over the tenth root of its load, [N^0.9/m].

    Two line contacts in series, for which 10/9 Q / D of Q = K D^(10/9) is 10/9 K^0.9 Q^0.1; profile and rib
    are left out. Of barrels over the cube root of the load, [N^(2/3)/m]: 3/2 K^(2/3) Q^(1/3) of two point
    contacts in series, whose ellipses no roller end cuts off.
    """
    if isinstance(bearing, SphericalBearing):
        softness = sum(_point_factor(bearing, ring) ** (-2.0 / 3.0) for ring in ("cup", "cone"))
        return POINT_EXPONENT / softness
    factor = line_contact_factor(bearing.material, bearing.effective_length) / 2.0**LINE_EXPONENT
    return LINE_EXPONENT * factor ** (1.0 / LINE_EXPONENT)


def _point_factor(bearing: SphericalBearing, ring: str) -> float:
    """Take the factor of the elliptical contact of a barrel, [N/m^1.5]."""
    law = barrel_ellipse(bearing, ring)
    return 4.0 / 3.0 * law.stiffness * law.reach


def roller_stiffness(bearing: RollerBearing, load: ArrayLike) -> Float:
    """Work out the stiffness of rollers between cup and cone under loads [N], [N/m]."""
    power = 1.0 / 3.0 if isinstance(bearing, SphericalBearing) else 0.1
    return np.asarray(roller_tangent(bearing) * np.asarray(load) ** power)


def lever_of_cup(bearing: RollerBearing) -> float:
    """Work out the arm of the cup's contact normal about the bearing centre, in a meridian plane, [m]."""
    radial, axial = place_on_cup(bearing)
    return axial * math.cos(bearing.cup_slant) + radial * math.sin(bearing.cup_slant)

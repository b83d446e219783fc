"""Basic load rating after ISO 281."""

from __future__ import annotations

import math
from dataclasses import dataclass

from beardyn_core.bearing.geometry import Bearing

_MILLIMETRES = 1.0e3
# Rating factor for present-day tapered roller bearings, ISO 281 table.
_MATERIAL_FACTOR = 1.1
_REDUCTION = 0.83


@dataclass(frozen=True)
class DynamicRating:
    """Dynamic load rating and load factors of the double row, ISO 281.

    Parameters
    ----------
    radial : float
        C_r of both rows together, [N].
    thrust_limit : float
        e: thrust ratio up to which Y1 applies, [-].
    thrust_low, thrust_high : float
        Y1 and Y2, axial load factors below and above e, [-].
    """

    radial: float
    thrust_limit: float
    thrust_low: float
    thrust_high: float


def rating_factor(gamma: float) -> float:
    """f_c of a radial roller bearing with line contact, [N/mm^(...)].

    Parameters
    ----------
    gamma : float
        Dwe cos(alpha) / Dpw, [-].

    References
    ----------
    Lundberg, G. and Palmgren, A. (1952), as tabled in ISO 281: 207.9 lambda nu gamma^(2/9)
    (1 - gamma)^(29/27) / (1 + gamma)^(1/4) {1 + [1.04 ((1 - gamma)/(1 + gamma))^(143/108)]^(9/2)}^(-2/9),
    lambda nu = 0.83.
    """
    rings = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return _REDUCTION * 207.9 * shape * (1.0 + rings**4.5) ** (-2.0 / 9.0)


def dynamic_rating(bearing: Bearing) -> DynamicRating:
    """Dynamic load rating of the double row; the contact angle of ISO 281 is the cup angle."""
    angle = bearing.cup_angle
    diameter = bearing.roller_diameter * _MILLIMETRES
    length = bearing.effective_length * _MILLIMETRES
    gamma = bearing.roller_diameter * math.cos(angle) / bearing.pitch_diameter
    radial = (
        _MATERIAL_FACTOR
        * rating_factor(gamma)
        * (2.0 * length * math.cos(angle)) ** (7.0 / 9.0)
        * bearing.roller_count**0.75
        * diameter ** (29.0 / 27.0)
    )
    return DynamicRating(
        radial=radial,
        thrust_limit=1.5 * math.tan(angle),
        thrust_low=0.45 / math.tan(angle),
        thrust_high=0.67 / math.tan(angle),
    )

"""Frictional moment of tapered roller bearings as SKF's catalogue has it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A
from typing import NamedTuple


class Moment(NamedTuple):
    """Parts of the frictional moment, [N m]."""

    rolling: float
    sliding: float

    @property
    def total(self) -> float:
        """Add both; the seals are not in it."""
        return self.rolling + self.sliding


@dataclass(frozen=True)
class Row:
    """One row, as a single-row bearing of the catalogue."""

    bore: A[float, "[mm]"]
    outer: A[float, "[mm]"]
    thrust_factor: A[float, "Y of the product table, [-]"] = 1.7
    rolling: A[float, "R_1 of its series"] = 2.27e-6
    sliding: A[float, "S_1"] = 0.018


# Of the series 322, whose section is nearest to those of axlebox bearings.
AXLEBOX_ROW = Row(130.0, 230.0)
BEARING_32216 = Row(80.0, 140.0, thrust_factor=1.4)
GREASE, OIL = 6.0e-8, 3.0e-8  # K_rs of grease, and of an oil bath or jet
_THRUST_ROLLING, _THRUST_SLIDING = 10.9, 2.0  # R_2 and S_2
_GEOMETRY = 6.0  # K_Z
_BOUNDARY, _FULL_FILM = 0.12, 0.002


def row_moment(
    row: Row, radial: float, axial: float, speed_rpm: float, viscosity_mm2_s: float, supply: float = GREASE
) -> Moment:
    """Compute the frictional moment of one row without seals and drag.

    Parameters
    ----------
    radial, axial : float
        Load of the row, [N].
    supply : float
        K_rs, `GREASE` or `OIL`.

    Notes
    -----
    The catalogue gives it for grease that has run for hours, in air of 20 °C and more. The factor of
    replenishment is an exponential of viscosity and speed, so the rolling part vanishes in the cold.

    References
    ----------
    SKF, Rolling bearings, "The SKF model for calculating the frictional moment", tables 2a and 3 and the
    constants of tapered roller bearings.
    """
    mean = 0.5 * (row.bore + row.outer)
    thrust = row.thrust_factor * axial
    flow = viscosity_mm2_s * speed_rpm
    heating = 1.0 / (1.0 + 1.84e-9 * (speed_rpm * mean) ** 1.28 * viscosity_mm2_s**0.64)
    slenderness = math.sqrt(_GEOMETRY / (2.0 * (row.outer - row.bore)))
    replenished = math.exp(-supply * flow * (row.bore + row.outer) * slenderness)
    rolling = row.rolling * mean**2.38 * (radial + _THRUST_ROLLING * thrust) ** 0.31
    rolling *= heating * replenished * flow**0.6
    boundary = math.exp(-2.6e-8 * flow**1.4 * mean)
    friction = boundary * _BOUNDARY + (1.0 - boundary) * _FULL_FILM
    sliding = row.sliding * mean**0.82 * (radial + _THRUST_SLIDING * thrust) * friction
    return Moment(1e-3 * rolling, 1e-3 * sliding)


def axlebox_moment(
    radial: float, speed_rpm: float, viscosity_mm2_s: float, *, induced: bool = False
) -> Moment:
    """Compute the moment of a double row bearing of 130 x 230 mm, half of the load on each row.

    Parameters
    ----------
    radial : float
        Of the whole bearing, [N].
    induced : bool
        Count the thrust of 0.5 F_r / Y with which the rows press each other as an axial load.
    """
    half = 0.5 * radial
    thrust = 0.5 * half / AXLEBOX_ROW.thrust_factor if induced else 0.0
    one = row_moment(AXLEBOX_ROW, half, thrust, speed_rpm, viscosity_mm2_s)
    return Moment(2.0 * one.rolling, 2.0 * one.sliding)

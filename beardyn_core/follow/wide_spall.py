"""Whether a spall is wider than half of the distance of two rollers: it looks much like a narrow one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.regression import Regression
from beardyn_core.observe.severity import spacing_of

LEARNT_SHARE = 1.2  # of the half distance: up to here the number of a width is learnt
LEAST_SHARE = 0.82  # of the half distance: the least width of a spall that counts as wide
FEWEST = 10  # runs of either kind to learn the rule from
_FAR_SHARE = 4.0 / 3.0  # of the half distance: wider spalls may not be taken for narrow ones
_MISSED = 0.05  # share of wide spalls that are taken for narrow ones, and of narrow ones for wide ones


@dataclass(frozen=True, eq=False)
class WideRule:
    """Regression that gives the chance of a spall to be wide, and the chances that decide.

    The exit of a wide spall is followed by the entry of the next roller, at the distance at which the entry
    of a narrow one comes before its exit. Below `narrow` a number is reported; above `wide` the least width
    of a wide spall; between them the least width of a narrow one, for it can be either.
    """

    regression: Regression
    half: A[float, "width from which a spall is wide, [m]"]
    narrow: A[float, "chance below which a spall is narrow"] = 0.25
    wide: A[float, "chance above which a spall is wide"] = 0.75

    def chance(self, standardised: Float) -> Float:
        """Compute the chance that a spall is wide, shape [run]."""
        return self.regression.value(standardised)

    def decided(self, chances: Float, widths: Float) -> WideRule:
        """Set the chances that decide by runs that were not learnt from, each shape [run]; widths in [m]."""
        far, near = chances[widths > _FAR_SHARE * self.half], chances[widths < LEAST_SHARE * self.half]
        if not len(far) or not len(near):
            return self
        narrow, wide = float(np.quantile(far, _MISSED)), float(np.quantile(near, 1.0 - _MISSED))
        middle = 0.5 * (narrow + wide)
        return replace(self, narrow=min(narrow, middle), wide=max(wide, middle))

    @property
    def least(self) -> float:
        """Least width of a spall that counts as wide, [m]."""
        return LEAST_SHARE * self.half


def half_distance(plate: NamePlate) -> float:
    """Compute half of the distance of two rollers on the cone, where it is shortest, [m]."""
    return 0.5 * spacing_of("cone", plate)

"""Whether a spall is wider than half of the distance of two rollers: it looks much like a narrow one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.severity import spacing_of

RACEWAYS = ("cup", "cone")
LEAST_SHARE = 0.82  # of the half distance: the least width of a spall that counts as wide
FEWEST = 10  # runs of either kind to learn the rule from
LEAST_FOLDED = 1.2e-3  # at which two events can be resolved, [m]
LEAST_OF_TWO = 2.8e-3  # width from which a spall makes two events, [m]
_FAR_SHARE = 1.15  # of the half distance: wider spalls may not be taken for narrow ones
NARROW, WIDE = 0.05, 0.9  # chances that decide at the most and at the least
_NEVER = -1.0  # chance below which a spall is narrow where no number is reported
_MISSED = 0.03  # share of wide spalls that are taken for narrow ones, and of narrow ones for wide ones
_APART, _APART_SHARE = 1.5e-3, 0.12  # between the way of two events and the width, [m] and of the width
_BEYOND = 1.02  # of the widest spall learnt from: wider ones are left out
UNKNOWN = 0.5  # chance where the order of the events is not known


@dataclass(frozen=True, eq=False)
class WideRule:
    """Chance of a spall to be wide by the order of its two events, and the chances that decide.

    The exit of a wide spall is followed by the entry of the next roller, at the distance at which the entry
    of a narrow one comes before its exit. So the width that is learnt is folded: the way to the nearest
    multiple of the distance of two rollers. Which of the widths it is of those that fold to it, is decided
    by the order of the events; those beyond the widest spall learnt from are left out, and where one is
    wider than the distance of two rollers, nothing decides. Below `narrow` a number is reported; above
    `wide` the least width of a wide spall; between them the least width of a narrow one.
    """

    readings: A[Float, "shape [3, descriptor], to logarithm of odds to be wide, way of the events, raceway"]
    offsets: A[Float, "shape [3], added to them"]
    spacings: A[Float, "shape [raceway], distance of two rollers, [m]"]
    largest: A[float, "widest spall learnt from, [m]"]
    added: A[float, "width of a narrow spall less the way of its events, [m]"] = 0.0
    doubt: A[float, "standard deviation of the logarithm of a width by that way"] = 0.0
    narrow: A[float, "chance below which a spall is narrow"] = NARROW
    wide: A[float, "chance above which a spall is wide"] = WIDE

    def half(self, standardised: Float) -> Float:
        """Give the half distance of two rollers on the raceway that is measured louder, shape [run], [m]."""
        return 0.5 * self._spacing(self._read(standardised)[2])

    def chance(self, standardised: Float, folded: Float, low: Float, high: Float) -> Float:
        """Compute the chance that a spall is wide, shape [run], of its folded width and interval, [m]."""
        odds, way, louder = self._read(standardised)
        spacing = self._spacing(louder)
        chance = np.where(agree(way, folded), chance_of(odds, way, spacing), UNKNOWN)
        chance = np.where(spacing - high > _BEYOND * self.largest, 0.0, chance)
        return np.asarray(np.where(spacing + low <= self.largest, UNKNOWN, chance), np.float64)

    def set_chances(self, chances: Float, widths: Float, spacings: Float) -> WideRule:
        """Set the chances that decide by runs that were not learnt from, each shape [run]; widths in [m]."""
        half = 0.5 * spacings
        far, near = chances[widths > _FAR_SHARE * half], chances[widths < LEAST_SHARE * half]
        if not len(far) or not len(near):
            return self
        narrow, wide = float(np.quantile(far, _MISSED)), float(np.quantile(near, 1.0 - _MISSED))
        return replace(self, narrow=min(narrow, NARROW), wide=max(wide, WIDE))

    @property
    def gives_numbers(self) -> bool:
        """Tell whether a number is reported of any spall."""
        return self.narrow >= 0.0

    def without_numbers(self) -> WideRule:
        """Take no spall for a narrow one: each is wide, or has two readings."""
        return replace(self, narrow=_NEVER)

    def _read(self, standardised: Float) -> Float:
        return np.asarray(self.readings @ standardised.T + self.offsets[:, None], np.float64)

    def _spacing(self, louder: Float) -> Float:
        return np.asarray(np.where(louder > 0.5, self.spacings[1], self.spacings[0]), np.float64)


def spacings_of(plate: NamePlate) -> Float:
    """Compute the distance of two rollers on each of `RACEWAYS`, [m]."""
    return np.array([spacing_of(part, plate) for part in RACEWAYS])


def fold_widths(widths: Float, spacings: Float) -> Float:
    """Fold widths to the way to the nearest multiple of the distance of two rollers, shape [run], [m]."""
    rest = np.mod(widths, spacings)
    return np.asarray(np.minimum(rest, spacings - rest), np.float64)


def chance_of(odds: Float, way: Float, spacing: Float) -> Float:
    """Compute the chance to be wide, shape [run], where of equal odds the narrower spall is the likelier.

    Spalls of a factor of widths are as frequent as those of any other such factor.
    """
    return np.asarray(
        1.0 / (1.0 + np.exp(-odds) * (spacing - way) / np.maximum(way, LEAST_FOLDED)), np.float64
    )


def agree(way: Float, width: Float) -> NDArray[np.bool_]:
    """Tell whether the way of two events can be that of a spall of a folded width, shape [run], [m]."""
    return np.asarray(np.abs(way - width) <= _APART + _APART_SHARE * width)

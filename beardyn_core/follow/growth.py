"""How a spall grows with mileage, and how far it may run: laws with their scatter, not a number."""

from __future__ import annotations

from dataclasses import dataclass
from math import log
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At, refuse

ASSUMED_LAW = "slow, then linear"  # the name of `GrowthLaw`
NORMAL_90 = 1.645  # standard deviations on either side of the middle that hold 90 %


@dataclass(frozen=True)
class GrowthLaw:
    """Growth of the area of a spall: slow up to a critical area, linear with mileage beyond it.

    The shape of the law is published: on test rigs of railway axle bearings spalls of the cup grow slowly at
    first and, from a critical area on, by a rate that mileage does not change, which differs from bearing to
    bearing. The rates are **assumed**: they belong to freight bearings under full load and are not public as
    numbers that fit another bearing. Give those of a fleet where there are any.

    References
    ----------
    Tarawneh, Lima, De Los Santos, Jones (2019), Tribol. Trans. 62, 897: prognostics models for railroad
    tapered roller bearings with spall defects on inner or outer rings; Lima, Dasgupta, Leal, Jones, Tarawneh
    (2017), ASME JRC2017-2272, defect prognostics models for spall growth in railroad bearing rings: the two
    regimes.
    """

    critical_area: A[float, At(gt=0.0), "from which the growth is linear, [m^2]; assumed"] = 250.0e-6
    rate: A[float, At(gt=0.0), "median beyond it, [m^2/m]; assumed"] = 1.0e-10
    rate_spread: A[float, At(ge=1.0, le=100.0), "90 % of the rates are within this factor; assumed"] = 4.0
    slow_share: A[float, At(gt=0.0, le=1.0), "of the rate, below the critical area; assumed"] = 0.2

    def __post_init__(self) -> None:
        refuse(self, "growth of a spall")

    def distance(self, begin: Float, end: Float, rate: Float) -> Float:
        """Compute the distance in which areas grow from one to another at their rates, [m]; 0 where grown."""
        slow = np.maximum(np.minimum(end, self.critical_area) - begin, 0.0) / self.slow_share
        fast = np.maximum(end - np.maximum(begin, self.critical_area), 0.0)
        return np.asarray((slow + fast) / rate, np.float64)

    def grow_areas(self, begin: Float, rate: Float, distance: float | Float) -> Float:
        """Compute the areas to which areas grow over a distance at their rates, [m^2]."""
        slow = self.slow_share * rate
        crawled = np.minimum(distance, np.maximum(self.critical_area - begin, 0.0) / slow)
        return np.asarray(begin + crawled * slow + (distance - crawled) * rate, np.float64)

    def rates(self, count: int, random: np.random.Generator) -> Float:
        """Draw rates of bearings, lognormal, shape [count], [m^2/m]."""
        return self.rate * np.exp(random.normal(0.0, log(self.rate_spread) / NORMAL_90, count))


@dataclass(frozen=True)
class PowerLaw:
    """Growth of the area of a spall at a rate that goes with a power of the area.

    A published family for rolling bearings, whose exponent is fitted to each of them; the exponents with
    which a forecast is compared, 0, 1/2 and 1, are **assumed**, as the rate at the reference area is.

    References
    ----------
    Li, Kurfess, Liang (2000), Mech. Syst. Signal Process. 14, 747: defect growth at a power of its size, with
    a lognormal factor.
    """

    exponent: A[float, At(ge=0.0, le=2.0), "0: linear in mileage, 1: exponential; assumed"]
    reference_area: A[float, At(gt=0.0), "at which the rate is given, [m^2]; assumed"] = 250.0e-6
    rate: A[float, At(gt=0.0), "median there, [m^2/m]; assumed"] = 1.0e-10

    def __post_init__(self) -> None:
        refuse(self, "growth of a spall")

    def distance(self, begin: Float, end: Float, rate: Float) -> Float:
        """Compute the distance in which areas grow from one to another at their rates, [m]; 0 where grown."""
        first, last = begin / self.reference_area, np.maximum(end, begin) / self.reference_area
        left = 1.0 - self.exponent
        grown = np.log(last / first) if left == 0.0 else (last**left - first**left) / left
        return np.asarray(self.reference_area * grown / rate, np.float64)

    def grow_areas(self, begin: Float, rate: Float, distance: float | Float) -> Float:
        """Compute the areas to which areas grow over a distance, [m^2]; infinite beyond all numbers."""
        first, along = begin / self.reference_area, rate * distance / self.reference_area
        left = 1.0 - self.exponent
        with np.errstate(over="ignore", divide="ignore"):
            if left == 0.0:
                grown = first * np.exp(along)
            else:
                grown = np.maximum(first**left + left * along, 0.0) ** (1.0 / left)
        return np.asarray(self.reference_area * grown, np.float64)


def other_laws(law: GrowthLaw) -> dict[str, PowerLaw]:
    """Give other laws of growth that have the rate of one at its critical area, by their names."""
    return {
        name: PowerLaw(exponent, law.critical_area, law.rate)
        for name, exponent in (("linear", 0.0), ("root of the area", 0.5), ("exponential", 1.0))
    }


def drawn_between(interval: tuple[float, float], count: int, random: np.random.Generator) -> Float:
    """Draw a positive number that has this 90 % interval, lognormal, shape [count]."""
    low, high = np.log(np.maximum(interval, 1e-9))
    return np.exp(random.normal(0.5 * (low + high), max(high - low, 0.0) / (2.0 * NORMAL_90), count))

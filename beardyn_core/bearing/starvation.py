"""What a starved inlet leaves of the rolling couple, from what it leaves of the film.

The film fills where the inlet begins, a meniscus at a distance from the contact. The closer it is, the less
pressure builds up on the way in: the film becomes thinner, and the couple, which is the moment of that
pressure, falls much faster. A film of 0.7 of the flooded one leaves 0.44 of the couple of rigid surfaces and
0.18 of that of elastic ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.integrate import cumulative_trapezoid, trapezoid
from scipy.optimize import brentq

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.oil_layer import CoupleShares

_FAR = 1e5  # where nothing is missed by the flooded inlet
_POINTS = 4000


def couple_shares(film_share: float) -> CoupleShares:
    """Compute the rolling couple of a starved line contact over that of the flooded one.

    Parameters
    ----------
    film_share : float
        Film over the flooded film, above 0 up to 1.

    References
    ----------
    Reynolds' equation with the film's begin as in Wolveridge, Baglin and Archard (1971), Proc. IMechE 185,
    1159: rigid surfaces after Martin (1916), elastic ones with Grubin's inlet (1949), h = h_0 + c x^1.5 and a
    reduced pressure of 1/alpha at the edge of the contact.
    """
    if film_share >= 1.0:
        return CoupleShares(1.0, 1.0)
    return CoupleShares(*(_couple_at(film_share, *_table(inlet)) for inlet in (_rigid_inlet, _elastic_inlet)))


def _couple_at(film_share: float, film: Float, couple: Float) -> float:
    return float(np.exp(np.interp(np.log(film_share), np.log(film), np.log(couple))))


@cache
def _table(inlet: Callable[[float], tuple[float, float]]) -> tuple[Float, Float]:
    """Tabulate film and couple over the flooded ones for a meniscus further and further away."""
    film, couple = np.array([inlet(float(meniscus)) for meniscus in np.geomspace(0.03, 1e3, 100)]).T
    flooded_film, flooded_couple = inlet(_FAR)
    return film / flooded_film, couple / flooded_couple


def _rigid_inlet(meniscus: float) -> tuple[float, float]:
    """Compute film and couple at a given load, gap 1 + x^2, up to a common factor."""
    outlet = brentq(lambda end: _martin(meniscus, end)[0][-1], 1e-4 * min(meniscus, 1.0), min(meniscus, 3.0))
    pressure, x = _martin(meniscus, outlet)
    film = float(trapezoid(pressure, x))
    return film, -float(trapezoid(pressure * x, x)) / math.sqrt(film)


def _martin(meniscus: float, outlet: float) -> tuple[Float, Float]:
    """Compute the pressure from the meniscus to the outlet, where its slope vanishes."""
    x = np.concatenate([-np.geomspace(meniscus, 1e-4 * outlet, _POINTS), np.linspace(0.0, outlet, _POINTS)])
    gap = 1.0 + x * x
    return cumulative_trapezoid((gap - gap[-1]) / gap**3, x, initial=0.0), x


def _elastic_inlet(meniscus: float) -> tuple[float, float]:
    """Compute film and couple at a load, gap 1 + x^1.5 before the contact's edge, up to a common factor."""
    x = np.geomspace(1e-8 * meniscus, meniscus, 2 * _POINTS)
    built_up = cumulative_trapezoid(x**1.5 / (1.0 + x**1.5) ** 3, x, initial=0.0) + 0.4 * x[0] ** 2.5
    pressure = -np.log(built_up / built_up[-1])
    film = float(built_up[-1] ** 0.75)
    return film, film * float(trapezoid(pressure * np.sqrt(x), x))

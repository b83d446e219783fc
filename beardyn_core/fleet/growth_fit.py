"""A law of growth fitted to the widths of one spall: draws of its length, first width and rate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import lgamma, log, pi
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.follow.growth import NORMAL_90, GrowthLaw, PowerLaw

ACROSS = (8.0e-3, 40.0e-3)  # 90 % of the lengths of spalls across the raceway, [m]; assumed
BEGINS = (2.0e-3, 20.0e-3)  # 90 % of the widths at the first measurement before it is known, [m]; assumed
_TRIED, _DRAWS, _SEED, _ROUNDS = 500, 3000, 1, 4
_PARTS = 5  # of the mixture that draws are of
_LEAST_SHARE, _FEWEST = 0.05, 20.0  # of a part: share of the draws; draws that count, to be shaped by
_FIRST = 3  # widths near which the search begins
_TAILS, _WIDER = 5.0, 3.0  # degrees of freedom, and covariance over that of the round before
_ENOUGH = 300.0  # draws that a round must leave to shape the next one
_LEAST_EFFECTIVE = 60.0  # draws that the last one must leave
_LARGEST_MISFIT = 1.5  # of a width, middle, by the draw that fits best


@dataclass(frozen=True)
class Widths:
    """Measured widths of one spall."""

    distance: A[Float, "since the first one, rising, shape [width], [m]"]
    width: A[Float, "shape [width], [m]"]
    deviation: A[Float, "standard deviation of each, shape [width], [m]"]


@dataclass(frozen=True)
class GrowthFit:
    """Draws that count as much as they agree with the widths."""

    across: A[Float, "length across the raceway, which stays, shape [draw], [m]"]
    begin: A[Float, "area at the first width, shape [draw], [m^2]"]
    rate: A[Float, "of growth, shape [draw], [m^2/m]"]
    weight: A[Float, "shape [draw], sum 1"]
    likelihood: A[float, "of the widths by the draw that fits best, logarithm, but for a constant"]
    misfit: A[float, "of a width by that draw, [-]"]

    @property
    def is_usable(self) -> bool:
        """Whether the law can have made the widths, and enough draws say so."""
        effective = 1.0 / float(np.sum(self.weight**2))
        return effective >= _LEAST_EFFECTIVE and self.misfit <= _LARGEST_MISFIT

    def quantiles(self, values: Float, shares: tuple[float, ...]) -> tuple[float, ...]:
        """Take quantiles of something of each draw, shape [draw]."""
        order = np.argsort(values)
        reached = np.cumsum(self.weight[order])
        places = np.minimum(np.searchsorted(reached, shares), len(order) - 1)
        return tuple(float(each) for each in values[order][places])


@dataclass(frozen=True)
class _Part:
    """A part of the mixture that draws are of."""

    share: float
    centre: A[Float, "logarithms of length, first width and rate, shape [3]"]
    covariance: A[Float, "shape [3, 3]"]


def fit_growth(law: GrowthLaw | PowerLaw, rates: GrowthLaw, widths: Widths) -> GrowthFit:
    """Fit a law of growth to the widths of one spall.

    Parameters
    ----------
    law : GrowthLaw or PowerLaw
    rates : GrowthLaw
        How rates of growth are spread, of any law.
    widths : Widths

    Notes
    -----
    Length across the raceway, first width and rate are unknown, log-normal by what is assumed of them. Errors
    of widths have heavy tails (Student, 4 degrees of freedom): one width may be wrong. Adaptive importance
    sampling about the most probable point: draws of one round shape those of the next, so that three rough
    widths and a hundred exact ones leave enough draws that count.

    References
    ----------
    Cappé, Guillin, Marin, Robert (2004), J. Comput. Graph. Stat. 13, 907: population Monte Carlo.
    """
    random = np.random.default_rng(_SEED)
    assumed = _assumed(rates)
    parts = _most_probable(law, widths, assumed, random)
    for _ in range(_ROUNDS):
        points, origin, proposed = _draw(parts, random)
        misfit = _misfits(law, points, widths)
        likely = _log_assumed(points, assumed) - 2.5 * misfit - proposed
        weight = np.exp(likely - likely.max())
        weight /= weight.sum()
        parts = _shaped(parts, points, origin, _tempered(likely))
    across, begin, rate = np.exp(points[:, 0]), np.exp(points[:, 0] + points[:, 1]), np.exp(points[:, 2])
    least = float(misfit.min())
    return GrowthFit(across, begin, rate, weight, -2.5 * least, least / len(widths.width))


def _assumed(rates: GrowthLaw) -> tuple[Float, Float]:
    """Give middle and standard deviation of the logarithms of length, first width and rate."""
    ends = [np.log(each) for each in (ACROSS, BEGINS)]
    middle = [*(float(each.mean()) for each in ends), log(rates.rate)]
    spread = [*(float(np.ptp(each)) / (2.0 * NORMAL_90) for each in ends), log(rates.rate_spread) / NORMAL_90]
    return np.array(middle), np.maximum(spread, 1e-6)


def _log_assumed(points: Float, assumed: tuple[Float, Float]) -> Float:
    """Compute the logarithm of how likely points are before any width is known, shape [draw]."""
    middle, spread = assumed
    constant = float(np.sum(np.log(spread))) + 1.5 * log(2.0 * pi)
    return np.asarray(-0.5 * np.sum(((points - middle) / spread) ** 2, axis=1) - constant, np.float64)


def _deviations(law: GrowthLaw | PowerLaw, points: Float, widths: Widths) -> Float:
    """Compute how far the widths of draws are from those that were measured, shape [draw, width]."""
    across, begin, rate = np.exp(points[:, 0]), np.exp(points[:, 0] + points[:, 1]), np.exp(points[:, 2])
    grown = law.grow_areas(begin[:, None], rate[:, None], widths.distance) / across[:, None]
    # a metre at most: an exponential law outgrows all numbers
    return np.asarray((np.minimum(grown, 1.0) - widths.width) / widths.deviation, np.float64)


def _misfits(law: GrowthLaw | PowerLaw, points: Float, widths: Widths) -> Float:
    """Sum the logarithms by which widths are less likely for their distance, over 2.5, shape [draw]."""
    return np.asarray(np.sum(np.log1p(_deviations(law, points, widths) ** 2 / 4.0), axis=1), np.float64)


def _most_probable(
    law: GrowthLaw | PowerLaw,
    widths: Widths,
    assumed: tuple[Float, Float],
    random: np.random.Generator,
) -> list[_Part]:
    """Find the most probable point among the short, the usual and the long spalls, and its neighbourhood.

    A law that changes at an area has a hollow for each side of it, and the length decides which.
    """
    from scipy.optimize import least_squares

    middle, spread = assumed
    points = middle + spread * random.normal(size=(_TRIED, 3))
    points[:, 1] = log(float(np.median(widths.width[:_FIRST])))
    cost = 2.5 * _misfits(law, points, widths) - _log_assumed(points, assumed)

    def residuals(point: Float) -> Float:
        apart = _deviations(law, point[None], widths)[0]
        # half of their squares is the logarithm of how likely the point is
        own = np.sign(apart) * np.sqrt(5.0 * np.log1p(apart**2 / 4.0))
        return np.concatenate([own, (point - middle) / spread])

    parts = []
    for places in np.array_split(np.argsort(points[:, 0]), _PARTS):
        start = points[places[np.argmin(cost[places])]]
        found = least_squares(residuals, start, x_scale=spread)
        parts.append(_Part(1.0, found.x, np.linalg.inv(found.jac.T @ found.jac)))
    # and all that is possible at the first width, where few widths say little
    doubt = float(np.median(widths.deviation[:_FIRST] / widths.width[:_FIRST]))
    vague = np.array([spread[0], doubt, spread[2]])
    parts.append(_Part(1.0, np.array([middle[0], points[0, 1], middle[2]]), np.diag(vague**2)))
    return parts


def _draw(parts: Sequence[_Part], random: np.random.Generator) -> tuple[Float, Int, Float]:
    """Draw about the parts of a mixture, with tails.

    Returns
    -------
    tuple of arrays
        Draws, shape [draw, 3]; the part that each is of; the logarithm of their density.
    """
    share = np.array([each.share for each in parts])
    origin = random.choice(len(parts), _DRAWS, p=share / share.sum())
    unit = random.normal(size=(_DRAWS, 3)) * np.sqrt(_TAILS / random.chisquare(_TAILS, _DRAWS))[:, None]
    roots = [np.linalg.cholesky(_WIDER * each.covariance + 1e-12 * np.eye(3)) for each in parts]
    points = np.empty((_DRAWS, 3))
    for number, (part, root) in enumerate(zip(parts, roots, strict=True)):
        own = origin == number
        points[own] = part.centre + unit[own] @ root.T
    constant = lgamma(0.5 * (_TAILS + 3)) - lgamma(0.5 * _TAILS) - 1.5 * log(_TAILS * pi)
    densities = []
    for part, root in zip(parts, roots, strict=True):
        apart = np.linalg.solve(root, (points - part.centre).T)
        density = constant - float(np.sum(np.log(np.diag(root)))) + log(part.share / share.sum())
        densities.append(density - 0.5 * (_TAILS + 3) * np.log1p(np.sum(apart**2, axis=0) / _TAILS))
    return points, origin, np.asarray(np.logaddexp.reduce(densities, axis=0), np.float64)


def _shaped(parts: Sequence[_Part], points: Float, origin: Int, weight: Float) -> list[_Part]:
    """Shape each part by its draws that count; one that has too few stays, with a small share."""
    found = []
    for number, part in enumerate(parts):
        own = origin == number
        whole = float(weight[own].sum())
        effective = whole**2 / max(float(np.sum(weight[own] ** 2)), 1e-300)
        if effective >= _FEWEST:
            centre = weight[own] @ points[own] / whole
            apart = points[own] - centre
            part = _Part(whole, centre, (apart * weight[own, None]).T @ apart / whole)
        found.append(replace(part, share=max(whole, _LEAST_SHARE)))
    return found


def _tempered(likely: Float) -> Float:
    """Give weights by which enough draws count to shape the next round."""
    power = 1.0
    while True:
        weight = np.exp(power * (likely - likely.max()))
        weight /= weight.sum()
        if 1.0 / float(np.sum(weight**2)) >= _ENOUGH or power < 1e-3:
            return np.asarray(weight, np.float64)
        power *= 0.7

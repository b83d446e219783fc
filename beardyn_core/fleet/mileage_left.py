"""Mileage and date until a spall is too wide, from its widths so far and a law of growth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Annotated as A

import numpy as np

from beardyn_core.fleet.identity import write_date
from beardyn_core.fleet.store import Stored
from beardyn_core.follow.forecast import WIDEST_FORECAST
from beardyn_core.follow.growth import GrowthLaw, drawn_between

ACROSS = (8.0e-3, 40.0e-3)  # 90 % of the lengths of spalls across the raceway, [m]; assumed
BEGINS = (2.0e-3, 20.0e-3)  # 90 % of the widths at the first measurement before it is known, [m]; assumed
_DRAWS, _SEED = 20_000, 1
_FEWEST = 3  # widths
_LEAST_EFFECTIVE = 60.0  # draws that the widths leave
_NORMAL_95 = 1.96
_SCATTER = 0.08  # of a width beside its interval, relative: the spall is not a rectangle; assumed
_DAYS = 86_400.0  # [s]
_CENTURY = 100.0 * 365.0 * _DAYS  # a date beyond it says nothing, [s]


@dataclass(frozen=True)
class MileageLeft:
    """What remains until the spall is too wide."""

    distance: A[tuple[float, float, float], "5, 50 and 95 %, NaN where it cannot be judged, [m]"]
    dates: A[tuple[float, float, float], "at the mileage of each day so far, NaN unknown, [s]"]
    sentence: A[str, "the same, or why it cannot be judged"]
    assumed: A[tuple[str, ...], "what it rests on"] = ()

    @property
    def is_known(self) -> bool:
        """Whether there is a number."""
        return isfinite(self.distance[1])


def judge_mileage(history: Sequence[Stored], part: str, law: GrowthLaw | None = None) -> MileageLeft:
    """Judge how far the bearing may run until its spall is 20 mm wide.

    Parameters
    ----------
    history : sequence of Stored
        Of one axlebox since its bearing was exchanged, in the order of time.
    part : str
        That is spalled.
    law : GrowthLaw, optional

    Notes
    -----
    Length across the raceway, first width and rate of growth are drawn from what is assumed of them; a draw
    counts as much as the widths that it leads to agree with those that were measured. Where few draws agree,
    the growth is not that of the law, and nothing is stated.
    """
    law = law or GrowthLaw()
    known = [
        each
        for each in history
        if each.analysis.verdict == part and isfinite(each.analysis.width) and isfinite(each.mileage)
    ]
    if not part:
        return _unknown("no part is named")
    if len(known) < _FEWEST:
        return _unknown(f"fewer than {_FEWEST} recordings with a width and a mileage")
    mileage = np.array([each.mileage for each in known])
    width = np.array([each.analysis.width for each in known])
    if np.median(width[-_FEWEST:]) >= WIDEST_FORECAST:
        return MileageLeft(
            (0.0, 0.0, 0.0), (known[-1].time,) * 3,
            f"the spall is {1e3 * WIDEST_FORECAST:.0f} mm wide or wider: take the bearing out now",
        )  # fmt: skip
    half = np.array([0.5 * (each.analysis.width_high - each.analysis.width_low) for each in known])
    deviation = np.hypot(half / _NORMAL_95, _SCATTER * width)
    random = np.random.default_rng(_SEED)
    across = drawn_between(ACROSS, _DRAWS, random)
    first = drawn_between(BEGINS, _DRAWS, random)
    # draws near the first widths: the others would count nothing
    middle = float(np.median(width[:_FEWEST]))
    near = middle + np.median(deviation[:_FEWEST]) * random.normal(0.0, 1.5, _DRAWS)
    first = np.where(random.random(_DRAWS) < 0.1, first, np.maximum(near, 0.5e-3))
    rate = law.rates(_DRAWS, random)
    begin = across * first
    misfit = np.zeros(_DRAWS)
    for at, measured, doubt in zip(mileage - mileage[0], width, deviation, strict=True):
        reached = law.grow_areas(begin, rate, float(at)) / across
        misfit += np.log1p(
            (reached - measured) ** 2 / (4.0 * doubt**2)
        )  # heavy tails: one width may be wrong
    weight = np.exp(-2.5 * (misfit - misfit.min()))
    typical = float(misfit.min()) / len(known)
    effective = float(weight.sum() ** 2 / np.sum(weight**2))
    if effective < _LEAST_EFFECTIVE or typical > 1.5:
        return _unknown("the widths so far do not agree with the assumed law of growth")
    # from the last recording on, which may have no width: what has grown since the last one is gone
    last = [each for each in history if isfinite(each.mileage)][-1]
    now = law.grow_areas(begin, rate, last.mileage - float(mileage[0]))
    distance = law.distance(now, across * WIDEST_FORECAST, rate)
    order = np.argsort(distance)
    share = np.cumsum(weight[order]) / weight.sum()
    low, likely, high = (float(distance[order][np.searchsorted(share, q)]) for q in (0.05, 0.5, 0.95))
    if likely == 0.0:
        return MileageLeft(
            (low, likely, high), (last.time,) * 3,
            f"by its growth the spall is {1e3 * WIDEST_FORECAST:.0f} mm wide or wider by now; its width was "
            f"measured last on {write_date(known[-1].time)}: take the bearing out now",
            _assumed(law),
        )  # fmt: skip
    pace = _pace(history)
    dates = tuple(last.time + each / pace if pace > 0.0 else nan for each in (low, likely, high))
    end = f"{1e3 * WIDEST_FORECAST:.0f} mm"
    text = f"{likely / 1e3:,.0f} km until {end}, 90 % interval {low / 1e3:,.0f} to {high / 1e3:,.0f}"
    if pace > 0.0 and high / pace < _CENTURY:
        days = [write_date(each) for each in dates]
        text += f"; at {pace * _DAYS / 1e3:,.0f} km a day {days[1]} ({days[0]} to {days[2]})"
    else:
        dates = (nan, nan, nan)
    return MileageLeft((low, likely, high), (dates[0], dates[1], dates[2]), text, _assumed(law))


def _pace(history: Sequence[Stored]) -> float:
    """Compute the mean speed of the mileage over the calendar, NaN unknown, [m/s]."""
    known = [each for each in history if isfinite(each.mileage)]
    if len(known) < 2 or known[-1].time <= known[0].time:
        return nan
    return (known[-1].mileage - known[0].mileage) / (known[-1].time - known[0].time)


def _assumed(law: GrowthLaw) -> tuple[str, ...]:
    low, high = (1e3 * each for each in ACROSS)
    slow, rate = 100.0 * law.slow_share, 1e12 * law.rate
    return (
        f"growth of the area of a spall beyond {1e6 * law.critical_area:.0f} mm²: {rate:.0f} mm² in 1000 km, "
        f"90 % within a factor of {law.rate_spread:g}; below it {slow:.0f} % of that; assumed",
        f"length across the raceway {low:.0f} to {high:.0f} mm, which stays; assumed",
        "load and mileage a day go on as they were",
    )


def _unknown(why: str) -> MileageLeft:
    return MileageLeft((nan, nan, nan), (nan, nan, nan), f"cannot be judged: {why}")

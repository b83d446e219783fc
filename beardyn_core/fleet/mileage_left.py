"""Mileage and date until a spall is too wide, from its widths so far and several laws of growth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, log, nan
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.fleet.growth_fit import ACROSS, GrowthFit, Widths, fit_growth
from beardyn_core.fleet.identity import write_date
from beardyn_core.fleet.store import Stored
from beardyn_core.follow.forecast import WIDEST_FORECAST
from beardyn_core.follow.growth import ASSUMED_LAW, GrowthLaw, PowerLaw, other_laws

_FEWEST = 3  # widths
_MOST = 120  # widths that are taken, spread over all
_SCATTER = 0.08  # of a width in addition to its interval, relative: the spall is not a rectangle; assumed
_LEAST_LIKELY = 0.05  # of the law that explains the widths best: one that is less likely does not agree
_DAYS = 86_400.0  # [s]
_CENTURY = 100.0 * 365.0 * _DAYS  # a date beyond it says nothing, [s]
_QUANTILES = (0.05, 0.5, 0.95)
_UNKNOWN = (nan, nan, nan)

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class LawMileage:
    """What remains by one law of growth."""

    law: A[str, "its name"]
    is_assumed: A[bool, "whether it is the one that is assumed"]
    agrees: A[bool, "whether the widths so far agree with it"]
    distance: A[Triple, "5, 50 and 95 %, [m]"]
    dates: A[Triple, "at the mileage of each day so far, NaN unknown, [s]"]


@dataclass(frozen=True)
class MileageLeft:
    """What remains until the spall is too wide."""

    distance: A[Triple, "by the assumed law: 5, 50 and 95 %, NaN where it cannot be judged, [m]"]
    dates: A[Triple, "at the mileage of each day so far, NaN unknown, [s]"]
    sentence: A[str, "the same, or why it cannot be judged"]
    assumed: A[tuple[str, ...], "what it rests on"] = ()
    laws: A[tuple[LawMileage, ...], "the assumed one first; none where nothing is to be fitted"] = ()

    @property
    def is_known(self) -> bool:
        """Whether the assumed law gives a number."""
        return isfinite(self.distance[1])

    @property
    def span(self) -> tuple[float, float]:
        """Least and largest mileage of the 90 % intervals of the laws that agree, NaN without one, [m]."""
        return _span([each.distance for each in self.laws if each.agrees] or [self.distance])

    @property
    def span_dates(self) -> tuple[float, float]:
        """First and last date of these, NaN unknown, [s]."""
        return _span([each.dates for each in self.laws if each.agrees] or [self.dates])

    @property
    def sentences(self) -> list[str]:
        """List what is known: by the assumed law, and the range over the laws."""
        several = f"mileage left by several laws: {self.laws_sentence}" if self.laws else ""
        return [f"mileage left: {self.sentence}", *filter(None, [several])]

    @property
    def laws_sentence(self) -> str:
        """Say the range over the laws, and which agree; empty where none is fitted."""
        if not self.laws:
            return ""
        agree, differ = ("; ".join(e.law for e in self.laws if e.agrees == kind) for kind in (True, False))
        assumed = next(each.law for each in self.laws if each.is_assumed)
        if not agree:
            return f"its widths agree with no law of growth ({differ})"
        low, high = self.span
        text = f"{low / 1e3:,.0f} to {high / 1e3:,.0f} km"
        first, last = self.span_dates
        if isfinite(first) and isfinite(last):
            text += f", {write_date(first)} to {write_date(last)},"
        text += f" over the laws of growth that its widths agree with ({agree})"
        return f"{text}{f', and not with: {differ}' if differ else ''}; assumed: {assumed}"


def judge_mileage(history: Sequence[Stored], part: str, law: GrowthLaw | None = None) -> MileageLeft:
    """Judge how far the bearing may run until its spall is 20 mm wide.

    Parameters
    ----------
    history : sequence of Stored
        Of one axlebox since its bearing was exchanged, in the order of time.
    part : str
        That is spalled.
    law : GrowthLaw, optional
        That is assumed; others with its rate at the critical area are compared with it.

    Notes
    -----
    See `growth_fit.fit_growth`. A law agrees with the widths where it can have made them, and where they are
    not twenty times less likely by the spall of it that fits best than by that of the best law: the rate of
    growth, which is assumed, has no part in it. Where the assumed law does not agree, it states nothing.
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
    if np.median([each.analysis.width for each in known[-_FEWEST:]]) >= WIDEST_FORECAST:
        return MileageLeft(
            (0.0, 0.0, 0.0), (known[-1].time,) * 3,
            f"the spall is {1e3 * WIDEST_FORECAST:.0f} mm wide or wider: take the bearing out now",
        )  # fmt: skip
    widths = _widths(known)
    # from the last recording on, which may have no width: what has grown since the last one is gone
    last = [each for each in history if isfinite(each.mileage)][-1]
    pace = _pace(history)
    every: dict[str, GrowthLaw | PowerLaw] = {ASSUMED_LAW: law, **other_laws(law)}
    fits = {name: fit_growth(each, law, widths) for name, each in every.items()}
    best = max(each.likelihood for each in fits.values())
    laws = []
    for name, fit in fits.items():
        distance = _distance(every[name], fit, last.mileage - known[0].mileage)
        laws.append(
            LawMileage(
                name,
                name == ASSUMED_LAW,
                fit.is_usable and fit.likelihood >= best + log(_LEAST_LIKELY),
                distance,
                _dates(last.time, distance, pace),
            )
        )
    first, several = laws[0], tuple(laws)
    if not first.agrees:
        why = f"the widths so far do not agree with the assumed law of growth ({first.law})"
        return MileageLeft(_UNKNOWN, _UNKNOWN, f"cannot be judged: {why}", _assumed(law), several)
    low, likely, high = first.distance
    if likely == 0.0:
        return MileageLeft(
            first.distance, (last.time,) * 3,
            f"by its growth the spall is {1e3 * WIDEST_FORECAST:.0f} mm wide or wider by now; its width was "
            f"measured last on {write_date(known[-1].time)}: take the bearing out now",
            _assumed(law), several,
        )  # fmt: skip
    end = f"{1e3 * WIDEST_FORECAST:.0f} mm"
    text = f"{likely / 1e3:,.0f} km until {end}, 90 % interval {low / 1e3:,.0f} to {high / 1e3:,.0f}"
    if isfinite(first.dates[2]):
        days = [write_date(each) for each in first.dates]
        text += f"; at {pace * _DAYS / 1e3:,.0f} km a day {days[1]} ({days[0]} to {days[2]})"
    return MileageLeft(first.distance, first.dates, text, _assumed(law), several)


def _widths(known: Sequence[Stored]) -> Widths:
    """Take the widths of recordings, of many some that are spread over all."""
    chosen = np.unique(np.linspace(0, len(known) - 1, min(len(known), _MOST)).round().astype(int))
    taken = [known[int(place)] for place in chosen]
    mileage = np.array([each.mileage for each in taken])
    width = np.array([each.analysis.width for each in taken])
    deviation = np.array([each.analysis.width_deviation for each in taken])
    return Widths(mileage - mileage[0], width, np.hypot(deviation, _SCATTER * width))


def _distance(law: GrowthLaw | PowerLaw, fit: GrowthFit, since: float) -> Triple:
    """Compute what remains by a law so far after the first width, [m]."""
    area: Float = fit.across * WIDEST_FORECAST
    now = np.minimum(law.grow_areas(fit.begin, fit.rate, since), area)
    low, likely, high = fit.quantiles(law.distance(now, area, fit.rate), _QUANTILES)
    return low, likely, high


def _dates(time: float, distance: Triple, pace: float) -> Triple:
    """Give the dates of mileages that are left at a pace, NaN where they say nothing, [s]."""
    if not pace > 0.0:
        return _UNKNOWN
    low, likely, high = (time + each / pace if each / pace < _CENTURY else nan for each in distance)
    return low, likely, high


def _pace(history: Sequence[Stored]) -> float:
    """Compute the mean speed of the mileage over the calendar, NaN unknown, [m/s]."""
    known = [each for each in history if isfinite(each.mileage)]
    if len(known) < 2 or known[-1].time <= known[0].time:
        return nan
    return (known[-1].mileage - known[0].mileage) / (known[-1].time - known[0].time)


def _span(triples: Sequence[Triple]) -> tuple[float, float]:
    """Give the least low end that is known, and the largest high end, NaN where one is not known."""
    low = min((each[0] for each in triples if isfinite(each[0])), default=nan)
    return low, float(np.max([each[2] for each in triples]))


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
    return MileageLeft(_UNKNOWN, _UNKNOWN, f"cannot be judged: {why}")

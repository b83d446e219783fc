"""Which of many bearings a vibration may be of: the combs of the monitor against the orders of each."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import log, nan
from statistics import median
from typing import Annotated as A

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.chain import REFERENCE
from beardyn_core.monitor.chain.competing_orders import is_related
from beardyn_core.monitor.chain.diagnosable import NOT_DIAGNOSABLE, live_axes, unmeasured
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.monitor.chain.fault_lines import (
    CONE,
    ROLLER,
    Candidate,
    Pattern,
    fault_patterns,
    lay_patterns,
)
from beardyn_core.monitor.chain.impulsiveness import with_strikes
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import Band
from beardyn_core.monitor.chain.result import MonitorResult
from beardyn_core.monitor.chain.verdict import HEALTHY, UNEXPLAINED, is_same_comb, strikes

ONE, SEVERAL, NONE, CANNOT_TELL = "one fits", "several fit equally", "none fits", "cannot tell"
SEARCH_SETTINGS = MonitorSettings(interval=2.0)  # a search takes long, and a window holds 60 revolutions
_EQUAL = 0.9  # of the evidence of the best, from which a bearing explains a comb as well
_ALIKE = 0.006  # orders that differ by less are of one comb, [-]
_NEAR = 0.01  # slip of an order beyond which a comb is rather that of another bearing, [-]
_BIN = 0.01  # patterns whose orders differ by less are laid as one, [-]
_FINER = 1.5  # times its order is below that of a pattern: a comb has lines between those of the pattern
_OTHER_SPEED, _SPEEDS = 2.0, 3  # times a stated speed, up to which others are named; how many
_RPM = 60.0  # of a hertz
_CAGE_BIN = 0.004  # and those whose cage orders do


@dataclass(frozen=True)
class FittingPart:
    """A part of a bearing that explains a comb of the vibration."""

    part: A[str, "``cup``, ``cone`` or ``roller``"]
    order: A[float, "found, per shaft revolution, [-]"]
    expected_order: A[float, "of the bearing data, [-]"]
    evidence: A[float, "of its lines against chance, [nat]"]

    @property
    def deviation(self) -> float:
        """Order found against that of the bearing data, relative, [-]."""
        return self.order / self.expected_order - 1.0


@dataclass(frozen=True)
class BearingFit:
    """A bearing whose orders fit the combs of a vibration."""

    name: A[str, "designation"]
    parts: A[tuple[FittingPart, ...], "that explain a comb, the surest first"]
    share: A[float, "of the analyses with a comb in which it is among the best, [-]"]

    @property
    def deviation(self) -> float:
        """Largest deviation of an order, without its sign, [-]."""
        return max(abs(each.deviation) for each in self.parts)


@dataclass(frozen=True)
class FittingSpeed:
    """A speed of the shaft at which a part of a bearing would have the order of the comb."""

    bearing: A[str, "designation"]
    part: A[str, "``cup``, ``cone`` or ``roller``"]
    shaft_frequency: A[float, "without slip, [Hz]"]
    change: A[float, "against the stated speed, relative, [-]"]

    def sentence(self) -> str:
        """Write it for a reason."""
        rpm = f"{_RPM * self.shaft_frequency:.5g} rpm"
        return f"the {PART_NAMES[self.part]} of {self.bearing} at {rpm} ({100.0 * self.change:+.1f} %)"


@dataclass(frozen=True)
class BearingSearchResult:
    """Bearings that fit a vibration."""

    answer: A[str, "``one fits``, ``several fit equally``, ``none fits`` or ``cannot tell``"]
    reason: A[str, "in a sentence"]
    fits: A[tuple[BearingFit, ...], "those that explain the combs equally well, the nearest orders first"]
    comb_order: A[float, "of the surest comb, NaN without, [-]"]
    analyses: A[int, "of stretches of the vibration"]
    with_comb: A[int, "analyses that found a comb of strikes"]
    searched: A[int, "bearings that were compared"]
    speeds: A[tuple[FittingSpeed, ...], "at which one would fit, the nearest first, where none fits"] = ()


@dataclass(frozen=True)
class _Look:
    """What one analysis says: the order of its comb, and the parts of each bearing that explain it."""

    order: float
    shaft_frequency: float
    parts: dict[str, tuple[FittingPart, ...]]


class BearingSearch:
    """A monitoring algorithm that compares many bearings with each stretch; `conclude` sums up.

    Parameters
    ----------
    bearings : mapping
        Fault frequencies of each by its name.

    Notes
    -----
    A comb is what the monitor calls one: lines beyond chance that strike. The surest pattern of all bearings
    names it. A bearing fits where one of its parts has the order of the comb within 1 % of slip and the
    uncertainty of the speed, and at least 0.9 of the evidence of the surest; sidebands count, so that a cone
    with sidebands differs from a cup. Without the lines of that comb, other parts of the bearings that fit
    are sought. Bearings with like orders explain a comb equally well, and nothing in the vibration shows
    them apart.
    """

    def __init__(self, bearings: Mapping[str, FaultFrequencies]) -> None:
        self.searched = len(bearings)
        self._patterns = {name: fault_patterns(orders) for name, orders in bearings.items()}
        bins: dict[tuple[object, ...], list[tuple[str, Pattern]]] = defaultdict(list)
        for name, patterns in self._patterns.items():
            for each in patterns:
                cage = round(each.sideband / _CAGE_BIN) if each.fault == ROLLER else 0
                bins[each.fault, round(log(each.order) / _BIN), cage].append((name, each))
        # the middle one of a bin is laid for all: the place that it finds is that of the comb
        self._alike = {
            sorted(several, key=lambda each: each[1].order)[len(several) // 2][1]: several
            for several in bins.values()
        }
        self._looks: list[_Look | None] = []
        self._refusals: list[str] = []

    def __call__(
        self, stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
    ) -> MonitorResult:
        """Compare the bearings with one stretch; orders and count of a monitored bearing are not used."""
        if why := unmeasured(stretch, settings):
            self._refusals.append(why)
            return MonitorResult(NOT_DIAGNOSABLE, why, stretch.end_ns)
        stretch, _ = live_axes(stretch)
        band = REFERENCE.select_band(stretch, settings)
        power = REFERENCE.envelope(REFERENCE.whiten(stretch, settings), band)
        tracked = REFERENCE.track(power, stretch, settings)
        found = lay_patterns(tracked, list(self._alike), stretch.shaft_frequency, settings)
        surest = _surest(found.candidates, settings)
        measured = with_strikes(replace(found, candidates=(surest,)), stretch, band, settings)
        passed = surest.score >= surest.threshold and strikes(measured.candidates[0], settings)
        for bare in measured.combs[:1]:
            between = bare.order * _FINER < surest.order and surest.pattern.divided == 1
            if bare.evidence <= surest.evidence or (is_same_comb(bare, surest) and not between):
                continue
            passed = False
            loudest = max(measured.combs, key=lambda each: each.strikes)
            if loudest.strikes >= settings.least_strikes or loudest.sharpest >= min(settings.least_sharpest):
                self._looks.append(_Look(bare.order, stretch.shaft_frequency, {}))
                reason = f"a comb of order {bare.order:.3f} that no bearing has"
                return MonitorResult(UNEXPLAINED, reason, stretch.end_ns)
        if not passed:
            self._looks.append(None)
            return MonitorResult(HEALTHY, "no comb", stretch.end_ns)
        parts = self._explaining(found.candidates, surest, settings)
        self._add_other_parts(parts, tracked, surest, stretch, band, settings)
        explained = {name: tuple(each) for name, each in parts.items()}
        self._looks.append(_Look(surest.order, stretch.shaft_frequency, explained))
        return MonitorResult(HEALTHY, f"a comb of order {surest.order:.3f}", stretch.end_ns)

    def _explaining(
        self, candidates: Sequence[Candidate], comb: Candidate, settings: MonitorSettings
    ) -> dict[str, list[FittingPart]]:
        """Find the bearings with a part of the order of a comb."""
        parts: dict[str, list[FittingPart]] = defaultdict(list)
        near = _NEAR + settings.speed_uncertainty
        for each, alike in zip(candidates, self._alike.values(), strict=True):
            if abs(each.order / comb.order - 1.0) > _ALIKE or _strength(each) < _EQUAL * comb.evidence:
                continue
            for name, pattern in alike:
                if abs(comb.order / pattern.order - 1.0) <= near:
                    parts[name].append(FittingPart(pattern.fault, comb.order, pattern.order, each.evidence))
        return parts

    def _add_other_parts(
        self,
        parts: dict[str, list[FittingPart]],
        tracked: Float,
        comb: Candidate,
        stretch: Stretch,
        band: Band,
        settings: MonitorSettings,
    ) -> None:
        """Add the parts of the bearings that fit which have a comb of their own besides."""
        others: dict[Pattern, list[str]] = defaultdict(list)
        for name, explained in parts.items():
            known = [each.part for each in explained]
            for pattern in self._patterns[name]:
                if pattern.fault not in known and not is_related(pattern.order, comb.order):
                    others[pattern].append(name)
        if not others:
            return
        found = lay_patterns(tracked, list(others), stretch.shaft_frequency, settings, without=comb)
        near = _NEAR + settings.speed_uncertainty
        for each, names in zip(found.candidates, others.values(), strict=True):
            if each.score < each.threshold or abs(each.order / each.pattern.order - 1.0) > near:
                continue
            measured = with_strikes(
                replace(found, candidates=(comb, each), combs=()), stretch, band, settings
            )
            if strikes(measured.candidates[1], settings):
                own = FittingPart(each.pattern.fault, each.order, each.pattern.order, each.evidence)
                for name in names:  # at one speed: a stated one is wrong for all parts alike
                    if abs(own.deviation - parts[name][0].deviation) <= _ALIKE:
                        parts[name].append(own)

    def conclude(self) -> BearingSearchResult:
        """Sum up all analyses."""
        struck = [each for each in self._looks if each is not None]
        analyses = len(self._looks) + len(self._refusals)
        order = median(each.order for each in struck) if struck else nan

        def answer(word: str, reason: str, fits: Sequence[BearingFit] = ()) -> BearingSearchResult:
            return BearingSearchResult(word, reason, tuple(fits), order, analyses, len(struck), self.searched)

        if not analyses:
            return answer(CANNOT_TELL, "the signal is shorter than the first analysis needs")
        if not self._looks:
            return answer(CANNOT_TELL, self._refusals[-1])
        if 2 * len(struck) < analyses:
            return answer(
                CANNOT_TELL,
                f"{len(struck)} of {analyses} analyses found a comb of strikes; a healthy bearing has none, "
                "and nothing else in the vibration names a bearing",
            )
        fits = sorted(self._fits(struck), key=lambda each: (-len(each.parts), each.deviation, each.name))
        comb = f"a comb of order {order:.3f}"
        if not fits:
            speeds = self._speeds(order, median(each.shaft_frequency for each in struck))
            reason = f"{comb} is that of no part of {self.searched} bearings"
            if speeds:
                near = speeds[0]
                would = ", ".join(each.sentence() for each in speeds)
                reason += (
                    f"; nearest is the {PART_NAMES[near.part]} of {near.bearing}, "
                    f"{100.0 * abs(near.change):.2g} % off; a wrong speed moves all orders alike: it would "
                    f"be {would}"
                )
            return replace(answer(NONE, reason), speeds=speeds)
        nearest = fits[0]
        part = " and ".join(PART_NAMES[each.part] for each in nearest.parts)
        off = f"{100.0 * nearest.deviation:.2g} % off"
        if len(fits) == 1:
            return answer(ONE, f"{comb} is that of the {part} of {nearest.name} alone, {off}", fits)
        return answer(
            SEVERAL,
            f"{comb} is that of a part of {len(fits)} of {self.searched} bearings; nearest is the {part} of "
            f"{nearest.name}, {off}",
            fits,
        )

    def _speeds(self, order: float, stated: float) -> tuple[FittingSpeed, ...]:
        """List the speeds, [Hz], nearest to the stated one, at which a part has the order of a comb."""
        ratios = sorted(
            (abs(log(order / each.order)), order / each.order, name, each.fault)
            for name, patterns in self._patterns.items()
            for each in patterns
        )
        found: list[FittingSpeed] = []
        for away, ratio, name, part in ratios:
            if away > log(_OTHER_SPEED) or len(found) == _SPEEDS:
                break
            if all(abs(ratio / (1.0 + each.change) - 1.0) > _ALIKE for each in found):
                found.append(FittingSpeed(name, part, stated * ratio, ratio - 1.0))
        return tuple(found)

    def _fits(self, struck: Sequence[_Look]) -> list[BearingFit]:
        found = []
        names = {name for look in struck for name in look.parts}
        for name in names:
            share = sum(name in look.parts for look in struck) / len(struck)
            if share < 0.5:
                continue
            by_part: dict[str, list[FittingPart]] = defaultdict(list)
            for look in struck:
                for each in look.parts.get(name, ()):
                    by_part[each.part].append(each)
            parts = [
                FittingPart(
                    part,
                    median(each.order for each in several),
                    several[0].expected_order,
                    median(each.evidence for each in several),
                )
                for part, several in by_part.items()
                if 2 * len(several) >= len(struck)
            ]
            if parts:
                parts.sort(key=lambda each: -each.evidence)
                found.append(BearingFit(name, tuple(parts), share))
        return found


def _strength(each: Candidate) -> float:
    """Give the evidence of a pattern; an inner ring may strike alike all round, without sidebands."""
    return max(each.evidence, each.alone) if each.pattern.fault == CONE else each.evidence


def _surest(candidates: Sequence[Candidate], settings: MonitorSettings) -> Candidate:
    """Find the pattern that names the comb.

    Without odd harmonics it is a comb of twice its order; with sure ones a comb of twice or three times that
    order is the same, its every second or third line stronger than those between.
    """
    whole = [each for each in candidates if each.odd > 0.0 or each.score < each.threshold]
    surest = max(whole or candidates, key=lambda each: each.evidence)
    chance = -log(settings.false_alarm_rate)
    parts = [
        each
        for each in whole
        for part in (2, 3)
        if each.score >= each.threshold
        and each.odd > chance
        and abs(surest.order / (part * each.order) - 1.0) <= _ALIKE
    ]
    return max(parts, key=lambda each: each.evidence, default=surest)

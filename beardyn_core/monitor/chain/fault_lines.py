"""Fault-line scoring: power on the lines of each fault, compared with that of noise.

The threshold follows from a stated false-alarm rate. In stationary noise the squared envelope has a smooth
spectrum whose lines are independent and, over their local mean, exponentially distributed. The score of a
fault adds the L lines of its pattern but the strongest: one line alone, from whatever source, proves nothing.
By Renyi's representation that is a sum of L - 1 exponentials with means (L - i) / (L - i + 1), whose tail is
known. It is sought over the tolerance of the fault frequency and for three faults, so the rate is shared
among all independent places.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import isnan
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Bool, Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.competing_orders import (
    LOWEST_COMB,
    Rival,
    mark_explained,
    reach,
    shaft_of,
    strongest_rival,
)
from beardyn_core.monitor.chain.false_alarm_rate import PLACES_PER_RESOLUTION, evidence, score_threshold
from beardyn_core.monitor.chain.inputs import MonitorSettings
from beardyn_core.monitor.features import OrderSpectrum, line_at, order_spectrum

CUP, CONE, ROLLER = FAULTS = ("cup", "cone", "roller")
COMB = "comb"  # evenly spaced lines of any order
LINE_LEVEL = 9.0  # over the median background, from which a single line is listed, [dB]
# of the search for the strongest line, in multiples of the roller count: above the cage's own orders
_LOWEST_ORDER = 0.3
_LOWEST_OF_PARTS = 0.7  # of the lowest order of a part, where the roller count is not known
_SLIP = 0.01  # of rollers at a speed that is not the stated one, [-]
_FOREIGN = 0.3  # combs are sought up to this share beyond the last line of the bearing's own parts
ODD = (1.0, 3.0, 5.0, 7.0)  # harmonics that are those of no comb of twice the order
_OF_SHAFT = 0.05  # parts of a comb that near twice the shaft are lines of the shaft, [-]
_MOST_SHAFTS = 3  # combs near whole orders that are taken out
_PARTS_OF_A_COMB = (1, 2, 3)  # every second or third line of a comb may be stronger than those between
SHAFT_REACH = 2.0  # resolutions next to a multiple of the shaft within which lines are left out
_NOTHING = -300.0  # [dB]
TURNS = 6  # multiples of the cage's order by which strikes of a rolling element come and go
_MEDIAN_OVER_MEAN = np.log(2.0)  # of an exponential distribution


@dataclass(frozen=True)
class Line:
    """A line that was looked for and found in the envelope order spectrum."""

    name: A[str, "such as ``2 x BPFO`` or ``BPFI - shaft``"]
    order: A[float, "found, cycles per shaft revolution, [-]"]
    expected_order: A[float, "from bearing data, [-]"]
    frequency: A[float, "at the mean shaft speed, [Hz]"]
    level: A[float, "over the background, [dB]"]


@dataclass(frozen=True)
class Pattern:
    """Lines of a fault: harmonics of one order, with sidebands."""

    fault: str
    symbol: str
    order: A[float, "[-]"]
    sideband: A[float, "distance of the sidebands, [-]"]
    sideband_symbol: str
    sidebands: A[int, "how many on each side are added up"]
    explained: A[int, "how many on each side may belong to the fault"]
    divided: A[int, "lines at this part of the order belong to the fault as well"] = 1
    other_sideband: A[float, "of a fault of another part, which this one has not, [-]"] = 0.0
    cage: A[
        float,
        "order of the cage from bearing data, where its multiples count in place of sidebands, else 0, [-]",
    ] = 0.0

    def lines(self, harmonics: int) -> list[tuple[int, int]]:
        """List harmonic and sideband number of each line."""
        if self.cage:
            return [(h, 0) for h in range(1, harmonics + 1)] + [(0, k) for k in range(1, TURNS + 1)]
        beside = range(-self.sidebands, self.sidebands + 1)
        return [(h, k) for h in range(1, harmonics + 1) for k in beside]


@dataclass(frozen=True)
class Candidate:
    """A pattern at its best place in a spectrum."""

    pattern: Pattern
    order: A[float, "where its fundamental fits best, [-]"]
    score: A[float, "mean power of its lines but the strongest, over that of noise, not below 0, [dB]"]
    threshold: A[float, "score that noise passes with the stated rate, [dB]"]
    evidence: A[float, "against chance, whatever the number of lines, [nat]"]
    rival: A[Rival, "evenly spaced lines that it does not explain"]
    lines: A[tuple[Line, ...], "those that stand out one by one"]
    strikes: A[
        float, "what its harmonics but the loudest make of the mean power, NaN when not measured, [-]"
    ] = np.nan
    alone: A[float, "evidence of its harmonics without sidebands, [nat]"] = -np.inf
    odd: A[float, "evidence of its odd harmonics, [nat]"] = -np.inf
    otherwise: A[
        float,
        "evidence of the same comb with the sidebands of another part, or of one of its sidebands as the "
        "comb and the others next to it, [nat]",
    ] = -np.inf
    sharpest: A[float, "the same in the octave where it is most, 0 when not measured, [-]"] = 0.0

    def places(self, harmonics: int) -> Float:
        """Compute where its lines are, shape [line], [-]."""
        return np.array(
            [h * self.order + k * self.pattern.sideband for h, k in self.pattern.lines(harmonics)]
        )

    def explains(self, orders: Float, resolution: float) -> Bool:
        """Tell which orders are its harmonics, or sidebands of these that its fault may have."""
        own = self.pattern
        found = mark_explained(orders, self.order / own.divided, own.sideband, own.explained, resolution)
        if own.cage:
            multiple = np.maximum(1.0, np.round(orders / own.sideband))
            near = reach(orders, resolution)
            found |= (np.abs(orders - multiple * own.sideband) <= near) & (near < 0.25 * own.sideband)
        return found

    def stated(self, chance: float) -> tuple[float, float]:
        """Give the order that shows the fault, and the same from bearing data, [-].

        It is that of the cage where the harmonics of its own prove nothing.

        Parameters
        ----------
        chance : float
            Evidence from which lines are no chance, [nat].
        """
        if self.pattern.cage and self.alone < chance:
            return self.pattern.sideband, self.pattern.cage
        return self.order, self.pattern.order


@dataclass(frozen=True)
class FaultLines:
    """Lines of faults in a spectrum, with their scores."""

    spectrum: OrderSpectrum
    candidates: A[tuple[Candidate, ...], "one for each of `FAULTS` whose order is known, at the stated speed"]
    strongest_order: A[float, "of the strongest line in the band of the fault lines, no whole order, [-]"]
    strongest_level: A[float, "of that line, [dB]"]
    deepest: A[float, "strongest line as measured over the mean power, [-]"] = 0.0
    elsewhere: A[tuple[Candidate, ...], "one for each of `FAULTS`, at other speeds than the stated one"] = ()
    neighbours: A[tuple[Candidate, ...], "faults of other bearings on the shaft"] = ()
    combs: A[tuple[Candidate, ...], "evenly spaced lines of any order, and parts of that order"] = ()
    turned: A[tuple[Candidate, ...], "a rolling element by the turns of a cage that may be another's"] = ()

    @property
    def every(self) -> tuple[Candidate, ...]:
        """All of them."""
        return (*self.candidates, *self.elsewhere, *self.neighbours, *self.combs, *self.turned)

    def with_each(self, change: Callable[[Candidate], Candidate]) -> FaultLines:
        """Change every candidate in the same way."""
        return replace(
            self,
            candidates=tuple(map(change, self.candidates)),
            elsewhere=tuple(map(change, self.elsewhere)),
            neighbours=tuple(map(change, self.neighbours)),
            combs=tuple(map(change, self.combs)),
            turned=tuple(map(change, self.turned)),
        )


def fault_patterns(orders: FaultFrequencies) -> tuple[Pattern, ...]:
    """List the patterns of cup, cone and roller faults, of those whose orders are known.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 2 (signatures).
    """
    cage = 0.0 if isnan(orders.ftf) else orders.ftf
    several = (
        Pattern("cup", "BPFO", orders.bpfo, 1.0, "shaft", 0, 1),
        Pattern("cone", "BPFI", orders.bpfi, 1.0, "shaft", 1, 4, other_sideband=cage),
        Pattern("roller", "2 BSF", 2.0 * orders.bsf, orders.ftf, "FTF", 1, 4, 2, other_sideband=1.0),
    )
    return tuple(each for each in several if not isnan(each.order + each.sideband))


def comb_score(
    tracked: Float,
    orders: FaultFrequencies,
    roller_count: int,
    shaft_frequency: float,
    settings: MonitorSettings,
) -> FaultLines:
    """Score every fault in power over the angle of the shaft.

    Parameters
    ----------
    tracked : float64 array, shape [step]
        Evenly in angle.
    orders : FaultFrequencies
        Of one row, per shaft revolution, from bearing data; NaN where one is not known, not all.
    roller_count : int
        0 where it is not known.
    shaft_frequency : float
        [Hz].
    """
    patterns = fault_patterns(orders)
    rate = settings.false_alarm_rate / len(FAULTS)
    low = _LOWEST_ORDER * roller_count or _LOWEST_OF_PARTS * min(each.order for each in patterns)
    known = settings.tolerance + settings.speed_uncertainty
    doubt = settings.speed_doubt
    slowest, fastest = (1.0 - _SLIP) / (1.0 + doubt) - 1.0, (1.0 + _SLIP) / (1.0 - doubt) - 1.0
    high = max(_highest(each, known, settings) for each in patterns)
    others = [each for orders in settings.neighbours for each in fault_patterns(orders)]
    highest = max(_highest(each, _FOREIGN, settings) for each in (*patterns, *others))
    wide = order_spectrum(tracked, settings.samples_per_revolution, highest, settings.background_width)
    beside = _beside_shaft(without_shaft_lines(wide), settings)
    strongest = line_at(beside, 0.5 * (low + high), 0.5 * (high - low))
    inside = ((-known, known),)
    outside = tuple(each for each in ((slowest, -known), (known, fastest)) if each[0] < each[1])
    lay = partial(_lay, spectrum=beside, shaft_frequency=shaft_frequency, rate=rate, settings=settings)
    neighbours = tuple(lay(each, inside, settings.speed_uncertainty) for each in others)
    return FaultLines(
        spectrum=_up_to(wide, high),
        candidates=tuple(lay(each, inside, settings.speed_uncertainty, with_rival=True) for each in patterns),
        strongest_order=strongest[0],
        strongest_level=strongest[1],
        elsewhere=tuple(lay(each, outside, settings.speed_doubt) for each in patterns) if outside else (),
        neighbours=neighbours,
        combs=_combs(beside, neighbours, settings),
    )


def lay_patterns(
    tracked: Float,
    patterns: Sequence[Pattern],
    shaft_frequency: float,
    settings: MonitorSettings,
    *,
    without: Candidate | None = None,
) -> FaultLines:
    """Score patterns of any bearings in power over the angle of the shaft, as `comb_score` those of one.

    The bare combs are those of any order, whatever explains them. Lines that a candidate explains can be
    taken out.
    """
    known = settings.tolerance + settings.speed_uncertainty
    highest = max(_highest(each, _FOREIGN, settings) for each in patterns)
    wide = order_spectrum(tracked, settings.samples_per_revolution, highest, settings.background_width)
    beside = _beside_shaft(without_shaft_lines(wide), settings)
    if without is not None:
        beside = _taken_out(beside, without.explains(beside.order, beside.resolution))
    rate = settings.false_alarm_rate / len(patterns)
    lay = partial(_lay, spectrum=beside, shaft_frequency=shaft_frequency, rate=rate, settings=settings)
    laid = tuple(lay(each, ((-known, known),), settings.speed_uncertainty, hasty=True) for each in patterns)
    return FaultLines(
        spectrum=wide,
        candidates=laid,
        strongest_order=np.nan,
        strongest_level=np.nan,
        combs=_combs(beside, (), settings),
    )


def _highest(pattern: Pattern, tolerance: float, settings: MonitorSettings) -> float:
    """Compute the last order that lines of a pattern may have."""
    return pattern.order * settings.harmonics * (1.0 + tolerance) + pattern.explained * pattern.sideband


def _up_to(spectrum: OrderSpectrum, highest: float) -> OrderSpectrum:
    """Cut a spectrum off above an order."""
    last = int(np.searchsorted(spectrum.order, highest, side="right"))
    return replace(
        spectrum,
        order=spectrum.order[:last],
        amplitude=spectrum.amplitude[:last],
        level=spectrum.level[:last],
    )


def _combs(
    spectrum: OrderSpectrum, neighbours: tuple[Candidate, ...], settings: MonitorSettings
) -> tuple[Candidate, ...]:
    """Find the strongest comb that no neighbour explains, and those of which it may be a multiple."""
    known = np.zeros(len(spectrum.order), dtype=bool)
    for each in neighbours:
        if each.evidence > -np.log(settings.false_alarm_rate):
            known |= each.explains(spectrum.order, spectrum.resolution)
    best = strongest_rival(spectrum, over_noise(spectrum), known, settings.harmonics)
    if not best.own > -np.log(settings.false_alarm_rate):
        return ()
    return tuple(
        Candidate(
            pattern=Pattern(COMB, "order", best.order / part, 0.0, "", 0, 1),
            order=best.order / part,
            score=0.0,
            threshold=np.inf,
            evidence=best.own,
            rival=Rival(),
            lines=(),
        )
        for part in _PARTS_OF_A_COMB
        if part == 1 or (best.order / part >= LOWEST_COMB and abs(best.order / part - 2.0) > _OF_SHAFT)
    )


def over_noise(spectrum: OrderSpectrum) -> Float:
    """Compute the power of every line over the mean of noise, shape [line]."""
    return np.asarray(_MEDIAN_OVER_MEAN * 10.0 ** (0.1 * spectrum.level), np.float64)


def _lay(
    pattern: Pattern,
    ranges: tuple[tuple[float, float], ...],
    speed_error: float,
    spectrum: OrderSpectrum,
    shaft_frequency: float,
    rate: float,
    settings: MonitorSettings,
    *,
    with_rival: bool = False,
    hasty: bool = False,
) -> Candidate:
    """Slide the pattern over ranges about its order, keep the best place and list its lines.

    Sidebands are multiples of the shaft or the cage; where the speed is in error [-] they may shift with it.
    Of many patterns, in haste, those below their threshold are not looked at any further.
    """
    harmonics, resolution = settings.harmonics, spectrum.resolution
    places = np.array(pattern.lines(harmonics))
    step = 0.25 * resolution / harmonics
    deviation = np.concatenate([np.arange(low, high, step / pattern.order) for low, high in ranges])
    trial = pattern.order * (1.0 + deviation)
    power = over_noise(spectrum)
    scales = [np.zeros(len(trial))]
    if speed_error > 0.0 and pattern.sidebands:
        scales.append(np.clip(deviation, -speed_error, speed_error))
    sums = []
    for scale in scales:
        sideband = pattern.sideband * (1.0 + scale)
        wanted = trial[:, None] * places[:, 0] + sideband[:, None] * places[:, 1]
        index = np.rint(wanted / spectrum.order[1]).astype(int)
        laid = power[np.minimum(index, len(power) - 1)]
        sums.append(laid.sum(axis=1) - laid.max(axis=1))
    summed = np.array(sums)
    which, best = np.unravel_index(int(np.argmax(summed)), summed.shape)
    order, total = float(trial[best]), float(summed[which, best])
    fitted = replace(pattern, sideband=float(pattern.sideband * (1.0 + scales[which][best])))
    count = len(places)
    width = pattern.order * len(scales) * sum(high - low for low, high in ranges)
    independent = max(1.0, PLACES_PER_RESOLUTION * width * harmonics / resolution)
    sure = evidence(total, count, independent * len(FAULTS))
    score = float(10.0 * np.log10(max(1.0, total / (count - 1))))
    threshold = score_threshold(count, round(independent, 1), rate)
    if hasty and score < threshold:
        return Candidate(fitted, order, score, threshold, sure, Rival(), ())
    weigh = partial(evidence_at, power, spectrum, independent)
    alone, otherwise = sure, -np.inf
    if pattern.sidebands:
        alone = weigh(order * np.arange(1.0, harmonics + 1.0))
        rivals = [(order, pattern.other_sideband)] if pattern.other_sideband else []
        rivals += [(order + side * fitted.sideband, fitted.sideband) for side in (-1.0, 1.0)]
        otherwise = max(weigh(each * places[:, 0] + side * places[:, 1]) for each, side in rivals)
    known = mark_explained(
        spectrum.order, order / pattern.divided, fitted.sideband, pattern.explained, resolution
    )
    return Candidate(
        pattern=fitted,
        order=order,
        score=score,
        threshold=threshold,
        evidence=sure,
        alone=alone,
        odd=weigh(order * np.array(ODD)),
        otherwise=otherwise,
        rival=strongest_rival(spectrum, power, known, harmonics) if sure > 0.0 and with_rival else Rival(),
        lines=lines_of(fitted, order, pattern, spectrum, shaft_frequency, harmonics),
    )


def lines_of(
    fitted: Pattern,
    order: float,
    nominal: Pattern,
    spectrum: OrderSpectrum,
    shaft_frequency: float,
    harmonics: int,
) -> tuple[Line, ...]:
    """List the lines of a pattern, at the place where it fits, that stand out one by one."""
    lines = []
    for h, k in fitted.lines(harmonics):
        where = h * order + k * fitted.sideband
        found, level = line_at(spectrum, where, float(reach(np.asarray(where), spectrum.resolution)))
        expected = h * nominal.order + k * nominal.sideband
        lines.append(Line(_name(fitted, h, k), found, expected, found * shaft_frequency, level))
    return tuple(line for line in lines if line.level >= LINE_LEVEL)


def _beside_shaft(spectrum: OrderSpectrum, settings: MonitorSettings) -> OrderSpectrum:
    """Remove the lines of the shaft near whole orders, where they lie at a speed that is a little off."""
    chance = -np.log(settings.false_alarm_rate)
    for _ in range(_MOST_SHAFTS):
        nothing = np.zeros(len(spectrum.order), dtype=bool)
        power = over_noise(spectrum)
        best = strongest_rival(spectrum, power, nothing, settings.harmonics)
        if not best.evidence > chance:
            break
        turns = shaft_of(best.order, spectrum, power, settings.speed_doubt, chance)
        if np.isnan(turns):
            break
        spectrum = _without(spectrum, turns)
    return spectrum


def evidence_at(power: Float, spectrum: OrderSpectrum, independent: float, orders: Float) -> float:
    """Compute the evidence of lines at some orders, found within one of several independent places."""
    index = np.minimum(np.rint(orders / spectrum.order[1]).astype(int), len(power) - 1)
    laid = power[index]
    return evidence(float(laid.sum() - laid.max()), len(laid), independent * len(FAULTS))


def without_shaft_lines(spectrum: OrderSpectrum) -> OrderSpectrum:
    """Remove the whole orders from a spectrum, where a wheel of varying strikes leaves a residue."""
    return _without(spectrum, 1.0)


def _without(spectrum: OrderSpectrum, turns: float) -> OrderSpectrum:
    """Remove the multiples of an order from a spectrum."""
    away = np.abs(spectrum.order - turns * np.round(spectrum.order / turns))
    return _taken_out(spectrum, away <= SHAFT_REACH * spectrum.resolution)


def _taken_out(spectrum: OrderSpectrum, lines: Bool) -> OrderSpectrum:
    return replace(
        spectrum,
        level=np.where(lines, _NOTHING, spectrum.level),
        amplitude=np.where(lines, 0.0, spectrum.amplitude),
    )


def _name(pattern: Pattern, harmonic: int, side: int) -> str:
    if not harmonic:
        return pattern.sideband_symbol if side == 1 else f"{side} x {pattern.sideband_symbol}"
    carrier = pattern.symbol if harmonic == 1 else f"{harmonic} x {pattern.symbol}"
    return f"{carrier} {'-' if side < 0 else '+'} {pattern.sideband_symbol}" if side else carrier

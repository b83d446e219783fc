"""Fault-line scoring: power on the lines of each fault, compared with that of noise.

The threshold follows from a stated false-alarm rate. In stationary noise the squared envelope has a smooth
spectrum whose lines are independent and, over their local mean, exponentially distributed. The score of a
fault adds the L lines of its pattern but the strongest: one line alone, from whatever source, proves nothing.
By Renyi's representation that is a sum of L - 1 exponentials with means (L - i) / (L - i + 1), whose tail is
known. It is sought over the tolerance of the fault frequency and for three faults, so the rate is shared
among all independent places.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.chain.inputs import MonitorSettings
from beardyn_core.observe.chain.rivals import Rival, explained, reach, strongest_rival
from beardyn_core.observe.chain.surprise import PLACES_PER_RESOLUTION, evidence, threshold
from beardyn_core.observe.features import OrderSpectrum, line_at, order_spectrum

FAULTS = ("cup", "cone", "roller")
LINE_LEVEL = 9.0  # over the median background, from which a single line is listed, [dB]
# of the search for the strongest line, in multiples of the roller count: above the cage's own orders
_LOWEST_ORDER = 0.3
_NOTHING = -300.0  # [dB]
_MEDIAN_OVER_MEAN = np.log(2.0)  # of an exponential distribution


@dataclass(frozen=True)
class Line:
    """A line that was looked for and found in the envelope order spectrum."""

    name: A[str, "such as ``2 x BPFO`` or ``BPFI - shaft``"]
    order: A[float, "found, cycles per shaft revolution, [-]"]
    expected_order: A[float, "from geometry, [-]"]
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

    def lines(self, harmonics: int) -> list[tuple[int, int]]:
        """List harmonic and sideband number of each line."""
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
    sharpest: A[float, "the same in the octave where it is most, 0 when not measured, [-]"] = 0.0

    def places(self, harmonics: int) -> Float:
        """Compute where its lines are, shape [line], [-]."""
        return np.array(
            [h * self.order + k * self.pattern.sideband for h, k in self.pattern.lines(harmonics)]
        )


@dataclass(frozen=True)
class FaultLines:
    """Lines of faults in a spectrum, with their scores."""

    spectrum: OrderSpectrum
    candidates: A[tuple[Candidate, ...], "one for each of `FAULTS`"]
    strongest_order: A[float, "of the strongest line in the band of the fault lines, no whole order, [-]"]
    strongest_level: A[float, "of that line, [dB]"]
    deepest: A[float, "strongest line as measured over the mean power, [-]"] = 0.0


def fault_patterns(orders: FaultFrequencies) -> tuple[Pattern, ...]:
    """List the patterns of cup, cone and roller faults.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 2 (signatures).
    """
    return (
        Pattern("cup", "BPFO", orders.bpfo, 1.0, "shaft", 0, 1),
        Pattern("cone", "BPFI", orders.bpfi, 1.0, "shaft", 1, 4),
        Pattern("roller", "2 BSF", 2.0 * orders.bsf, orders.ftf, "FTF", 1, 4, 2),
    )


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
        Of one row, per shaft revolution, from geometry.
    shaft_frequency : float
        [Hz].
    """
    patterns = fault_patterns(orders)
    rate = settings.false_alarm_rate / len(patterns)
    low = _LOWEST_ORDER * roller_count
    high = max(
        p.order * settings.harmonics * (1.0 + settings.tolerance) + p.explained * p.sideband for p in patterns
    )
    spectrum = order_spectrum(tracked, settings.samples_per_revolution, high, settings.background_width)
    beside = _beside_wheel(spectrum)
    strongest = line_at(beside, 0.5 * (low + high), 0.5 * (high - low))
    return FaultLines(
        spectrum=spectrum,
        candidates=tuple(_lay(pattern, beside, shaft_frequency, rate, settings) for pattern in patterns),
        strongest_order=strongest[0],
        strongest_level=strongest[1],
    )


def _lay(
    pattern: Pattern, spectrum: OrderSpectrum, shaft_frequency: float, rate: float, settings: MonitorSettings
) -> Candidate:
    """Slide the pattern over the tolerance, keep the best place and list its lines."""
    harmonics, resolution = settings.harmonics, spectrum.resolution
    places = np.array(pattern.lines(harmonics))
    half = settings.tolerance * pattern.order
    trial = np.arange(pattern.order - half, pattern.order + half, 0.25 * resolution / harmonics)
    wanted = trial[:, None] * places[:, 0] + pattern.sideband * places[:, 1]
    index = np.rint(wanted / spectrum.order[1]).astype(int)
    power = _MEDIAN_OVER_MEAN * 10.0 ** (0.1 * spectrum.level)
    laid = power[np.minimum(index, len(power) - 1)]
    summed = laid.sum(axis=1) - laid.max(axis=1)
    best = int(np.argmax(summed))
    order = float(trial[best])
    count = len(places)
    independent = max(1.0, PLACES_PER_RESOLUTION * 2.0 * half * harmonics / resolution)
    sure = evidence(float(summed[best]), count, independent * len(FAULTS))
    known = explained(
        spectrum.order, order / pattern.divided, pattern.sideband, pattern.explained, resolution
    )
    lines = []
    for h, k in places.tolist():
        where = h * order + k * pattern.sideband
        found, level = line_at(spectrum, where, float(reach(where, resolution)))
        expected = h * pattern.order + k * pattern.sideband
        lines.append(Line(_name(pattern, h, k), found, expected, found * shaft_frequency, level))
    return Candidate(
        pattern=pattern,
        order=order,
        score=float(10.0 * np.log10(max(1.0, summed[best] / (count - 1)))),
        threshold=threshold(count, round(independent, 1), rate),
        evidence=sure,
        rival=strongest_rival(spectrum, power, known, harmonics) if sure > 0.0 else Rival(),
        lines=tuple(line for line in lines if line.level >= LINE_LEVEL),
    )


def _beside_wheel(spectrum: OrderSpectrum) -> OrderSpectrum:
    """Remove the whole orders from a spectrum, where a wheel of varying strikes leaves a residue."""
    whole = np.abs(spectrum.order - np.round(spectrum.order)) <= 2.0 * spectrum.resolution
    return replace(
        spectrum,
        level=np.where(whole, _NOTHING, spectrum.level),
        amplitude=np.where(whole, 0.0, spectrum.amplitude),
    )


def _name(pattern: Pattern, harmonic: int, side: int) -> str:
    carrier = pattern.symbol if harmonic == 1 else f"{harmonic} x {pattern.symbol}"
    return f"{carrier} {'-' if side < 0 else '+'} {pattern.sideband_symbol}" if side else carrier

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
from functools import cache
from math import exp, log, pi, sqrt
from typing import Annotated as A

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtr  # scipy.stats takes long to import

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.chain.inputs import MonitorSettings
from beardyn_core.observe.features import OrderSpectrum, line_at, order_spectrum

FAULTS = ("cup", "cone", "roller")
LINE_LEVEL = 9.0  # over the median background, from which a single line is listed, [dB]
# of the search for the strongest line, in multiples of the roller count: above the cage's own orders
_LOWEST_ORDER = 0.3
# lines a resolution apart are correlated by the window, and peaks lie between them
_PLACES_PER_RESOLUTION = 3.0
_NOTHING = -300.0  # [dB]
_LARGEST_TOTAL = 300.0  # passed by noise once in e^300 places
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
    strongest: A[float, "level of its strongest line, [dB]"]
    burst: A[float, "root of the mean power that comes and goes on a line, the strongest left out, [m/s^2]"]
    lines: A[tuple[Line, ...], "those that stand out one by one"]


@dataclass(frozen=True)
class FaultLines:
    """Lines of faults in a spectrum, with their scores."""

    spectrum: OrderSpectrum
    candidates: A[tuple[Candidate, ...], "one for each of `FAULTS`"]
    strongest_order: A[float, "of the strongest line in the band of the fault lines, no whole order, [-]"]
    strongest_level: A[float, "of that line, [dB]"]
    chance_level: A[float, "level that the strongest line of noise passes with the stated rate, [dB]"]
    power: A[float, "mean squared envelope beside strikes of the wheel, NaN when unknown, [m^2/s^4]"] = np.nan


def fault_patterns(orders: FaultFrequencies) -> tuple[Pattern, ...]:
    """List the patterns of cup, cone and roller faults.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 2 (signatures).
    """
    return (
        Pattern("cup", "BPFO", orders.bpfo, 1.0, "shaft", 0, 0),
        Pattern("cone", "BPFI", orders.bpfi, 1.0, "shaft", 1, 4),
        Pattern("roller", "2 BSF", 2.0 * orders.bsf, orders.ftf, "FTF", 1, 4),
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
    places = _PLACES_PER_RESOLUTION * (high - low) / spectrum.resolution
    return FaultLines(
        spectrum=spectrum,
        candidates=tuple(_lay(pattern, beside, shaft_frequency, rate, settings) for pattern in patterns),
        strongest_order=strongest[0],
        strongest_level=strongest[1],
        chance_level=_level(np.log(places / settings.false_alarm_rate)),
    )


@cache
def threshold(lines: int, places: float, rate: float) -> float:
    """Compute the score that noise exceeds somewhere at the false-alarm rate.

    Parameters
    ----------
    lines : int
        Of the pattern, L.
    places : float
        Independent places where the pattern is sought.
    rate : float
        [-].

    Returns
    -------
    float
        [dB].
    """
    wanted = min(log(rate / places), log(trimmed_tail(lines, lines)))
    total = brentq(lambda total: log(trimmed_tail(total, lines)) - wanted, lines, lines + _LARGEST_TOTAL)
    return float(10.0 * np.log10(total / (lines - 1)))


def trimmed_tail(total: float, lines: int) -> float:
    """Compute the probability that L exponentials of mean 1, less the largest, sum to more than a total.

    The total is beyond the mean of the sum.

    References
    ----------
    Renyi (1953), On the theory of order statistics, Acta Math. Acad. Sci. Hung. 4: the representation.
    Lugannani, Rice (1980), Saddle point approximation for the distribution of the sum of independent
    random variables, Adv. Appl. Prob. 12: the tail.
    """
    means = 1.0 - 1.0 / np.arange(2.0, lines + 1.0)
    saddle = float(
        brentq(lambda t: np.sum(means / (1.0 - t * means)) - total, 1e-9, (1.0 - 1e-9) / means.max())
    )
    cumulant = -float(np.sum(np.log1p(-saddle * means)))
    signed = sqrt(2.0 * (saddle * total - cumulant))
    scaled = saddle * sqrt(float(np.sum((means / (1.0 - saddle * means)) ** 2)))
    density = exp(-0.5 * signed**2) / sqrt(2.0 * pi)
    return float(ndtr(-signed) + density * (1.0 / scaled - 1.0 / signed))


def reach(order: float, resolution: float) -> float:
    """Compute how far a line may lie from its place in a pattern, by resolution and slow cage slip."""
    return min(resolution + 0.003 * order, 0.25)


def explains(candidate: Candidate, order: float, resolution: float) -> bool:
    """Check whether a line belongs to the pattern with its sidebands."""
    pattern = candidate.pattern
    for k in range(-pattern.explained, pattern.explained + 1):
        carrier = order - k * pattern.sideband
        h = max(1, round(carrier / candidate.order))
        if abs(carrier - h * candidate.order) <= reach(order, resolution):
            return True
    return False


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
    power = _MEDIAN_OVER_MEAN * 10.0 ** (0.1 * spectrum.level[np.minimum(index, len(spectrum.level) - 1)])
    summed = power.sum(axis=1) - power.max(axis=1)
    best = int(np.argmax(summed))
    order = float(trial[best])
    count = len(places)
    squares = np.sort(spectrum.amplitude[np.minimum(index[best], len(spectrum.level) - 1)])[:-1] ** 2
    independent = max(1.0, _PLACES_PER_RESOLUTION * 2.0 * half * harmonics / resolution)
    lines = []
    for h, k in places.tolist():
        where = h * order + k * pattern.sideband
        found, level = line_at(spectrum, where, reach(where, resolution))
        expected = h * pattern.order + k * pattern.sideband
        lines.append(Line(_name(pattern, h, k), found, expected, found * shaft_frequency, level))
    return Candidate(
        pattern=pattern,
        order=order,
        score=float(10.0 * np.log10(max(1.0, summed[best] / (count - 1)))),
        threshold=threshold(count, round(independent, 1), rate),
        strongest=max(line.level for line in lines),
        burst=float(np.mean(squares) ** 0.25),
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


def _level(power_over_mean: float) -> float:
    """Convert a power over the mean background to a level over the median background, [dB]."""
    return float(10.0 * np.log10(power_over_mean / _MEDIAN_OVER_MEAN))

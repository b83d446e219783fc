"""The example of a monitoring algorithm: envelope order spectrum and kinematic line search.

`analyse` is a pure function of one stretch of signal; `observe.monitoring` feeds it from streams and
takes any other function with the same arguments in its place.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.features import (
    OrderSpectrum,
    analytic_band,
    kurtosis,
    line_at,
    order_spectrum,
    resample_by_angle,
)

Float = NDArray[np.float64]

VERDICTS = ("waiting", "healthy", "cup", "cone", "roller")
FAULTS = ("cup", "cone", "roller")


@dataclass(frozen=True)
class MonitorSettings:
    """What can be tuned about `analyse` and `Monitor`.

    Parameters
    ----------
    band : tuple of 2 floats
        Of the band-pass before the envelope, [Hz].
    window_revolutions : float
        Shaft revolutions in one analysis; 60 are some 25 of the cage, [-].
    least_revolutions : float
        Shaft revolutions before the first verdict, [-].
    longest_window : float
        The window at slow speed, [s].
    interval : float
        Time between two analyses, [s].
    samples_per_revolution : int
        Angular grid of the order tracking.
    lowest_order, highest_order : float
        Band in which the strongest line is sought, in multiples of the roller count, [-].
    background_width : float
        Width of the neighbourhood whose median is the background, [shaft orders].
    tolerance : float
        Of a fault frequency against geometry, [-].
    harmonics : int
        How many harmonics, the fundamental included, are looked at.
    line_threshold : float
        Level over the background from which a line counts as found, [dB].
    alarm_threshold : float
        Score from which a fault is called, [dB].
    """

    band: tuple[float, float] = (2000.0, 10_000.0)
    window_revolutions: float = 60.0
    least_revolutions: float = 15.0
    longest_window: float = 20.0
    interval: float = 0.5
    samples_per_revolution: int = 1024
    lowest_order: float = 0.3
    highest_order: float = 12.0
    background_width: float = 3.0
    tolerance: float = 0.01
    harmonics: int = 5
    line_threshold: float = 9.0
    alarm_threshold: float = 11.0


@dataclass(frozen=True)
class Line:
    """A line that was looked for and found in the envelope order spectrum.

    Parameters
    ----------
    name : str
        Such as ``2 BPFO`` or ``BPFI - shaft``.
    order, expected_order : float
        Cycles per shaft revolution, found and from geometry, [-].
    frequency : float
        At the mean shaft speed, [Hz].
    level : float
        Over the background, [dB].
    """

    name: str
    order: float
    expected_order: float
    frequency: float
    level: float


@dataclass(frozen=True)
class Stretch:
    """A stretch of signal to analyse.

    Parameters
    ----------
    rate : float
        [Hz].
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    shaft_angle : float64 array, shape [sample]
        Increasing, [rad].
    load : float
        Mean vertical load, NaN when unknown, [N].
    end_ns : int
        Time of the last sample, [ns].
    """

    rate: float
    acceleration: Float
    shaft_angle: Float
    load: float
    end_ns: int


@dataclass(frozen=True)
class MonitorResult:
    """What the monitor says at one time.

    Parameters
    ----------
    verdict : str
        ``waiting`` (not enough signal yet), ``healthy``, ``cup``, ``cone`` or ``roller``.
    reason : str
        The verdict in a sentence.
    end_ns : int
        Simulated time of the last sample analysed, [ns].
    fault_order, fault_frequency : float
        Found, NaN without a fault, per shaft revolution and [Hz].
    expected_order, expected_frequency : float
        Of that fault from geometry, [-], [Hz].
    score : float
        Of the strongest candidate: mean level of its fundamental and its two best harmonics, [dB].
    scores : tuple of 3 floats
        For each of `FAULTS`, [dB].
    lines : tuple of Line
        Lines of the strongest candidate over the line threshold.
    strongest_order, strongest_level : float
        Strongest line between 0.3 and 12 times the roller count, [-], [dB].
    rms : float
        Of the band-passed signal, all axes, [m/s^2].
    kurtosis : float
        Of the band-passed signal, the largest of the axes, [-].
    shaft_frequency : float
        Mean, [Hz].
    revolutions : float
        Shaft revolutions analysed, [-].
    load : float
        Mean vertical load, [N].
    spectrum : OrderSpectrum or None
        Of the envelope.
    """

    verdict: str
    reason: str
    end_ns: int
    fault_order: float = np.nan
    fault_frequency: float = np.nan
    expected_order: float = np.nan
    expected_frequency: float = np.nan
    score: float = 0.0
    scores: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lines: tuple[Line, ...] = ()
    strongest_order: float = np.nan
    strongest_level: float = np.nan
    rms: float = np.nan
    kurtosis: float = np.nan
    shaft_frequency: float = np.nan
    revolutions: float = 0.0
    load: float = np.nan
    spectrum: OrderSpectrum | None = None


@dataclass(frozen=True)
class _Pattern:
    """Where a fault puts its lines: harmonics of one order, with sidebands."""

    fault: str
    symbol: str
    order: float
    sideband: float
    sideband_symbol: str
    sideband_count: int


@dataclass(frozen=True)
class _Candidate:
    """A pattern laid over a spectrum."""

    pattern: _Pattern
    order: float
    score: float
    lines: tuple[Line, ...]
    found: bool


def analyse(
    stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
) -> MonitorResult:
    """Find cup, cone and roller faults in one stretch of vibration.

    Band-pass, envelope over all axes, order tracking, spectrum. A fault is called when its fundamental
    and a harmonic stand out of the background within the tolerance, its score passes the
    threshold, and the strongest line of the spectrum is one of its lines.

    Parameters
    ----------
    stretch : Stretch
    orders : FaultFrequencies
        Of one row, per shaft revolution, from geometry.
    roller_count : int
        Rollers of one row.
    settings : MonitorSettings

    Returns
    -------
    MonitorResult

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, sections 2 (signatures) and 4 (envelope analysis).
    """
    revolutions = float(stretch.shaft_angle[-1] - stretch.shaft_angle[0]) / (2.0 * np.pi)
    duration = (len(stretch.shaft_angle) - 1) / stretch.rate
    shaft_frequency = revolutions / duration
    analytic = analytic_band(stretch.acceleration, stretch.rate, settings.band)
    envelope = np.sqrt(np.sum(analytic.real**2 + analytic.imag**2, axis=1))
    tracked = resample_by_angle(envelope, stretch.shaft_angle, settings.samples_per_revolution)
    spectrum = order_spectrum(
        tracked,
        settings.samples_per_revolution,
        settings.highest_order * roller_count,
        settings.background_width,
    )
    strongest_order, strongest_level = strongest_line(spectrum, roller_count, settings)
    patterns = (
        _Pattern("cup", "BPFO", orders.bpfo, 1.0, "shaft", 0),
        _Pattern("cone", "BPFI", orders.bpfi, 1.0, "shaft", 2),
        _Pattern("roller", "2 BSF", 2.0 * orders.bsf, orders.ftf, "FTF", 2),
    )
    candidates = [_lay(pattern, spectrum, shaft_frequency, settings) for pattern in patterns]
    scores = [candidate.score for candidate in candidates]
    called = [
        candidate
        for candidate in candidates
        if candidate.found
        and candidate.score >= settings.alarm_threshold
        and _explains(candidate, strongest_order, spectrum.resolution)
    ]
    best = max(called or candidates, key=lambda candidate: candidate.score)
    verdict = best.pattern.fault if called else "healthy"
    return MonitorResult(
        verdict=verdict,
        reason=_sentence(best, bool(called), shaft_frequency, settings),
        end_ns=stretch.end_ns,
        fault_order=best.order if called else np.nan,
        fault_frequency=best.order * shaft_frequency if called else np.nan,
        expected_order=best.pattern.order if called else np.nan,
        expected_frequency=best.pattern.order * shaft_frequency if called else np.nan,
        score=best.score,
        scores=(scores[0], scores[1], scores[2]),
        lines=best.lines,
        strongest_order=strongest_order,
        strongest_level=strongest_level,
        rms=float(np.sqrt(np.mean(np.sum(analytic.real**2, axis=1)))),
        kurtosis=max(kurtosis(axis) for axis in analytic.real.T),
        shaft_frequency=shaft_frequency,
        revolutions=revolutions,
        load=stretch.load,
        spectrum=spectrum,
    )


def strongest_line(
    spectrum: OrderSpectrum, roller_count: int, settings: MonitorSettings
) -> tuple[float, float]:
    """Order and level over the background of the strongest line in the band of the fault lines."""
    low, high = settings.lowest_order * roller_count, settings.highest_order * roller_count
    return line_at(spectrum, 0.5 * (low + high), 0.5 * (high - low))


def _lay(
    pattern: _Pattern, spectrum: OrderSpectrum, shaft_frequency: float, settings: MonitorSettings
) -> _Candidate:
    """Find the fundamental and what lies on its harmonics and sidebands."""

    def line(name: str, order: float, level: float, expected: float) -> Line:
        return Line(name, order, expected, order * shaft_frequency, level)

    order, level = line_at(spectrum, pattern.order, settings.tolerance * pattern.order)
    fundamental = line(pattern.symbol, order, level, pattern.order)
    harmonics = []
    for h in range(2, settings.harmonics + 1):
        where = h * order
        allowed = min(_reach(where, spectrum.resolution), settings.tolerance * where)
        harmonics.append(
            line(f"{h} x {pattern.symbol}", *line_at(spectrum, where, allowed), h * pattern.order)
        )
    sidebands = []
    for k in (-1, 1) if pattern.sideband_count else ():
        where = order + k * pattern.sideband
        name = f"{pattern.symbol} {'-' if k < 0 else '+'} {pattern.sideband_symbol}"
        reach = _reach(where, spectrum.resolution)
        sidebands.append(line(name, *line_at(spectrum, where, reach), pattern.order + k * pattern.sideband))
    best = sorted((max(0.0, other.level) for other in harmonics), reverse=True)[:2]
    score = (max(0.0, level) + sum(best)) / (1 + len(best))
    threshold = settings.line_threshold
    return _Candidate(
        pattern=pattern,
        order=order,
        score=score,
        lines=tuple(other for other in (fundamental, *harmonics, *sidebands) if other.level >= threshold),
        found=level >= threshold and max(other.level for other in harmonics) >= threshold,
    )


def _reach(order: float, resolution: float) -> float:
    """How far from its place a line of a found pattern may lie: resolution and slow cage slip."""
    return min(resolution + 0.003 * order, 0.25)


def _explains(candidate: _Candidate, order: float, resolution: float) -> bool:
    """Whether a line belongs to the pattern with its sidebands."""
    pattern = candidate.pattern
    for k in range(-pattern.sideband_count, pattern.sideband_count + 1):
        carrier = order - k * pattern.sideband
        h = max(1, round(carrier / candidate.order))
        if abs(carrier - h * candidate.order) <= _reach(order, resolution):
            return True
    return False


def _sentence(best: _Candidate, called: bool, shaft_frequency: float, settings: MonitorSettings) -> str:
    symbol = best.pattern.symbol
    if not called:
        return (
            f"no fault: {symbol} scores {best.score:.1f} dB, the alarm is at {settings.alarm_threshold:g} dB "
            f"with fundamental, a harmonic and the strongest line agreeing"
        )
    deviation = 100.0 * (best.order / best.pattern.order - 1.0)
    return (
        f"{best.pattern.fault} fault: {symbol} found at {best.order * shaft_frequency:.2f} Hz, "
        f"{best.pattern.order * shaft_frequency:.2f} Hz from geometry ({deviation:+.2f} %), "
        f"{_fundamental_level(best):.1f} dB over the background, score {best.score:.1f} dB"
    )


def _fundamental_level(candidate: _Candidate) -> float:
    """Level of the fundamental over the background; of the strongest line when it was not found, [dB]."""
    levels = [line.level for line in candidate.lines if line.expected_order == candidate.pattern.order]
    return levels[0] if levels else max((line.level for line in candidate.lines), default=float("nan"))

"""Results of a monitor: as a diagnostics message, and summed up over a whole run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, fields
from math import isfinite, nan

from beardyn_core.observe.chain import MonitorResult
from beardyn_core.record.messages import Diagnostic

WAITING, HEALTHY = "waiting", "healthy"
HOT_BOX = "hot_box"
FAULT_SYMBOLS = {"cup": "BPFO", "cone": "BPFI", "roller": "2 BSF"}


@dataclass(frozen=True)
class Finding:
    """One result of the monitor, without its spectrum.

    Parameters
    ----------
    verdict : str
        ``waiting``, ``healthy``, ``cup``, ``cone``, ``roller`` or ``hot_box``.
    reason : str
        The verdict in a sentence.
    time : float
        Simulated time of the last sample analysed, [s].
    found_frequency, expected_frequency : float
        Line found and the same from geometry; NaN without a fault, [Hz].
    found_order, expected_order : float
        Per shaft revolution, [-].
    signal_to_background : float
        Of the fundamental line; without a fault of the strongest line, [dB].
    score : float
        What the alarm threshold is compared with, [dB].
    shaft_frequency : float
        [Hz].
    load : float
        Mean vertical load, [N].
    rms, kurtosis, crest : float
        Of the band-passed vibration, [m/s^2], [-], [-].
    threshold : float
        Score from which a fault is called, [dB].
    band_low, band_high : float
        Of the envelope, [Hz].
    rms_rise : float
        Over earlier results at a like speed, [dB].
    temperature : float
        Of the axlebox, [K].
    """

    verdict: str
    reason: str
    time: float
    found_frequency: float = nan
    expected_frequency: float = nan
    found_order: float = nan
    expected_order: float = nan
    signal_to_background: float = nan
    score: float = 0.0
    shaft_frequency: float = nan
    load: float = nan
    rms: float = nan
    kurtosis: float = nan
    crest: float = nan
    threshold: float = nan
    band_low: float = nan
    band_high: float = nan
    rms_rise: float = nan
    temperature: float = nan

    @classmethod
    def of(cls, result: MonitorResult) -> Finding:
        """Make the finding of a monitor's result."""
        fundamental = [line.level for line in result.lines if line.expected_order == result.expected_order]
        return cls(
            verdict=result.verdict,
            reason=result.reason,
            time=result.end_ns * 1e-9,
            found_frequency=result.fault_frequency,
            expected_frequency=result.expected_frequency,
            found_order=result.fault_order,
            expected_order=result.expected_order,
            signal_to_background=fundamental[0] if fundamental else result.strongest_level,
            score=result.score,
            shaft_frequency=result.shaft_frequency,
            load=result.load,
            rms=result.rms,
            kurtosis=result.kurtosis,
            crest=result.crest,
            threshold=result.threshold,
            band_low=result.band[0],
            band_high=result.band[1],
            rms_rise=result.rms_rise,
            temperature=result.temperature,
        )

    @property
    def is_fault(self) -> bool:
        """Whether a fault is called."""
        return self.verdict in FAULT_SYMBOLS

    @property
    def symbol(self) -> str:
        """``BPFO``, ``BPFI`` or ``2 BSF``; '' without a fault."""
        return FAULT_SYMBOLS.get(self.verdict, "")

    @property
    def deviation(self) -> float:
        """Frequency found against geometry, relative, [-]."""
        return self.found_order / self.expected_order - 1.0

    def to_diagnostic(self, name: str, extra: Sequence[tuple[str, str]] = ()) -> Diagnostic:
        """Write as a status of ``monitor/result``: a fault is a warning, a hot box an error."""
        values = [("verdict", self.verdict)]
        for member in fields(self)[2:]:
            number = float(getattr(self, member.name))
            values.append((member.name, f"{number:.9g}" if isfinite(number) else "nan"))
        level = 2 if self.verdict == HOT_BOX else int(self.is_fault)
        return Diagnostic(name, level, self.reason, (*values, *extra))

    @classmethod
    def from_diagnostic(cls, status: Diagnostic) -> Finding | None:
        """Read a finding from a status; ``None`` when the status is no finding."""
        verdict = status.value("verdict")
        if verdict is None:
            return None
        numbers = {member.name: float(status.value(member.name) or "nan") for member in fields(cls)[2:]}
        return cls(verdict, status.message, **numbers)


@dataclass(frozen=True)
class Conclusion:
    """Results of a monitor over a whole run, summed up.

    Parameters
    ----------
    finding : Finding or None
        Latest of the most frequent verdict; ``None`` when there never was enough signal.
    agreeing, analyses : int
        Results with that verdict, and results at all.
    """

    finding: Finding | None
    agreeing: int
    analyses: int

    @property
    def verdict(self) -> str:
        """Most frequent verdict; ``waiting`` without any."""
        return self.finding.verdict if self.finding else WAITING


def conclude(findings: Sequence[Finding]) -> Conclusion:
    """Find the most frequent verdict of a run; results before there was enough signal do not count."""
    judged = [finding for finding in findings if finding.verdict != WAITING]
    if not judged:
        return Conclusion(None, 0, 0)
    verdict, agreeing = Counter(finding.verdict for finding in judged).most_common(1)[0]
    latest = [finding for finding in judged if finding.verdict == verdict][-1]
    return Conclusion(latest, agreeing, len(judged))

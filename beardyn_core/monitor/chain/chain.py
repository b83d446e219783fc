"""The chain: six plain functions in the order of the data, each of which can be replaced."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.ambiguity import (
    CAGE,
    alike_parts,
    comes_with_the_cage,
    not_judged_sentence,
    parts_on_the_shaft,
    parts_without_order,
)
from beardyn_core.monitor.chain.cage_turns import score_with_turns
from beardyn_core.monitor.chain.confidence import confidence_of, grounds_of
from beardyn_core.monitor.chain.diagnosable import NOT_DIAGNOSABLE, doubt, live_axes, unmeasured
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.monitor.chain.fault_lines import FAULTS, FaultLines, fault_patterns
from beardyn_core.monitor.chain.impulsiveness import with_strikes
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import Band
from beardyn_core.monitor.chain.levels import levels_of, rise
from beardyn_core.monitor.chain.result import MonitorResult
from beardyn_core.monitor.chain.speed_drift import (
    LARGEST_LEVEL_CHANGE,
    Drift,
    level_change,
    level_fall,
    speed_drift,
)
from beardyn_core.monitor.chain.tracking import by_angle, logarithm_by_angle
from beardyn_core.monitor.chain.verdict import HEALTHY, UNEXPLAINED, Verdict, strongest_pattern
from beardyn_core.monitor.chain.whitening import by_cepstrum, whole_band
from beardyn_core.monitor.chain.whole_orders import fault_on_the_shaft, other_speeds

_NOTHING_LEFT = 60.0  # [dB]


def squared_envelope(stretch: Stretch, band: Band) -> Float:
    """Compute the squared envelope of the band, summed over the axes.

    Returns
    -------
    float64 array, shape [sample]
        [m^2/s^4].

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 4.3: the squared envelope has no harmonics of its own making.
    """
    return stretch.squared_envelope((band.low, band.high))


Algorithm = Callable[[Stretch, FaultFrequencies, int, MonitorSettings], MonitorResult]


@dataclass(frozen=True)
class Chain:
    """A monitoring algorithm in six steps; calling it analyses a stretch.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25: the same order of steps.
    """

    select_band: A[Callable[[Stretch, MonitorSettings], Band], "which frequencies are used"] = whole_band
    whiten: A[Callable[[Stretch, MonitorSettings], Stretch], "the same with a weight for every frequency"] = (
        by_cepstrum
    )
    envelope: A[Callable[[Stretch, Band], Float], "shape [sample], how loud it is there"] = squared_envelope
    track: A[
        Callable[[Float, Stretch, MonitorSettings], Float],
        "shape [step], how loud it is evenly over the angle of the shaft",
    ] = logarithm_by_angle
    score: A[
        Callable[[Float, FaultFrequencies, int, float, MonitorSettings], FaultLines],
        "how much of it is on the lines of each fault",
    ] = score_with_turns
    decide: A[Callable[[FaultLines, Stretch, MonitorSettings], Verdict], "what to call"] = strongest_pattern

    def __call__(
        self, stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
    ) -> MonitorResult:
        """Analyse one stretch of vibration.

        Parameters
        ----------
        orders : FaultFrequencies
            Of one row, per shaft revolution, from bearing data; NaN where one is not known, not all.
        roller_count : int
            Rollers of one row; 0 where that is not known.
        """
        speed = stretch.shaft_frequency
        unknown, hidden = parts_without_order(orders), parts_on_the_shaft(orders, stretch.revolutions)
        not_judged = (*unknown, *hidden)
        if why := unmeasured(stretch, settings):
            return MonitorResult(
                NOT_DIAGNOSABLE,
                why,
                stretch.end_ns,
                not_judged=not_judged,
                shaft_frequency=speed,
                revolutions=stretch.revolutions,
            )
        stretch, dead = live_axes(stretch)
        band = self.select_band(stretch, settings)
        power = self.envelope(self.whiten(stretch, settings), band)
        tracked = lined = self.track(power, stretch, settings)
        found = self.score(tracked, orders, roller_count, speed, settings)
        found = with_strikes(found, stretch, band, settings)
        verdict = self.decide(found, stretch, settings)
        if verdict.name not in (*FAULTS, UNEXPLAINED) and found.deepest >= settings.clockwork_depth:
            # what strikes like clockwork is a comb of tones, and whitening takes them away: where it is deep
            # it is read as measured
            measured = by_angle(stretch.squared_envelope((band.low, band.high)), stretch, settings)
            clockwork = self.score(measured, orders, roller_count, speed, settings)
            clockwork = with_strikes(clockwork, stretch, band, settings)
            never = (np.inf, np.inf, np.inf)
            deep = replace(
                settings, least_strikes=settings.clockwork_strikes, least_sharpest=never, faint_margin=np.inf
            )
            received = self.decide(clockwork, stretch, deep)
            if received.name in (*FAULTS, UNEXPLAINED):
                found, verdict, lined = clockwork, received, measured
        if verdict.name == HEALTHY and (why := doubt(stretch)):
            verdict = replace(verdict, name=NOT_DIAGNOSABLE, reason=f"{why}; {verdict.reason}")
        levels = levels_of(stretch.in_band(settings.band)[stretch.inner], speed)
        change = np.nan
        if verdict.name == HEALTHY and settings.speed_uncertainty > 0.0:
            drift = speed_drift(tracked, settings)
            change, level = drift.change, level_change(stretch, (band.low, band.high))
            verdict = _doubt_speed(verdict, drift, level, level_fall(levels, stretch.earlier))
        unsure = verdict.name == HEALTHY and settings.speed_uncertainty > 0.0
        if unsure and (why := self._on_the_shaft(power, band, stretch, orders, roller_count, settings)):
            verdict = replace(verdict, name=NOT_DIAGNOSABLE, reason=f"{why}; {verdict.reason}")
        grounds = grounds_of(found, verdict, lined, settings)
        score = {each.pattern.fault: each.score for each in found.candidates}
        not_judged = tuple(part for part in not_judged if part != verdict.name)  # sidebands may name it
        if not_judged and verdict.name not in FAULTS:
            verdict = replace(verdict, reason=f"{verdict.reason}; {not_judged_sentence(unknown, hidden)}")
        alike: tuple[str, ...] = ()
        if verdict.name in FAULTS and (alike := alike_parts(verdict.best, found.candidates)):
            others = " and ".join(PART_NAMES[part] for part in alike)
            verdict = replace(verdict, reason=f"{verdict.reason}; the {others} would have these lines, too")
        also = alike
        if verdict.name in FAULTS and comes_with_the_cage(verdict.best, settings):
            also = (*alike, CAGE)
            verdict = replace(verdict, reason=f"{verdict.reason}; a damaged cage would have these lines, too")
        sure = confidence_of(verdict.name, grounds) / (1 + len(alike))  # one is as likely as the other
        if verdict.name == HEALTHY and not_judged:
            sure = np.nan  # it says nothing of parts that were not judged
        best, called, comb = verdict.best, verdict.name in FAULTS, verdict.comb
        own = [each.speed for each in verdict.fits if not each.bearing]
        order, expected = best.stated(-np.log(settings.false_alarm_rate))
        if called:
            own = [speed * order / expected]
        return MonitorResult(
            verdict=verdict.name,
            reason=f"{verdict.reason}{f'; dead: axis {dead}' if dead else ''}",
            end_ns=stretch.end_ns,
            confidence=sure,
            grounds=grounds,
            fault_order=order if called else np.nan,
            fault_frequency=order * speed if called else np.nan,
            expected_order=expected if called else np.nan,
            expected_frequency=expected * speed if called else np.nan,
            fitting_shaft_frequency=own[0] if own else np.nan,
            comb_order=comb.order if comb else np.nan,
            comb_frequency=comb.order * speed if comb else np.nan,
            comb_strikes=max(comb.strikes, comb.sharpest) if comb else np.nan,
            fits=verdict.fits,
            score=best.score,
            threshold=best.threshold,
            scores=(score.get("cup", np.nan), score.get("cone", np.nan), score.get("roller", np.nan)),
            not_judged=not_judged,
            also_fits=also,
            lines=best.lines,
            strongest_order=found.strongest_order,
            strongest_level=found.strongest_level,
            band=(band.low, band.high),
            rms=levels.rms,
            kurtosis=levels.kurtosis,
            crest=levels.crest,
            rms_rise=rise(levels, stretch.earlier),
            shaft_frequency=speed,
            speed_change=change,
            revolutions=stretch.revolutions,
            load=stretch.load,
            temperature=stretch.temperature,
            temperature_state=verdict.temperature_state,
            spectrum=found.spectrum,
        )

    def _on_the_shaft(
        self,
        power: Float,
        band: Band,
        stretch: Stretch,
        orders: FaultFrequencies,
        roller_count: int,
        settings: MonitorSettings,
    ) -> str:
        """Say which fault may be among the lines of the shaft, at a speed a little off; empty without one."""
        patterns = fault_patterns(orders)
        for other in other_speeds(stretch, patterns, settings):
            tracked = self.track(power, other, settings)
            found = self.score(tracked, orders, roller_count, other.shaft_frequency, settings)
            there = self.decide(with_strikes(found, other, band, settings), other, settings)
            if why := fault_on_the_shaft(there, other, stretch, patterns, settings):
                return why
        return ""


def _doubt_speed(verdict: Verdict, drift: Drift, level: float, fall: float) -> Verdict:
    """Leave open what is healthy at a speed that is stated and not constant, by strikes or by levels [dB]."""
    if not np.isnan(drift.change):
        reason = (
            f"the speed is not constant: it changes by {100.0 * drift.change:+.0f} % within "
            f"{drift.revolutions:g} revolutions by the rate of strikes; give a tachometer or a speed channel"
        )
    elif max(level, fall) > LARGEST_LEVEL_CHANGE:
        where = "within the stretch" if level > LARGEST_LEVEL_CHANGE else "below that of earlier stretches"
        size = max(level, fall)
        change = f"{size:.0f} dB" if size < _NOTHING_LEFT else f"more than {_NOTHING_LEFT:g} dB"
        reason = (
            f"the level changes by {change} {where}, as where a train stops or starts, passes a bridge, or a "
            "signal fails: a constant speed does not fit; give a tachometer or a speed channel"
        )
    else:
        return verdict
    return replace(verdict, name=NOT_DIAGNOSABLE, reason=f"{reason}; {verdict.reason}")


REFERENCE = Chain()

"""The verdict: the fault that is reported, and the sentence that says why; the temperature rule."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan, log
from typing import Annotated as A

from beardyn_core.observe.chain.fault_lines import FAULTS, Candidate, FaultLines
from beardyn_core.observe.chain.inputs import MonitorSettings, Stretch

HEALTHY, HOT_BOX = "healthy", "hot_box"
UNKNOWN, NORMAL, WARM, HOT = "unknown", "normal", "warm", "hot"
_ZERO_CELSIUS = 273.15


@dataclass(frozen=True)
class Verdict:
    """Fault that is reported, with its reason."""

    name: A[str, "``healthy``, ``not_diagnosable``, ``cup``, ``cone``, ``roller`` or ``hot_box``"]
    reason: A[str, "in a sentence"]
    best: A[Candidate, "the strongest candidate, or the one that is called"]
    temperature_state: A[str, "``unknown``, ``normal``, ``warm`` or ``hot``"] = UNKNOWN


def strongest_pattern(found: FaultLines, stretch: Stretch, settings: MonitorSettings) -> Verdict:
    """Report the fault with most evidence if that passes its threshold, unless a rival explains more.

    What is below `least_strikes` is a hum and no fault, however sure it is that it is there.
    A rival are evenly spaced lines of another bearing, a gear or a fan, no chance where the fault does not
    explain them: some of them always lie near those of a fault. A hot box is called whatever the lines say;
    it leaves a fault its name.
    """
    heard = [each for each in found.candidates if strikes(each, settings)]
    best = max(heard or found.candidates, key=lambda candidate: candidate.evidence)
    chance = -log(settings.false_alarm_rate)
    contradicted = best.rival.own > chance and best.rival.evidence > best.evidence
    state = temperature_state(stretch.temperature, stretch.heating, settings)
    if heard and best.score >= best.threshold and not contradicted:
        name, reason = best.pattern.fault, _fault_sentence(best, stretch.shaft_frequency)
    else:
        name, reason = HEALTHY, _healthy_sentence(best, contradicted)
    if state == HOT:
        name = HOT_BOX if name == HEALTHY else name
        reason = f"{_hot_sentence(stretch)}; {reason}"
    return Verdict(name, reason, best, state)


def strikes(candidate: Candidate, settings: MonitorSettings) -> bool:
    """Tell whether a candidate strikes, in all that is heard or in one octave, or was not measured."""
    hums = candidate.strikes < settings.least_strikes
    least = settings.least_sharpest[FAULTS.index(candidate.pattern.fault)]
    return not hums or candidate.sharpest >= least


def temperature_state(temperature: float, heating: float, settings: MonitorSettings) -> str:
    """Judge the temperature of the axlebox [K] by its rise [K/s]: ``unknown``, ``normal``, ``warm``, ``hot``.

    Each is NaN when it is unknown.

    References
    ----------
    EN 15437-2 (2012), Axlebox condition monitoring, part 2: on-board systems alarm on temperature, with
    levels of the vehicle's own. Those of `MonitorSettings` are assumed.
    """
    if isnan(temperature):
        return UNKNOWN
    if temperature >= settings.hot:
        return HOT
    if temperature >= settings.heating_floor and heating >= settings.heating:
        return HOT
    return WARM if temperature >= settings.warm else NORMAL


def _fault_sentence(best: Candidate, shaft_frequency: float) -> str:
    expected = best.pattern.order
    deviation = 100.0 * (best.order / expected - 1.0)
    return (
        f"{best.pattern.fault} fault: {best.pattern.symbol} found at {best.order * shaft_frequency:.2f} Hz, "
        f"{expected * shaft_frequency:.2f} Hz from geometry ({deviation:+.2f} %), "
        f"its lines {best.score:.1f} dB over noise, the alarm is at {best.threshold:.1f} dB"
    )


def _healthy_sentence(best: Candidate, contradicted: bool) -> str:
    scores = f"{best.pattern.symbol} scores {best.score:.1f} dB, the alarm is at {best.threshold:.1f} dB"
    if best.score >= best.threshold:
        if contradicted:
            return f"no fault: {scores}, but multiples of order {best.rival.order:.3f} are surer"
        return (
            f"no fault: {scores}, but it does not strike: its harmonics but the loudest make "
            f"{best.strikes:.1%} of the power in its band"
        )
    return f"no fault: {scores}"


def _hot_sentence(stretch: Stretch) -> str:
    return (
        f"hot box: {stretch.temperature - _ZERO_CELSIUS:.0f} °C, "
        f"rising by {60.0 * stretch.heating:.1f} K a minute"
    )

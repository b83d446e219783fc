"""The verdict: the fault that is reported, and the sentence that says why; the temperature rule."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isnan, log
from typing import Annotated as A

from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.monitor.chain.cage_turns import WELL_KNOWN
from beardyn_core.monitor.chain.competing_orders import is_related
from beardyn_core.monitor.chain.diagnosable import NOT_DIAGNOSABLE
from beardyn_core.monitor.chain.explanations import PART_NAMES, Explanation, explanations
from beardyn_core.monitor.chain.fault_lines import COMB, FAULTS, ROLLER, Candidate, FaultLines
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch

HEALTHY, UNEXPLAINED, HOT_BOX = "healthy", "unexplained", "hot_box"
UNKNOWN, NORMAL, WARM, HOT = "unknown", "normal", "warm", "hot"
_RPM = 60.0  # of a hertz
NEIGHBOUR = "another bearing on this shaft explains more"
_SURER = 1.6  # evidence of other sidebands over its own, from which a fault is doubtful: sidebands scatter
_HARDER = 1.2  # strikes of a comb with the lines between those of another over its own, [-]
_MULTIPLE = 1.5  # over which an order is a multiple of another, [-]
_NO_DOUBT = 0.01  # of an order against bearing data, [-]


@dataclass(frozen=True)
class Verdict:
    """Fault that is reported, with its reason."""

    name: A[str, "``healthy``, ``not_diagnosable``, ``cup``, ``cone``, ``roller`` or ``hot_box``"]
    reason: A[str, "in a sentence"]
    best: A[Candidate, "the strongest candidate, or the one that is called"]
    temperature_state: A[str, "``unknown``, ``normal``, ``warm`` or ``hot``"] = UNKNOWN
    comb: A[Candidate | None, "what strikes and belongs to no part at the stated speed"] = None
    fits: A[tuple[Explanation, ...], "what would explain that comb"] = ()


def strongest_pattern(found: FaultLines, stretch: Stretch, settings: MonitorSettings) -> Verdict:
    """Report the fault with most evidence if that passes its threshold, unless something else explains more.

    What is below `least_strikes` is a hum and no fault, however sure it is that it is there, unless its lines
    are such as no healthy bearing has (`is_faint_fault`).
    A comb of another bearing, a gear or a fan, or of this bearing at another speed, always has some lines
    near those of a fault: where it explains more, the fault is not named. A comb that strikes and fits no
    part at this speed is reported as what it is. A hot box is called whatever the lines say; it leaves a
    fault its name.
    """
    striking = [each for each in found.candidates if strikes(each, settings)]
    best = max(striking or found.candidates, key=lambda candidate: candidate.evidence)
    passed = bool(striking) and best.score >= best.threshold
    stranger = _stranger(found, settings)
    if not passed and stranger is None:
        faint = [
            each
            for each in found.candidates
            if is_faint_fault(each, settings) and not _contradiction(found, each, None, settings)
        ]
        if faint:
            best, passed = max(faint, key=lambda candidate: candidate.evidence), True
    contradiction = _contradiction(found, best, stranger, settings)
    if passed and not contradiction:
        verdict = Verdict(best.pattern.fault, _fault_sentence(best, stretch.shaft_frequency, settings), best)
    elif passed and stranger is None and contradiction != NEIGHBOUR:
        verdict = _verdict_on(best, found, best, stretch, settings, contradiction)
    elif stranger is not None:
        verdict = _verdict_on(stranger, found, best, stretch, settings)
    else:
        verdict = Verdict(HEALTHY, _healthy_sentence(best, contradiction), best)
        for each in found.turned:
            is_fault = strikes(each, settings) or is_faint_fault(each, settings)
            if is_fault and not _contradiction(found, each, None, settings):
                reason = _turned_sentence(each, stretch.shaft_frequency, settings)
                verdict = Verdict(NOT_DIAGNOSABLE, reason, best)
    state = temperature_state(stretch.temperature, stretch.heating, settings)
    if state == HOT:
        name = verdict.name if verdict.name in FAULTS else HOT_BOX
        verdict = replace(verdict, name=name, reason=f"{_hot_sentence(stretch)}; {verdict.reason}")
    return replace(verdict, temperature_state=state)


def _stranger(found: FaultLines, settings: MonitorSettings) -> Candidate | None:
    """Find strikes that belong to no part at the stated speed: a part at another one, or a bare comb."""
    comb = found.combs[0] if found.combs else None
    known = [*found.neighbours, *found.candidates]
    elsewhere = [
        each
        for each in found.elsewhere
        if strikes(each, settings)
        and each.score >= each.threshold
        and all(other.evidence <= each.evidence for other in found.neighbours)
        and not any(
            own.evidence >= each.evidence and is_related(each.order, own.order) for own in found.candidates
        )
        and (comb is None or comb.evidence <= each.evidence or is_same_comb(comb, each))
        and each.otherwise <= _SURER * max(each.evidence, each.alone)
    ]
    if elsewhere:
        return max(elsewhere, key=lambda candidate: candidate.evidence)
    if comb is None or any(each.evidence > 0.0 and is_same_comb(comb, each) for each in known):
        return None
    comb = max(found.combs, key=lambda candidate: candidate.strikes)
    impulsive = not comb.strikes < settings.least_strikes or comb.sharpest >= min(settings.least_sharpest)
    return comb if impulsive else None


def _contradiction(
    found: FaultLines, best: Candidate, stranger: Candidate | None, settings: MonitorSettings
) -> str:
    """Say what explains more than the best candidate does, empty when nothing.

    A fault that has sidebands is compared with the same comb without them, and with those of another part:
    a rolling element modulates with the cage, an inner ring with the shaft. Without sidebands a comb is one
    of a rolling element only where its order leaves no doubt.
    """
    chance = max(-log(settings.false_alarm_rate), best.evidence)
    if any(each.evidence > chance and not is_related(each.order, best.order) for each in found.neighbours):
        return NEIGHBOUR
    if best.rival.own > -log(settings.false_alarm_rate) and best.rival.evidence > best.evidence:
        return f"multiples of order {best.rival.order:.3f} are surer"
    for each in (*((stranger,) if stranger is not None else ()), *found.combs[:1]):
        if each.evidence > chance and not is_same_comb(each, best):
            return f"multiples of order {each.order:.3f} are surer"
    if best.otherwise > _SURER * max(best.evidence, best.alone):
        return "its sidebands are those of another comb"
    doubtful = abs(best.order / best.pattern.order - 1.0) > _NO_DOUBT
    if best.pattern.fault == ROLLER and best.alone > best.evidence and doubtful:
        return "it has no sidebands, and its order is that of a rolling element at another speed only"
    return ""


def is_same_comb(other: Candidate, best: Candidate) -> bool:
    """Tell whether a comb is that of a candidate under another name.

    A comb of a multiple of its order is, where lines between show that the order itself is there: these are
    sure, or with them it strikes harder.
    """
    if other.pattern.fault != COMB:
        return other.pattern.fault == best.pattern.fault and is_related(other.order, best.order)
    alone = other.order > _MULTIPLE * best.order and other.evidence > best.evidence
    harder = not best.pattern.sidebands and best.strikes > _HARDER * other.strikes
    if alone and best.odd <= 0.0 and not harder:
        return False
    own = best.pattern
    if own.cage and is_related(other.order, own.sideband, most=round(other.order / own.sideband)):
        return True
    return is_related(other.order, best.order) or is_related(other.order, best.order / own.divided)


def _verdict_on(
    stranger: Candidate,
    found: FaultLines,
    best: Candidate,
    stretch: Stretch,
    settings: MonitorSettings,
    contradiction: str = "",
) -> Verdict:
    """Report a comb that fits no part at the stated speed, or a part that something contradicts.

    What is weak and has the order of another bearing at this very speed, or of nothing known, may come from
    a bearing or a gear next to this one: then it is not known whether this bearing is healthy.
    """
    (order, expected), speed = stranger.stated(-log(settings.false_alarm_rate)), stretch.shaft_frequency
    patterns = [each.pattern for each in found.candidates]
    fits = explanations(order, patterns, speed, settings.speed_doubt, stranger.pattern.fault)
    own = any(not each.bearing for each in fits)
    other = any(each.bearing for each in fits)
    strong = not stranger.strikes < settings.foreign_strikes or stranger.sharpest >= settings.foreign_sharpest
    sure = strong or (own and not other)
    would = " or ".join(each.sentence(speed) for each in fits) or "no part of this or a shipped bearing"
    share = max(stranger.strikes, stranger.sharpest)
    strike = (
        f"a comb of order {order:.3f} ({order * speed:.2f} Hz) strikes with {share:.2g} times the mean power"
    )
    if contradiction:
        near = (
            stranger.pattern.sideband_symbol if expected == stranger.pattern.cage else stranger.pattern.symbol
        )
        reason = f"{strike} near {near}, but {contradiction}; "
    else:
        reason = (
            f"{strike} and fits no part of this bearing at the stated {_RPM * speed:.5g} rpm; "
            f"it would fit {would}; "
        )
    if sure:
        name, advice = UNEXPLAINED, "check speed, wheel and bearing data"
    else:
        name = NOT_DIAGNOSABLE
        advice = (
            "it is weak enough to come from next to this bearing: name the other bearings on the shaft, or "
            "check speed and bearing data"
        )
    return Verdict(name, reason + advice, best, comb=stranger, fits=fits)


def strikes(candidate: Candidate, settings: MonitorSettings) -> bool:
    """Tell whether a candidate strikes, in all that is measured or in one octave, or was not measured."""
    hums = candidate.strikes < settings.least_strikes
    least = settings.least_sharpest[FAULTS.index(candidate.pattern.fault)]
    return not hums or candidate.sharpest >= least


def is_faint_fault(candidate: Candidate, settings: MonitorSettings) -> bool:
    """Tell whether lines that hardly strike are still those of a fault: nothing else explains them as well.

    Rollers that pass give a healthy bearing lines of the cup, and rollers that differ make them come and go
    with the cage: there an octave must strike more than theirs do. Those of cone and roller are a fault's
    where load zone or cage modulates them; combs without such sidebands were measured in healthy bearings.
    Waves of cone and rollers have them too, where no background hides them, but are smooth.
    """
    if candidate.score < candidate.threshold + settings.faint_margin:
        return False
    if candidate.rival.own >= settings.faint_rival * candidate.evidence:
        return False
    plain, modulated = settings.faint_sharpest
    if not candidate.pattern.sidebands:
        return candidate.sharpest >= plain
    return (
        candidate.sharpest >= modulated and candidate.evidence >= settings.faint_sidebands * candidate.alone
    )


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


def _fault_sentence(best: Candidate, shaft_frequency: float, settings: MonitorSettings) -> str:
    own, (order, expected) = best.pattern, best.stated(-log(settings.false_alarm_rate))
    deviation = order / expected - 1.0
    symbol = own.sideband_symbol if expected == own.cage else own.symbol
    sentence = (
        f"fault of the {PART_NAMES[own.fault]}: {symbol} found at {order * shaft_frequency:.2f} Hz, "
        f"{expected * shaft_frequency:.2f} Hz from bearing data ({100.0 * deviation:+.2f} %), "
        f"its lines {best.score:.1f} dB over noise, the alarm is at {best.threshold:.1f} dB"
    )
    if own.cage:
        sentence += "; its strikes come and go with the cage"
    if not strikes(best, settings):
        sentence += f", faint: its harmonics but the loudest make {best.strikes:.1%} of the power in its band"
    if settings.speed_uncertainty > 0.0:
        fitting = _RPM * shaft_frequency * (1.0 + deviation)
        sentence += f"; without slip it fits {fitting:.5g} rpm, stated are {_RPM * shaft_frequency:.5g} rpm"
    return sentence


def _healthy_sentence(best: Candidate, contradiction: str) -> str:
    scores = f"{best.pattern.symbol} scores {best.score:.1f} dB, the alarm is at {best.threshold:.1f} dB"
    if best.score >= best.threshold:
        if contradiction:
            return f"no fault: {scores}, but {contradiction}"
        return (
            f"no fault: {scores}, but it does not strike: its harmonics but the loudest make "
            f"{best.strikes:.1%} of the power in its band"
        )
    return f"no fault: {scores}"


def _turned_sentence(turned: Candidate, shaft_frequency: float, settings: MonitorSettings) -> str:
    """Say what comes and goes with a cage, and what would tell whose it is."""
    sentence = (
        f"strikes come and go at {turned.pattern.sideband * shaft_frequency:.2f} Hz, with a cage: those of a "
        "rolling element or of a damaged cage"
    )
    if settings.speed_uncertainty > WELL_KNOWN:
        return (
            f"{sentence}, of this bearing or of another on the shaft, for the speed is uncertain by "
            f"{settings.speed_uncertainty:.0%}; give a tachometer, or the speed within {WELL_KNOWN:.0%}"
        )
    return f"{sentence}, of this bearing or of its neighbour, whose cages turn as fast"


def _hot_sentence(stretch: Stretch) -> str:
    return (
        f"hot box: {stretch.temperature - ZERO_CELSIUS:.0f} °C, "
        f"rising by {60.0 * stretch.heating:.1f} K a minute"
    )

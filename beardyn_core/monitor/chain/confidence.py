"""How sure a verdict is: what it rests on, and how often verdicts on such grounds were right."""

from __future__ import annotations

from collections.abc import Mapping
from math import exp, isfinite, log, log10, nan
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.fault_lines import (
    COMB,
    FAULTS,
    Candidate,
    FaultLines,
    evidence_at,
    over_noise,
    without_shaft_lines,
)
from beardyn_core.monitor.chain.inputs import MonitorSettings
from beardyn_core.monitor.chain.verdict import HEALTHY, UNEXPLAINED, Verdict, strikes
from beardyn_core.monitor.features import order_spectrum

PART = "part"  # any part that is named
_PLACES = 5  # at which the lines of a half are sought, about the order found in the whole
_LEAST_STRIKES = 0.01  # over the bound: less is silence
_MOST_DB = 15.0
_MOST_OTHERWISE = 2.0


class Grounds(NamedTuple):
    """What a verdict rests on."""

    comb: A[float, "lines of the comb over the alarm threshold, of the strongest one without a fault, [dB]"]
    strikes: A[float, "what they make of the power over the bound of a fault, of the most impulsive one, [-]"]
    steady: A[float, "evidence of the same lines in that half of the stretch where it is less, [nat]"]
    deviation: A[float, "of the order from that of the bearing data, without its sign, [-]"]
    otherwise: A[float, "evidence of another reading of the lines over that of this one, [-]"]

    def terms(self) -> tuple[float, ...]:
        """Scale the grounds to terms of a logistic regression, each of the order of 1."""
        return (
            1.0,
            0.1 * min(max(self.comb, -_MOST_DB), _MOST_DB),
            log(max(self.strikes, _LEAST_STRIKES)),
            log10(max(self.steady, 1.0)),
            100.0 * self.deviation,
            min(max(self.otherwise, 0.0), _MOST_OTHERWISE),
        )


def grounds_of(
    found: FaultLines, verdict: Verdict, tracked: Float, settings: MonitorSettings
) -> Grounds | None:
    """Measure what a verdict rests on; ``None`` of one that has no confidence, a faint fault among them.

    Parameters
    ----------
    tracked : float64 array, shape [step]
        Loudness over the angle of the shaft in which the lines were found.
    """
    if verdict.name in FAULTS:
        best = verdict.best
        if not strikes(best, settings):
            return None  # hardly any of the records has one
        order, expected = best.stated(-log(settings.false_alarm_rate))
        return Grounds(
            comb=best.score - best.threshold,
            strikes=_strikes_over_bound(best, settings),
            steady=_least_of_halves(best, tracked, settings),
            deviation=abs(order / expected - 1.0),
            otherwise=best.otherwise / best.evidence if isfinite(best.otherwise) else 0.0,
        )
    if verdict.name == UNEXPLAINED and verdict.comb is not None:
        comb = verdict.comb
        return Grounds(
            comb=10.0 * log10(max(comb.evidence, 1.0) / -log(settings.false_alarm_rate)),
            strikes=_strikes_over_bound(comb, settings),
            steady=_least_of_halves(comb, tracked, settings),
            deviation=0.0,
            otherwise=0.0,
        )
    if verdict.name == HEALTHY:
        several = (*found.candidates, *found.combs)
        return Grounds(
            comb=max(each.score - each.threshold for each in found.candidates),
            strikes=max(_strikes_over_bound(each, settings) for each in several),
            steady=0.0,
            deviation=0.0,
            otherwise=0.0,
        )
    return None


def _strikes_over_bound(each: Candidate, settings: MonitorSettings) -> float:
    """Compare what a comb makes of the power with the bound of a fault."""
    fault = each.pattern.fault
    bound = min(settings.least_sharpest) if fault == COMB else settings.least_sharpest[FAULTS.index(fault)]
    whole = 0.0 if np.isnan(each.strikes) else each.strikes / settings.least_strikes
    return max(whole, each.sharpest / bound)


def _least_of_halves(each: Candidate, tracked: Float, settings: MonitorSettings) -> float:
    """Compute the evidence of the lines of a comb in either half of a stretch, and give the lesser, [nat].

    A fault strikes in both; what is there once does not.
    """
    steps = settings.samples_per_revolution
    half = len(tracked) // (2 * steps) * steps
    if half < 2 * steps:
        return 0.0
    places = np.array(each.pattern.lines(settings.harmonics))
    sidebands = places[:, 1] * each.pattern.sideband
    highest = float(each.places(settings.harmonics).max()) + 1.0
    found = []
    for part in (tracked[:half], tracked[half : 2 * half]):
        spectrum = without_shaft_lines(order_spectrum(part, steps, highest, settings.background_width))
        power = over_noise(spectrum)
        reach = 0.5 * spectrum.resolution / settings.harmonics
        orders = each.order + np.linspace(-reach, reach, _PLACES)
        found.append(
            max(evidence_at(power, spectrum, 1.0, order * places[:, 0] + sidebands) for order in orders)
        )
    return min(found)


# of the terms of `Grounds`; `python -m evidence.measured.confidence` prints them and judges them
WEIGHTS: dict[str, tuple[float, ...]] = {
    PART: (0.39, 0.08, 1.31, 0.44, -0.21, -0.51),
    HEALTHY: (0.56, 0.0, -0.03, 0.0, 0.0, 0.0),
    UNEXPLAINED: (2.49, 0.0, 0.0, 0.43, 0.0, 0.0),
}


def confidence_of(
    verdict: str, grounds: Grounds | None, weights: Mapping[str, tuple[float, ...]] = WEIGHTS
) -> float:
    """Give the probability that a verdict is right; NaN of one that states no more than that it cannot tell.

    Parameters
    ----------
    verdict : str
        Its name.
    weights : mapping
        Of the terms of `Grounds`, by the kind of the verdict.
    """
    chosen = weights.get(PART if verdict in FAULTS else verdict)
    if grounds is None or chosen is None:
        return nan
    return 1.0 / (1.0 + exp(-sum(w * x for w, x in zip(chosen, grounds.terms(), strict=True))))

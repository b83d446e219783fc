"""Rolling elements by the turns of the cage: balls spin about axes that wander, and all come and go with it.

Few strikes of a ball follow each other at 2 BSF, so that its sidebands are weak; the cage carries it in and
out of the load all the same. Multiples of FTF are those of a rolling element where nothing else is.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import gammaincc

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.competing_orders import Rival, reach, strongest_rival
from beardyn_core.monitor.chain.false_alarm_rate import PLACES_PER_RESOLUTION, evidence, score_threshold
from beardyn_core.monitor.chain.fault_lines import (
    FAULTS,
    ODD,
    ROLLER,
    TURNS,
    Candidate,
    FaultLines,
    Pattern,
    comb_score,
    evidence_at,
    fault_patterns,
    lines_of,
    over_noise,
    without_shaft_lines,
)
from beardyn_core.monitor.chain.inputs import MonitorSettings
from beardyn_core.monitor.features import OrderSpectrum

WELL_KNOWN = 0.01  # uncertainty of a speed at which cages of two bearings are distinguished, [-]
_SHARE = 0.5  # of the false alarms of a part, for its second pattern
_PARTS = (2, 3, 4, 5, 7)  # what comes back at such a part of the order, as rail joints may, is no cage
_MULTIPLES = (2, 3)  # nor is a comb of a multiple: lines between its own must be there
_AS_SURE = 0.6  # of the evidence of its multiples, from which lines between them are there as well
_FEWEST = 3  # harmonics of 2 BSF that lie on no multiple of FTF


def score_with_turns(
    tracked: Float,
    orders: FaultFrequencies,
    roller_count: int,
    shaft_frequency: float,
    settings: MonitorSettings,
) -> FaultLines:
    """Score every fault as `comb_score` does, rolling elements by the turns of the cage as well.

    The cage carries other strikes, too, those of slots in the rings among them: its turns count where neither
    cup nor cone passes its threshold. Cages of all bearings turn about as fast: where the speed is not well
    known, or a neighbour's cage as fast, it may be the cage of another bearing, and is given as `turned`.

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal
    Process. 25, section 2: rolling elements are modulated at the speed of the cage.
    """
    found = comb_score(tracked, orders, roller_count, shaft_frequency, settings)
    pattern = next((each for each in fault_patterns(orders) if each.fault == ROLLER), None)
    if pattern is None or not pattern.sideband > 0.0:
        return found
    if any(each.score >= each.threshold for each in found.candidates if each.pattern.fault != ROLLER):
        return found
    turned = _laid(pattern, without_shaft_lines(found.spectrum), shaft_frequency, settings)
    if turned is None:
        return found
    apart = 2.0 * (settings.tolerance + settings.speed_uncertainty)
    beside = any(not abs(each.ftf / pattern.sideband - 1.0) > apart for each in settings.neighbours)
    if beside or settings.speed_uncertainty > WELL_KNOWN:
        return replace(found, turned=(turned,))

    def surer(each: Candidate) -> Candidate:
        return turned if each.pattern.fault == ROLLER and turned.evidence > each.evidence else each

    return replace(found, candidates=tuple(map(surer, found.candidates)))


def _laid(
    pattern: Pattern, spectrum: OrderSpectrum, shaft_frequency: float, settings: MonitorSettings
) -> Candidate | None:
    """Lay harmonics of 2 BSF and multiples of FTF, each at its best place; ``None`` without proof.

    Harmonics that lie on multiples of FTF as well, as 2 BSF near 16 FTF does, are no evidence of their own.
    """
    power = over_noise(spectrum)
    known = settings.tolerance + settings.speed_uncertainty
    order, own, places = _best(pattern.order, settings.harmonics, known, spectrum, power)
    cage, turns, cage_places = _best(pattern.sideband, TURNS, known, spectrum, power)
    lines = np.concatenate((own, turns))
    total, independent = float(lines.sum() - lines.max()), places * cage_places
    score = float(10.0 * np.log10(max(1.0, total / (len(lines) - 1))))
    rate = _SHARE * settings.false_alarm_rate / len(FAULTS)
    threshold = score_threshold(len(lines), round(independent, 1), rate)
    if score < threshold or not _is_of_a_cage(cage, spectrum, power, settings):
        return None
    fitted = replace(pattern, sideband=cage, sidebands=0, cage=pattern.sideband)
    beside = order * np.arange(1.0, settings.harmonics + 1.0)
    beside = beside[np.abs(beside - cage * np.round(beside / cage)) > reach(beside, spectrum.resolution)]
    few = len(beside) < _FEWEST
    candidate = Candidate(
        pattern=fitted,
        order=order,
        score=score,
        threshold=threshold,
        evidence=evidence(total, len(lines), independent * len(FAULTS)),
        alone=-np.inf if few else evidence_at(power, spectrum, places, beside),
        odd=evidence_at(power, spectrum, places, order * np.array(ODD)),
        rival=Rival(),
        lines=lines_of(fitted, order, pattern, spectrum, shaft_frequency, settings.harmonics),
    )
    explained = candidate.explains(spectrum.order, spectrum.resolution)
    return replace(candidate, rival=strongest_rival(spectrum, power, explained, settings.harmonics))


def _best(
    order: float, harmonics: int, known: float, spectrum: OrderSpectrum, power: Float
) -> tuple[float, Float, float]:
    """Slide a comb about its order: the best place, the power of its lines, and the places searched."""
    trial = order * (1.0 + np.arange(-known, known, 0.25 * spectrum.resolution / harmonics / order))
    index = np.rint(trial[:, None] * np.arange(1, harmonics + 1) / spectrum.order[1]).astype(int)
    laid = power[np.minimum(index, len(power) - 1)]
    best = int(np.argmax(laid.sum(axis=1) - laid.max(axis=1)))
    places = PLACES_PER_RESOLUTION * 2.0 * known * order * harmonics / spectrum.resolution
    return float(trial[best]), laid[best], max(1.0, places)


def _is_of_a_cage(cage: float, spectrum: OrderSpectrum, power: Float, settings: MonitorSettings) -> bool:
    """Tell whether a comb is that of an order itself, and of no part or multiple of it.

    What comes back at a part of it has more lines between than on its multiples.
    """
    own = evidence_at(power, spectrum, 1.0, cage * np.arange(1.0, TURNS + 1.0))
    for part in _PARTS:
        between = np.array([j for j in range(1, TURNS * part) if j % part])
        if evidence_at(power, spectrum, 1.0, between * cage / part) >= _AS_SURE * own:
            return False
    for multiple in _MULTIPLES:
        between = np.array([k for k in range(1, TURNS + 1) if k % multiple])
        index = np.rint(between * cage / spectrum.order[1]).astype(int)
        if gammaincc(len(between), power[index].sum()) >= settings.false_alarm_rate:
            return False
    return True

"""Rivals: a periodicity that is none of a fault's own and explains the spectrum better."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, inf
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Bool, Float
from beardyn_core.monitor.chain.false_alarm_rate import PLACES_PER_RESOLUTION, evidence
from beardyn_core.monitor.features import OrderSpectrum

LOWEST_COMB = 1.2  # fundamental of a rival: below are the cage's own orders and the wheel's, [-]
_ALIKE = 0.006  # orders that differ by less are one, [-]
_FINE = 201  # trials about a shaft order, which all its lines then sharpen
_TAKEN_OUT = 1e-9  # power over noise of lines that were taken out
_SHAFT_LINES, _FEWEST = 24, 3  # multiples of the shaft among which those are that show it
_STEP = 0.3  # of the last harmonic between trials, in resolutions


@dataclass(frozen=True)
class Rival:
    """The evenly spaced lines that are most surprising among those which a candidate does not explain."""

    order: A[float, "of the fundamental, [-]"] = np.nan
    evidence: A[float, "of all its lines against chance, [nat]"] = -inf
    own: A[float, "of those alone which the candidate does not explain, [nat]"] = -inf


def is_related(order: float, fundamental: float, most: int = 5) -> bool:
    """Tell whether a comb is that of a fundamental: of its multiples, or of every line between them."""
    ratio = order / fundamental
    whole = max(1.0, round(ratio)) if ratio > 1.0 else 1.0 / max(1.0, round(1.0 / ratio))
    return max(whole, 1.0 / whole) <= most and abs(ratio / whole - 1.0) <= _ALIKE


def reach(order: Float, resolution: float) -> Float:
    """Compute how far a line may lie from its place in a pattern, by resolution and slow cage slip."""
    return np.minimum(resolution + 0.003 * order, 0.25)


def mark_explained(
    order: Float, fundamental: float, sideband: float, sidebands: int, resolution: float
) -> Bool:
    """Tell which orders are harmonics of a fundamental, or sidebands of these up to a number."""
    found = np.zeros(np.shape(order), dtype=bool)
    for k in range(-sidebands, sidebands + 1):
        carrier = order - k * sideband
        harmonic = np.maximum(1.0, np.round(carrier / fundamental))
        found |= np.abs(carrier - harmonic * fundamental) <= reach(order, resolution)
    return found


def strongest_rival(spectrum: OrderSpectrum, power: Float, known: Bool, harmonics: int) -> Rival:
    """Slide a comb of harmonics over all fundamentals and keep the most surprising one.

    A bearing next to the judged one, a gear or a fan strikes as evenly as a spall does, and some lines
    of its comb lie near those of any pattern. Where it explains more, the pattern is no evidence. It is
    sought in what the pattern leaves over, for a fault has combs at parts of its order as well.

    Parameters
    ----------
    power : float64 array, shape [line]
        Over that of noise, 0 at whole orders.
    known : bool array, shape [line]
        Lines which the candidate explains.
    harmonics : int
        Of the comb, the fundamental included.
    """
    highest = float(spectrum.order[-1]) / harmonics
    if highest <= LOWEST_COMB:
        return Rival()
    rest = np.where(known, 0.0, power)
    trial = np.arange(LOWEST_COMB, highest, _STEP * spectrum.resolution / harmonics)
    total, largest = np.zeros(len(trial)), np.zeros(len(trial))
    for harmonic in range(1, harmonics + 1):
        index = np.rint(trial * (harmonic / spectrum.order[1])).astype(np.int64)
        line = rest[np.minimum(index, len(rest) - 1)]
        total += line
        np.maximum(largest, line, out=largest)
    total -= largest
    best = int(np.argmax(total))
    places = PLACES_PER_RESOLUTION * (highest - LOWEST_COMB) * harmonics / spectrum.resolution
    index = np.rint(trial[best] * np.arange(1, harmonics + 1) / spectrum.order[1]).astype(np.int64)
    line = power[np.minimum(index, len(power) - 1)]
    whole = float(line.sum() - line.max())
    return Rival(
        float(trial[best]),
        evidence(whole, harmonics, places),
        evidence(float(total[best]), harmonics, places),
    )


def shaft_of(order: float, spectrum: OrderSpectrum, power: Float, doubt: float, chance: float) -> float:
    """Find the order of the shaft of whose lines a comb is a part; NaN where it is none of a shaft.

    At a stated speed that is a little off, what turns with the shaft has lines near whole orders.

    Parameters
    ----------
    order : float
        Of the comb, [-].
    doubt : float
        Largest error of the stated speed, [-].
    chance : float
        Evidence from which lines are no chance, [nat].
    """
    found, most = np.nan, chance
    for part in range(max(2, ceil(order / (1.0 + doubt))), floor(order / (1.0 - doubt)) + 1):
        turns = order / part
        # next to multiples of a comb lie its sidebands of the shaft, which are no shaft alone
        apart = 0 if part < 4 else 1 if part < 6 else 2
        own = range(1, _SHAFT_LINES + 1)
        lines = np.array([h for h in own if h < part - apart or apart < h % part < part - apart])
        lines = lines[np.gcd(lines, part) == 1]  # others are of a comb at a part of the order
        index = np.rint(lines * turns / spectrum.order[1]).astype(np.int64)
        line = power[index[index < len(power)]]
        line = line[line > _TAKEN_OUT]  # what lies on whole orders was taken out
        if len(line) < _FEWEST:
            continue
        between = evidence(float(line.sum() - line.max()), len(line), 1.0)
        if between > (0.0 if part == 2 else most):
            found, most = turns, between
    if np.isnan(found):
        return found
    near = found + np.linspace(-1.0, 1.0, _FINE) * spectrum.resolution
    lines = np.arange(1, int(spectrum.order[-1] / near[-1]) + 1)
    index = np.minimum(np.rint(np.outer(near, lines) / spectrum.order[1]).astype(np.int64), len(power) - 1)
    return float(near[np.argmax(np.log1p(power[index]).sum(axis=1))])

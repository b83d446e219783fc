"""Rivals: a periodicity that is none of a fault's own and explains the spectrum better."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Bool, Float
from beardyn_core.observe.chain.surprise import PLACES_PER_RESOLUTION, evidence
from beardyn_core.observe.features import OrderSpectrum

_LOWEST = 1.2  # fundamental of a rival: below are the cage's own orders and the wheel's, [-]
_STEP = 0.3  # of the last harmonic between trials, in resolutions


@dataclass(frozen=True)
class Rival:
    """The evenly spaced lines that are most surprising among those which a candidate does not explain."""

    order: A[float, "of the fundamental, [-]"] = np.nan
    evidence: A[float, "of all its lines against chance, [nat]"] = -inf
    own: A[float, "of those alone which the candidate does not explain, [nat]"] = -inf


def reach(order: Float, resolution: float) -> Float:
    """Compute how far a line may lie from its place in a pattern, by resolution and slow cage slip."""
    return np.minimum(resolution + 0.003 * order, 0.25)


def explained(order: Float, fundamental: float, sideband: float, sidebands: int, resolution: float) -> Bool:
    """Tell which orders are harmonics of a fundamental, or sidebands of these up to a number."""
    found = np.zeros(np.shape(order), dtype=bool)
    for k in range(-sidebands, sidebands + 1):
        carrier = order - k * sideband
        harmonic = np.maximum(1.0, np.round(carrier / fundamental))
        found |= np.abs(carrier - harmonic * fundamental) <= reach(order, resolution)
    return found


def strongest_rival(spectrum: OrderSpectrum, power: Float, known: Bool, harmonics: int) -> Rival:
    """Slide a comb of harmonics over all fundamentals and keep the most surprising one.

    A bearing beside the one that is judged, a gear or a fan strikes as evenly as a spall does, and some lines
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
    if highest <= _LOWEST:
        return Rival()
    rest = np.where(known, 0.0, power)
    trial = np.arange(_LOWEST, highest, _STEP * spectrum.resolution / harmonics)
    total, largest = np.zeros(len(trial)), np.zeros(len(trial))
    for harmonic in range(1, harmonics + 1):
        index = np.rint(trial * (harmonic / spectrum.order[1])).astype(np.int64)
        line = rest[np.minimum(index, len(rest) - 1)]
        total += line
        np.maximum(largest, line, out=largest)
    total -= largest
    best = int(np.argmax(total))
    places = PLACES_PER_RESOLUTION * (highest - _LOWEST) * harmonics / spectrum.resolution
    index = np.rint(trial[best] * np.arange(1, harmonics + 1) / spectrum.order[1]).astype(np.int64)
    line = power[np.minimum(index, len(power) - 1)]
    whole = float(line.sum() - line.max())
    return Rival(
        float(trial[best]),
        evidence(whole, harmonics, places),
        evidence(float(total[best]), harmonics, places),
    )

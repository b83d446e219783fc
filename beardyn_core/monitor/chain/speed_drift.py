"""Whether the speed of a shaft changes although it is stated as constant: strikes whose rate changes."""

from __future__ import annotations

from collections.abc import Sequence
from math import copysign, inf, isfinite, log, log10, nan
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.competing_orders import strongest_rival
from beardyn_core.monitor.chain.fault_lines import over_noise, without_shaft_lines
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.levels import Levels
from beardyn_core.monitor.features import order_spectrum

# revolutions of a piece, in which the speed changes evenly, and the step of the changes that are tried, [-]
_SCALES = ((20, 0.01), (8, 0.03))
_TRIED = np.arange(-15, 16)  # steps
_HIGHEST_ORDER = 60.0
_FEWEST = 2  # pieces that must agree
_PARTS = 10  # of a stretch, whose levels are compared
_LOUD = 90.0  # per cent of earlier stretches that are quieter
# [dB]: 284 of 286 public records at a steady speed have up to 5.7, the other two a signal that fails
LARGEST_LEVEL_CHANGE = 8.0


class _Piece(NamedTuple):
    change: float  # of the speed, relative
    sure: float  # evidence of the comb at this change [nat]
    gained: float  # over that at constant speed [nat]


class Drift(NamedTuple):
    """Change of a speed that is stated as constant."""

    change: A[float, "over `revolutions`, relative; NaN: none was found, [-]"]
    revolutions: A[float, "in which that is, NaN without"]


def speed_drift(tracked: Float, settings: MonitorSettings) -> Drift:
    """Find out whether a comb of strikes is sharper where the speed changes evenly than where it is constant.

    Parameters
    ----------
    tracked : float64 array, shape [step]
        Loudness over the angle of the shaft, as the stated speed has it.

    Notes
    -----
    At a speed that changes, lines over multiples of a constant one are smeared, and a fault is not found. In
    pieces of 20 revolutions, or of 8 for quicker changes, the change is taken to be even, and the strongest
    comb of any order is sought for each of 31 changes. That one gives more evidence than none must be no
    chance, and most pieces must have a change of one sign.
    """
    for revolutions, step in _SCALES:
        steps = revolutions * settings.samples_per_revolution
        changes = np.asarray(step * _TRIED, np.float64)
        begins = range(0, len(tracked) - steps + 1, steps)
        pieces = [_piece(tracked[first : first + steps], changes, settings) for first in begins]
        change = _agreed(pieces, settings)
        if isfinite(change):
            return Drift(change, revolutions)
    return Drift(nan, nan)


def level_fall(levels: Levels, earlier: Sequence[Levels]) -> float:
    """Compute by how much a stretch is quieter than earlier ones of a stream, 0 without, [dB].

    Most of these may be of a train that stands: the louder tenth counts.
    """
    usual = [each.rms for each in earlier if each.rms > 0.0]
    if not usual or not levels.rms > 0.0:
        return 0.0
    return max(20.0 * log10(float(np.percentile(usual, _LOUD)) / levels.rms), 0.0)


def level_change(stretch: Stretch, band: tuple[float, float]) -> float:
    """Compute by how much the level of the tenths of a stretch differs, [dB].

    Strikes are rare within a tenth, and its median ignores them; a train that stops loses 30 dB and more.
    """
    power = stretch.squared_envelope(band)[stretch.inner]
    levels = [float(np.median(part)) for part in np.array_split(power, _PARTS)]
    least, most = min(levels), max(levels)
    return 10.0 * log10(most / least) if least > 0.0 else inf if most > 0.0 else 0.0


def _agreed(pieces: Sequence[_Piece], settings: MonitorSettings) -> float:
    """Find the change that most pieces have, NaN without, [-]."""
    chance = -log(settings.false_alarm_rate) + log(len(_TRIED))
    sure = [each.change for each in pieces if each.change and each.sure > chance and each.gained > chance]
    alike = [each for each in sure if copysign(1.0, each) == copysign(1.0, float(np.median(sure)))]
    if len(alike) < _FEWEST or 2 * len(alike) <= len(pieces) or len(alike) < len(sure):
        return nan
    return float(np.median(alike))


def _piece(loudness: Float, changes: Float, settings: MonitorSettings) -> _Piece:
    """Search the changes of one piece."""
    share = np.arange(len(loudness)) / len(loudness)
    found = []
    for change in changes:
        turned = share + 0.5 * change * (share * share - share)  # over the stated angle
        even = np.interp(share, turned, loudness)
        spectrum = without_shaft_lines(
            order_spectrum(even, settings.samples_per_revolution, _HIGHEST_ORDER, settings.background_width)
        )
        nothing = np.zeros(len(spectrum.order), dtype=bool)
        found.append(strongest_rival(spectrum, over_noise(spectrum), nothing, settings.harmonics).evidence)
    best = int(np.argmax(found))
    still = found[int(np.flatnonzero(changes == 0.0)[0])]
    return _Piece(float(changes[best]), found[best], found[best] - max(still, 0.0))

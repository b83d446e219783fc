"""Whether the speed of a shaft changes although it is stated as constant: strikes whose rate changes."""

from __future__ import annotations

from math import copysign, log, nan
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.competing_orders import strongest_rival
from beardyn_core.monitor.chain.fault_lines import over_noise, without_shaft_lines
from beardyn_core.monitor.chain.inputs import MonitorSettings
from beardyn_core.monitor.features import order_spectrum

_REVOLUTIONS = 20  # of a piece, in which the speed changes evenly
_CHANGES = np.arange(-0.15, 0.1501, 0.01)  # of the speed over a piece, that are tried, [-]
_HIGHEST_ORDER = 60.0
_FEWEST = 2  # pieces that must agree


class _Piece(NamedTuple):
    change: float  # of the speed, relative
    sure: float  # evidence of the comb at this change [nat]
    gained: float  # over that at constant speed [nat]


class Drift(NamedTuple):
    """Change of a speed that is stated as constant."""

    change: A[float, "over `revolutions`, relative; NaN: none was found, [-]"]
    revolutions: A[float, "of a piece"]


def speed_drift(tracked: Float, settings: MonitorSettings) -> Drift:
    """Find out whether a comb of strikes is sharper where the speed changes evenly than where it is constant.

    Parameters
    ----------
    tracked : float64 array, shape [step]
        Loudness over the angle of the shaft, as the stated speed has it.

    Notes
    -----
    At a speed that changes, lines over multiples of a constant one are smeared, and a fault is not found. In
    pieces of 20 revolutions the change is taken to be even, and the strongest comb of any order is sought for
    each of 31 changes. That one gives more evidence than none must be no chance, and most pieces must have a
    change of one sign.
    """
    steps = _REVOLUTIONS * settings.samples_per_revolution
    begins = range(0, len(tracked) - steps + 1, steps)
    pieces = [_piece(tracked[first : first + steps], settings) for first in begins]
    chance = -log(settings.false_alarm_rate) + log(len(_CHANGES))
    sure = [each.change for each in pieces if each.change and each.sure > chance and each.gained > chance]
    alike = [each for each in sure if copysign(1.0, each) == copysign(1.0, float(np.median(sure)))]
    if len(alike) < _FEWEST or 2 * len(alike) <= len(pieces) or len(alike) < len(sure):
        return Drift(nan, _REVOLUTIONS)
    return Drift(float(np.median(alike)), _REVOLUTIONS)


def _piece(loudness: Float, settings: MonitorSettings) -> _Piece:
    """Search the changes of one piece."""
    share = np.arange(len(loudness)) / len(loudness)
    found = []
    for change in _CHANGES:
        turned = share + 0.5 * change * (share * share - share)  # over the stated angle
        even = np.interp(share, turned, loudness)
        spectrum = without_shaft_lines(
            order_spectrum(even, settings.samples_per_revolution, _HIGHEST_ORDER, settings.background_width)
        )
        nothing = np.zeros(len(spectrum.order), dtype=bool)
        found.append(strongest_rival(spectrum, over_noise(spectrum), nothing, settings.harmonics).evidence)
    best = int(np.argmax(found))
    still = found[int(np.argmin(np.abs(_CHANGES)))]
    change = float(_CHANGES[best]) if abs(_CHANGES[best]) > 0.5 * (_CHANGES[1] - _CHANGES[0]) else 0.0
    return _Piece(change, found[best], found[best] - max(still, 0.0))

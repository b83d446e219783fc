"""Input of a monitoring algorithm: a stretch of signal, with the shaft, load and temperature of a train."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.observe.chain.levels import Levels

Float = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """A stretch of signal to analyse.

    Parameters
    ----------
    rate : float
        [Hz].
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    shaft_angle : float64 array, shape [sample]
        Increasing, [rad].
    load : float
        Mean vertical load, NaN when unknown, [N].
    end_ns : int
        Time of the last sample, [ns].
    temperature : float
        Of the axlebox at the end, NaN when unknown, [K].
    heating : float
        Rise of that temperature, NaN when unknown, [K/s].
    earlier : tuple of Levels
        Of the stretches before, the oldest first.
    """

    rate: float
    acceleration: Float
    shaft_angle: Float
    load: float
    end_ns: int
    temperature: float = np.nan
    heating: float = np.nan
    earlier: tuple[Levels, ...] = ()

    @property
    def revolutions(self) -> float:
        """Revolutions of the shaft, [-]."""
        return float(self.shaft_angle[-1] - self.shaft_angle[0]) / (2.0 * np.pi)

    @property
    def shaft_frequency(self) -> float:
        """Mean frequency of the shaft, [Hz]."""
        return self.revolutions * self.rate / (len(self.shaft_angle) - 1)

"""Input of a monitoring algorithm: a stretch of signal, with the shaft, load and temperature of a train."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.observe.chain.levels import Levels


@dataclass(frozen=True)
class Stretch:
    """A stretch of signal to analyse."""

    rate: A[float, "[Hz]"]
    acceleration: A[Float, "shape [sample, axis], [m/s^2]"]
    shaft_angle: A[Float, "shape [sample], increasing, [rad]"]
    load: A[float, "mean vertical load, NaN when unknown, [N]"]
    end_ns: A[int, "time of the last sample, [ns]"]
    temperature: A[float, "of the axlebox at the end, NaN when unknown, [K]"] = np.nan
    heating: A[float, "rise of that temperature, NaN when unknown, [K/s]"] = np.nan
    earlier: A[tuple[Levels, ...], "of the stretches before, the oldest first"] = ()

    @property
    def revolutions(self) -> float:
        """Revolutions of the shaft, [-]."""
        return float(self.shaft_angle[-1] - self.shaft_angle[0]) / (2.0 * np.pi)

    @property
    def shaft_frequency(self) -> float:
        """Mean frequency of the shaft, [Hz]."""
        return self.revolutions * self.rate / (len(self.shaft_angle) - 1)

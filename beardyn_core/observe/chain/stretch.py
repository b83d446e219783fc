"""Input of a monitoring algorithm: a stretch of signal, with the shaft, load and temperature of a train."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray
from scipy.fft import rfft

from beardyn_core.observe.chain.levels import Levels
from beardyn_core.observe.features import analytic_part, real_part, squared_magnitude

Float = NDArray[np.float64]


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

    @cached_property
    def spectrum(self) -> NDArray[np.complex128]:
        """``rfft`` of the acceleration, shape [line, axis], which every band is cut out of."""
        return np.asarray(rfft(self.acceleration, axis=0), np.complex128)

    @cached_property
    def _envelopes(self) -> dict[tuple[float, float], Float]:
        return {}

    def squared_envelope(self, band: tuple[float, float]) -> Float:
        """Compute the squared envelope of a band, summed over the axes, shape [sample], [m^2/s^4]."""
        if band not in self._envelopes:
            analytic = analytic_part(self.spectrum, len(self.acceleration), self.rate, band)
            self._envelopes[band] = squared_magnitude(analytic)
        return self._envelopes[band]

    def in_band(self, band: tuple[float, float]) -> Float:
        """Compute the acceleration in a band, shape [sample, axis], [m/s^2]."""
        return real_part(self.spectrum, len(self.acceleration), self.rate, band)

"""Low-pass filter of live load: what a sampler behind it would fold is taken away, the delay is known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Poles of the Bessel filter of order 4 that has its half-power point at 1 rad/s, one of each pair.
POLES = np.array([-1.3700678306 + 0.4102497175j, -0.9952087644 + 1.2571057395j])
DELAY = 2.1139176749  # of slow signals, in units of 1 / (2 pi bandwidth)


def filter_delay(bandwidth: float) -> float:
    """Compute by how much the filter delays everything below its bandwidth [Hz], [s]."""
    return DELAY / (2.0 * np.pi * bandwidth)


class LowPass:
    """Bessel filter of order 4 for unevenly spaced samples, straight between them.

    A step comes through with less than 1 % of overshoot, and all frequencies below the bandwidth with
    the same delay.

    Parameters
    ----------
    bandwidth : float
        Where half of the power passes, [Hz].
    """

    def __init__(self, bandwidth: float) -> None:
        both = np.concatenate((POLES, POLES.conj()))
        others = [np.prod([pole - each for each in both if each != pole]) for pole in POLES]
        scale = 2.0 * np.pi * bandwidth
        self._poles = POLES * scale
        self._residues = np.prod(both) / np.array(others) * scale
        self._state: NDArray[np.complex128] | None = None
        # the filter works on what differs from the first value: a constant comes through to the bit
        self._rest = self._last = np.zeros(0)

    def push(self, steps: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Take samples and return the filtered value at the last of them, shape [column].

        Parameters
        ----------
        steps : array, shape [sample]
            Time since the sample before, [s]; the very first one counts from rest in its own value.
        values : array, shape [sample, column]
        """
        if self._state is None:
            self._rest, self._last = values[0], np.zeros_like(values[0])
            self._state = np.zeros((len(self._poles), len(values[0])), complex)
        values = values - self._rest
        before = np.vstack((self._last, values[:-1]))
        turn = self._poles[:, None] * steps
        growth = np.expm1(turn)
        # of a straight line from `before` to `values` over a step: weights of its two ends
        end = self._residues[:, None] * (growth - turn) / (self._poles[:, None] * turn)
        start = self._residues[:, None] * growth / self._poles[:, None] - end
        left = np.cumsum(turn[:, ::-1], axis=1)[:, ::-1]
        decay = np.exp(left - turn)
        self._state = np.exp(left[:, :1]) * self._state + (decay * start) @ before + (decay * end) @ values
        self._last = values[-1]
        return np.asarray(self._rest + 2.0 * self._state.sum(axis=0).real)

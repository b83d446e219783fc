"""Mounting resonance of an accelerometer: one mass on a spring, exact up to the edge of its band."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.arrays import Float
from beardyn_core.jit import entry

LOOKAHEAD = 12  # steps; with one step per sample the gain is still within 0.02 dB
_HIGHEST_POLE = 0.475  # of the step rate; above that the gain over the band is smooth enough without poles
_BAND_POINTS = 400


def resonance_gain(frequency: Float, resonance: float, damping_ratio: float) -> NDArray[np.complex128]:
    """Compute the acceleration of a mass on a spring over that of its base.

    Parameters
    ----------
    frequency : array
        [Hz].
    resonance : float
        Undamped, [Hz].

    Notes
    -----
    That is the reading over the true acceleration: a piezoelectric accelerometer measures the force in
    its spring, which is the mass times its acceleration, damping left out against the stiffness.
    """
    r = np.asarray(frequency) / resonance
    return np.asarray(1.0 / (1.0 - r * r + 2j * damping_ratio * r))


def filter_coefficients(
    resonance: float, damping_ratio: float, rate: float, band: float
) -> tuple[Float, Float]:
    """Design poles and taps of the filter.

    Returns
    -------
    poles : float64 array, shape [2]
        Factors of the last output and the one before.
    taps : float64 array, shape [2 * LOOKAHEAD + 1]
        Factors of the inputs, the oldest first.

    Notes
    -----
    The poles are those of the mass, exactly. What is left of the gain has no poles in the band, so few
    taps match it there: least squares of the relative error, gain 1 at rest.
    """
    poles = np.zeros(2)
    if resonance < _HIGHEST_POLE * rate:
        turn = 2.0 * np.pi * resonance / rate
        pole = np.exp(turn * (-damping_ratio + 1j * np.sqrt(1.0 - damping_ratio**2)))
        poles = np.array([2.0 * pole.real, -(abs(pole) ** 2)])
    frequency = np.linspace(0.0, band, _BAND_POINTS)
    late = np.exp(-2j * np.pi * frequency / rate)
    rest = resonance_gain(frequency, resonance, damping_ratio) * (1.0 - poles[0] * late - poles[1] * late**2)
    offered = late[:, None] ** np.arange(LOOKAHEAD, -LOOKAHEAD - 1, -1) / rest[:, None]
    system = np.concatenate((offered.real, offered.imag))
    wanted = np.repeat([1.0, 0.0], _BAND_POINTS)
    taps = np.linalg.lstsq(system, wanted, rcond=None)[0]
    return poles, taps * (1.0 - poles.sum()) / taps.sum()


class Resonance:
    """The filter of one sensor; its output comes `LOOKAHEAD` steps late.

    Cutting the stream into other blocks gives the same bits.

    Parameters
    ----------
    resonance, damping_ratio : float
        [Hz], [-].
    rate : float
        Of the steps, [Hz].
    band : float
        Up to here the gain is that of `resonance_gain`, [Hz].
    initial : float64 array, shape [channel]
        What the stream held before its first step.
    """

    def __init__(
        self, resonance: float, damping_ratio: float, rate: float, band: float, initial: Float
    ) -> None:
        self._poles, self._taps = filter_coefficients(resonance, damping_ratio, rate, band)
        self._inputs = np.tile(initial, (2 * LOOKAHEAD, 1))
        self._outputs = np.tile(initial, (2, 1))

    def push(self, block: Float) -> Float:
        """Filter a block, shape [step, channel], and return as many steps."""
        stretch = np.concatenate((self._inputs, block))
        out = np.empty((len(block) + 2, block.shape[1]))
        out[:2] = self._outputs
        _ring(stretch, self._taps, self._poles, out)
        self._inputs, self._outputs = stretch[len(block) :], out[len(block) :].copy()
        return out[2:]


@entry
def _ring(stretch, taps, poles, out):
    for i in range(2, len(out)):
        for j in range(out.shape[1]):
            total = poles[0] * out[i - 1, j] + poles[1] * out[i - 2, j]
            for k in range(len(taps)):
                total += taps[k] * stretch[i - 2 + k, j]
            out[i, j] = total

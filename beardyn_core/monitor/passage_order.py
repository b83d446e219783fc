"""The order at which a fault is passed: found in the vibration, near the order of the bearing data."""

from __future__ import annotations

import numpy as np
from scipy.fft import fft, ifft, next_fast_len

from beardyn_core.base.arrays import Float

REACH = 0.008  # relative: slip, tolerances and the contact angle under load shift an order by less
HARMONICS = 4
_BAND = (1500.0, 11000.0)  # of the envelope, [Hz]
_HIGHEST_SHARE = 0.45  # of the sampling rate
_STEPS_PER_PASSAGE = 16
_FINENESS = 8  # points of the search in the width of a line


def find_passage_order(
    acceleration: Float, rate: float, shaft_angle: Float, order: float, reach: float = REACH
) -> float:
    """Find the order near a nominal one whose harmonics hold most power of the envelope.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    rate : float
        [Hz].
    shaft_angle : float64 array, shape [sample]
        Increasing, [rad].
    order : float
        Passages per revolution of the shaft, as the bearing data give it.
    reach : float
        Half of the range that is searched, relative.

    Returns
    -------
    float
        Passages per revolution; the nominal order where the signal is silent.

    Notes
    -----
    A stretch of 1.5 s has 200 to 300 passages. An order that is wrong by 0.2 % shifts the last passage by
    half a passage against the first, and everything that is averaged over passages is blurred by as much.
    The envelope is averaged over equal steps of the angle. Power is summed over harmonics, so that the step
    of the search is that of the highest of them.
    """
    envelope = band_envelope(acceleration, rate, *_BAND)
    passed = shaft_angle * order / (2.0 * np.pi)
    count = int((passed[-1] - passed[0]) * _STEPS_PER_PASSAGE)
    if count < 2 * _STEPS_PER_PASSAGE:
        return order
    edges = passed[0] + np.arange(count + 1) / _STEPS_PER_PASSAGE
    total = np.concatenate([[0.0], np.cumsum(0.5 * (envelope[1:] + envelope[:-1]) * np.diff(passed))])
    steps = np.diff(np.interp(edges, passed, total)) * _STEPS_PER_PASSAGE
    line = (steps - steps.mean()) * np.hanning(count)
    padded = next_fast_len(_FINENESS * count)
    power = np.abs(fft(line, padded)[: padded // 2]) ** 2
    passages = count / _STEPS_PER_PASSAGE
    tries = max(3, 2 * int(np.ceil(reach * passages * HARMONICS * _FINENESS)) + 1)
    factors = 1.0 + np.linspace(-reach, reach, tries)
    places = np.arange(padded // 2)
    heights = sum(
        np.interp(k * factors * padded / _STEPS_PER_PASSAGE, places, power) for k in range(1, HARMONICS + 1)
    )
    if not np.max(heights) > 0.0:
        return order
    return float(order * factors[int(np.argmax(heights))])


def band_envelope(acceleration: Float, rate: float, low: float, high: float) -> Float:
    """Compute the envelope of a band, all axes together, shape [sample], [m/s^2]."""
    count = len(acceleration)
    frequency = np.fft.fftfreq(count, 1.0 / rate)
    inside = (frequency > low) & (frequency < min(high, _HIGHEST_SHARE * rate))
    analytic = ifft(2.0 * inside[:, None] * fft(acceleration, axis=0), axis=0)
    return np.asarray(np.sqrt(np.sum(np.abs(analytic) ** 2, axis=1)), np.float64)

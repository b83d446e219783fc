"""Symmetric low-pass kernels; scipy.signal would take a third of the time a run needs to start."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry


def low_pass(length: int, cutoff: float, beta: float) -> Float:
    """Design a low-pass filter as a sinc under Kaiser's window, with gain 1 at rest.

    With an odd number of taps, the half-gain frequency over the Nyquist frequency, the window's shape beta.

    References
    ----------
    Kaiser (1974), Nonrecursive digital filter design using the I0-sinh window function.
    """
    from_middle = np.arange(length) - length // 2
    kernel = np.sinc(cutoff * from_middle) * np.kaiser(length, beta)
    return np.asarray(kernel / kernel.sum())


def kaiser_order(ripple: float, width: float) -> tuple[int, float]:
    """Compute taps and window shape for a ripple above 50 dB and a transition over the Nyquist frequency.

    References
    ----------
    Kaiser (1974): N = (A - 7.95) / (2.285 d_omega) + 1, beta = 0.1102 (A - 8.7).
    """
    return math.ceil((ripple - 7.95) / (2.285 * math.pi * width) + 1.0), 0.1102 * (ripple - 8.7)


def first_order(signal: Float, steps: float) -> Float:
    """Filter by a first-order lag whose time constant is a number of steps, 0 or more; it begins settled.

    Exact for a signal that is held over each step.
    """
    if steps == 0.0:
        return signal.copy()
    return np.asarray(_lag(np.ascontiguousarray(signal), math.exp(-1.0 / steps)))


@partial(entry, allocates=True)
def _lag(signal, keep):
    lagged = np.empty_like(signal)
    last = signal[0]
    for n in range(len(signal)):
        last = keep * last + (1.0 - keep) * signal[n]
        lagged[n] = last
    return lagged


def thinning_kernel(factor: int) -> Float:
    """Design a symmetric kernel of odd length: flat to 0.4, 70 dB down from 0.6 of the new rate."""
    length, beta = kaiser_order(70.0, 0.4 / factor)
    return low_pass(length | 1, 1.0 / factor, beta)


def decimate(signal: Float, factor: int, kernel: Float) -> Float:
    """Take every factor-th sample of the filtered signal, without delay, ends held."""
    half = len(kernel) // 2
    padded = np.concatenate([np.full(half, signal[0]), signal, np.full(half, signal[-1])])
    windows = np.lib.stride_tricks.sliding_window_view(padded - signal[0], len(kernel))[::factor]
    return np.asarray(np.einsum("ij,j->i", windows, kernel)) + signal[0]

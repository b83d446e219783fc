"""Streaming anti-alias decimation with linear phase."""

from __future__ import annotations

from functools import cache, partial

import numpy as np
from numpy.typing import NDArray
from scipy.signal import firwin

from beardyn_core.jit import entry

Float = NDArray[np.float64]

DELAY = 12  # output samples: the shortest that gives 70 dB with a passband to 0.4
_KAISER_BETA = 7.2
LARGEST_FACTOR = 64


@cache
def _half_kernel(factor: int) -> Float:
    """Taps from the first to the middle one of the symmetric kernel, sum over all taps 1."""
    kernel = firwin(2 * DELAY * factor + 1, 1.0 / factor, window=("kaiser", _KAISER_BETA))
    return np.ascontiguousarray(kernel[: DELAY * factor + 1])


class Decimator:
    """Keeps every factor-th sample of a stream behind a linear-phase low-pass.

    Flat within 0.1 dB to 0.4 of the new rate, at least 70 dB down from 0.6 of it. Cutting the stream
    into other blocks gives the same bits.

    Parameters
    ----------
    factor : int
        Old over new rate, 1 to 64. With 1 the stream passes unchanged, without delay.
    channels : int
    initial : array, shape [channel], optional
        What the stream held before its first sample; 0 by default.
    held_back : int, optional
        Input samples by which the stream comes later than it is pushed.
    """

    def __init__(self, factor: int, channels: int, initial: Float | None = None, held_back: int = 0) -> None:
        if not 1 <= factor <= LARGEST_FACTOR:
            raise ValueError(f"factor is {factor}; allowed is 1 to {LARGEST_FACTOR}")
        self.factor = factor
        self.channels = channels
        self._half = _half_kernel(factor) if factor > 1 else np.ones(1)
        self._kept = 2 * (len(self._half) - 1) + held_back
        # the stream from the oldest sample that is still needed on; its beginning is the state
        self._stretch = np.zeros((channels, self._kept))
        if initial is not None:
            self._stretch += np.asarray(initial, dtype=np.float64)[:, None]

    @property
    def delay_samples(self) -> int:
        """Input samples by which output m lags: it belongs to input m x factor - delay_samples."""
        return self._kept - (len(self._half) - 1)

    @property
    def state(self) -> Float:
        """Copy of all that the future depends on, shape [channel, past]."""
        return self._stretch[:, : self._kept].copy()

    def restore(self, state: Float) -> None:
        """Go back to a `state`."""
        shape = (self.channels, self._kept)
        if state.shape != shape:
            raise ValueError(f"state has shape {state.shape}; this decimator's is {shape}")
        self._stretch[:, : self._kept] = state

    def push(self, block: Float) -> Float:
        """Consume a block and return what comes out.

        Parameters
        ----------
        block : float64 array, shape [n, channel]
            n a multiple of the factor.

        Returns
        -------
        float64 array, shape [n / factor, channel]
        """
        if block.ndim != 2 or block.shape[1] != self.channels or block.shape[0] % self.factor:
            raise ValueError(
                f"block has shape {block.shape}; it must be [multiple of {self.factor}, {self.channels}]"
            )
        if self._stretch.shape[1] < self._kept + len(block):
            longer = np.empty((self.channels, self._kept + len(block)))
            longer[:, : self._kept] = self._stretch[:, : self._kept]
            self._stretch = longer
        out = np.empty((len(block) // self.factor, self.channels))
        _filter(self._stretch, self._kept, np.ascontiguousarray(block), self._half, self.factor, out)
        return out


# reassoc lets the sum over taps run in vector lanes; its order depends on the kernel only, so blocks
# of any length give the same bits
@partial(entry, flags=("reassoc", "contract", "nsz"))
def _filter(stretch, kept, block, half, factor, out):
    middle = len(half) - 1
    for channel in range(stretch.shape[0]):
        signal = stretch[channel]
        for i in range(len(block)):
            signal[kept + i] = block[i, channel]
        for m in range(len(out)):
            first = signal[m * factor : m * factor + middle]
            last = signal[m * factor + middle + 1 : m * factor + 2 * middle + 1]
            total = 0.0
            for k in range(middle):
                total += half[k] * (first[k] + last[middle - 1 - k])
            out[m, channel] = total + half[middle] * signal[m * factor + middle]
        for i in range(kept):
            signal[i] = signal[len(block) + i]

"""Streaming anti-alias decimation with linear phase."""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.jit import entry
from beardyn_core.rail.low_pass import low_pass

DELAY = 12  # output samples: the shortest that gives 70 dB with a passband to 0.4
_KAISER_BETA = 7.2
LARGEST_FACTOR = 512


@cache
def _kernel(factor: int) -> Float:
    """Design the taps of the symmetric kernel, their sum 1."""
    if factor == 1:
        return np.ones(1)
    return np.ascontiguousarray(low_pass(2 * DELAY * factor + 1, 1.0 / factor, _KAISER_BETA))


class Decimator:
    """Keeps every factor-th sample of a stream behind a linear-phase low-pass.

    Flat within 0.1 dB to 0.4 of the new rate, at least 70 dB down from 0.6 of it. Cutting the stream
    into other blocks gives the same bits.

    Parameters
    ----------
    factor : int
        Old over new rate, 1 to 512. With 1 the stream passes unchanged, without delay.
    initial : array, shape [channel], optional
        What the stream held before its first sample; 0 by default.
    held_back : int, optional
        Input samples by which the stream comes later than it is pushed.
    kernel : float64 array, optional
        Taps of another symmetric kernel, an odd number.
    """

    def __init__(
        self,
        factor: int,
        channels: int,
        initial: Float | None = None,
        held_back: int = 0,
        kernel: Float | None = None,
    ) -> None:
        if not 1 <= factor <= LARGEST_FACTOR:
            raise ValueError(f"factor is {factor}; allowed is 1 to {LARGEST_FACTOR}")
        self.factor = factor
        self.channels = channels
        self._kernel = _kernel(factor) if kernel is None else kernel
        self._kept = len(self._kernel) - 1 + held_back
        # the stream from the oldest sample that is still needed on; its beginning is the state
        self._stretch = np.zeros((channels, self._kept))
        if initial is not None:
            self._stretch += np.asarray(initial, dtype=np.float64)[:, None]

    @property
    def delay_samples(self) -> int:
        """Delay in input samples: output m belongs to input m x factor - delay_samples."""
        return self._kept - (len(self._kernel) - 1) // 2

    def push(self, block: Float) -> Float:
        """Filter a block and return the output so far.

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
        if self.factor == 1:
            whole = np.concatenate((self._stretch[:, : self._kept].T, block))
            self._stretch[:, : self._kept] = whole[len(block) :].T
            return whole[: len(block)]
        out = np.empty((len(block) // self.factor, self.channels))
        _filter(self._stretch, self._kept, np.ascontiguousarray(block), self._kernel, self.factor, out)
        return out


_SECOND = 8  # factor of the second of two stages
_SECOND_HALF = 93  # its taps on each side; those of the first stage fill up to the delay of a single one
_FIRST_BETA = 8.0


class TwoStageDecimator:
    """A `Decimator` of a large factor in a third of the work, with the same delay.

    The first stage only has to clear what folds onto the band that the second one keeps. As flat as a
    single stage and 73 dB down from 0.6 of the new rate.

    Parameters
    ----------
    factor : int
        16, 32, 64 or 128.
    channels, initial, held_back
        As of `Decimator`.
    """

    def __init__(self, factor: int, channels: int, initial: Float | None = None, held_back: int = 0) -> None:
        if factor not in (16, 32, 64, 128):
            raise ValueError(f"factor is {factor}; allowed is 16, 32, 64 or 128")
        self.factor = factor
        first, second = _two_kernels(factor)
        self._first = Decimator(factor // _SECOND, channels, initial, held_back, first)
        self._second = Decimator(_SECOND, channels, initial, 0, second)

    @property
    def delay_samples(self) -> int:
        """See `Decimator.delay_samples`."""
        return self._first.delay_samples + self._first.factor * self._second.delay_samples

    def push(self, block: Float) -> Float:
        """See `Decimator.push`."""
        if block.shape[0] % self.factor:
            raise ValueError(f"block has {block.shape[0]} rows; it must be a multiple of {self.factor}")
        return self._second.push(self._first.push(block))


@cache
def _two_kernels(factor: int) -> tuple[Float, Float]:
    """Design the kernels of both stages; together they reach as far as that of a single one."""
    early = factor // _SECOND
    first_half = DELAY * factor - _SECOND_HALF * early
    first = low_pass(2 * first_half + 1, 1.0 / early, _FIRST_BETA)
    second = low_pass(2 * _SECOND_HALF + 1, 1.0 / _SECOND, _KAISER_BETA)
    return np.ascontiguousarray(first), np.ascontiguousarray(second)


# reassoc lets the sum over taps run in vector lanes; its order depends on the kernel only, so blocks
# of any length give the same bits
@partial(entry, flags=("reassoc", "contract", "nsz"))
def _filter(stretch, kept, block, kernel, factor, out):
    for i in range(len(block)):
        for channel in range(stretch.shape[0]):
            stretch[channel, kept + i] = block[i, channel]
    for channel in range(stretch.shape[0]):
        signal = stretch[channel]
        for m in range(len(out)):
            window = signal[m * factor : m * factor + len(kernel)]
            total = 0.0
            for k in range(len(kernel)):
                total += kernel[k] * window[k]
            out[m, channel] = total
        for i in range(kept):
            signal[i] = signal[len(block) + i]

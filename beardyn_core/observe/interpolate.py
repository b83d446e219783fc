"""Streaming interpolation with linear phase: waveforms of runs whose step is longer than a sample."""

from __future__ import annotations

from functools import cache

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.jit import entry, inline
from beardyn_core.rail.low_pass import low_pass

FACTORS = (2, 4)
_PIECE = 64
_PAD = 8  # keeps the channels of a piece out of each other's cache lines
# Pairs of taps between two samples and shape of the window. The first filter has the band of the decimator,
# flat to 0.4 of the old rate and 70 dB down from 0.6 of it; the second one finds nothing near its edge.
_SHARP, _WIDE = (12, 7.2), (6, 7.2)
# Samples of its own rate by which each stage waits longer than it must, so that the sum is `delay`.
_SPARE = {2: (5, 0), 4: (2, 0)}


@cache
def _taps(pairs: int, beta: float) -> Float:
    """Design the weights of the samples around the middle between two, nearest first; they sum to 1/2."""
    kernel = low_pass(4 * pairs - 1, 0.5, beta)[2 * pairs :: 2]
    return np.ascontiguousarray(0.5 * kernel / kernel.sum())


def delay(factor: int) -> int:
    """Compute the delay of the output in samples of the new rate."""
    return 16 * factor


class Interpolator:
    """Puts samples between those of a stream, which pass unchanged.

    Flat within 0.1 dB to 0.4 of the old rate; images of what lies there are at least 70 dB down, and
    nothing is left from 0.6 of the old rate on. Cutting the stream into other blocks gives the same bits.

    Parameters
    ----------
    factor : int
        New over old rate, out of `FACTORS`.
    initial : array, shape [channel]
        What the stream held before its first sample.

    Notes
    -----
    Every doubling keeps the samples and filters what is between them: half-band filters.
    Input sample n is output sample ``factor (n + 1)`` without the `delay`: a step's signals are those of
    its end.
    """

    def __init__(self, factor: int, channels: int, initial: Float) -> None:
        if factor not in FACTORS:
            raise ValueError(f"factor is {factor}; allowed is one of {FACTORS}")
        self.factor = factor
        self._stages = tuple(_taps(*each) for each in (_SHARP, _WIDE)[: factor // 2])
        kept = [2 * len(taps) - 1 + spare for taps, spare in zip(self._stages, _SPARE[factor], strict=False)]
        # the stream before each stage from the oldest sample that is still needed on
        self._streams = tuple(
            np.repeat(np.asarray(initial, dtype=np.float64)[:, None], count + (stage + 1) * _PIECE, axis=1)
            for stage, count in enumerate(kept)
        )
        assert all(len(stream) == channels for stream in self._streams)
        self._kept = kept

    def push(self, block: Float) -> Float:
        """Filter a block and return the output so far.

        Parameters
        ----------
        block : float64 array, shape [n, channel]
            What lies beyond the stream's channels is left out.

        Returns
        -------
        float64 array, shape [n * factor, channel]
        """
        out = np.empty((len(block) * self.factor, len(self._streams[0])))
        if self.factor == 2:
            _twice(self._streams[0], self._kept[0], self._stages[0], block, out)
        else:
            _four_times(*self._streams, *self._kept, *self._stages, block, out)
        return out


# written out, so that the compiler puts several samples into the lanes of a register


@inline
def _sharp(x, count, t, between):
    """Interpolate between the samples of a stream; the first result lies behind sample 11."""
    for i in range(count):
        near = t[0] * (x[i + 11] + x[i + 12]) + t[1] * (x[i + 10] + x[i + 13]) + t[2] * (x[i + 9] + x[i + 14])
        mid = t[3] * (x[i + 8] + x[i + 15]) + t[4] * (x[i + 7] + x[i + 16]) + t[5] * (x[i + 6] + x[i + 17])
        wide = t[6] * (x[i + 5] + x[i + 18]) + t[7] * (x[i + 4] + x[i + 19]) + t[8] * (x[i + 3] + x[i + 20])
        far = t[9] * (x[i + 2] + x[i + 21]) + t[10] * (x[i + 1] + x[i + 22]) + t[11] * (x[i] + x[i + 23])
        between[i] = (near + mid) + (wide + far)


@inline
def _wide(x, count, t, between):
    """Interpolate between the samples of a stream; the first result lies behind sample 5."""
    for i in range(count):
        near = t[0] * (x[i + 5] + x[i + 6]) + t[1] * (x[i + 4] + x[i + 7]) + t[2] * (x[i + 3] + x[i + 8])
        far = t[3] * (x[i + 2] + x[i + 9]) + t[4] * (x[i + 1] + x[i + 10]) + t[5] * (x[i] + x[i + 11])
        between[i] = near + far


@inline
def _twelve(t):
    return t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9], t[10], t[11]


@inline
def _six(t):
    return t[0], t[1], t[2], t[3], t[4], t[5]


@inline
def _forget(stream, kept, count):
    for i in range(kept):
        stream[i] = stream[count + i]


@entry
def _twice(stream, kept, taps, block, out):
    channels = stream.shape[0]
    between, sharp = np.empty(_PIECE), _twelve(taps)
    tile = np.empty((channels, 2 * _PIECE + _PAD))
    for start in range(0, len(block), _PIECE):
        count = min(_PIECE, len(block) - start)
        for channel in range(channels):
            row, done = stream[channel], tile[channel]
            for i in range(count):
                row[kept + i] = block[start + i, channel]
            _sharp(row, count, sharp, between)
            for i in range(count):
                done[2 * i] = row[11 + i]
                done[2 * i + 1] = between[i]
            _forget(row, kept, count)
        _write_rows(tile, 2 * count, out[2 * start :])


@entry
def _four_times(first, second, first_kept, second_kept, first_taps, second_taps, block, out):
    channels = first.shape[0]
    between, finer = np.empty(_PIECE), np.empty(2 * _PIECE)
    sharp, wide = _twelve(first_taps), _six(second_taps)
    tile = np.empty((channels, 4 * _PIECE + _PAD))
    for start in range(0, len(block), _PIECE):
        count = min(_PIECE, len(block) - start)
        for channel in range(channels):
            row, fine, done = first[channel], second[channel], tile[channel]
            for i in range(count):
                row[first_kept + i] = block[start + i, channel]
            _sharp(row, count, sharp, between)
            for i in range(count):
                fine[second_kept + 2 * i] = row[11 + i]
                fine[second_kept + 2 * i + 1] = between[i]
            _wide(fine, 2 * count, wide, finer)
            for i in range(2 * count):
                done[2 * i] = fine[5 + i]
                done[2 * i + 1] = finer[i]
            _forget(row, first_kept, count)
            _forget(fine, second_kept, 2 * count)
        _write_rows(tile, 4 * count, out[4 * start :])


@inline
def _write_rows(tile, count, out):
    for i in range(count):
        for channel in range(tile.shape[0]):
            out[i, channel] = tile[channel, i]

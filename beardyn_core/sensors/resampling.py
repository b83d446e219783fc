"""Streaming decimation and interpolation with linear phase."""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.base.low_pass import low_pass

DELAY = 12  # output samples: the shortest that gives 70 dB with a passband to 0.4
_KAISER_BETA = 7.2
LARGEST_FACTOR = 4096


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
        Old over new rate, 1 to 4096. With 1 the stream passes unchanged, without delay.
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
    """A `Decimator` by 16, 32, 64 or 128 in a third of the work, with the same delay and arguments.

    The first stage only has to clear what folds onto the band that the second one keeps. As flat as a
    single stage and 73 dB down from 0.6 of the new rate.
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


AnyDecimator = Decimator | TwoStageDecimator


def decimator(factor: int, channels: int, initial: Float, held_back: int) -> AnyDecimator:
    """Make the cheaper `Decimator` of a factor; arguments as of that."""
    kind = TwoStageDecimator if factor >= 2 * _SECOND else Decimator
    return kind(factor, channels, initial, held_back)


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
        self.factor, self.channels = factor, channels
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


@partial(entry, allocates=True)
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


@partial(entry, allocates=True)
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

"""A measured transfer path as a filter that goes on from block to block."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.rail.transfer_path import TransferPath

PATH_LOOKAHEAD = 64  # samples; a measured path has a little of its response before its cause
_LENGTH = 4096  # samples of the response: 160 ms at 25.6 kHz
_PIECES = 50  # a second: pieces of 20 ms are transformed, however long the block is
_FADE = 1.1  # above its last frequency nothing is known of a path: it fades to silence by here
_MOST_ERROR = 0.5  # dB, where the path is not 20 dB under its peak


def response_of(path: TransferPath, rate: float) -> Float:
    """Compute the impulse response of a measured path; the cause stands at sample `PATH_LOOKAHEAD`.

    Linear between the measured frequencies and down to 1 at rest, where box and sensor stand in the same
    gravity: a row at 0 Hz, which no accelerometer of a box measures, is not used. From the last frequency on
    it fades to nothing over a tenth of it.

    Raises
    ------
    InputError
        When the response is longer than the filter, or comes before its cause.
    """
    grid = np.fft.rfftfreq(4 * _LENGTH, 1.0 / rate)
    moving = path.frequency > 0.0
    frequency = np.concatenate([[0.0], path.frequency[moving]])
    ratio = np.concatenate([[1.0 + 0.0j], path.ratio[moving]])
    wanted = np.interp(grid, frequency, ratio.real) + 1j * np.interp(grid, frequency, ratio.imag)
    beyond = np.clip((grid / frequency[-1] - 1.0) / (_FADE - 1.0), 0.0, 1.0)
    wanted *= 0.5 + 0.5 * np.cos(np.pi * beyond)
    whole = np.roll(np.fft.irfft(wanted), PATH_LOOKAHEAD)[:_LENGTH]
    ends = np.ones(_LENGTH)
    rise = 0.5 - 0.5 * np.cos(np.pi * np.arange(PATH_LOOKAHEAD // 2) / (PATH_LOOKAHEAD // 2))
    ends[: len(rise)], ends[-len(rise) :] = rise, rise[::-1]
    found = whole * ends
    known = (grid > frequency[1]) & (grid < min(path.frequency[-1], 0.4 * rate))
    known &= np.abs(wanted) > 0.1 * np.abs(wanted[known]).max(initial=0.0)
    got = np.fft.rfft(np.roll(np.pad(found, (0, 3 * _LENGTH)), -PATH_LOOKAHEAD))[known]
    error = float(np.abs(20.0 * np.log10(np.abs(got / wanted[known]))).max(initial=0.0))
    if error > _MOST_ERROR:
        raise InputError(
            f"a measured path is missed by {error:.1f} dB as a filter of {1e3 * _LENGTH / rate:.0f} ms; it "
            "rings longer, or its phase has its response before its cause: allowed are "
            f"{_MOST_ERROR:g} dB within 20 dB of its peak"
        )
    found[PATH_LOOKAHEAD] += wanted[0].real - found.sum()  # gravity, exactly
    return found


class PathFilter:
    """The measured paths of one sensor; the output comes `PATH_LOOKAHEAD` samples late on every axis.

    Overlap and save, in pieces of 20 ms: blocks of one or several of them give the same bits.

    Parameters
    ----------
    paths : dict
        Axis, 0 to 2 -> its path; the others pass unchanged.
    rate : float
        Of the samples, [Hz].
    initial : float64 array, shape [3]
        What the stream held before its first sample.
    """

    def __init__(self, paths: dict[int, TransferPath], rate: float, initial: Float) -> None:
        self._piece = round(rate / _PIECES)
        size = 1 << (self._piece + _LENGTH - 2).bit_length()
        responses = np.zeros((size, 3))
        responses[PATH_LOOKAHEAD] = 1.0
        for axis, path in paths.items():
            responses[:, axis] = 0.0
            responses[:_LENGTH, axis] = response_of(path, rate)
        self._gain = np.fft.rfft(responses, axis=0)
        self._stretch = np.tile(initial, (size, 1))

    def push(self, block: Float) -> Float:
        """Filter a block, shape [sample, 3], of one or more whole pieces, and return as many samples."""
        out = np.empty_like(block)
        for begin in range(0, len(block), self._piece):
            piece = block[begin : begin + self._piece]
            self._stretch = np.concatenate((self._stretch[len(piece) :], piece))
            whole = np.fft.irfft(np.fft.rfft(self._stretch, axis=0) * self._gain, len(self._stretch), axis=0)
            out[begin : begin + len(piece)] = whole[-len(piece) :]
        return out

"""From one value of the live load a block to samples without images of the block rate."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.scene.chord_polynomials import between, fitted_polynomials
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.held_load import HeldLoad

SAMPLES = 40  # of a block, 2 kHz
REACH = 4  # blocks on either side; images are 85 dB down up to a fifth of the block rate
_POLYNOMIALS = fitted_polynomials(REACH, ((0.2, 1.0), (0.5, 1e-6)))


class LiveLine:
    """A smooth line through the values that were held at the end of each block, `REACH` - 1 blocks late.

    Parameters
    ----------
    first : HeldLoad
        Taken to have been held for ever.
    block_ns : int
        Between values, [ns].
    """

    def __init__(self, first: HeldLoad, block_ns: int) -> None:
        self._values = np.tile(_row(first), (2 * REACH, 1))
        self._block_ns = block_ns
        self._end_ns = 0

    def begin(self) -> LoadHistory:
        """Return the sample at time 0."""
        return _history(np.zeros(1, np.int64), self._values[:1])

    def go_on(self, held: HeldLoad) -> LoadHistory:
        """Take the value that is held now, and return the samples of the next block."""
        self._values = np.vstack((self._values[1:], _row(held)))
        u = np.arange(1, SAMPLES + 1) / SAMPLES
        time_ns = self._end_ns + np.arange(1, SAMPLES + 1) * (self._block_ns // SAMPLES)
        self._end_ns += self._block_ns
        return _history(time_ns, between(self._values, _POLYNOMIALS, u))


def _row(held: HeldLoad) -> Float:
    return np.array([*held.wrench, held.shaft_speed], dtype=np.float64)


def _history(time_ns: np.ndarray, rows: Float) -> LoadHistory:
    wrench, speed = np.ascontiguousarray(rows[:, :6]), np.ascontiguousarray(rows[:, 6])
    return LoadHistory(time_ns, wrench, speed, np.zeros((len(rows), 3)))

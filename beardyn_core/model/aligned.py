"""Arrays of lane values that begin on a cache line, so that none of their values lies across two."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

_LINE = 64


def aligned_zeros(*shape: int) -> NDArray[np.float64]:
    """Zeros whose first number lies at the beginning of a cache line; NumPy aligns to 16 bytes only."""
    size = math.prod(shape)
    room = np.zeros(size + _LINE // 8)
    first = -room.ctypes.data % _LINE // 8
    return room[first : first + size].reshape(shape)


def aligned_copy(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """A copy that begins on a cache line."""
    copy = aligned_zeros(*values.shape)
    copy[...] = values
    return copy

"""Cases of plain arrays to lane arrays and back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


def through(lanes: Any, entry: Callable[..., None], cases: Float, outputs: int, *arguments: Any) -> Float:
    """Run an entry over cases ``[case, field]``; outputs ``[case, output]``.

    Cases are packed in lanes; the last block is filled up with its last case.
    """
    width = lanes.width
    blocks = -(-len(cases) // width)
    filled = np.concatenate([cases, np.repeat(cases[-1:], blocks * width - len(cases), axis=0)])
    packed = np.ascontiguousarray(np.moveaxis(filled.reshape(blocks, width, -1), 1, 2))
    out = np.full((blocks, outputs, width), -1.0)
    with np.errstate(all="ignore"):  # in plain Python NumPy warns of the NaN and infinities under test
        entry(lanes, packed, out, *arguments)
    return np.moveaxis(out, 1, 2).reshape(blocks * width, outputs)[: len(cases)]

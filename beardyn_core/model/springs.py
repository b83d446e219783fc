"""Tables of the springs that a contact is made of."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def for_springs(table: NDArray[np.float64]) -> NDArray[np.float64]:
    """A table of laminae twice over, shape [..., 2 x lamina]: near a patch a lamina is two springs.

    Parameters
    ----------
    table : float64 array, shape [..., lamina]
    """
    return np.ascontiguousarray(np.concatenate([table, table], axis=-1))

"""Stress concentration at the roller ends, as rating life counts it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def edge_concentration(lamina_count: int) -> NDArray[np.float64]:
    """Compute the factor on the load per length of each lamina in the rating life of a profiled roller.

    Parameters
    ----------
    lamina_count : int
        At least 2.

    Returns
    -------
    float64 array, shape [lamina]
        1.002 near the middle, 2.33 at both ends, [-].

    Notes
    -----
    For life alone: it is no load and has no place in the equilibrium. Laminae that are coupled already
    carry part of the concentration; use one of the two.

    References
    ----------
    ISO/TS 16281:2008, stress riser of rollers:
    f[k] = 1 - 0.01 / ln(1.985 |(2k - n - 1)/(2n - 2)|), k = 1 to n.
    """
    if lamina_count < 2:
        raise ValueError(f"lamina_count is {lamina_count}; the ends of a roller need at least 2 laminae.")
    number = np.arange(1, lamina_count + 1)
    place = np.abs(2 * number - lamina_count - 1) / (2.0 * lamina_count - 2.0)
    with np.errstate(divide="ignore"):  # the middle lamina of an odd count: ln 0, factor 1
        factor: NDArray[np.float64] = 1.0 - 0.01 / np.log(1.985 * place)
    return factor

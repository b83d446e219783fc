"""One depth for a lamina that lies partly over a patch, at which it joins laminae that sink with each other.

Of a lamina the part k stands higher and the rest a gap g below: over a hole the part beside it, at a raised
rim the part on it. Alone, at the depth d of the higher part, both are to store::

    9/19 K (k^n d^(19/9) + (1 - k^n) (d - r g)^(19/9)) = 9/19 K D^(19/9),    r = (1 - k) / (1 - k^n),

each part where it touches. The whole lamina joins the others at the depth D, so that forces stay the
gradient of an energy. With n = 1 this is Palmgren's law for each part. Beside a hole the surface sinks away,
and a short part carries more than its length of it: n < 1. r keeps the mean gap, which counts where both
touch.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]

_LOST_EXPONENT = 0.35  # fitted to lines of 240 laminae on the half-space over holes and rims
_SMALLEST = 1.0e-12


def part_exponent(strength: float) -> float:
    """Compute the exponent n of the higher part of a lamina, for a strength of the coupling, [-]."""
    return 1.0 - _LOST_EXPONENT * strength


def joint_depth(depth: Float, gap: Float, cover: Float, exponent: float) -> tuple[Float, Float]:
    """Compute the depth D of laminae of which a patch covers a part.

    Parameters
    ----------
    depth : float64 array, shape [..., lamina]
        Geometric penetration beside the patch, [m].
    gap : float64 array, shape [..., lamina]
        By which it is less over the patch, negative on a raised rim, [m].
    cover : float64 array, shape [..., lamina]
        Part of each lamina's length that the patch takes, [-].
    exponent : float
        From `part_exponent`.

    Returns
    -------
    joint : float64 array, shape [..., lamina]
        D, [m].
    share : float64 array, shape [..., lamina]
        Its slope over the depth: the part of its load that a lamina presses with, [-].
    """
    kept = np.clip(np.where(gap < 0.0, cover, 1.0 - cover), 0.0, 1.0)
    held = kept**exponent
    loose = np.maximum(1.0 - held, _SMALLEST)
    higher = depth - np.minimum(gap, 0.0)
    lower = np.maximum(higher - (1.0 - kept) / loose * np.abs(gap), 0.0)
    higher = np.maximum(higher, 0.0)
    energy = held * higher ** (19.0 / 9.0) + loose * lower ** (19.0 / 9.0)
    force = held * higher ** (10.0 / 9.0) + loose * lower ** (10.0 / 9.0)
    pressed = energy > 0.0
    some = np.where(pressed, energy, 1.0)
    joint = np.where(pressed, some ** (9.0 / 19.0), np.minimum(depth - cover * gap, 0.0))
    share = np.where(pressed, force * some ** (-10.0 / 19.0), 1.0)
    return np.where(cover > 0.0, joint, depth), np.where(cover > 0.0, share, 1.0)

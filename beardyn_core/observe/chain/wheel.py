"""What the wheel does at each of its angles: flats, polygons and whatever else turns with the shaft."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Bool = NDArray[np.bool_]

SECTORS = 64
_STRUCK = 2.0  # times the usual power


def struck_sectors(power: Float) -> Bool:
    """Sectors of the wheel in which it strikes the rail in most of its revolutions.

    Parameters
    ----------
    power : float64 array, shape [revolution, sector]
        Squared envelope over the angle of the shaft.

    Returns
    -------
    bool array, shape [sector]
        Where the median over the revolutions is twice that of the usual sector.

    Notes
    -----
    A flat comes back at the same angle each time. A spall on the cone is loud in one half of the
    revolution too, but its strikes lie elsewhere in each: their median stays that of the noise.
    """
    usual = np.median(power, axis=0)
    # a strike does not end at the border of a sector
    wide = np.maximum(usual, np.maximum(np.roll(usual, 1), np.roll(usual, -1)))
    struck: Bool = wide > _STRUCK * np.median(usual)
    return struck


def without_wheel(power: Float) -> Float:
    """Deviation from the wheel's own pattern, 0 where it strikes.

    The mean over the revolutions at each angle holds all that comes back with the shaft: every whole
    order. No bearing fault has one.

    Parameters
    ----------
    power : float64 array, shape [revolution, step]
        Squared envelope over the angle of the shaft; a multiple of `SECTORS` steps.

    Returns
    -------
    float64 array, shape [revolution, step]

    References
    ----------
    Randall, Antoni (2011), Rolling element bearing diagnostics - a tutorial, Mech. Syst. Signal Process.
    25, section 3.1 (time synchronous averaging).
    """
    revolutions, steps = power.shape
    struck = struck_sectors(power.reshape(revolutions, SECTORS, -1).mean(axis=2))
    rest = power - power.mean(axis=0)
    rest[:, np.repeat(struck, steps // SECTORS)] = 0.0
    return rest

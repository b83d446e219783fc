"""Load-zone integrals of one row under rigid rings.

A roller at angle psi from the load line is pressed by (1 - (1 - cos psi)/(2 eps)) of the largest approach;
eps is the part of the pitch diameter, along the load line, that is loaded.
"""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.bearing.contact_law import LINE_EXPONENT

_ORDER = 400


def radial_integral(extent: float, exponent: float = LINE_EXPONENT) -> float:
    """Compute J_r, the radial load of a row over Z Q_max cos(alpha), [-].

    Parameters
    ----------
    extent : float
        eps of the load zone: 0.5 with radial load and no clearance, above 1 with every roller loaded.
    exponent : float
        Of the load over the approach.

    References
    ----------
    Sjovall, H. (1933), as in Harris, T. A. (2001), Rolling Bearing Analysis, 4th ed., chapter 7.
    """
    return _zone_integral(extent, exponent, radial=True)


def axial_integral(extent: float, exponent: float = LINE_EXPONENT) -> float:
    """Compute J_a, the axial load of a row over Z Q_max sin(alpha), [-]; arguments as `radial_integral`."""
    return _zone_integral(extent, exponent, radial=False)


def _zone_integral(extent: float, exponent: float, *, radial: bool) -> float:
    if not extent > 0.0:
        raise ValueError(f"extent of the load zone is {extent:g}; it must be greater than 0")
    half = math.acos(1.0 - 2.0 * extent) if extent < 1.0 else math.pi
    nodes, weights = np.polynomial.legendre.leggauss(_ORDER)
    angle = half * nodes
    load = np.maximum(1.0 - (1.0 - np.cos(angle)) / (2.0 * extent), 0.0) ** exponent
    if radial:
        load = load * np.cos(angle)
    return float(half * np.sum(weights * load) / (2.0 * math.pi))

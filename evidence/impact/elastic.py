"""How deep an elastic roller sinks over a narrow slot: plane contact of half-spaces, strip by strip.

The slow reference of the twin's edges (`physics.patch_path`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.physics.defect import surface_radius

Bool = NDArray[np.bool_]

STRIP = 8e-6  # [m]
PLACE = STRIP * np.arange(-160, 161)  # of the strips from the roller's middle [m]


def cup_radius(bearing: Bearing) -> float:
    """Work out the radius of a cylinder on a plane in place of roller and cup, [m]."""
    return 1.0 / (2.0 / bearing.roller_diameter - 1.0 / surface_radius(bearing, "cup"))


def sink(bearing: Bearing, width: float, arc: float, load: float) -> float:
    """Compute how much deeper a roller goes at an arc from the middle of a slot, at the same load, [m].

    ``width``, ``arc``: [m]; ``load``: of the roller [N].

    Notes
    -----
    The slot is bottomless and its edges are as stiff as the rest of the half-space; under a pressure p over
    a strip both surfaces yield by -2 p / (pi E*) times the integral of ln|x| and a constant, the same
    with and without the slot: here lengths are in metres. Strips carry no tension.

    References
    ----------
    Johnson (1985), Contact mechanics, section 2.8 and equation 2.25b.
    """
    open_ = np.abs(PLACE + arc) < 0.5 * width
    per_length = load / bearing.effective_length
    return approach(bearing, ~open_, per_length) - approach(bearing, np.ones(len(PLACE), bool), per_length)


def approach(bearing: Bearing, there: Bool, per_length: float) -> float:
    """Find the approach of a roller at rest under a load per length [N/m] where only some strips bear."""
    gap = PLACE**2 / (2.0 * cup_radius(bearing))
    between = PLACE[:, None] - PLACE

    def integral(x: Float) -> Float:
        return np.asarray(x * np.log(np.abs(x)) - x)

    yields = integral(between - 0.5 * STRIP) - integral(between + 0.5 * STRIP)
    yields *= 2.0 / (np.pi * 0.5 * bearing.material.contact_modulus)

    def excess(depth: float) -> float:
        pressed = there & (gap < depth)
        while True:
            pressure = np.zeros(len(PLACE))
            at = np.nonzero(pressed)[0]
            pressure[at] = np.linalg.solve(yields[np.ix_(at, at)], depth - gap[at])
            pulled = pressed & (pressure < 0.0)
            inside = there & ~pressed & (depth - gap - yields @ pressure > 1e-12)
            if not pulled.any() and not inside.any():
                return float(STRIP * pressure.sum() - per_length)
            pressed = pressed & ~pulled if pulled.any() else pressed | inside

    return float(brentq(excess, 1e-8, 1e-4, xtol=1e-11))

"""Elastohydrodynamic film of a raceway line contact."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, exp2, log2, magnitude
from beardyn_core.model.film_factor import LOAD_EXPONENT, SPEED_EXPONENT
from beardyn_core.model.parameters import LAMINA_FILM


@inline
def log2_entrainment(speed: Any, film: Any) -> Any:
    """Speed part of the film thickness, once per contact, [log2 (m/s)^0.7]."""
    if film is None:
        return 0.0
    return SPEED_EXPONENT * log2(magnitude(speed) + 1e-3)


@inline
def log2_film_thickness(load: Any, log2_speed: Any, lamina: Any, ring: Any, laminae: Any, film: Any) -> Any:
    """Binary logarithm of the minimum film thickness of one lamina, [log2 m].

    Neglects thermal inlet shear and the drag of starving oil beyond the starvation factor; valid in
    the elastohydrodynamic regime, loads below 1 mN are treated as 1 mN.

    References
    ----------
    Dowson and Higginson (1966).
    """
    if film is None:
        return 0.0
    return log2_speed + LOAD_EXPONENT * log2(at_least(load, 1e-3)) + laminae[LAMINA_FILM + ring, lamina]


@inline
def film_output(load: Any, log2_speed: Any, ring: Any, laminae: Any, film: Any) -> Any:
    """Film thickness of the middle lamina under the mean lamina load, [m]; 0 without a film."""
    if film is None:
        return 0.0
    middle = laminae.shape[1] // 2
    return exp2(log2_film_thickness(load / laminae.shape[1], log2_speed, middle, ring, laminae, film))

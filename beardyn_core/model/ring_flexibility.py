"""Bending of the cup as kernel parameters."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.ring_bending import cup_ring, housing_ring
from beardyn_core.effects import EffectSet


class FlexibilityParams(NamedTuple):
    """Bending modes of the cup, from two waves upwards, each in two directions."""

    mass: Any  # [mode], [kg]
    stiffness: Any  # [mode], [N/m]
    damping: Any  # [mode], [N s/m]


def flexibility_params(bearing: Bearing, effects: EffectSet) -> FlexibilityParams | None:
    """Work out the modes of the cup with the housing wall around it."""
    ring = effects.ring_flexibility
    if ring is None:
        return None
    parts = [cup_ring(bearing)]
    if ring.housing_wall > 0.0:
        parts.append(housing_ring(bearing, ring.housing_wall, ring.housing_modulus, ring.housing_density))
    waves = range(2, ring.highest_mode + 1)
    stiffness = np.array(
        [ring.stiffness_factor * sum(part.modal_stiffness(n) for part in parts) for n in waves]
    )
    mass = np.array([sum(part.modal_mass(n) for part in parts) for n in waves])
    return FlexibilityParams(mass, stiffness, 2.0 * ring.damping_ratio * np.sqrt(stiffness * mass))

"""Cage pockets as kernel parameters."""

from __future__ import annotations

import math

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet
from beardyn_core.model.parameters import (
    CageParams,
)


def cage_params(bearing: Bearing, effects: EffectSet) -> CageParams | None:
    """Cage pockets around the nominal rollers."""
    if effects.cage is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    radial = 0.5 * bearing.pitch_diameter + bearing.roller_mass_offset * sine
    axial = bearing.roller_mass_offset * cosine
    return CageParams(
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        half_clearance=0.5 * bearing.cage.circumferential_clearance,
        half_end_clearance=0.5 * bearing.cage.axial_clearance,
        bar_sine=math.sin(effects.cage.bar_inclination),
        bar_cosine=math.cos(effects.cage.bar_inclination),
        bar_place=0.35 * bearing.effective_length,
        roller_height=radial,
        roller_place=radial * sine + axial * cosine,
        axis_radial=sine,
        axis_axial=cosine,
        friction=effects.cage.friction,
        regularisation=effects.cage.regularisation_speed,
        place=0.5 * bearing.row_spacing,
        mass=bearing.cage.mass,
        polar_inertia=bearing.cage.polar_inertia,
        transverse_inertia=bearing.cage.transverse_inertia,
    )

"""Small rib as kernel parameters."""

from __future__ import annotations

import math

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet
from beardyn_core.model.contact_parameters import DampingParams
from beardyn_core.model.guide_parameters import SmallRibParams


def small_rib_params(bearing: Bearing, effects: EffectSet) -> SmallRibParams | None:
    """Small rib in the cone's coordinates; its clearance opens when the roller just touches the large rib."""
    effect = effects.small_rib
    if effect is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    along = -0.5 * bearing.roller_length - bearing.small_rib_clearance
    below = bearing.small_end_radius - 0.5 * bearing.small_rib_height
    return SmallRibParams(
        radius=0.5 * bearing.pitch_diameter + along * sine - below * cosine,
        place=0.5 * bearing.row_spacing + along * cosine + below * sine,
        end_place=-0.5 * bearing.roller_length - bearing.roller_mass_offset,
        stiffness=effect.stiffness,
        damping=DampingParams(effect.damping / effect.stiffness),
        friction=effect.friction,
        regularisation=effect.regularisation_speed,
    )

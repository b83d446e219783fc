"""Rib contact as kernel parameters."""

from __future__ import annotations

import math

from beardyn_core.bearing.contact_law import rib_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet
from beardyn_core.model.parameters import (
    RibParams,
)


def rib_params(bearing: Bearing, effects: EffectSet) -> RibParams | None:
    """Rib contact in the cone's coordinates; the nominal roller just touches it."""
    if effects.rib is None:
        return None
    lean = bearing.contact_angle - bearing.rib_polar_angle
    normal_axial, normal_radial = math.cos(lean), math.sin(lean)
    centre_axial = 0.5 * bearing.row_spacing + bearing.sphere_centre * math.cos(bearing.contact_angle)
    centre_radial = 0.5 * bearing.pitch_diameter + bearing.sphere_centre * math.sin(bearing.contact_angle)
    return RibParams(
        stiffness=rib_contact_factor(bearing),
        sphere_radius=bearing.sphere_radius,
        sphere_place=bearing.sphere_centre - bearing.roller_mass_offset,
        normal_axial=normal_axial,
        normal_radial=normal_radial,
        distance=centre_axial * normal_axial + centre_radial * normal_radial + bearing.sphere_radius,
        friction=effects.rib.friction,
        regularisation=effects.rib.regularisation_speed,
    )

"""A roller pressed straight into the cup, near a patch of it and far from it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from beardyn_core.effects import EffectSet
from beardyn_core.scene.patch import Patch
from test.kernels.casting import Float, through
from test.kernels.fault_entries import moving_contacts
from test.kernels.rig import parameters_of
from test.scenes import scene_with

NEAR, FAR = 0.3, 1.3
ENERGY, LET_GO, STIFFNESS, PENETRATION, FORCE, MOMENT, ENERGY_SLOPE = range(7)


def pressed(
    lanes: Any,
    azimuths: list[float],
    depth: float,
    patch: Patch | tuple[Patch, ...],
    *,
    rate: float = 0.0,
    effects: EffectSet | None = None,
    laminae: int = 6,
) -> Float:
    """Contact at azimuths in the cup, FAR among them, of a roller pressed into its sound raceway by a depth.

    Shape [azimuth, output of `moving_contacts` and the slope of the energy over the depth].
    """
    scene = scene_with(effects, defects=patch if isinstance(patch, tuple) else (patch,), laminae=laminae)
    p = parameters_of(scene, lanes.width)
    bearing = scene.bearing
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    axis = np.array([sine, 0.0, cosine])
    centre = np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])
    # the contact point lies half a cone angle beyond the roller axis
    outer = bearing.contact_angle + bearing.half_angle
    normal = np.array([math.cos(outer), 0.0, -math.sin(outer)])
    middle = centre + bearing.roller_mass_offset * axis

    def at(shift: float) -> Float:
        place = middle + shift * normal
        cases = np.array([[a, 0.0, *place, *axis, *(rate * normal)] for a in azimuths])
        return through(lanes, moving_contacts, np.repeat(cases, lanes.width, axis=0), 6, p)[:: lanes.width]

    shift, step = depth - at(0.0)[azimuths.index(FAR), PENETRATION], 1e-9
    found = at(shift)
    slope = (at(shift + step)[:, ENERGY] - at(shift - step)[:, ENERGY]) / (2.0 * step)
    return np.column_stack([found, slope])

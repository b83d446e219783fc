"""Faults as kernel parameters."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.lamina_table import lamina_places
from beardyn_core.model.parameters import (
    SpallParams,
)
from beardyn_core.scene.defect import Spall
from beardyn_core.scene.scene import Scene


def spall_params(scene: Scene, on: str, arrangement: Arrangement) -> SpallParams | None:
    """Spalls of one surface as gap tables by block and lane; ``None`` without any."""
    spalls = [spall for spall in scene.defects if spall.on == on]
    if not spalls:
        return None
    count = scene.numerics.laminae
    patches = np.zeros((len(spalls), arrangement.block_count, 3 + count, arrangement.width))
    for patch, spall in zip(patches, spalls, strict=True):
        present = arrangement.row == spall.row
        if on == "roller":
            present = present & (arrangement.roller == spall.roller)
        patch[:, 0] = spall.azimuth
        patch[:, 1] = 0.5 * spall.width
        patch[:, 2] = surface_radius(scene.bearing, on)
        patch[:, 3:] = present[:, None, :] * lamina_depths(scene.bearing, spall, count)[None, :, None]
    shape = (len(spalls) * arrangement.block_count, 3 + count, arrangement.width)
    return SpallParams(np.ascontiguousarray(patches.reshape(shape)), arrangement.block_count)


def surface_radius(bearing: Bearing, on: str) -> float:
    """Radius that turns an azimuth of cup, cone or roller into an arc at mid-length, [m]."""
    distance = bearing.apex_distance / math.cos(bearing.half_angle)
    angle = {"cup": bearing.cup_angle, "cone": bearing.cone_angle}
    return 0.5 * bearing.roller_diameter if on == "roller" else distance * math.sin(angle[on])


def lamina_depths(bearing: Bearing, spall: Spall, count: int) -> NDArray[np.float64]:
    """Depth of a spall on each lamina: full where it covers more than half of it, shape [lamina], [m]."""
    place = lamina_places(bearing, count)
    half = 0.5 * bearing.effective_length / count
    low = np.maximum(place - half, spall.offset - 0.5 * spall.length)
    high = np.minimum(place + half, spall.offset + 0.5 * spall.length)
    covered = np.clip(high - low, 0.0, None) / (2.0 * half)
    return np.where(covered > 0.5, spall.depth, 0.0)

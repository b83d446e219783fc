"""Faults as kernel parameters, and their growth between blocks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.fault_parameters import (
    PATCH_FIELDS,
    PATCH_POINTS,
    PLACE_ARC_RADIUS,
    PLACE_AZIMUTH,
    PLACE_RADIUS,
    PLACE_REACH,
    PLACE_REPEATS,
    PLACE_SCALE,
    SPRING_FIELDS,
    DamageParams,
    FaultParams,
    SurfaceParams,
)
from beardyn_core.model.lamina_table import lamina_places
from beardyn_core.model.patch_path import PATH_CELLS, reach_of, roller_path
from beardyn_core.model.springs import for_springs
from beardyn_core.model.waviness_params import wave_params
from beardyn_core.scene.defect import Patch, RollerError, WornPocket
from beardyn_core.scene.scene import Scene

Float = NDArray[np.float64]

SURFACES = ("cup", "cone", "roller")

_SMALLEST_PART = 1.0e-9  # of a lamina


def fault_params(scene: Scene, arrangement: Arrangement, laminae: Float) -> FaultParams:
    """All faults at t = 0; what the scene does not have is ``None``."""
    cup, cone, roller = (surface_params(scene, on, arrangement) for on in SURFACES)
    cup_waves, cone_waves, roller_waves = (wave_params(scene, on, arrangement) for on in SURFACES)
    cup_damage, cone_damage = (
        None if ring is None and roller is None else damage_params(laminae, arrangement.width)
        for ring in (cup, cone)
    )
    return FaultParams(
        cup, cone, roller, cup_damage, cone_damage, cup_waves, cone_waves, roller_waves,
        pocket_wear(scene, arrangement),
    )  # fmt: skip


def patches_of(scene: Scene, on: str) -> list[Patch]:
    """Patches of one surface, in the order of the scene."""
    return [defect for defect in scene.defects if isinstance(defect, Patch) and defect.on == on]


def surface_params(scene: Scene, on: str, arrangement: Arrangement) -> SurfaceParams | None:
    """Patches of one surface; ``None`` without any."""
    patches = patches_of(scene, on)
    if not patches:
        return None
    count = scene.numerics.laminae
    places = np.zeros((len(patches), PATCH_FIELDS))
    present = np.zeros((arrangement.block_count, len(patches), arrangement.width))
    paths = np.zeros((len(patches), count, PATCH_POINTS))
    for index, patch in enumerate(patches):
        there = arrangement.row == patch.row
        if on == "roller":
            there = there & (arrangement.roller == patch.roller)
        present[:, index] = there
    cover = np.array([lamina_cover(scene.bearing, patch, count) for patch in patches])
    surface = SurfaceParams(places, present, cover, paths.reshape(-1))
    for index, patch in enumerate(patches):
        _write_patch(surface, index, patch, scene, 0.0)
    return surface


def grow(faults: FaultParams, scene: Scene, time: float) -> None:
    """Give growing patches their size at a time [s]; a function of the time alone."""
    for on, surface in zip(SURFACES, (faults.cup, faults.cone, faults.roller), strict=True):
        for index, patch in enumerate(patches_of(scene, on)):
            if surface is not None and patch.growth is not None:
                _write_patch(surface, index, patch, scene, time)


def _write_patch(surface: SurfaceParams, index: int, patch: Patch, scene: Scene, time: float) -> None:
    bearing, count = scene.bearing, scene.numerics.laminae
    size = patch.size_at(time)
    radii = (bearing.apex_distance + lamina_places(bearing, count)) * math.tan(bearing.half_angle)
    half_width = max(0.5 * size[0], 1e-9)
    reach = max(reach_of(half_width, size[2], patch.rim_width, radius) for radius in radii)
    repeats = bearing.roller_count if patch.kind == "brinelling" else 1
    radius = surface_radius(bearing, patch.on)
    place = surface.places[index]
    place[PLACE_AZIMUTH] = patch.azimuth
    place[PLACE_REPEATS] = repeats
    place[PLACE_RADIUS] = radius
    place[PLACE_ARC_RADIUS] = radius / repeats
    place[PLACE_REACH] = reach
    place[PLACE_SCALE] = PATH_CELLS / reach
    paths = surface.paths.reshape(-1, count, PATCH_POINTS)
    for lamina, roller_radius in enumerate(radii):
        paths[index, lamina, : PATH_CELLS + 1] = roller_path(patch, size, roller_radius, reach)


def surface_radius(bearing: Bearing, on: str) -> float:
    """Radius that turns an azimuth of cup, cone or roller into an arc at mid-length, [m]."""
    distance = bearing.apex_distance / math.cos(bearing.half_angle)
    angle = {"cup": bearing.cup_angle, "cone": bearing.cone_angle}
    return 0.5 * bearing.roller_diameter if on == "roller" else distance * math.sin(angle[on])


def lamina_cover(bearing: Bearing, patch: Patch, count: int) -> Float:
    """Share of the length of each lamina that a patch covers, shape [lamina], [-].

    A part that is rounding is none: the surface under it does not exist.
    """
    place = lamina_places(bearing, count)
    half = 0.5 * bearing.effective_length / count
    low = np.maximum(place - half, patch.offset - 0.5 * patch.length)
    high = np.minimum(place + half, patch.offset + 0.5 * patch.length)
    cover = np.clip((high - low) / (2.0 * half), 0.0, 1.0)
    cover[cover < _SMALLEST_PART] = 0.0
    cover[cover > 1.0 - _SMALLEST_PART] = 1.0
    return np.asarray(cover)


def damage_params(laminae: Float, width: int) -> DamageParams:
    """Lamina table twice over (sound and damaged springs) and work space for the springs."""
    springs = np.zeros((1, SPRING_FIELDS * 2 * laminae.shape[1], width))
    return DamageParams(for_springs(laminae), springs)


def pocket_wear(scene: Scene, arrangement: Arrangement) -> Float | None:
    """Half of the added clearance of each pocket, shape [block, 1, lane], [m]; ``None`` without wear."""
    worn = [defect for defect in scene.defects if isinstance(defect, WornPocket)]
    if not worn:
        return None
    added = np.zeros((2, arrangement.roller_count))
    for defect in worn:
        added[defect.row, defect.pocket] += 0.5 * defect.clearance
    return np.ascontiguousarray(arrangement.to_lanes(added)[:, None, :])


def roller_oversize(scene: Scene) -> Float:
    """Radius error of each roller, shape [row, roller], [m]."""
    error = np.zeros((2, scene.bearing.roller_count))
    for defect in scene.defects:
        if isinstance(defect, RollerError):
            error[defect.row, defect.roller] += 0.5 * defect.diameter
    return error

"""Skew and tilt of the rollers of the high-speed bearing against Zhao et al. (2026)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.choice import load_scene
from beardyn_core.effects import LineFilm, LoadSharingTraction, Rib, RibShearedFilm
from beardyn_core.rail.build import load_history
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

Float = NDArray[np.float64]
SETTLED_S = 0.16
RUN_S = 0.4
BINS = 36


@dataclass(frozen=True)
class Condition:
    """Load in kN, load eccentricity along the axle in mm, speed in rpm, lubricant temperature in deg C."""

    radial: float = 80.0
    axial: float = 15.0
    eccentricity: float = 0.0
    speed: float = 2000.0
    temperature: float = 70.0


@dataclass(frozen=True)
class Posture:
    """Means over azimuth classes, shape [row, class]: skew and tilt [mrad], load on the cup [N]."""

    azimuth: Float
    skew: Float
    tilt: Float
    load: Float


def scene_of(condition: Condition) -> Scene:
    """Put the condition on a bearing with play, free to tilt, with films that shear in raceways and ribs.

    Skew is a balance of rib and raceway friction, and temperature acts through the viscosity alone, so
    constant friction coefficients would leave out what two of the trends are about.
    """
    scene = load_scene("static_80kN")
    effects = replace(
        scene.effects,
        traction=LoadSharingTraction(film_traction="bair_winer", inlet_shear=True),
        film=LineFilm(isoviscous=True),
        rib=Rib(drilling=True, lubrication=RibShearedFilm()),
    )
    force = (0.0, 1e3 * condition.axial, 1e3 * condition.radial)
    # a force along z at y = e turns about x
    moment = (condition.eccentricity * condition.radial, 0.0, 0.0)
    return replace(
        scene,
        effects=effects,
        operation=ConstantOperation(force=force, moment=moment, speed=condition.speed * np.pi / 30.0),
        mounting=replace(scene.mounting, journal_tilt="free"),
        end_play=0.2e-3,
        temperature=273.15 + condition.temperature,
        duration=RUN_S,
    )


@lru_cache
def posture(condition: Condition) -> Posture:
    """Run a condition and average the rollers' attitude by azimuth."""
    scene = scene_of(condition)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, RUN_S, scene.seed))
    angles, skews, tilts, loads = [], [], [], []
    while twin.next_end_ns <= RUN_S * 1e9:
        block = twin.advance()
        if block.start_ns < SETTLED_S * 1e9:
            continue
        pose = block.body_pose[:, 4:].reshape(len(block.body_pose), 2, twin.roller_count, 7)
        x, y, z, w = np.moveaxis(pose[..., 3:], -1, 0)
        along = np.stack(
            [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=-1
        )  # body x axis
        angle = np.arctan2(pose[..., 0], pose[..., 2])
        outward = np.sin(angle) * along[..., 0] + np.cos(angle) * along[..., 2]
        ahead = np.cos(angle) * along[..., 0] - np.sin(angle) * along[..., 2]
        side = np.array([-1.0, 1.0])[:, None]
        angles.append(angle)
        skews.append(np.arcsin(ahead))
        tilts.append(np.arctan2(outward, side * along[..., 1]) - scene.bearing.contact_angle)
        loads.append(np.linalg.norm(block.contacts[:, :, :, 0, 3:6], axis=-1))
    return _by_azimuth(*(np.concatenate(part) for part in (angles, skews, tilts, loads)))


def _by_azimuth(angle: Float, skew: Float, tilt: Float, load: Float) -> Posture:
    index = np.floor((angle + np.pi) / (2 * np.pi) * BINS).astype(int) % BINS
    means = np.full((3, 2, BINS), np.nan)
    for row in range(2):
        for bin_ in range(BINS):
            chosen = index[:, row] == bin_
            if chosen.any():
                for part, values in enumerate((skew, tilt, load)):
                    means[part, row, bin_] = values[:, row][chosen].mean()
    centre = (np.arange(BINS) + 0.5) / BINS * 360.0 - 180.0
    return Posture(centre, 1e3 * means[0], 1e3 * means[1], means[2])

"""Skew and tilt of the rollers of the high-speed bearing against Zhao et al. (2026)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.choice import load_scene
from beardyn_core.choice.steady_heat import steady_heat
from beardyn_core.effects import Drag, EffectSet, LineFilm, RingStructure, Thermal
from beardyn_core.physics.slow_thermal import film_temperature
from beardyn_core.rail.build import load_history
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

Float = NDArray[np.float64]
SETTLED_S = 0.3
RUN_S = 1.0
BINS = 36

# What restrains the tilt of the cone against the cup, [N m/rad]. A rig holds the box in its frame and its
# shaft bends: E I / L of 130 mm clamped 0.3 m from the bearing is 9.6e6; the source does not draw its own.
RIG = 1.0e7
VEHICLE = Mounting().rotational_stiffness[0]
RIGID = 1.0e10
MOUNTED_PLAY = 2.0e-4
ROOM = 293.15
FRESH_FILL = 0.3


@dataclass(frozen=True)
class Condition:
    """Load, speed and temperature of a run, and what the bearing is held by and filled with."""

    radial: A[float, "[kN]"] = 80.0
    axial: A[float, "[kN]"] = 15.0
    eccentricity: A[float, "of the load along the axle, [mm]"] = 0.0
    speed: A[float, "[rpm]"] = 2000.0
    temperature: A[float, "of the lubricant, [deg C]"] = 70.0
    restraint: A[float, "of the tilt of the cone against the cup, [N m/rad]"] = RIG
    closes: A[bool, "end play follows the temperature; otherwise it is that of 70 deg C"] = True
    fresh: A[bool, "full of fresh grease instead of settled"] = False
    stiffer: A[float, "stiffness of cup and housing over that of a wall of 25 mm"] = 1.0


@dataclass(frozen=True)
class Posture:
    """Means over azimuth classes, shape [row, class]: skew and tilt [mrad], load on the cup [N]."""

    azimuth: Float
    skew: Float
    tilt: Float
    load: Float


@lru_cache
def closure_per_kelvin() -> float:
    """Work out how much the end play closes per kelvin of the lubricant above the room, [m/K].

    From the steady state in which the bearing heats itself at the source's mean load and highest speed. An
    oven would heat cup and cone alike and close nothing.
    """
    scene = _with_load(load_scene("static_80kN", effects="all"), Condition())
    effects = replace(scene.effects, thermal=Thermal(ambient=ROOM))
    warm = steady_heat(replace(scene, effects=effects, end_play=MOUNTED_PLAY, temperature=ROOM))
    return (MOUNTED_PLAY - warm.end_play) / (film_temperature(warm.temperature) - ROOM)


def end_play(condition: Condition) -> float:
    """Work out the end play of a condition, [m]."""
    temperature = condition.temperature if condition.closes else Condition().temperature
    return MOUNTED_PLAY - closure_per_kelvin() * (temperature + 273.15 - ROOM)


def scene_of(condition: Condition) -> Scene:
    """Put the condition on a bearing of grade G1 in a rig or an axlebox, with every effect on."""
    scene = _with_load(load_scene("static_80kN", effects="all"), condition)
    mounting = replace(
        scene.mounting,
        cup="suspended",
        journal_tilt="locked",
        rotational_stiffness=(condition.restraint,) * 3,
    )
    return replace(
        scene,
        effects=_effects(scene.effects, condition),
        mounting=mounting,
        end_play=end_play(condition),
        temperature=273.15 + condition.temperature,
        scatter=Scatter(grade="G1", seed=1),
        duration=RUN_S,
    )


def _with_load(scene: Scene, condition: Condition) -> Scene:
    force = (0.0, 1e3 * condition.axial, 1e3 * condition.radial)
    # a force along z at y = e turns about x
    moment = (condition.eccentricity * condition.radial, 0.0, 0.0)
    return replace(
        scene,
        operation=ConstantOperation(force=force, moment=moment, speed=condition.speed * np.pi / 30.0),
    )


def _effects(effects: EffectSet, condition: Condition) -> EffectSet:
    film, drag = effects.film or LineFilm(), effects.drag or Drag()
    if condition.fresh:
        film, drag = replace(film, supply="fresh"), replace(drag, fill=FRESH_FILL)
    usual = effects.structure if isinstance(effects.structure, RingStructure) else RingStructure()
    ring = replace(usual, stiffness_factor=condition.stiffer)
    return replace(effects, film=film, drag=drag, structure=ring)


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

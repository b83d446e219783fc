"""Slow warming next to the fast motion: temperatures advanced every 0.2 s, and what they change."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.thermal import PartTemperatures, play_change
from beardyn_core.effects import Thermal
from beardyn_core.physics.bodies.layout import ENERGY_LOST
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.physics.thermal import CONE_NODE, CUP_NODE, NODES, ROLLER_NODE, heat_shares, thermal_network
from beardyn_core.scene.scene import Scene

# Parameters are rebuilt when the film has warmed by this much or the play has moved that far.
_NOTICEABLE_WARMING = 0.02  # [K]
_NOTICEABLE_CLOSURE = 2.0e-8  # [m]
_LONGEST = 10  # blocks: as often as temperatures are recorded


@dataclass(frozen=True)
class Warmth:
    """Temperatures at some moment, and the energy that was lost until then."""

    temperature: Float  # [node], of `physics.thermal.NODES` [K]
    lost: Float  # [source], since the start of the run [J]
    film_temperature: float  # that the kernels work with now [K]
    play: float  # likewise: end play, or radial clearance of cylinders [m]


def film_temperature(temperature: Float) -> float:
    """Take the film's temperature, the mean of the surfaces that carry it into the contacts, [K]."""
    return float(0.5 * temperature[ROLLER_NODE] + 0.25 * (temperature[CUP_NODE] + temperature[CONE_NODE]))


def blocks_between(thermal: Thermal) -> int:
    """Count the blocks of 20 ms from one temperature to the next: fewer where heating is accelerated."""
    return max(1, round(_LONGEST / max(1.0, thermal.time_scale)))


def cold_start(scene: Scene) -> Warmth:
    """Set every part to the scene's temperature, or to its own when the scene gives them."""
    temperature = np.full(len(NODES), scene.temperature)
    if scene.temperatures is not None:
        parts = scene.temperatures
        temperature[[CUP_NODE, CONE_NODE, ROLLER_NODE]] = parts.cup, parts.cone, parts.rollers
    return Warmth(temperature, np.zeros(LOSSES), scene.temperature, scene.play)


def advance_temperatures(
    scene: Scene, thermal: Thermal, now: Warmth, energy: Float, shaft_speed: float, duration: float
) -> Warmth:
    """Advance the temperatures over some blocks.

    Parameters
    ----------
    now : Warmth
        At its beginning.
    energy : float64 array, shape [ENERGY_TERMS]
        At its end, [J].
    shaft_speed : float
        At their end, [rad/s].
    duration : float
        [s].

    Notes
    -----
    A source that gains energy meanwhile (a pocket bounce) takes its heat back.
    """
    lost = energy[ENERGY_LOST : ENERGY_LOST + LOSSES].copy()
    heat = (lost - now.lost) / duration @ heat_shares()
    network = thermal_network(
        scene.bearing, thermal, scene.mounting.box_mass, shaft_speed, scene.roller_total, scene.rows
    )
    temperature = network.after(now.temperature, heat, thermal.ambient, duration)
    start = cold_start(scene).temperature
    change = temperature - start
    play = scene.play + play_change(
        scene.bearing,
        PartTemperatures(change[CUP_NODE], change[CONE_NODE], change[ROLLER_NODE]),
        thermal.expansion,
    )
    film = scene.temperature + film_temperature(temperature) - film_temperature(start)
    if abs(film - now.film_temperature) < _NOTICEABLE_WARMING and abs(play - now.play) < _NOTICEABLE_CLOSURE:
        film, play = now.film_temperature, now.play
    return Warmth(temperature, lost, film, play)


def scene_at(scene: Scene, warmth: Warmth) -> Scene:
    """Give the scene film temperature and play as they are now."""
    return replace(scene.with_play(warmth.play), temperature=warmth.film_temperature)

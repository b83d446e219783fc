"""Slip of the cages under light loads.

The bearing runs with every effect at 3000 rpm, half as fast again as in service, in settled and in fresh
grease, with its end play as mounted and, to tell what the play does, without any. Nothing is fitted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Annotated as A

import numpy as np

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.effects import Cage, Drag, LineFilm
from beardyn_core.rail.build import load_history
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from evidence.validation.anchor import HOLDS_FROM, Finding, Trend, falls, rises

HARRIS = "Harris 1966, roller bearing at high speed, from memory"
DAWOUD = (
    "Dawoud, Beitler, Schwarze 2022, J. Tribol. 145(2), parts I and III, abstracts: measured on NU215 "
    "bearings under less than the minimum load"
)
GUO = (
    "Guo and Keller 2020, Tribol. Int., preprint, abstract: measured in the gearbox of a wind turbine, up to "
    "60 % in the loaded zone of cylindrical roller bearings"
)
CATALOGUE = "SKF 2018, Rolling bearings, minimum load of roller bearings"
RIGS = "cage skid on rigs"
MINIMUM_KN = 19.0  # 0.02 C
LOADS_KN = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, MINIMUM_KN, 80.0)
LIGHT_KN = 0.5
SPEED = 3000.0 * np.pi / 30.0
# A cage under a light load takes seconds to come to its slip; some loads leave it two to choose from.
ROLLING, STANDING = 1.0, 0.15
LONG_S, SHORT_S = 8.0, 3.0
LONG_KN = 1.0


@dataclass(frozen=True)
class Filling:
    """Grease and end play of a series of runs."""

    name: str
    supply: A[str, "of oil to the raceways"]
    fill: A[float, "part of the free space that grease fills, [-]"]
    end_play: A[float, "[m]"] = 2.0e-4


SETTLED = Filling("settled grease", "settled", 0.02)
FRESH = Filling("fresh grease", "fresh", 0.3)
CLOSED = Filling("settled grease without end play", "settled", 0.02, 0.0)
SERIES = (SETTLED, FRESH, CLOSED)
PRELOADED = Filling("settled grease, preloaded by 60 um", "settled", 0.02, -6e-5)
# Of the trends of rigs: a tenth of the minimum load, and speeds and temperatures beside those of the series.
RIG_KN = 2.0
RIG_SPEEDS_RPM = (1000.0, 2000.0, 3000.0)
RIG_CELSIUS = (40.0, 70.0, 100.0)


def scene_of(load: float, filling: Filling, start: float = ROLLING) -> Scene:
    """Put a radial load in kN on the bearing, its cages at a part of the rolling speed."""
    scene = load_scene("static_80kN", effects="all")
    old = scene.effects
    assert isinstance(old.cage, Cage)
    effects = replace(
        old,
        film=replace(old.film or LineFilm(), supply=filling.supply),
        drag=replace(old.drag or Drag(), fill=filling.fill),
        cage=replace(old.cage, initial_speed_ratio=start),
    )
    return replace(
        scene,
        effects=effects,
        operation=ConstantOperation(force=(0.0, 0.0, 1e3 * load), speed=SPEED),
        end_play=filling.end_play,
        duration=LONG_S if load <= LONG_KN else SHORT_S,
    )


@lru_cache
def slip(load: float, filling: Filling, start: float = ROLLING) -> float:
    """Run a load and average the slip of both cages over the last third, [-]."""
    return settled_slip(scene_of(load, filling, start))


def settled_slip(scene: Scene) -> float:
    """Run a scene to its end: 1 less the mean speed of both cages over rolling, in the last third."""
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, scene.duration, scene.seed))
    assert isinstance(scene.operation, ConstantOperation)
    rolling = cage_speed(scene.bearing, scene.operation.speed)
    ratios = []
    while twin.next_end_ns <= scene.duration * 1e9:
        block = twin.advance()
        if len(block.cage_speed):
            ratios.append(float(block.cage_speed.mean()) / rolling)
    return 1.0 - float(np.mean(ratios[-len(ratios) // 3 :]))


@lru_cache
def slip_at(
    filling: Filling, speed_rpm: float = RIG_SPEEDS_RPM[-1], celsius: float = RIG_CELSIUS[1]
) -> float:
    """Run the load of the rigs at a speed and a temperature, and average the slip as `slip` does, [-]."""
    scene = scene_of(RIG_KN, filling)
    operation = ConstantOperation((0.0, 0.0, 1e3 * RIG_KN), speed=speed_rpm * np.pi / 30.0)
    return settled_slip(replace(scene, operation=operation, temperature=celsius + 273.15))


def slips(filling: Filling) -> list[float]:
    """Return the slip under each of `LOADS_KN`, [-]."""
    return [slip(load, filling) for load in LOADS_KN]


def percent(values: list[float]) -> str:
    """Write slips as text, in %."""
    return ", ".join(f"{100.0 * value:.1f}" for value in values) + " %"


def falls_with_load() -> Finding:
    """Check that slip falls with load in both greases, and from which load on it does."""
    light = [load for load in LOADS_KN if load <= LIGHT_KN]
    return Finding(
        all(falls(slips(filling)) for filling in (SETTLED, FRESH)),
        f"Slip under {', '.join(f'{load:g}' for load in LOADS_KN)} kN: "
        + "; ".join(f"{percent(slips(filling))} with {filling.name}" for filling in SERIES)
        + f". Where the cages start at {STANDING:g} of the rolling speed, up to {LIGHT_KN:g} kN: "
        f"{percent([slip(load, SETTLED, STANDING) for load in light])} with {SETTLED.name}.",
    )


def size_at_light_load() -> Finding:
    """Check that the slip at light load is 10 to 60 %."""
    light = {
        filling: [slip(load, filling) for load in LOADS_KN if load <= LIGHT_KN]
        for filling in (SETTLED, FRESH)
    }
    return Finding(
        all(0.1 <= found <= 0.6 for values in light.values() for found in values),
        f"Slip up to {LIGHT_KN:g} kN: "
        + "; ".join(f"{percent(found)} with {filling.name}" for filling, found in light.items())
        + ".",
    )


def none_from_the_minimum_load_on() -> Finding:
    """Check that cages in settled grease do not slip under the least load that catalogues ask for."""
    found = {filling: slip(MINIMUM_KN, filling) for filling in SERIES}
    return Finding(
        max(abs(found[filling]) for filling in (SETTLED, CLOSED)) < HOLDS_FROM,
        f"Slip under {MINIMUM_KN:g} kN: "
        + "; ".join(f"{100.0 * value:.1f} % with {filling.name}" for filling, value in found.items())
        + ". Figures of catalogues are taken for grease that has settled.",
    )


def none_at_rated_load() -> Finding:
    """Check that no slip is left under the heaviest load."""
    heavy = {filling: slip(LOADS_KN[-1], filling) for filling in (SETTLED, FRESH)}
    return Finding(
        max(abs(value) for value in heavy.values()) < HOLDS_FROM,
        f"Slip under {LOADS_KN[-1]:g} kN: "
        + "; ".join(f"{100.0 * value:.2f} % with {filling.name}" for filling, value in heavy.items())
        + ".",
    )


def rises_with_speed() -> Finding:
    """Check that slip under less than the minimum load rises with the speed."""
    found = [slip_at(SETTLED, speed_rpm=speed) for speed in RIG_SPEEDS_RPM]
    return Finding(
        rises(found),
        f"Slip under {RIG_KN:g} kN at {', '.join(f'{speed:g}' for speed in RIG_SPEEDS_RPM)} rpm: "
        f"{percent(found)} with {SETTLED.name}.",
    )


def rises_with_oil() -> Finding:
    """Check that slip under less than the minimum load rises with the oil that the bearing holds."""
    found = [slip_at(filling) for filling in (SETTLED, FRESH)]
    return Finding(
        rises(found),
        f"Slip under {RIG_KN:g} kN at {RIG_SPEEDS_RPM[-1]:g} rpm: {100.0 * found[0]:.1f} % with "
        f"{SETTLED.name}, {100.0 * found[1]:.1f} % with {FRESH.name}.",
    )


def none_with_preload() -> Finding:
    """Check that rollers which are all pressed let no cage slip."""
    preloaded, closed = slip_at(PRELOADED), slip_at(CLOSED)
    return Finding(
        abs(preloaded) < HOLDS_FROM < closed,
        f"Slip under {RIG_KN:g} kN at {RIG_SPEEDS_RPM[-1]:g} rpm: {100.0 * preloaded:.1f} % with "
        f"{PRELOADED.name}, {100.0 * closed:.1f} % with {CLOSED.name}.",
    )


def falls_with_temperature() -> Finding:
    """Check that slip falls as the oil warms, in both greases."""
    found = {
        filling: [slip_at(filling, celsius=celsius) for celsius in RIG_CELSIUS]
        for filling in (SETTLED, FRESH)
    }
    return Finding(
        all(falls(values) for values in found.values()),
        f"Slip under {RIG_KN:g} kN at {RIG_SPEEDS_RPM[-1]:g} rpm, "
        f"{', '.join(f'{celsius:g}' for celsius in RIG_CELSIUS)} °C: "
        + "; ".join(f"{percent(values)} with {filling.name}" for filling, values in found.items())
        + ".",
    )


TWO_STATES = (
    "up to 0.2 kN the cages of settled grease may roll or slip, by their start, and a heavier load can find "
    "them slipping where a lighter one did not; churning leaves one state, and with fresh grease it falls"
)
CHURNED = (
    "churning of fresh grease brakes more than light loads drive; settled, which takes that away, it is 35 "
    "to 54 % where the cages slip, and 7 % in the other state, near rolling"
)
WARM = (
    "both greases do the reverse, and no cause was found: as oil thins it brakes less and drives less, and "
    "the rollers of that gearbox stand in another oil and under other loads, which the abstract does not tell"
)
TRENDS = (
    Trend(
        "cage skid",
        "cage slip falls with load",
        HARRIS,
        falls_with_load,
        misses=TWO_STATES,
        picture="skid.png",
    ),
    Trend(
        "cage skid",
        "cage slip is 10 to 60 % below a few hundred newtons",
        HARRIS,
        size_at_light_load,
        misses=CHURNED,
    ),
    Trend("cage skid", "cages do not slip from 0.02 C on", CATALOGUE, none_from_the_minimum_load_on),
    Trend("cage skid", "cage slip goes to zero at service load", HARRIS, none_at_rated_load),
    Trend(RIGS, "cage slip rises with the speed", DAWOUD, rises_with_speed),
    Trend(RIGS, "cage slip rises with the flow of oil", DAWOUD, rises_with_oil),
    Trend(RIGS, "cages of bearings that are preloaded do not slip", DAWOUD, none_with_preload),
    Trend(RIGS, "cage slip falls as the oil warms", GUO, falls_with_temperature, misses=WARM),
)

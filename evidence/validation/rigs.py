"""Torque of single rows of tapered rollers on rigs, as others measured it.

Speeds, loads, oil and tolerances were written before the first run. Ours is the torque by source of the
static equilibrium, `beardyn_core.choice.steady_heat.torque_by_source`, of one row with every effect of the
reference, in an oil bath: a flooded inlet, no seals, and no churning, which both sources kept small or
subtracted. Not known of either bearing, and taken as shipped: the height of the rib contact, the sphere of
the roller end and the profile of the rollers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Annotated as A

from scipy.optimize import brentq

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.choice import load_scene
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.steady_heat import torque_by_source
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.effects import LineFilm, Rib, RibMixedFilm
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from evidence.validation.anchor import Anchor
from evidence.validation.losses import RPM, bearing_32216

TOPIC = "torque on a rig"
READ = "measured, read from a figure (by github.com/sckim-ai/TRB)"
COMBINED = f"Wingertszahn et al. 2023, Lubricants 11:369, Fig. 6, {READ}; FVA 3, oil bath"
GHENT = (
    f"Manjunath et al. 2023, Machines 11:801, Fig. 13, {READ}; FVA 3A, inside of the 32008 from Liu et al. "
    "2022, Lubricants 10:154, Table 1"
)
# As of the rows of the same bearing under thrust alone: two digits of a figure, and a part of the geometry.
COMBINED_TOLERANCE = 0.15
# Two digits of a figure, the inside of another maker's bearing, and ribs of unknown roughness.
GHENT_TOLERANCE = 0.25


# Of the 32008: 0.3 l/min, as the source says, of mineral oil, 1.9 kJ/kgK, [W/K].
OIL_FLOW = 0.3e-3 / 60.0 * 884.1 * 1.9e3


@dataclass(frozen=True)
class Rig:
    """One row under a load in oil of a temperature."""

    bearing: Bearing
    oil: Lubricant
    temperature: A[float, "[K]"]
    axial: A[float, "[N]"]
    radial: A[float, "[N]"] = 0.0
    supply: A[str, "of oil to the raceways"] = "flooded"
    rib_film_friction: A[float, "coefficient of friction of the film at the ribs"] = (
        RibMixedFilm().film_friction
    )


def scene_of(rig: Rig, speed_rpm: float) -> Scene:
    """Put one row on its rig, with the effects of the reference that it has."""
    scene = load_scene("static_80kN", effects="all")
    film = replace(scene.effects.film or LineFilm(), supply=rig.supply)
    rib = scene.effects.rib or Rib()
    assert isinstance(rib.lubrication, RibMixedFilm)
    rib = replace(rib, lubrication=replace(rib.lubrication, film_friction=rig.rib_film_friction))
    effects = replace(scene.effects, film=film, rib=rib, drag=None, seal=None, structure=None)
    force = (0.0, rig.axial, rig.radial)
    return replace(
        scene,
        bearing=rig.bearing,
        lubricant=rig.oil,
        temperature=rig.temperature,
        rows=1,
        end_play=0.0,
        effects=effects,
        operation=ConstantOperation(force=force, speed=speed_rpm * RPM),
    )


@cache
def sources(rig: Rig, speed_rpm: float) -> dict[str, float]:
    """Work out the torque by source, [N m]."""
    scene = scene_of(rig, speed_rpm)
    return torque_by_source(scene, circumstances(scene).typical)


def torque(rig: Rig, speed_rpm: float) -> float:
    """Work out the torque, [N m]."""
    return sum(sources(rig, speed_rpm).values())


def warmed(rig: Rig, speed_rpm: float, measured: float) -> Rig:
    """Warm the oil by half of what its flow carries away of a measured torque, [N m]."""
    return replace(rig, temperature=rig.temperature + 0.5 * measured * speed_rpm * RPM / OIL_FLOW)


@cache
def combined(celsius: float) -> Rig:
    """Build the 32216 under 6.5 kN axial and 6 kN radial; roughness as in Table 2 of the source."""
    bearing = replace(bearing_32216()[0], raceway_roughness=0.16e-6, rib_roughness=0.24e-6)
    return Rig(bearing, load_lubricant("FVA3"), celsius + 273.15, 6.5e3, 6e3)


@cache
def ghent(supplied: float) -> Rig:
    """Build the 32008 under 12.85 kN axial, oil supplied at some deg C.

    The source gives the viscosity at which its bearing ran, below the supply: 70.11 and 56.90 mm2/s.
    """
    oil = replace(
        load_lubricant("FVA3"),
        name="FVA3A",
        kinematic_viscosity_40=90.02e-6,
        kinematic_viscosity_100=10.41e-6,
        density=884.1,
        pressure_viscosity=2.16e-8,
        pressure_viscosity_temperature=298.15,
    )
    running = {55.0: 70.11e-6, 65.0: 56.90e-6}[supplied]
    temperature = brentq(lambda warm: oil.kinematic_viscosity(warm) - running, 293.15, 373.15)
    return Rig(bearing_32008(), oil, float(temperature), 12.85e3)


def bearing_32008() -> Bearing:
    """Build Z 23, rollers of 6.131 to 6.846 mm and 13.66 mm, 0.1949 and 0.2473 rad, closed on one apex."""
    roller = 0.5 * (6.131e-3 + 6.846e-3)
    angle, half = 0.5 * (0.2473 + 0.1949), 0.5 * (0.2473 - 0.1949)
    return replace(
        load_bearing("HS130x230"),
        name="32008",
        roller_count=23,
        pitch_diameter=roller / math.tan(half) * math.sin(angle),
        roller_diameter=roller,
        effective_length=13.66e-3,
        roller_length=13.66e-3 + 0.6e-3,
        contact_angle=angle,
        row_spacing=25e-3,
        rib_contact_height=0.7e-3,
        rib_height=1.4e-3,
        rib_undercut=0.3e-3,
        roller_chamfer=0.2e-3,
        small_rib_height=0.7e-3,
        bore=40e-3,
        outer_diameter=68e-3,
        width=45e-3,
        nominal_cup_angle=None,
        nominal_cone_angle=None,
    )


# deg C, rpm, N m
COMBINED_TORQUES = (
    (50.0, 500.0, 1.50),
    (50.0, 1000.0, 1.95),
    (50.0, 2000.0, 2.50),
    (50.0, 4000.0, 3.25),
    (42.0, 500.0, 2.00),
    (42.0, 1000.0, 2.65),
    (42.0, 2000.0, 3.50),
    (42.0, 4000.0, 4.45),
)
# rpm, N m with oil supplied at 55 and at 65 deg C
GHENT_TORQUES = (
    (200.0, 0.62, 0.83),
    (400.0, 0.48, 0.42),
    (600.0, 0.63, 0.45),
    (1000.0, 0.97, 0.77),
    (1400.0, 1.03, 0.82),
    (1800.0, 1.05, 0.90),
    (2200.0, 1.07, 0.95),
)
FLOODED = "the flooded inlet: with as little oil as fresh grease leaves ours is "
WARMER = (
    "one viscosity is given for all speeds: warmed by half of what the oil's 0.3 l/min carry away of the "
    "measured torque ours is "
)
RIB_FILM = "friction of the film at the ribs, 0.01 by assumption: with the source's 0.002 ours is "
# Each by a run that removes the cause, in test_causes.
COMBINED_MISSES = {
    (50.0, 1000.0): FLOODED + "13 % above",
    (50.0, 2000.0): FLOODED + "10 % above",
    (50.0, 4000.0): FLOODED + "14 % below",
    (42.0, 1000.0): FLOODED + "5 % below",
    (42.0, 2000.0): FLOODED + "17 % below, so the rig lies between",
}
GHENT_MISSES = {
    (
        65.0,
        200.0,
    ): "the height of the rib contact is not stated: with 1.3 mm instead of 0.7 ours is 23 % below, but then "
    "56 % above at 400 rpm; no cause was found that serves both",
    (55.0, 400.0): RIB_FILM + "10 % above",
    (65.0, 400.0): RIB_FILM + "16 % above",
    (
        65.0,
        600.0,
    ): "no cause was found: rolling without ribs is 25 % above; from 55 to 65 °C the source falls by "
    "29 % here, by 11 to 21 % at its other speeds from 400 rpm on",
    (65.0, 1400.0): WARMER + "11 % above",
    (55.0, 1800.0): WARMER + "1 % below",
    (65.0, 1800.0): WARMER + "9 % above",
    (55.0, 2200.0): WARMER + "2 % above",
    (65.0, 2200.0): WARMER + "8 % above",
}

ANCHORS = (
    *(
        Anchor(
            TOPIC,
            f"32216 under 6.5 kN axial and 6 kN radial, {celsius:g} °C, {speed:g} rpm",
            measured,
            "N m",
            COMBINED,
            partial(lambda celsius, speed: torque(combined(celsius), speed), celsius, speed),
            tolerance=COMBINED_TOLERANCE,
            misses=COMBINED_MISSES.get((celsius, speed), ""),
            measured=True,
        )
        for celsius, speed, measured in COMBINED_TORQUES
    ),
    *(
        Anchor(
            TOPIC,
            f"32008 under 12.85 kN axial, oil supplied at {supplied:g} °C, {speed:g} rpm",
            measured,
            "N m",
            GHENT,
            partial(lambda supplied, speed: torque(ghent(supplied), speed), supplied, speed),
            tolerance=GHENT_TOLERANCE,
            misses=GHENT_MISSES.get((supplied, speed), ""),
            measured=True,
        )
        for speed, *both in GHENT_TORQUES
        for supplied, measured in zip((55.0, 65.0), both, strict=True)
    ),
)

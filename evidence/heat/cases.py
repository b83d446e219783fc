"""Scenes of the tables: speeds, states of the bearing, and every assumed input varied."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated as A
from typing import Any

from beardyn_core.choice import load_scene
from beardyn_core.choice.load_cases import LoadCase
from beardyn_core.choice.steady_heat import SteadyHeat, steady_heat, torque_by_source
from beardyn_core.config import load_bearing
from beardyn_core.effects import Drag, LineFilm, Rib, Seal, Thermal
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from evidence.heat.published import COEFFICIENTS, AxleResistance, Resistance
from evidence.heat.skf import axlebox_moment

SPEEDS_KMH = (80.0, 200.0, 300.0)
LOAD = 80e3
MOUNTED_PLAY = 1.0e-4
AMBIENT, SUMMER = 293.15, 313.15
WHEEL = 0.92


@dataclass(frozen=True)
class State:
    """A state of bearing, grease and surroundings."""

    name: str
    end_play: A[float, "as mounted, [m]"] = MOUNTED_PLAY
    supply: A[str, "of oil to the raceways"] = "settled"
    fill: A[float | None, "grease where the rollers run, by default that of a settled grease"] = None
    seal_torque: A[float | None, "of one seal, [N m]"] = None
    dry_rib: A[float | None, "coefficient of friction of ribs without a film"] = None
    thermal: A[tuple[tuple[str, float], ...], "options of the thermal network that differ"] = ()


HEALTHY = State("healthy")
FRESH = State("freshly greased", supply="fresh", fill=0.1)
OVERGREASED = State("overgreased", supply="fresh", fill=0.3)
PRELOADED = State("preloaded by 60 um", end_play=-6.0e-5)
CHANNELLED = State("channelled", supply="channelled")
STARVED = State("starved: channelled, dry ribs", supply="channelled", dry_rib=0.1)
RUBBING = State("rubbing seals", seal_torque=1.2)
CLEARANCE = State("clearance seals", seal_torque=0.0)
SPEED_OF_LIESER = 160.0 / 0.621371  # of 160 mph, [km/h]
STATES = (HEALTHY, FRESH, OVERGREASED, PRELOADED, CHANNELLED, STARVED)
VARIED = (
    HEALTHY,
    State("no end play", end_play=0.0),
    State("end play 0.2 mm", end_play=2.0e-4),
    State("flooded", supply="flooded"),
    State("fill 0.5 %", fill=0.005),
    State("fill 5 %", fill=0.05),
    State("seals 0.05 N m each", seal_torque=0.05),
    State("seals 1.2 N m each", seal_torque=1.2),
    State("air at 10 % of the train's speed", thermal=(("air_speed", 0.1),)),
    State("air at 60 %", thermal=(("air_speed", 0.6),)),
    State("box surface 0.4 m2", thermal=(("box_area", 0.4),)),
    State("box surface 0.8 m2", thermal=(("box_area", 0.8),)),
    State("axle 10 W/m2K", thermal=(("axle_heat_transfer", 10.0),)),
    State("axle 60 W/m2K", thermal=(("axle_heat_transfer", 60.0),)),
    State("still air 12 W/m2K", thermal=(("still_air", 12.0),)),
    State("roller contacts 2 W/K", thermal=(("contact_conductance", 2.0),)),
    State("seat gap 60 um", thermal=(("seat_gap", 6.0e-5),)),
    State("air of 40 °C", thermal=(("ambient", SUMMER),)),
)


def scene_of(
    state: State,
    speed_kmh: float,
    *,
    force: tuple[float, float, float] = (0.0, 0.0, LOAD),
    bearing: str = "HS130x230",
    **thermal: Any,
) -> Scene:
    """Build the scene of a state at a speed of the train, with every effect on."""
    scene = load_scene("static_80kN", effects="all")
    options = Thermal(**{"ambient": AMBIENT, "wheel_diameter": WHEEL, **dict(state.thermal), **thermal})
    fill = Drag().fill if state.fill is None else state.fill
    torque = Seal().torque if state.seal_torque is None else state.seal_torque
    rib = scene.effects.rib or Rib()
    if state.dry_rib is not None:
        rib = replace(rib, lubrication=None, friction=state.dry_rib)
    effects = replace(
        scene.effects,
        rib=rib,
        film=replace(scene.effects.film or LineFilm(), supply=state.supply),
        drag=replace(scene.effects.drag or Drag(), fill=fill),
        seal=replace(scene.effects.seal or Seal(), torque=torque),
        thermal=options,
    )
    speed = speed_kmh / 3.6 / (0.5 * options.wheel_diameter)
    return replace(
        scene,
        bearing=load_bearing(bearing),
        effects=effects,
        end_play=state.end_play,
        temperature=AMBIENT,
        operation=ConstantOperation(force=force, speed=speed),
    )


@cache
def steady(state: State, speed_kmh: float) -> SteadyHeat:
    """Find the steady temperatures of a state at a speed."""
    return steady_heat(scene_of(state, speed_kmh))


@cache
def of_car(car: Resistance) -> SteadyHeat:
    """Find the steady state of a bearing under the load and at the speed of a car."""
    force = (0.0, 0.0, car.load)
    return steady_heat(scene_of(HEALTHY, car.speed_kmh, force=force, wheel_diameter=car.wheel_diameter))


@cache
def of_class_k(axle: AxleResistance, seal_torque: float | None = None) -> SteadyHeat:
    """Find the steady state of a bearing of AAR class K under the load and at the speed of an axle."""
    state = State(axle.name, seal_torque=axle.seal_torque if seal_torque is None else seal_torque)
    return steady_heat(
        scene_of(
            state,
            axle.speed_kmh,
            force=(0.0, 0.0, axle.load),
            bearing="AARK_6.5x9",
            wheel_diameter=axle.wheel_diameter,
        )
    )


NTN_STATE = State("on the rig of NTN")
NTN_LIGHT = State("likewise, little grease, light seals", supply="channelled", fill=0.005, seal_torque=0.05)


@cache
def on_the_rig(state: State) -> SteadyHeat:
    """Find the steady state of a bearing on NTN's rig."""
    return steady_heat(rig_scene(state))


def rig_scene(state: State) -> Scene:
    """Build the scene of a bearing of 120 x 220 on NTN's rig: 2216 rpm, air of 10 m/s."""
    wheel = 330.0 / 3.6 / (2216.0 / 60.0) / math.pi
    return scene_of(
        state,
        330.0,
        force=(0.0, 13.6e3, 68.3e3),
        bearing="METRO120x220",
        wheel_diameter=wheel,
        air_speed=10.0 / (330.0 / 3.6),
    )


def all_states() -> Iterator[tuple[State, float, SteadyHeat]]:
    """Solve every state at every speed."""
    for state in STATES:
        for speed in SPEEDS_KMH:
            yield state, speed, steady(state, speed)


@dataclass(frozen=True)
class TorquePoint:
    """Torque of the mounted bearing under 80 kN at one temperature and speed, beside SKF's, [N m]."""

    temperature_c: float
    speed_rpm: float
    contacts: A[dict[str, float], "ours without seals, churning and pockets, by supply"]
    whole: A[dict[str, float], "ours with all sources, by supply"]
    catalogue: A[float, "SKF, half of the load on each row"]
    catalogue_induced: A[float, "SKF with the thrust that the rows induce in each other"]


def published_band() -> tuple[float, float]:
    """Return the least and largest torque that the published coefficients give the bearing, [N m]."""
    radius = 0.5 * load_bearing("HS130x230").bore
    return min(COEFFICIENTS) * LOAD * radius, max(COEFFICIENTS) * LOAD * radius


TEMPERATURES_C = (-20.0, 0.0, 20.0, 40.0, 70.0, 100.0)
SPEEDS_RPM = (300.0, 600.0, 1165.0, 2000.0)
SUPPLIED = ("channelled", "settled", "fresh", "flooded")
_CONTACTS = ("rolling_resistance", "rib", "raceway_sliding")


def torque_without_stiffening(temperature_c: float, speed_rpm: float) -> float:
    """Compute the torque of all sources with settled grease and seals that no cold makes stiffer, [N m]."""
    scene = replace(scene_of(HEALTHY, 200.0), temperature=temperature_c + 273.15)
    assert scene.effects.seal is not None
    seal = replace(scene.effects.seal, viscosity_exponent=0.0)
    case = LoadCase("typical", (0.0, 0.0, LOAD), (0.0, 0.0, 0.0), speed_rpm * math.pi / 30.0)
    return sum(torque_by_source(replace(scene, effects=replace(scene.effects, seal=seal)), case).values())


@cache
def torque_point(temperature_c: float, speed_rpm: float) -> TorquePoint:
    """Work out the torque of ours by supply, and of the catalogue."""
    contacts, whole = {}, {}
    speed = speed_rpm * math.pi / 30.0
    scene = replace(scene_of(HEALTHY, 200.0), temperature=temperature_c + 273.15)
    for supply in SUPPLIED:
        effects = replace(scene.effects, film=replace(scene.effects.film or LineFilm(), supply=supply))
        case = LoadCase("typical", (0.0, 0.0, LOAD), (0.0, 0.0, 0.0), speed)
        found = torque_by_source(replace(scene, effects=effects), case)
        contacts[supply] = sum(found[name] for name in _CONTACTS)
        whole[supply] = sum(found.values())
    viscosity = 1e6 * scene.lubricant.kinematic_viscosity(scene.temperature)
    return TorquePoint(
        temperature_c,
        speed_rpm,
        contacts,
        whole,
        axlebox_moment(LOAD, speed_rpm, viscosity).total,
        axlebox_moment(LOAD, speed_rpm, viscosity, induced=True).total,
    )


def torque_grid() -> Iterator[TorquePoint]:
    """Work out the torque at every temperature and speed."""
    for temperature in TEMPERATURES_C:
        for speed in SPEEDS_RPM:
            yield torque_point(temperature, speed)

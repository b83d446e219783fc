"""Steady temperatures without a run: balances, and the run itself."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

import beardyn_core as bd
from beardyn_core.base.errors import ValidityError
from beardyn_core.choice import load_scene
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.steady_heat import HOTTEST, SteadyHeat, steady_heat, torque_by_source
from beardyn_core.effects import Thermal
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.thermal import NODES, thermal_network
from beardyn_core.rail.build import load_history
from beardyn_core.scene.defect import MissingRoller
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.study import desk_run
from beardyn_core.twin import Twin
from test.examples import fast_ones

RPM = math.pi / 30.0


def at(speed_rpm: float, end_play: float = 1e-4, thermal: Thermal | None = None) -> Scene:
    scene = load_scene("static_80kN", effects="all")
    operation = ConstantOperation(force=(0.0, 0.0, 80e3), speed=speed_rpm * RPM)
    effects = replace(scene.effects, thermal=thermal or Thermal())
    return replace(scene, effects=effects, end_play=end_play, temperature=293.15, operation=operation)


def carried_off(scene: Scene, found: SteadyHeat) -> float:
    assert scene.effects.thermal is not None
    network = thermal_network(
        scene.bearing, scene.effects.thermal, scene.mounting.box_mass, found.speed, scene.roller_total
    )
    return float((found.temperature - found.ambient) @ network.to_ambient)


@pytest.mark.parametrize("speed_rpm", fast_ones([400.0, 1165.0], 1))
def test_all_that_friction_loses_leaves_to_the_air(speed_rpm: float) -> None:
    scene = at(speed_rpm)
    found = steady_heat(scene)
    assert found.settles
    assert carried_off(scene, found) == pytest.approx(found.power, rel=2e-3)
    assert set(found.torque) <= set(LOSS_NAMES)
    # heat comes from inside: cone and rollers are warmer than the cup, the cup than its box
    assert found.rise("cone") > found.rise("cup") > found.rise("axlebox") > 0.0
    assert found.end_play < scene.end_play


def test_it_warms_with_speed_and_cools_with_air() -> None:
    rises = [steady_heat(at(speed)).rise("axlebox") for speed in (400.0, 1165.0)]
    assert rises == sorted(rises)
    still, windy = (steady_heat(at(1165.0, thermal=Thermal(air_speed=share))) for share in (0.1, 0.6))
    assert still.rise("axlebox") > 1.5 * windy.rise("axlebox")


def test_a_bearing_that_closes_up_runs_away_and_is_told() -> None:
    """Hardly any heat leaves: the oil thins and the play closes until something is as hot as 200 °C."""
    lost = Thermal(air_speed=0.0, still_air=1.0, axle_heat_transfer=0.5)
    found = steady_heat(at(1750.0, -1e-4, lost))
    assert not found.settles
    assert found.temperature.max() >= HOTTEST


@pytest.mark.slow
def test_python_asks_for_it_by_the_name_of_a_scene() -> None:
    """The scene's end play is that at its 70 °C, and all parts start from there."""
    found = bd.steady_heat("static_80kN", effects="all")
    assert found.rise("axlebox") == pytest.approx(steady_heat(at(1165.0, 0.0)).rise("axlebox"), rel=1e-6)
    assert found.power == pytest.approx(sum(found.torque.values()) * 1165.0 * RPM)


def test_a_load_without_equilibrium_is_an_error() -> None:
    scene = at(1165.0)
    places = [(row, roller) for row in (0, 1) for roller in range(scene.bearing.roller_count)]
    gone = replace(scene, missing_rollers=tuple(MissingRoller(*place) for place in places))
    with pytest.raises(ValidityError, match="no static equilibrium"):
        steady_heat(gone)


@pytest.mark.slow
def test_torque_by_source_is_that_of_a_run() -> None:
    scene = replace(load_scene("static_80kN", effects="all"), duration=0.4)
    ours = torque_by_source(scene, circumstances(scene).typical)
    budget = desk_run.run(scene).budget
    assert budget is not None
    lost = {share.source: share.torque for share in budget.shares}
    assert sum(ours.values()) == pytest.approx(sum(lost.values()), rel=0.05)
    for name in ("rolling_resistance", "rib", "seal", "drag"):
        assert ours[name] == pytest.approx(lost[name], rel=0.05), name


@pytest.mark.slow
def test_temperatures_are_those_that_a_run_comes_to() -> None:
    """A run that warms 20 000 times as fast as it turns, over five time constants of the axlebox.

    It comes 15 % higher: cages that are knocked about squeeze the films of their pockets, which no static
    load tells of: 0.45 N m of 5.6 here.
    """
    scene = at(1165.0)
    assert scene.effects.thermal is not None
    expected = steady_heat(scene)
    quick = replace(scene.effects, thermal=replace(scene.effects.thermal, time_scale=2e4))
    run = replace(scene, effects=quick, duration=0.8)
    twin = Twin(run)
    twin.start(load_history(run.operation, run.mounting, run.duration, run.seed))
    block = twin.advance()
    while twin.next_end_ns <= run.duration * 1e9:
        block = twin.advance()
    assert block.temperature is not None
    for node, name in enumerate(NODES):
        if name == "cages":
            continue  # which the pockets warm
        assert block.temperature[node] - 293.15 == pytest.approx(expected.rise(name), rel=0.2), name

"""Intervals of steady temperatures: how inputs add, which are varied, and that runaways are no number."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.choice.heat_interval import RANGES, HeatInterval, VariedInput, heat_interval
from beardyn_core.choice.steady_heat import SteadyHeat
from beardyn_core.effects import EffectSet, Seal, Thermal
from beardyn_core.physics.thermal import NODES
from beardyn_core.scene.scene import Scene


def steady_at(rise: float, settles: bool = True) -> SteadyHeat:
    return SteadyHeat(np.full(len(NODES), 293.15 + rise), 293.15, 1e-4, {"seal": 1.0}, 100.0, settles)


def varied(low: float, high: float, settles: bool = True) -> VariedInput:
    return VariedInput("seal", "torque", (0.0, 1.0), (steady_at(low), steady_at(high, settles)))


def test_logarithms_of_the_ratios_add_by_their_squares() -> None:
    found = HeatInterval(steady_at(20.0), (varied(10.0, 40.0), varied(40.0, 10.0), varied(20.0, 20.0)))
    least, usual, most = found.rise("axlebox")
    assert usual == pytest.approx(20.0)
    assert most / usual == pytest.approx(2.0 ** math.sqrt(2.0))
    assert usual / least == pytest.approx(most / usual)
    assert found.warm_from(313.15) == pytest.approx(313.15 + most)


def test_an_input_that_makes_the_bearing_run_away_leaves_no_upper_end() -> None:
    found = HeatInterval(steady_at(20.0), (varied(10.0, 90.0, settles=False),))
    assert found.rise("cup")[:2] == pytest.approx((10.0, 20.0))
    assert found.rise("cup")[2] == math.inf
    assert HeatInterval(steady_at(90.0, settles=False), ()).rise("cup")[2] == math.inf


def test_only_effects_of_the_scene_and_the_surroundings_are_varied(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[EffectSet] = []

    def record(scene: Scene) -> SteadyHeat:
        asked.append(scene.effects)
        return steady_at(20.0)

    monkeypatch.setattr("beardyn_core.choice.heat_interval.steady_heat", record)
    scene = load_scene("static_80kN", effects="dry")
    scene = replace(scene, effects=replace(scene.effects, seal=Seal(), film=None, drag=None))
    names = {(each.effect, each.option) for each in heat_interval(scene).inputs}
    assert names == {("seal", "torque"), *(("thermal", option) for option in RANGES["thermal"])}
    assert len(asked) == 1 + 2 * len(names)
    assert {effects.seal.torque for effects in asked if effects.seal} == {Seal().torque, 0.05, 1.2}
    air = {effects.thermal.air_speed for effects in asked if effects.thermal}
    assert air == {0.1, 0.6, Thermal().air_speed}

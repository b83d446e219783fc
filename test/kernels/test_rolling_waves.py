"""Waviness as the fast tiers look it up: the same gaps as of the waves, in tables of other forms."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import POCKET_ANGLE
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.rolling_waves import MOST_POINTS, highest_wave, rolling_wave_params
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.waviness import Waviness, band_amplitudes
from test.kernels.casting import Float, through
from test.kernels.fault_entries import massless_rollers, pairs_in_table, rolling_gaps, waves_on_cone
from test.kernels.rig import parameters_of
from test.scenes import scene_with

Z = 17
SHARE = 0.9
ORDERS = tuple(range(2, 41))


def waved(width: int, *waves: Waviness) -> Parameters:
    """A bearing whose pockets stand unevenly."""
    scene = replace(scene_with(None), waviness=waves, scatter=Scatter(seed=3, pocket_place=2e-5))
    return parameters_of(scene, width)


def wave_on(surface: str, seed: int) -> Waviness:
    return Waviness(surface, 0, ORDERS, band_amplitudes(2, 40, 1e-6), None, seed)


def taken(lanes: Any, p: Parameters, turns: Float) -> Float:
    """What a block loses of its approach, shape [case, lane]."""
    waves = rolling_wave_params(p.effects.faults, p.rollers, SHARE)
    out = np.zeros((len(turns), 1, lanes.width))
    rolling_gaps(lanes, turns, out, 1, waves)
    return -out[:, 0]


def test_gaps_of_all_surfaces_are_the_sums_of_their_orders(lanes: Any) -> None:
    """Against plain sums at the azimuths of every roller; chords are off by 0.12 % of the shortest wave."""
    cup, cone, roller = (wave_on(surface, seed) for seed, surface in enumerate(("cup", "cone", "roller")))
    p = waved(lanes.width, cup, cone, roller)
    turns = np.random.default_rng(1).uniform(-9.0, 9.0, (40, 3))
    found = taken(lanes, p, turns)
    pockets = p.rollers[1, POCKET_ANGLE]
    numbers = Arrangement(Z, lanes.width).roller[1]
    row = Arrangement(Z, lanes.width).row[1]
    for lane in range(lanes.width):
        azimuth = pockets[lane] + turns[:, 0]
        wanted = cup.gap(azimuth, 0) + SHARE * cone.gap(azimuth - turns[:, 1], 0)
        wanted = wanted + roller.gap(-turns[:, 2], int(numbers[lane]))
        wanted = wanted + SHARE * roller.gap(math.pi - turns[:, 2], int(numbers[lane]))
        if row[lane] == 0:
            np.testing.assert_allclose(found[:, lane], wanted, atol=6e-9)
            assert np.ptp(wanted) > 1e-6
        else:
            np.testing.assert_allclose(found[:, lane], 0.0, atol=1e-20)  # that row is round


@pytest.mark.parametrize("surface", ["cup", "cone", "roller"])
def test_a_surface_alone_has_its_waves(lanes: Any, surface: str) -> None:
    wave = wave_on(surface, 7)
    p = waved(lanes.width, wave)
    turns = np.linspace(-9.0, 9.0, 50)[:, None] * [1.0, 2.3, -8.0]
    azimuth = p.rollers[1, POCKET_ANGLE, 0] + turns[:, 0]
    number = int(Arrangement(Z, lanes.width).roller[1, 0])
    wanted = {
        "cup": wave.gap(azimuth, 0),
        "cone": SHARE * wave.gap(azimuth - turns[:, 1], 0),
        "roller": wave.gap(-turns[:, 2], number) + SHARE * wave.gap(math.pi - turns[:, 2], number),
    }
    np.testing.assert_allclose(taken(lanes, p, turns)[:, 0], wanted[surface], atol=5e-9)


def test_a_table_is_never_larger_than_a_cache_and_fine_waves_are_right_to_two_percent() -> None:
    wave = Waviness("cup", 0, (1000,), (1e-6,))
    p = waved(1, wave)
    waves = rolling_wave_params(p.effects.faults, p.rollers, SHARE)
    assert waves is not None
    assert len(waves.cup) == MOST_POINTS + 2
    turns = np.linspace(0.0, 0.02, 300)[:, None] * [1.0, 0.0, 0.0]
    found = taken(Lanes(1), p, turns)[:, 0]
    np.testing.assert_allclose(found, wave.gap(p.rollers[1, POCKET_ANGLE, 0] + turns[:, 0], 0), atol=2.1e-8)


def test_no_angle_reads_beyond_the_tables(lanes: Any) -> None:
    """No number at all stays one, and one that is next to a whole turn is the turn's end."""
    p = waved(lanes.width, wave_on("cup", 1))
    assert np.isnan(taken(lanes, p, np.full((1, 3), np.nan))).all()
    near = taken(lanes, p, np.array([[-1e-300, 0.0, 0.0], [0.0, 0.0, 0.0], [2.0 * np.pi, 0.0, 0.0]]))
    np.testing.assert_allclose(near, near[[1, 1, 1]], atol=1e-18)


def test_two_points_in_one_look_are_those_of_two_looks(lanes: Any) -> None:
    table = np.random.default_rng(2).normal(size=101)
    indices = np.random.default_rng(3).uniform(0.0, 99.999, (50 * lanes.width, 1))
    found = through(lanes, pairs_in_table, indices, 4, table)
    np.testing.assert_array_equal(found[:, :2], found[:, 2:])
    outside = np.repeat([[-5.0], [1e9], [np.nan]], lanes.width, axis=0)
    kept = through(lanes, pairs_in_table, outside, 4, table)[:: lanes.width, :2]
    np.testing.assert_array_equal(kept, [table[:2], table[-2:], table[:2]])


def test_waves_on_the_cone_are_looked_up_wherever_a_roller_may_touch(lanes: Any) -> None:
    """Left out only where no roller of the block comes within the highest wave; else to the bit."""
    p = waved(lanes.width, wave_on("cone", 1), wave_on("roller", 2))
    faults = p.effects.faults
    highest = highest_wave(faults)
    draw = np.random.default_rng(4)
    cases = np.column_stack([np.repeat(draw.uniform(-3.0, 3.0, 40) * highest, lanes.width)] * 3)
    cases[:, 1:] = draw.uniform(-9.0, 9.0, (len(cases), 2))
    found = through(lanes, waves_on_cone, cases, 2, 1, faults, highest)
    near = cases[:, 0] > -highest
    np.testing.assert_array_equal(found[near, 0], found[near, 1])
    np.testing.assert_array_equal(found[~near, 0], 0.0)
    assert (cases[~near, 0] - found[~near, 1]).max() <= 0.0  # none of them touches with its waves
    assert near.any()
    assert (~near).any()
    assert highest_wave(waved(lanes.width).effects.faults) == 0.0


@pytest.mark.parametrize("on", ["cup", "cone", "roller"])
def test_nothing_is_met_beyond_the_highest_rim_and_a_rim_is_met_before_it(lanes: Any, on: str) -> None:
    """A rim as long as the roller, which stands at every place of it or has it on either side."""
    length = scene_with().bearing.effective_length
    rim = Patch(on, 0, 0.1, 4e-3, 5e-5, length, rim_height=3e-6, rim_width=1.5e-3)
    scene = replace(scene_with(None, defects=(rim,)), tier="lumped")
    p = TIERS["lumped"].parameters(scene, parameters_of(scene, lanes.width))
    assert p.highest == pytest.approx(12e-6 if on == "roller" else 6e-6)
    azimuths = np.linspace(-0.5, 0.5, 401)
    cases = np.array([[azimuth, -height] for azimuth in azimuths for height in (p.highest, 2e-6)])
    turned = -1.0 if on == "roller" else 0.0
    cases = np.column_stack([cases, turned * cases[:, 0]])
    load = through(lanes, massless_rollers, np.repeat(cases, lanes.width, 0), 1, p)[:: lanes.width, 0]
    assert load[::2].max() == 0.0
    assert load[1::2].max() > 10.0

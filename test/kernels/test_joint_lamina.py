"""Coupled laminae of which some lie partly over a patch: as one spring each, for few laminae as for many."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from beardyn_core.bearing.lamina_coupling import LaminaRoot, coupled_law, joint_depth, part_exponent
from beardyn_core.effects import EffectSet, LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.lamina_table import surface_radius
from beardyn_core.physics.spall_cover import counted_cover, lamina_cover
from beardyn_core.scene.patch import Patch
from test.kernels.pressed_roller import (
    ENERGY,
    ENERGY_SLOPE,
    FAR,
    FORCE,
    MOMENT,
    NEAR,
    PENETRATION,
    pressed,
)
from test.scenes import standard_scene

COUPLED = replace(EffectSet(), lamina_coupling=LaminaCoupling())
INDEPENDENT = replace(EffectSet(), lamina_coupling=LaminaCoupling(strength=0.0))
LENGTH = standard_scene().bearing.effective_length
DEPTH = 1e-5
FINE = 240
ON_RIM = NEAR + (0.5 * 6e-3 + 0.5 * 3e-3) / surface_radius(standard_scene().bearing, "cup")
SPALL = Patch(on="cup", row=0, azimuth=NEAR, width=6e-3, depth=1e-4, length=0.025)
PLACES = [
    (0.0, 25e-3),
    (5e-3, 25e-3),
    (0.0, 20e-3),
    (0.0, 8e-3),
    (10e-3, 12e-3),
    (-12e-3, 10e-3),
    (0.0, 3e-3),
]


def over(offset: float, length: float, depth: float = 1e-4) -> Patch:
    return replace(SPALL, offset=offset, length=length, depth=depth)


@cache
def coupled_root(laminae: int) -> LaminaRoot:
    return bearing_lamina_root(standard_scene().bearing, LaminaCoupling(), laminae)


@cache
def line_share(
    offset: float, length: float, gap: float, laminae: int, counted: float = 1.0
) -> tuple[float, float]:
    """Force and moment of a line over a patch, of the sound line's force and of that by its length [-].

    Of the patch's length a share counts, with a larger gap.
    """
    edges = (np.arange(laminae + 1) / laminae - 0.5) * LENGTH
    low, high = np.maximum(edges[:-1], offset - 0.5 * length), np.minimum(edges[1:], offset + 0.5 * length)
    cover = np.maximum(high - low, 0.0) * laminae / LENGTH
    depth = np.full(laminae, DEPTH)
    joint, share = joint_depth(depth, np.full(laminae, gap / counted), counted * cover, part_exponent(1.0))
    loads, _, _ = coupled_law(np.array([joint, depth]), 1.0, coupled_root(laminae))
    pressing = loads[0] * share / loads[1].sum()
    return float(pressing.sum()), float(pressing @ (edges[:-1] + edges[1:])) / (2.0 * LENGTH)


@pytest.mark.parametrize("depth", [5e-7, 1e-4])
@pytest.mark.parametrize(("offset", "length"), PLACES)
def test_without_strength_a_lamina_presses_as_its_two_parts(
    lanes: Any, offset: float, length: float, depth: float
) -> None:
    patch = over(offset, length, depth)
    joint = pressed(lanes, [NEAR, FAR], 2e-6, patch, effects=INDEPENDENT)
    divided = pressed(lanes, [NEAR, FAR], 2e-6, patch)
    np.testing.assert_allclose(joint[:, ENERGY], divided[:, ENERGY], rtol=1e-9)
    np.testing.assert_allclose(joint[:, FORCE], divided[:, FORCE], rtol=1e-9)
    np.testing.assert_allclose(joint[:, MOMENT], divided[:, MOMENT], atol=1e-9 * divided[:, FORCE].max())


@pytest.mark.parametrize("depth", [5e-7, 3e-6, 1e-4])
@pytest.mark.parametrize(("offset", "length"), PLACES)
def test_force_is_the_slope_of_the_energy(lanes: Any, offset: float, length: float, depth: float) -> None:
    """3e-3: what the passes of `couple_laminae` leave where laminae are free."""
    found = pressed(lanes, [NEAR, FAR], 2e-6, over(offset, length, depth), effects=COUPLED)
    np.testing.assert_allclose(found[:, FORCE], found[:, ENERGY_SLOPE], rtol=3e-3)


@pytest.mark.parametrize("gap", [1e-4, 6e-6, 1e-6, -2e-6, -6e-6])
@pytest.mark.parametrize("laminae", [4, 6, 10])
@pytest.mark.parametrize(("offset", "length"), PLACES)
def test_few_laminae_press_as_many(offset: float, length: float, laminae: int, gap: float) -> None:
    """Over holes and rims, in parts of the sound line's force, and of that by its length.

    3.5 % of the force, 2.5 % with 10 laminae. Over the deep hole independent laminae miss up to 13 %, laminae
    that take its mean depth up to 31 % where there are 4, 28 % with 6, 13 % with 10.
    """
    force, lever = line_share(offset, length, gap, FINE)
    few_force, few_lever = line_share(offset, length, gap, laminae)
    assert few_force == pytest.approx(force, abs=0.025 if laminae == 10 else 0.035)
    assert few_lever == pytest.approx(lever, abs=0.007)


@pytest.mark.parametrize("depth", [5e-7, 3e-6, 1e-4])
@pytest.mark.parametrize(("offset", "length"), PLACES)
def test_kernel_presses_as_the_law(lanes: Any, offset: float, length: float, depth: float) -> None:
    """5e-3 of the sound line: what the passes of `couple_laminae` leave where laminae are free."""
    found = pressed(lanes, [NEAR, FAR], DEPTH, over(offset, length, depth), effects=COUPLED)
    scene = standard_scene()
    cover = lamina_cover(scene.bearing, over(offset, length), 6)
    counted = counted_cover(scene.bearing, [over(offset, length)], 6, LaminaCoupling())[0]
    force, lever = line_share(offset, length, depth, 6, float(counted.sum() / cover.sum()))
    whole, middle = found[1, FORCE], found[1, MOMENT] / found[1, FORCE]
    assert found[0, FORCE] / whole == pytest.approx(force, abs=5e-3)
    assert (found[0, MOMENT] - middle * found[0, FORCE]) / whole == pytest.approx(
        lever * LENGTH, abs=5e-3 * LENGTH
    )


@pytest.mark.parametrize("laminae", [6, 10, 20])
@pytest.mark.parametrize("length", [LENGTH, 25e-3])
def test_penetration_is_that_of_surfaces_that_exist(lanes: Any, length: float, laminae: int) -> None:
    """Over a hole along the whole line nothing is pressed, and beside a short one the sound part is."""
    found = pressed(lanes, [NEAR, FAR], DEPTH, over(0.0, length), effects=COUPLED, laminae=laminae)
    assert found[1, PENETRATION] == pytest.approx(DEPTH, rel=1e-9)
    expected = 0.0 if length == LENGTH else DEPTH
    assert found[0, PENETRATION] == pytest.approx(expected, rel=0.05, abs=1e-12)


@pytest.mark.parametrize(("offset", "length"), PLACES)
def test_force_on_a_raised_rim_is_the_slope_of_its_energy(lanes: Any, offset: float, length: float) -> None:
    """On a rim of 4 um beside the hole the part that the patch covers stands higher."""
    rim = replace(over(offset, length), rim_height=4e-6, rim_width=3e-3)
    found = pressed(lanes, [ON_RIM, FAR], 2e-6, rim, effects=COUPLED)
    assert found[0, FORCE] > found[1, FORCE]
    np.testing.assert_allclose(found[:, FORCE], found[:, ENERGY_SLOPE], rtol=3e-3)


@pytest.mark.parametrize("effects", [None, COUPLED], ids=["independent", "coupled"])
def test_a_rim_beside_a_short_hole_is_no_higher_than_it_is(lanes: Any, effects: EffectSet | None) -> None:
    """A roller 4.1 um away does not touch a rim of 4 um, one that is 1 um away does."""
    rim = replace(over(0.0, 4e-3), rim_height=4e-6, rim_width=3e-3)
    assert pressed(lanes, [ON_RIM, FAR], -4.1e-6, rim, effects=effects)[0, FORCE] == 0.0
    assert pressed(lanes, [ON_RIM, FAR], -1e-6, rim, effects=effects)[0, FORCE] > 0.0


def test_force_is_continuous_as_the_patch_grows_over_a_lamina(lanes: Any) -> None:
    """From the edge of one lamina to that of the next: no jump of more than twice the usual step."""
    lengths = np.linspace(16.0e-3, 34.0e-3, 73)
    forces = np.array(
        [pressed(lanes, [NEAR, FAR], DEPTH, over(0.0, a), effects=COUPLED)[0, FORCE] for a in lengths]
    )
    steps = -np.diff(forces) / forces[0]
    assert steps.min() > -1e-3
    assert steps.max() < 0.02

"""Scatter of a scene file: what is read, what it draws, and what is refused."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.config.yaml_text import read_mapping
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.scene.scatter import GRADES, Deviations, Scatter
from beardyn_core.scene.surface import circumference
from beardyn_core.scene.waviness import Waviness

BEARING = load_scene("static_80kN").bearing
SEEDS = range(200)
QUANTITIES = tuple(field.name for field in fields(Deviations))
GRADED = tuple(name for name in GRADES if name != "none")


def scene_with(**scatter: Any) -> Any:
    mapping = read_mapping(scene_text(load_scene("static_80kN")), "static_80kN")
    mapping["scatter"] = scatter
    return scene_from_text(json.dumps(mapping))


def test_a_grade_and_own_keys_are_read_and_recorded_as_they_were_written() -> None:
    scene = scene_with(grade="G2", seed=7, roller_diameter_um=1.5)
    assert scene.scatter == Scatter("G2", 7, roller_diameter=1.5e-6)
    assert scene.scatter.variation("roller_diameter") == 1.5e-6
    assert scene.scatter.variation("profile") == GRADES["G2"]["profile"] * 1e-6
    assert "scatter" in scene.effect_names
    assert scene_from_text(scene_text(scene)) == scene
    written = read_mapping(scene_text(scene), "again")["scatter"]
    assert written == {"grade": "G2", "seed": 7, "roller_diameter_um": 1.5, "shortest_wave_mm": 0.2}


def test_a_surface_and_the_end_of_its_waves_are_read_as_they_were_written() -> None:
    keys = {"grade": "G1", "seed": 1, "surface": "fine", "shortest_wave_mm": 0.5}
    scene = scene_with(**keys)
    assert scene.scatter == Scatter("G1", surface="fine", shortest_wave=5e-4)
    assert read_mapping(scene_text(scene), "again")["scatter"] == keys
    assert scene_with(grade="G1", shortest_wave_mm=0.2).scatter == Scatter("G1")


@pytest.mark.parametrize(
    "scatter", [{"grade": "none"}, {"seed": 3}, {"roller_diameter_um": 0.0}, {"surface": "none"}]
)
def test_no_scatter_is_no_effect_and_no_parameter(scatter: dict[str, Any]) -> None:
    """The same types with the same numbers: nothing is compiled anew and no bit changes."""
    scene = scene_with(**scatter)
    assert scene.scattered is None
    assert "scatter" not in scene.effect_names
    assert scene.waves == ()
    arrangement = Arrangement(BEARING.roller_count, 8)
    found, nominal = (
        build_parameters(each, arrangement, np.zeros(6)) for each in (scene, replace(scene, scatter=None))
    )
    assert found.effects.faults == nominal.effects.faults == (None,) * len(nominal.effects.faults)
    np.testing.assert_array_equal(found.rollers, nominal.rollers)


@pytest.mark.parametrize(
    ("scatter", "words"),
    [
        ({"grade": "G4"}, ["scatter.grade is 'G4'", "'none', 'G1', 'G2', 'G3', 'G5'"]),
        ({"grade": "G1", "surface": "rough"}, ["scatter.surface is 'rough'", "'fine', 'typical', 'coarse'"]),
        ({"roller_diameter_um": -1}, ["scatter.roller_diameter_um is -1", "at least 0"]),
        ({"roller_diameter_mm": 1}, ["scatter.roller_diameter_mm", "roller_diameter_um"]),
        (
            {"pocket_place_um": 300, "pocket_clearance_um": 250},
            ["scatter: pocket_place_um and pocket_clearance_um together are 550", "below 500"],
        ),
    ],
)
def test_what_cannot_be_is_refused_with_what_is_allowed(scatter: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(InputError) as refused:
        scene_with(**scatter)
    for word in words:
        assert word in str(refused.value)


def test_a_seed_always_draws_the_same_bearing() -> None:
    """Numbers of an earlier day: recordings name grade and seed only."""
    drawn = Scatter("G2", 7).deviations(BEARING)
    np.testing.assert_allclose(
        drawn.roller_diameter[:, :3] * 1e6,
        [[0.41806646, 0.4624119, -0.05493004], [-0.28857458, -0.34056061, -0.06700243]],
        atol=1e-8,
    )
    np.testing.assert_allclose(drawn.row_clearance * 1e6, [-1.11061927, 3.70572968], atol=1e-8)


@pytest.mark.parametrize("name", QUANTITIES)
def test_a_quantity_does_not_depend_on_the_others_nor_on_its_own_size(name: str) -> None:
    alone = replace(Scatter(seed=5), **{name: 2e-6}).deviations(BEARING)  # type: ignore[arg-type]
    graded = replace(Scatter("G5", 5), **{name: 1e-6}).deviations(BEARING)  # type: ignore[arg-type]
    np.testing.assert_allclose(getattr(alone, name), 2.0 * getattr(graded, name), rtol=1e-12)
    others = {other for other in QUANTITIES if other != name}
    assert all(not getattr(alone, other).any() for other in others)


def test_a_row_keeps_its_rollers_when_the_bearing_has_more() -> None:
    more = replace(BEARING, roller_count=BEARING.roller_count + 3)
    one, two = (Scatter("G2", 4).deviations(each).roller_diameter for each in (BEARING, more))
    np.testing.assert_array_equal(one, two[:, : BEARING.roller_count])


@pytest.mark.parametrize("grade", GRADED)
@pytest.mark.parametrize("name", QUANTITIES)
def test_deviations_have_the_distribution_of_their_grade(name: str, grade: str) -> None:
    """Normal, four standard deviations wide, cut: then the deviation is 0.8796 of the uncut one.

    Five standard errors of mean and deviation at the size of the sample, kurtosis 2.37 of a cut normal one.
    """
    variation = GRADES[grade][name] * 1e-6
    sample = np.concatenate(
        [getattr(Scatter(grade, seed).deviations(BEARING), name).ravel() for seed in SEEDS]
    )
    spread = 0.8796 * 0.25 * variation
    assert np.abs(sample).max() <= 0.5 * variation
    assert abs(sample.mean()) < 5.0 * spread / np.sqrt(sample.size)
    error = np.sqrt((2.37 - 1.0) / (4.0 * sample.size))
    assert sample.std() == pytest.approx(spread, rel=5.0 * error)


def test_quantities_rows_and_seeds_are_not_alike() -> None:
    """Correlations within five over the root of the sample's size."""
    drawn = [Scatter("G2", seed).deviations(BEARING) for seed in SEEDS]
    columns = [
        np.concatenate([getattr(each, name)[row] for each in drawn])
        for name in QUANTITIES
        if name != "row_clearance"
        for row in (0, 1)
    ]
    columns.append(np.roll(columns[0], BEARING.roller_count))  # the next seed
    found = np.corrcoef(columns) - np.eye(len(columns))
    assert np.abs(found).max() < 5.0 / np.sqrt(len(columns[0]))


def test_surfaces_rows_and_bearings_of_a_lot_have_phases_of_their_own() -> None:
    azimuth = np.linspace(0.0, 2.0 * np.pi, 512, endpoint=False)
    gaps = {(wave.on, wave.row): wave.gap(azimuth) for wave in Scatter("G3", 9).waves(BEARING)}
    assert set(gaps) == {(on, row) for on in ("cup", "cone", "roller") for row in (0, 1)}
    assert len({gap.tobytes() for gap in gaps.values()}) == len(gaps)
    other = {wave.gap(azimuth).tobytes() for wave in Scatter("G3", 10).waves(BEARING)}
    assert not other & {gap.tobytes() for gap in gaps.values()}


def test_waves_end_where_the_file_says() -> None:
    usual, longer = Scatter("G1", 9), Scatter("G1", 9, shortest_wave=1e-3)
    for all_of_them, some in zip(usual.waves(BEARING), longer.waves(BEARING), strict=True):
        assert circumference(some.on, BEARING) / some.orders[-1] == pytest.approx(1e-3, rel=0.015)
        assert some.amplitudes == all_of_them.amplitudes[: len(some.orders)]


def test_waves_that_are_given_stay_beside_those_of_the_scatter() -> None:
    own = Waviness("cup", 0, (20,), (1e-6,))
    scene = replace(load_scene("static_80kN"), waviness=(own,), scatter=Scatter("G1", 2))
    assert scene.waves[0] == own
    assert scene.waves[1:] == Scatter("G1", 2).waves(scene.bearing)

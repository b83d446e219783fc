"""Rating life: laws of ISO 281 and ISO 16281 that need no table."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.bearing.life import (
    basic_rating_life,
    dynamic_rating,
    edge_concentration,
    fatigue_load_limit,
    life_modification,
    reference_life,
    reference_viscosity,
    static_rating,
)
from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.physics.statics.rating_life import LoadClass, load_classes, rating_life, scene_life
from beardyn_core.physics.statics.static import solve
from beardyn_core.rail.build import load_history
from beardyn_core.scene.load import LoadHistory

BEARING = load_bearing("HS130x230")
LUBRICANT = load_lubricant("LGEP2")


def life(*classes: LoadClass):
    found = rating_life(BEARING, classes, LUBRICANT, 343.15, end_play=0.0, tilt="locked")
    assert found is not None
    return found


def load_class(share: float, radial: float, axial: float = 0.0) -> LoadClass:
    return LoadClass(share, (0.0, axial, radial), (0.0, 0.0, 0.0), 122.0)


def test_twice_the_load_lives_a_tenth_as_long():
    rating = dynamic_rating(BEARING).radial
    assert basic_rating_life(rating, rating) == pytest.approx(1.0e6)
    assert basic_rating_life(rating, 2.0) / basic_rating_life(rating, 1.0) == pytest.approx(2.0 ** (-10 / 3))
    assert basic_rating_life(rating, 0.0) == math.inf


def test_equivalent_load_of_pure_radial_force_is_that_force_and_thrust_adds():
    rating = dynamic_rating(BEARING)
    assert rating.equivalent_load(80e3, 0.0) == 80e3
    assert rating.equivalent_load(80e3, -15e3) == rating.equivalent_load(80e3, 15e3)
    assert rating.equivalent_load(80e3, 15e3) == pytest.approx(
        80e3 + 0.45 / math.tan(BEARING.cup_angle) * 15e3
    )
    limit = rating.thrust_limit * 80e3
    assert rating.equivalent_load(80e3, limit) == pytest.approx(
        rating.equivalent_load(80e3, limit * (1.0 + 1e-9)), rel=0.02
    )


@given(kappa=st.floats(0.1, 4.0), limit=st.floats(1e-3, 5.0), contamination=st.floats(0.0, 1.0))
def test_life_modification_is_bounded_and_grows_with_film_and_cleanliness(kappa, limit, contamination):
    factor = life_modification(kappa, contamination, limit)
    assert 0.1 <= factor <= 50.0
    assert life_modification(min(1.2 * kappa, 4.0), contamination, limit) >= factor * (1.0 - 5e-3)
    assert life_modification(kappa, min(contamination + 0.1, 1.0), limit) >= factor
    assert life_modification(5.0, contamination, limit) == life_modification(4.0, contamination, limit)


def test_ranges_of_the_viscosity_ratio_join_within_the_rounding_of_the_standard():
    for kappa in (0.4, 1.0):
        below, above = (life_modification(kappa + step, 0.6, 0.5) for step in (-1e-9, 1e-9))
        assert below == pytest.approx(above, rel=0.02)
    assert life_modification(0.05, 1.0, 5.0) == 0.1


def test_reference_viscosity_joins_at_1000_rpm():
    below, above = (reference_viscosity(BEARING, rpm * math.pi / 30.0) for rpm in (999.9, 1000.1))
    assert below == pytest.approx(above, rel=0.03)
    assert reference_viscosity(BEARING, 0.0) == math.inf


def test_static_rating_and_fatigue_limit_by_hand():
    """ISO 76 with the numbers of the bearing in millimetres, written out."""
    gamma = 26.7 * math.cos(BEARING.cup_angle) / 185.0
    by_hand = 44.0 * (1.0 - gamma) * 34 * 50.0 * 26.7 * math.cos(BEARING.cup_angle)
    assert static_rating(BEARING) == pytest.approx(by_hand)
    assert fatigue_load_limit(BEARING) == pytest.approx(by_hand / 8.2 * (100.0 / 185.0) ** 0.3)


def test_reference_life_falls_with_the_fourth_power_of_all_loads():
    static = solve(BEARING, (0, 0, 80e3), end_play=0.0, laminae=30)
    once = reference_life(BEARING, static.cup_lamina_load, static.cone_lamina_load, 1.0, 0.6)
    twice = reference_life(BEARING, 2 * static.cup_lamina_load, 2 * static.cone_lamina_load, 1.0, 0.6)
    assert once.basic / twice.basic == pytest.approx(16.0)
    assert once.equivalent_load == pytest.approx(dynamic_rating(BEARING).radial * (1e6 / once.basic) ** 0.3)
    assert once.lamina_life.shape == (2, 30)
    assert once.lamina_life.min() > once.basic


def test_reference_life_without_load_is_endless():
    none = np.zeros((2, 17, 30))
    assert reference_life(BEARING, none, none, 1.0, 0.6).modified == math.inf


def test_reference_life_without_edge_stress_does_not_depend_on_the_lamina_count():
    lives = []
    for laminae in (30, 60):
        static = solve(BEARING, (0, 0, 80e3), end_play=0.0, laminae=laminae)
        edge = edge_concentration(laminae)
        cup, cone = static.cup_lamina_load / edge, static.cone_lamina_load / edge
        lives.append(reference_life(BEARING, cup, cone, 1.0, 0.6).basic)
    assert lives[1] == pytest.approx(lives[0], rel=5e-3)


def test_tilt_costs_life():
    straight = life(load_class(1.0, 80e3))
    tilted = rating_life(
        BEARING,
        (LoadClass(1.0, (0.0, 0.0, 80e3), (1000.0, 0.0, 0.0), 122.0),),
        LUBRICANT, 343.15, end_play=0.0, tilt="free",
    )  # fmt: skip
    assert tilted is not None
    assert tilted.basic == straight.basic
    assert tilted.reference_basic < 0.9 * straight.reference_basic


def test_damage_adds_by_revolutions():
    light, heavy = life(load_class(1.0, 40e3)), life(load_class(1.0, 80e3))
    mixed = life(load_class(0.25, 80e3), load_class(0.75, 40e3))
    for name in ("basic", "modified", "reference_basic", "reference_modified"):
        expected = 1.0 / (0.25 / getattr(heavy, name) + 0.75 / getattr(light, name))
        assert getattr(mixed, name) == pytest.approx(expected)


def test_constant_scene_is_one_class_and_standstill_has_no_life():
    scene = load_scene("static_80kN")
    load = load_history(scene.operation, scene.mounting, 0.5, scene.seed)
    (only,) = load_classes(load)
    assert only.share == pytest.approx(1.0)
    found = scene_life(scene, load)
    assert found is not None
    assert found.equivalent_load == pytest.approx(80e3)
    still = LoadHistory(load.time_ns, load.wrench, 0.0 * load.shaft_speed, load.bogie)
    assert scene_life(scene, still) is None


def test_load_beside_the_centre_lives_as_its_moment_does():
    """25 mm beside the centre, 80 kN: the moment 2 kN m by hand, and a shorter life than centred."""
    scene = load_scene("static_80kN")
    load = load_history(scene.operation, scene.mounting, 0.1, scene.seed)
    beside = replace(
        scene, mounting=replace(scene.mounting, journal_tilt="free", load_offset=(0.0, 0.025, 0.0))
    )
    free = replace(scene, mounting=replace(scene.mounting, journal_tilt="free"))
    turned = replace(load, wrench=load.wrench + np.array([0.0, 0.0, 0.0, 0.025 * 80e3, 0.0, 0.0]))
    off_centre, centred = scene_life(beside, load), scene_life(free, load)
    assert off_centre == scene_life(free, turned)
    assert off_centre is not None
    assert centred is not None
    assert off_centre.reference_basic < 0.9 * centred.reference_basic


def test_life_counts_only_the_load_that_was_run():
    load = LoadHistory(np.array([0, 10, 20, 30]), np.zeros((4, 6)), np.ones(4), np.zeros((4, 3)))
    assert load.until(15).time_ns.tolist() == [0, 10, 20]
    assert load.until(20).time_ns.tolist() == [0, 10, 20]
    assert load.until(40).time_ns.tolist() == [0, 10, 20, 30]


@given(seed=st.integers(0, 1000))
@settings(deadline=None)
def test_classes_keep_the_mean_force_by_revolutions(seed):
    random = np.random.default_rng(seed)
    wrench = random.normal((0, 5e3, 70e3, 0, 0, 0), (1e3, 5e3, 1e4, 1, 0, 1), (200, 6))
    speed = random.uniform(50.0, 150.0, 200)
    load = LoadHistory(np.arange(200), wrench, speed, np.zeros((200, 3)))
    classes = load_classes(load)
    assert sum(part.share for part in classes) == pytest.approx(1.0)
    mean = sum(part.share * np.array(part.force) for part in classes)
    assert mean == pytest.approx(np.average(wrench[:, :3], axis=0, weights=speed))

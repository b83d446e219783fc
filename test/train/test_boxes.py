"""The scene of each axlebox of several, and what a scene file may say of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.edge import NounError
from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_mapping
from beardyn_core.config import read_scene
from beardyn_core.config.boxes import mirror_box, mirrored_modes, scene_of_box
from beardyn_core.config.yaml_text import read_file
from beardyn_core.rail.train import MIRRORED
from beardyn_core.run import start
from beardyn_core.scene.axleboxes import Axleboxes
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import modes_of_effects
from beardyn_core.structure.table import read_table
from beardyn_core.twin import Twin

SCENES = Path("config/scenes")


def train(name: str = "cup_spall", **axleboxes: Any) -> Scene:
    data = {**read_file(SCENES / f"{name}.yaml"), "tier": "lumped", "effects": "standard"}
    return scene_from_mapping({**data, "axleboxes": {"axles": 2, **axleboxes}}, name, SCENES)


def test_every_box_is_another_bearing_and_only_the_faulty_ones_have_the_defects() -> None:
    scene = train(faulty=["axle_2_left"])
    boxes = {box.name: scene_of_box(scene, box) for box in Axleboxes(axles=2).boxes}
    assert list(boxes) == ["axle_1_left", "axle_1_right", "axle_2_left", "axle_2_right"]
    assert [bool(each.defects) for each in boxes.values()] == [False, False, True, False]
    assert len({each.seed for each in boxes.values()}) == 4
    assert len({each.scatter.seed for each in boxes.values() if each.scatter}) == 4
    assert all(each.axleboxes is None for each in boxes.values())


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ({"axles": 0}, r"axleboxes.axles is 0; it must be at least 1"),
        (
            {"faulty": ["axle_3_left"]},
            r"faulty\[0\] is 'axle_3_left'; the boxes are axle_1_left to axle_2_right",
        ),
        ({"faulty": ["axle_1_left", "axle_1_left"]}, r"faulty\[1\] is 'axle_1_left', given twice"),
        ({"car_distance_m": 99}, r"axleboxes.car_distance_m is 99; it must be at most 60"),
        ({"cars": 2}, r"axleboxes.cars: unknown key"),
    ],
)
def test_bad_keys_are_told_in_a_sentence(keys: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        train(**keys)


def test_axles_must_be_said() -> None:
    data = {**read_file(SCENES / "cup_spall.yaml"), "axleboxes": {}}
    with pytest.raises(InputError, match=r"axleboxes\.axles"):
        scene_from_mapping(data, "train", SCENES)
    with pytest.raises(NounError, match="given twice"):
        raise NounError("axleboxes", list(Axleboxes(axles=1, faulty=("axle_1_left",) * 2).rules()))


def test_the_shipped_bogie_has_its_spall_in_one_box_of_four() -> None:
    scene = read_scene("bogie").scene
    assert scene.axleboxes is not None
    assert (scene.tier, scene.doubts) == ("quasistatic", ())
    boxes = {box.name: scene_of_box(scene, box) for box in scene.axleboxes.boxes}
    assert [name for name, each in boxes.items() if each.defects] == ["axle_2_left"]
    assert [each.mounting.side for each in boxes.values()] == ["left", "right", "left", "right"]
    assert len(boxes) == 4


def test_a_twin_is_one_bearing() -> None:
    with pytest.raises(InputError, match="has axleboxes, 4 of them, and a twin is one"):
        Twin(train())


def test_a_mirror_of_a_mirror_is_the_box() -> None:
    modes = read_table("config/structures/high_speed.csv")
    twice = mirrored_modes(mirrored_modes(modes))
    assert np.array_equal(twice.raceway, modes.raceway)
    assert (twice.centre, twice.products, twice.places) == (modes.centre, modes.products, modes.places)
    scene = load_scene("cup_spall", effects="standard", tier="lumped")
    assert mirror_box(mirror_box(scene)) == scene
    assert mirror_box(scene).defects[0].row == 1


def test_a_mirrored_box_that_is_stiffer_than_its_table_rings_as_the_left_one() -> None:
    structure = {"kind": "modes", "table": "high_speed", "stiffness_factor": 1.44, "damping_factor": 2.0}
    scene = load_scene("service_high_speed", effects={"preset": "standard", "structure": structure})
    left, right = modes_of_effects(scene.effects), modes_of_effects(mirror_box(scene).effects)
    assert left is not None
    assert right is not None
    # a table has five digits
    np.testing.assert_allclose(right.frequency, left.frequency, rtol=1e-4)
    np.testing.assert_allclose(right.damping_ratio, left.damping_ratio, rtol=1e-4)


@pytest.mark.parametrize("box", ["rigid", pytest.param("modes", marks=pytest.mark.slow)])
def test_a_right_axlebox_answers_a_mirrored_load_as_the_left_one_the_load(box: str) -> None:
    """With thrust, a spall in one row, a box whose mass, springs and modes are no mirror images, an axle."""
    modal = {"preset": "standard", "structure": {"kind": "modes", "table": "high_speed"}}
    name, effects = ("cup_spall", "standard") if box == "rigid" else ("service_high_speed_cup", modal)
    left = load_scene(name, tier="lumped", duration=0.2, effects=effects)
    sensors = tuple(replace(each, noise_density=0.0, range=1e5) for each in left.sensors)
    mounting = left.mounting
    if box == "rigid":
        mounting = replace(mounting, box_centre=(0.05, 0.02, 0.01), suspension_centre=(0.0, -0.03, 0.04))
        mounting = replace(mounting, load_offset=(0.0, -0.1, 0.0))
        sensors = tuple(replace(each, position=(0.0, 0.06, 0.17)) for each in sensors)
    left = replace(left, scatter=None, background=None, sensors=sensors, mounting=mounting)
    right = mirror_box(left)
    assert right.mounting.side == "right"
    if box == "modes":
        modes = modes_of_effects(right.effects)
        assert modes is not None
        assert modes.centre[1] < 0.0 < read_table("config/structures/high_speed.csv").centre[1]
    count = 420
    time = np.arange(count) * 5e-4
    wrench = np.zeros((count, 6))
    wrench[:, 1] = 8e3 * np.sin(2 * np.pi * 7.0 * time)
    wrench[:, 2] = 6e4 + 5e3 * np.sin(2 * np.pi * 40.0 * time)
    bogie = np.zeros((count, 3))
    bogie[:, 1] = 1e-3 * (1.0 - np.cos(2 * np.pi * 3.0 * time))
    speed = np.full(count, 120.0)
    stamps = np.arange(count, dtype=np.int64) * 500_000
    load = LoadHistory(stamps, wrench, speed, bogie)
    other = LoadHistory(stamps, wrench * MIRRORED, speed, bogie * MIRRORED[:3])
    one = list(start(left, 0.2, load).blocks())
    two = list(start(right, 0.2, other).blocks())
    force = np.concatenate([each.force_waveform for each in one])
    turned = np.concatenate([each.force_waveform for each in two]) * MIRRORED
    assert np.ptp(force[:, 1]) > 5e3
    assert np.allclose(turned, force, atol=1e-6)  # rounding makes 1e-10 N in the first 40 ms
    shaken = np.concatenate([each.acceleration[0] for each in one])
    assert np.ptp(shaken[:, 1]) > 0.1
    again = np.concatenate([each.acceleration[0] for each in two]) * MIRRORED[:3]
    assert np.allclose(again, shaken, atol=1e-6)

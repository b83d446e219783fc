"""Defects, waviness and roughness of a scene file: what is read, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.config.yaml_text import write_mapping
from beardyn_core.record.description import RunDescription
from beardyn_core.scene.defect import RollerError, WornPocket
from beardyn_core.scene.patch import PATCH_KINDS, Growth, Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from test.examples import examples


def scene_of(folder: Path, **keys: Any) -> Scene:
    path = folder / "mine.yaml"
    operation = {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1000}
    path.write_text(
        write_mapping(
            {"scene": "mine", "bearing": "HS130x230", "lubricant": "L055", "operation": operation, **keys}
        )
    )
    return load_scene(path)


def test_each_kind_of_defect_in_si(tmp_path: Path) -> None:
    scene = scene_of(
        tmp_path,
        defects=[
            {"on": "cup", "row": 1, "width_mm": 6, "depth_um": 100},
            {
                "kind": "dent", "on": "cone", "row": 0, "azimuth_deg": 90, "width_mm": 2, "depth_um": 30,
                "length_mm": 4, "offset_mm": -8, "rim_height_um": 4,
                "growth": {"from_s": 0.5, "to_s": 2, "initial_share": 0.2, "size": "depth"},
            },
            {"kind": "diameter", "row": 0, "roller": 3, "diameter_um": -12},
            {"kind": "worn_pocket", "row": 1, "pocket": 16, "clearance_mm": 0.5},
        ],
        waviness=[
            {"on": "cup", "row": 0, "orders": [17, 34], "amplitude_um": 0.3},
            {
                "on": "roller", "row": 1, "roller": 4, "seed": 9,
                "band": {"first": 2, "last": 20, "rms_um": 0.5},
            },
        ],
        roughness={"raceway_um": 0.4, "rib_um": 0.25},
    )  # fmt: skip
    spall, dent, error, pocket = scene.defects
    assert spall == Patch("cup", 1, 0.0, 6e-3, 1e-4, scene.bearing.effective_length, rim_width=1.5e-3)
    growth = Growth(0.5, 2.0, 0.2, width=False)
    assert dent == Patch("cone", 0, math.pi / 2, 2e-3, 3e-5, 4e-3, -8e-3, 0, "dent", 4e-6, 5e-4, growth)
    assert error == RollerError(0, 3, -1.2e-5)
    assert pocket == WornPocket(1, 16, 5e-4)
    single, band = scene.waviness
    assert (single.orders, single.amplitudes) == ((17, 34), (3e-7, 3e-7))
    assert (band.roller, band.seed, band.orders) == (4, 9, tuple(range(2, 21)))
    amplitudes = np.array(band.amplitudes)
    assert math.sqrt(0.5 * (amplitudes @ amplitudes)) == pytest.approx(5e-7)
    np.testing.assert_allclose(amplitudes * np.array(band.orders), amplitudes[0] * 2)
    assert scene.bearing.raceway_roughness == pytest.approx(4e-7)
    assert isinstance(scene.bearing, Bearing)
    assert scene.bearing.rib_roughness == pytest.approx(2.5e-7)
    assert "waviness" in scene.effect_names


SPALL = {"on": "cup", "row": 0, "width_mm": 6, "depth_um": 100}
WAVE = {"on": "cup", "row": 0}


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        (
            {"defects": [{**SPALL, "kind": "dentt"}]},
            ["defects[0].kind is 'dentt'", "did you mean 'dent'?", "'diameter'"],
        ),
        ({"defects": [{**SPALL, "rim_height_mm": 1}]}, ["defects[0].rim_height_mm", "`rim_height_um`"]),
        ({"defects": [{**SPALL, "roller": 3}]}, ["defects[0]: roller is 3, but on is 'cup'"]),
        (
            {"waviness": [{**WAVE, "on": "cone", "roller": 0, "orders": [2], "amplitude_um": 1}]},
            ["waviness[0]: roller is 0, but on is 'cone'"],
        ),
        (
            {"defects": [{**SPALL, "growth": {"from_s": 2, "to_s": 1}}]},
            ["defects[0].growth: to_s is 1", "greater than from_s, 2"],
        ),
        (
            {"defects": [{**SPALL, "growth": {"from_s": 0, "to_s": 1, "initial_share": 2}}]},
            ["defects[0].growth.initial_share is 2", "at most 1"],
        ),
        (
            {"defects": [{**SPALL, "kind": "brinelling", "on": "roller"}]},
            ["defects[0].on is 'roller'", "cone"],
        ),
        (
            {"defects": [{**SPALL, "kind": "brinelling", "width_mm": 40}]},
            ["width_mm is 40", "half a roller pitch"],
        ),
        (
            {"defects": [{"kind": "diameter", "row": 0, "roller": 17, "diameter_um": 3}]},
            ["defects[0].roller is 17", "0 to 16"],
        ),
        (
            {"defects": [{"kind": "diameter", "row": 0, "roller": 1, "width_mm": 3, "diameter_um": 3}]},
            ["defects[0].width_mm: unknown key"],
        ),
        (
            {"defects": [{"kind": "worn_pocket", "row": 0, "pocket": 40, "clearance_mm": 1}]},
            ["defects[0].pocket is 40", "0 to 16"],
        ),
        (
            {
                "defects": [{"kind": "worn_pocket", "row": 0, "pocket": 4, "clearance_mm": 1}],
                "effects": {"preset": "standard", "cage": False},
            },
            ["defects[0]", "needs the cage", "effects.cage"],
        ),
        ({"waviness": [WAVE]}, ["waviness[0]", "`orders` with `amplitude_um`, or `band`"]),
        ({"waviness": [{**WAVE, "orders": [2]}]}, ["waviness[0]", "`orders` with `amplitude_um`"]),
        (
            {"waviness": [{**WAVE, "orders": [0], "amplitude_um": 1}]},
            ["waviness[0].orders[0] is 0", "at least 1"],
        ),
        (
            {"waviness": [{**WAVE, "band": {"first": 9, "last": 3, "rms_um": 1}}]},
            ["waviness[0].band: last is 3", "at least first, 9"],
        ),
        (
            {"waviness": [{**WAVE, "on": "roller", "roller": 20, "orders": [2], "amplitude_um": 1}]},
            ["waviness[0].roller is 20", "0 to 16"],
        ),
        ({"roughness": {"raceway_um": 0}}, ["roughness.raceway_um is 0", "greater than 0"]),
    ],
)  # fmt: skip
def test_a_mistake_is_one_sentence(tmp_path: Path, keys: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(InputError) as caught:
        scene_of(tmp_path, **keys)
    (problem,) = caught.value.problems
    for word in ("mine.yaml", *words):
        assert word in problem


def test_mistakes_of_several_faults_are_told_together(tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        scene_of(
            tmp_path,
            defects=[
                {**SPALL, "length_mm": 90},
                {"kind": "worn_pocket", "row": 0, "pocket": 40, "clearance_mm": 1},
            ],
            waviness=[{**WAVE, "on": "roller", "roller": 20, "orders": [2], "amplitude_um": 1}],
        )
    assert len(caught.value.problems) == 3


patches = some.fixed_dictionaries(
    {
        "kind": some.sampled_from(PATCH_KINDS),
        "on": some.sampled_from(["cup", "cone"]),
        "row": some.integers(0, 1),
        "azimuth_deg": some.floats(-720.0, 720.0),
        "width_mm": some.floats(0.1, 10.0),
        "depth_um": some.floats(0.1, 300.0),
        "length_mm": some.floats(0.5, 20.0),
        "offset_mm": some.floats(-15.0, 15.0),
        "rim_height_um": some.floats(0.0, 50.0),
    },
    optional={
        "growth": some.fixed_dictionaries(
            {
                "from_s": some.floats(0.0, 5.0),
                "to_s": some.floats(6.0, 9.0),
                "initial_share": some.floats(0, 1),
            }
        )
    },
)
others = some.one_of(
    some.fixed_dictionaries(
        {
            "kind": some.just("diameter"),
            "row": some.integers(0, 1),
            "roller": some.integers(0, 16),
            "diameter_um": some.floats(-1000.0, 200.0),
        }
    ),
    some.fixed_dictionaries(
        {
            "kind": some.just("worn_pocket"),
            "row": some.integers(0, 1),
            "pocket": some.integers(0, 16),
            "clearance_mm": some.floats(0.01, 5.0),
        }
    ),
)


@settings(
    max_examples=examples(25), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(defects=some.lists(some.one_of(patches, others), max_size=4))
def test_any_allowed_defects_load_build_and_come_back_from_the_recording(
    tmp_path: Path, defects: list[dict[str, Any]]
) -> None:
    """The scene's own text gives the same scene again, and so does a recording's truth; paths are finite."""
    scene = scene_of(tmp_path, defects=defects)
    assert scene_from_text(scene_text(scene)).defects == scene.defects
    twin = Twin(scene)
    described = RunDescription.of(scene, twin.truth(), twin.body_names)
    assert RunDescription.from_json(described.to_json()).defects == scene.defects
    assert len(scene.fault_sentences) == len(defects)
    faults = twin._parameters.effects.faults
    for surface in faults[:3]:
        if surface is not None:
            assert np.isfinite(surface.paths).all()
            assert surface.places[:, 4].min() > 0.0

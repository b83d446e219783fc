"""`numerics: {steps_per_sample: auto}`: what the scene comes to, and what it says of mistakes."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

from beardyn_core.config import load_scene
from beardyn_core.config.load import scene_from_text
from beardyn_core.errors import InputError
from beardyn_core.scene.scene import Scene


def scene(numerics: dict[str, Any], **changes: Any) -> Scene:
    data = yaml.safe_load(load_scene("static_80kN").source_text)
    return scene_from_text(yaml.safe_dump({**data, **changes, "numerics": numerics}))


@pytest.mark.parametrize(("up_to", "steps"), [(0, 2), (5, 2), (7, 3), (10, 5)])
def test_steps_follow_the_vibration_that_is_asked_for(up_to: float, steps: int) -> None:
    found = scene({"steps_per_sample": "auto", "vibration_up_to_kHz": up_to})
    assert found.numerics.steps_per_sample == steps


@pytest.mark.parametrize(("tier", "steps"), [("lumped", 1), ("quasistatic", 2)])
def test_fast_tiers_keep_their_own_step(tier: str, steps: int) -> None:
    assert scene({"steps_per_sample": "auto"}, tier=tier).numerics.steps_per_sample == steps


def test_effects_matter() -> None:
    numerics = {"steps_per_sample": "auto", "vibration_up_to_kHz": 0}
    assert scene(numerics, effects="dry").numerics.steps_per_sample == 4


def test_what_is_recorded_is_the_number_and_reads_back_as_the_same_scene() -> None:
    found = scene({"steps_per_sample": "auto", "vibration_up_to_kHz": 5})
    assert yaml.safe_load(found.source_text)["numerics"]["steps_per_sample"] == 2
    assert scene_from_text(found.source_text) == found


def test_a_given_step_is_kept() -> None:
    assert scene({"steps_per_sample": 7, "vibration_up_to_kHz": 5}).numerics.steps_per_sample == 7


@pytest.mark.parametrize("value", ["automatic", 0, 65, 2.5])
def test_a_wrong_step_is_told_what_is_allowed(value: object) -> None:
    with pytest.raises(InputError) as told:
        scene({"steps_per_sample": value})
    text = " ".join(told.value.problems)
    assert "numerics.steps_per_sample" in text
    assert str(value) in text
    assert "auto" in text


def test_a_load_without_equilibrium_is_told() -> None:
    with pytest.raises(InputError, match=r"numerics.steps_per_sample.*auto"):
        scene(
            {"steps_per_sample": "auto"},
            operation={"kind": "constant", "force_kN": [0, 0, 1e9], "speed_rpm": 1000},
        )

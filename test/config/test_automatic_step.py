"""`numerics: {steps_per_sample: auto}`: what the scene comes to, and what it says of mistakes."""

from __future__ import annotations

from dataclasses import replace

import pytest
import yaml

from beardyn_core.base.errors import InputError
from beardyn_core.choice import explain_scene, load_scene, scene_from_text
from beardyn_core.choice.usual_step import with_modes
from beardyn_core.config import scene_text
from beardyn_core.physics.tiers.friction_steps import StepChoice
from test.scenes import scene_with_keys

AUTO = {"steps_per_sample": "auto"}
SUSPENDED = {"cup": "suspended"}


@pytest.mark.parametrize(("quantities", "steps"), [(["torque"], 2), (["vibration"], 3)])
def test_steps_follow_what_is_asked_for(quantities: list[str], steps: int) -> None:
    found = scene_with_keys(numerics=AUTO, mounting=SUSPENDED, quantities=quantities)
    assert found.numerics.steps_per_sample == steps
    assert found.numerics.laminae == 6
    assert found.effects == load_scene("static_80kN").effects


@pytest.mark.parametrize(("tier", "steps"), [("lumped", 1), ("quasistatic", 1)])
def test_fast_tiers_keep_their_own_step(tier: str, steps: int) -> None:
    assert scene_with_keys(numerics=AUTO, tier=tier).numerics.steps_per_sample == steps


def test_effects_matter() -> None:
    assert scene_with_keys(numerics=AUTO, effects="dry").numerics.steps_per_sample == 4


def test_what_is_recorded_is_the_number_and_reads_back_as_the_same_scene() -> None:
    found = scene_with_keys(numerics=AUTO)
    assert yaml.safe_load(scene_text(found))["numerics"]["steps_per_sample"] == 2
    again = scene_from_text(scene_text(found))
    assert (again.numerics, again.effects, again.tier) == (found.numerics, found.effects, found.tier)


@pytest.mark.parametrize("key", ["steps_per_sample", "laminae"])
@pytest.mark.parametrize("value", ["automatic", 0, 101, 2.5, True])
def test_a_wrong_number_is_told_what_is_allowed(key: str, value: object) -> None:
    with pytest.raises(InputError) as told:
        scene_with_keys(numerics={key: value})
    (text,) = told.value.problems
    assert f"numerics.{key} is {value!r}; it must be" in text


@pytest.mark.parametrize(("effects", "steps"), [("standard", 4), ("full", 4), ("dry", 4)])
def test_a_scene_that_names_no_step_gets_what_its_friction_needs(effects: str, steps: int) -> None:
    assert load_scene("static_80kN", effects=effects).numerics.steps_per_sample == steps


@pytest.mark.parametrize(
    ("name", "tier", "effects"),
    [("static_80kN", "lumped", None), ("smooth_run", "lumped", None), ("static_80kN", None, "dry")],
)
def test_explain_tells_the_step_of_the_run(name: str, tier: str | None, effects: str | None) -> None:
    explained = explain_scene(name, tier=tier, effects=effects)
    assert (
        explained.current.steps_per_sample
        == load_scene(name, tier=tier, effects=effects).numerics.steps_per_sample
    )


def test_a_load_from_outside_takes_no_long_steps() -> None:
    scene = load_scene("static_80kN", tier="lumped", outside_load=True)
    assert scene.numerics.steps_per_sample == 1


def test_a_fast_sensor_keeps_what_friction_needs() -> None:
    steep = {"preset": "dry", "traction": {"regularisation_speed_m_per_s": 0.002}}
    data = yaml.safe_load(scene_text(load_scene("static_80kN")))
    del data["numerics"]["steps_per_sample"]
    sensors = [{"name": "fast", "rate_kHz": 51.2}]
    alone = scene_from_text(yaml.safe_dump({**data, "effects": steep, "mounting": SUSPENDED}))
    received = scene_from_text(
        yaml.safe_dump({**data, "effects": steep, "mounting": SUSPENDED, "sensors": sensors})
    )
    assert alone.numerics.steps_per_sample == 11
    assert received.numerics.steps_per_sample == 12


BOX = {"preset": "standard", "structure": {"kind": "modes", "table": "high_speed"}}


@pytest.mark.parametrize(("steps", "needed", "turns"), [(1, 2, "5.1"), (4, 4, "10.2")])
def test_modes_of_the_box_get_five_steps_a_turn(steps: int, needed: int, turns: str) -> None:
    """The highest free one below 10 kHz; none where none is received or the box is rigid."""
    boxed, given = (
        scene_with_keys(numerics={}, effects=BOX, mounting=SUSPENDED),
        StepChoice(steps, "as given"),
    )
    found = with_modes(given, boxed, 1e4)
    assert found.steps_per_sample == needed
    assert f"modes of the box up to 10 kHz have {turns} steps a turn" in found.reason
    assert with_modes(given, boxed, 100.0) == given
    assert with_modes(given, scene_with_keys(numerics={}), 1e4) == given
    assert with_modes(given, replace(boxed, tier="lumped"), 1e4) == found

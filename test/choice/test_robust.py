"""A choice is found for every valid scene, and wrong keys are told."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError
from beardyn_core.config import shipped_names
from beardyn_core.scene.scene import QUANTITIES
from beardyn_core.scene.tier import TIER_NAMES
from test.bearings import TAPERED
from test.choice.scenes import SPALL, constant, variant

FORCES = st.floats(-90.0, 90.0)
SCENES = {
    "bearing": st.sampled_from(TAPERED),
    "lubricant": st.sampled_from(shipped_names("lubricants")),
    "force": st.tuples(FORCES, st.floats(-30.0, 30.0), FORCES),
    "speed": st.sampled_from([-2000.0, -100.0, 0.0, 1.0, 600.0, 3000.0]),
    "end_play": st.floats(-0.02, 0.3),
    "temperature": st.floats(-30.0, 150.0),
    "cup": st.sampled_from(["held", "suspended"]),
    "tilt": st.sampled_from(["locked", "free"]),
    "quantities": st.lists(st.sampled_from(QUANTITIES), min_size=1, unique=True),
    "accuracy": st.floats(0.1, 50.0),
    "defects": st.sampled_from([[], [SPALL]]),
    "tier": st.sampled_from(["auto", "full", "quasistatic", "lumped"]),
    "effects": st.sampled_from(
        ["auto", {"preset": "auto", "thermal": {}, "audit": {}}, {"preset": "auto", "cage": False}]
    ),
}


def assert_a_choice_is_found(
    bearing: str,
    lubricant: str,
    force: tuple[float, float, float],
    speed: float,
    end_play: float,
    temperature: float,
    cup: str,
    tilt: str,
    quantities: list[str],
    accuracy: float,
    defects: list[dict[str, Any]],
    tier: str,
    effects: Any,
) -> None:
    scene = variant(
        tier=tier,
        effects=effects,
        bearing=bearing,
        lubricant=lubricant,
        operation=constant(list(force), speed),
        end_play_mm=end_play,
        temperature_C=temperature,
        mounting={"cup": cup, "journal_tilt": tilt},
        quantities=quantities,
        accuracy_percent=accuracy,
        defects=defects,
    )
    assert scene.tier == tier or (tier == "auto" and scene.tier in TIER_NAMES)
    assert scene.effects.rib is not None
    assert len(scene.chosen) >= 3


@settings(max_examples=2, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.fixed_dictionaries(SCENES))
def test_a_choice_is_found_for_every_valid_scene(given_keys: dict[str, Any]) -> None:
    assert_a_choice_is_found(**given_keys)


@pytest.mark.slow
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.fixed_dictionaries(SCENES))
def test_a_choice_is_found_for_many_valid_scenes(given_keys: dict[str, Any]) -> None:
    assert_a_choice_is_found(**given_keys)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"accuracy_percent": 0}, ["accuracy_percent is 0", "at least 0.1"]),
        ({"accuracy_percent": "5 %"}, ["accuracy_percent is '5 %'", "must be a number"]),
        ({"quantities": ["forces"]}, ["quantities[0] is 'forces'", "did you mean 'force'?"]),
        ({"quantities": ["force", "force"]}, ["quantities[1] is 'force'", "given twice"]),
        ({"quantities": []}, ["quantities", "at least 1"]),
        ({"accuracy": 5}, ["accuracy", "accuracy_percent"]),
        ({"tier": "automatic"}, ["tier is 'automatic'", "'auto'"]),
        ({"numerics": "automatic"}, ["numerics is 'automatic'", "'auto'"]),
        ({"numerics": {"laminae": "many"}}, ["numerics.laminae is 'many'", "whole number"]),
        (
            {"effects": {"preset": "auto", "cage": {"friction": 2}}},
            ["effects.cage.friction is 2", "at most 1"],
        ),
        ({"effects": "automatic"}, ["there is no effects preset 'automatic'", "auto chooses them"]),
    ],
)
def test_a_wrong_key_is_told_with_what_is_allowed(keys: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(InputError) as refused:
        variant(**keys)
    for word in words:
        assert word in str(refused.value)

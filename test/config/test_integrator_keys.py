"""`numerics: {integrator: explicit}`: for references, and what is told of mistakes."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels.rig import parameters_of
from test.scenes import scene_with_keys

REFERENCE = {"integrator": "explicit", "steps_per_sample": 391}


def parameters(numerics: Any) -> Parameters:
    made = scene_with_keys(numerics=numerics)
    return parameters_of(made)


def test_a_scene_is_implicit_when_it_does_not_say() -> None:
    assert load_scene("static_80kN").numerics.integrator == "implicit"
    assert parameters({"steps_per_sample": 4}).explicit is None


def test_an_explicit_reference_has_steps_of_a_tenth_of_a_microsecond() -> None:
    made = parameters(REFERENCE)
    assert made.explicit is not None
    assert made.step == pytest.approx(0.1e-6, rel=2e-3)


def test_what_is_recorded_reads_back_as_the_same_integrator() -> None:
    made = scene_with_keys(numerics=REFERENCE)
    assert yaml.safe_load(scene_text(made))["numerics"]["integrator"] == "explicit"
    assert scene_from_text(scene_text(made)).numerics == made.numerics


@pytest.mark.parametrize(
    ("numerics", "changes", "words"),
    [
        ({**REFERENCE, "integrator": "euler"}, {}, ["integrator is 'euler'", "'implicit', 'explicit'"]),
        ({**REFERENCE, "integrator": True}, {}, ["integrator is True", "'implicit', 'explicit'"]),
        ({**REFERENCE, "steps_per_sample": 513}, {}, ["steps_per_sample is 513", "at most 512"]),
        ({"steps_per_sample": 65}, {}, ["steps_per_sample is 65", "at most 64"]),
        (
            {"integrator": "implicit", "steps_per_sample": 391},
            {},
            ["steps_per_sample is 391", "at most 64"],
        ),
        ({"integrator": "explicit"}, {}, ["integrator: 'explicit' needs numerics.steps_per_sample", "391"]),
        (REFERENCE, {"tier": "quasistatic"}, ["integrator: 'explicit' needs the tier 'full'", "quasistatic"]),
        (REFERENCE, {"tier": "auto"}, ["integrator: 'explicit'", "auto"]),
        (REFERENCE, {"effects": "auto"}, ["integrator: 'explicit'", "auto"]),
        ({**REFERENCE, "steps_per_sample": "auto"}, {}, ["integrator: 'explicit'", "auto"]),
        ({**REFERENCE, "laminae": "auto"}, {}, ["integrator: 'explicit'", "auto"]),
    ],
)
def test_a_mistake_is_one_sentence(numerics: Any, changes: dict[str, Any], words: list[str]) -> None:
    with pytest.raises(InputError) as told:
        scene_with_keys(numerics=numerics, **changes)
    (text,) = told.value.problems
    for word in ["numerics.", *words]:
        assert word in text


def test_all_mistakes_are_told_at_once() -> None:
    with pytest.raises(InputError) as told:
        scene_with_keys(numerics={"integrator": "explicit", "laminae": 0}, tier="lumped")
    assert len(told.value.problems) == 3

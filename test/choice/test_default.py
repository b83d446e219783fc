"""A scene that names no effects is computed with those that 5 % of accuracy need, and says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.choice import load, load_scene, load_trial, scene_from_mapping, trial_scene, with_choices
from beardyn_core.choice.trial import together
from beardyn_core.cli.main import main
from beardyn_core.config import load_effects, read_scene, shipped_names
from beardyn_core.config.folders import find
from beardyn_core.config.load import read_scene_mapping
from beardyn_core.config.yaml_text import read_file
from beardyn_core.effects import ModalStructure
from beardyn_core.scene.scene import Free
from beardyn_core.scene.trial import Trial
from test.choice.scenes import BASE

pytestmark = pytest.mark.usefixtures("shipped_configuration")
UNNAMED = {key: value for key, value in BASE.items() if key != "effects"}


def refuse(*_: Any) -> None:
    """Stand in for a choice that must not be made."""
    raise AssertionError("this is no reason to choose")


def test_effects_laminae_and_step_are_open_and_the_tier_is_full() -> None:
    found = read_scene_mapping({**UNNAMED, "scene": "unnamed"}, "unnamed", Path())
    assert found.free == Free(tier=False)
    assert found.scene.tier == "full"
    assert read_scene("cup_spall").free == Free()  # of a scene that says so, with its box


def test_a_tier_may_be_left_open_beside() -> None:
    assert read_scene("cup_spall", {("tier",): "auto"}).free == Free()


def test_what_is_written_down_is_kept() -> None:
    scene = scene_from_mapping({**UNNAMED, "numerics": {"laminae": 8}}, "mine", Path())
    assert scene.numerics.laminae == 8
    assert read_scene("cup_spall", {("effects",): "standard"}).free.effects == frozenset()


def test_it_is_what_auto_takes_in_the_full_tier() -> None:
    unnamed = scene_from_mapping(UNNAMED, "mine", Path())
    named = scene_from_mapping({**UNNAMED, "effects": "auto", "tier": "full"}, "mine", Path())
    assert unnamed == named
    assert unnamed.chosen[0].startswith(
        "chosen for force, deflection, roller_load, torque within 5 %; vibration"
    )
    assert unnamed.effects.structure is not None


@pytest.mark.parametrize(
    ("name", "tier", "beyond"),
    [
        ("static_80kN", "quasistatic", False),
        ("static_5kN", "quasistatic", True),  # its rollers slip
        ("static_5kN", "lumped", True),
    ],
)
def test_fast_tiers_get_what_they_can_have(name: str, tier: str, beyond: bool) -> None:
    scene = load_scene(name, tier=tier)
    assert scene.tier == tier
    assert scene.missing_effects == ()
    assert scene.effects.film is not None, (
        "it starves the rolling resistance: else the torque is three times as large"
    )
    assert ("the bound is wider than the wanted" in scene.chosen[0]) == beyond
    assert scene.numerics.laminae <= 12, "no fineness is bought for what the tier misses anyway"


def test_no_shipped_scene_names_the_standard_effects_but_those_of_a_publication() -> None:
    written = {name: read_file(find("scenes", name)).get("effects") for name in shipped_names("scenes")}
    named = {name for name, effects in written.items() if isinstance(effects, str)}
    assert all(name.startswith("santos_") for name in named)
    assert {effects["preset"] for effects in written.values() if isinstance(effects, dict)} == {"auto"}


@pytest.mark.slow  # some seconds each
def test_shipped_scenes_have_few_sets_of_effects() -> None:
    names = [name for name in shipped_names("scenes") if not name.startswith("santos_")]
    assert len({load_scene(name).effects.names() for name in names}) <= 8


def test_seeds_change_no_effect() -> None:
    scene = read_file(find("scenes", "oversize_roller"))
    found = [
        scene_from_mapping({**scene, "seed": seed, "scatter": {"grade": "G2", "seed": seed}}, "mine", Path())
        for seed in (1, 2)
    ]
    assert replace(found[0], seed=0, scatter=None) == replace(found[1], seed=0, scatter=None)


def test_lists_choose_nothing(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(load, "choice_for", refuse)
    assert main(["scenes", "all", "--json"]) == 0
    assert '"auto"' in capsys.readouterr().out
    load_trial("default")


def test_a_mistake_still_names_file_and_key() -> None:
    with pytest.raises(InputError, match=r"mine: operation\.speed_rpm is 'fast'"):
        scene_from_mapping(
            {**UNNAMED, "operation": {**UNNAMED["operation"], "speed_rpm": "fast"}}, "mine", Path()
        )


def test_steps_that_no_bending_box_can_take_are_told_what_to_do() -> None:
    numerics = {"steps_per_sample": 0.25}
    with pytest.raises(InputError, match=r"effects\.structure.*name some without structure"):
        scene_from_mapping({**UNNAMED, "tier": "lumped", "numerics": numerics}, "mine", Path())
    scene_from_mapping({**UNNAMED, "tier": "lumped", "numerics": numerics, "effects": "dry"}, "mine", Path())


def test_an_explicit_integrator_asks_for_names() -> None:
    numerics = {"integrator": "explicit", "steps_per_sample": 391}
    with pytest.raises(InputError, match="write tier, effects"):
        scene_from_mapping({**UNNAMED, "numerics": numerics}, "mine", Path())


def test_a_changed_scene_of_python_is_chosen_for_anew() -> None:
    sound = bd.scene("smooth_run")
    spall = {"on": "cup", "width_mm": 6, "length_mm": 4, "offset_mm": 20}
    spalled = bd.scene(sound, faults=[spall])
    assert spalled.numerics.laminae > sound.numerics.laminae  # a short patch aside tilts its roller
    assert spalled == bd.scene("smooth_run", faults=[spall])


def test_what_is_set_in_python_stays_set() -> None:
    dry = load_effects("dry")
    scene = replace(bd.scene("static_80kN"), effects=dry)
    assert bd.scene(scene, seed=5).effects == dry
    assert bd.scene(bd.scene("static_80kN"), effects="dry").effects == dry


def small(**changes: Any) -> Trial:
    """Make a trial of one speed, track and wheel."""
    whole = load_trial("quick")
    return replace(whole, sizes=(6e-3,), faults=("cup",), wheels=whole.wheels[:1], check=None, **changes)


def test_a_trial_computes_sound_and_spalled_bearings_with_the_same_effects() -> None:
    trial = with_choices(small())
    scenes = [trial_scene(trial, cell) for cell in trial.cells()]
    assert {bool(scene.defects) for scene in scenes} == {True, False}
    assert len({(scene.effects, scene.numerics) for scene in scenes}) == 1
    assert "the same in all runs" in scenes[0].chosen[0]


def test_a_trial_with_effects_chooses_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    from beardyn_core.choice import trial as trials

    monkeypatch.setattr(trials, "choice_for", refuse)
    trial = with_choices(small(effects="standard"))
    assert trial.choices == ()
    effects = trial_scene(trial, trial.cells()[0]).effects
    assert isinstance(effects.structure, ModalStructure)  # the box of the scene stays
    assert replace(effects, structure=None) == load_effects("standard")


def test_together_every_effect_is_on_that_one_needs_and_of_the_kind_that_leaves_out_least() -> None:
    full, dry = load_effects("all"), load_effects("dry")
    less = replace(full, seal=None, small_rib=None, audit=None)
    both = together([less, replace(dry, seal=full.seal)], full)
    assert both.seal == full.seal
    assert both.small_rib is None
    assert (both.traction, both.film) == (full.traction, full.film)

"""The levels of a ladder: which there are for a scene, and in which order."""

from __future__ import annotations

from dataclasses import replace

import pytest

from beardyn_core.choice import load_scene
from beardyn_core.scene.tier import TIERS, contradictions
from beardyn_core.study.ladder_levels import automatic, expected_cost, level_of, levels_of
from beardyn_core.study.level_run import Comparison
from beardyn_core.twin import Twin
from test.study.fake_ladder import STANDARD, level


def test_a_fault_line_is_asked_of_the_vibration() -> None:
    scene = load_scene("cup_spall")
    asked = automatic(scene, 0.05, ("fault_line",))
    assert asked == automatic(scene, 0.05, ("vibration",))
    # what would be chosen if nothing were asked
    assert asked != automatic(scene, 0.05, ())


def test_tiers_are_judged_with_the_steps_that_they_take_unasked() -> None:
    for quick in (True, False):
        found = {
            (level.tier, level.steps_per_sample) for level in levels_of(load_scene("cup_spall"), quick).levels
        }
        assert {(tier.name, tier.steps_per_sample) for tier in TIERS.values()} <= found


# every scene and every list of levels once; the slow suite has each with each
LISTS = {"quick": (True, False), "usual": (False, False), "each effect": (False, True)}
FAST_LISTS = {("smooth_run", "usual"), ("cup_spall", "quick"), ("static_5kN", "each effect")}


@pytest.mark.parametrize(
    ("name", "quick", "each_effect"),
    [
        pytest.param(
            name, *chosen, id=f"{name}, {told}",
            marks=[] if (name, told) in FAST_LISTS else [pytest.mark.slow],
        )
        for name in ("smooth_run", "cup_spall", "static_5kN")
        for told, chosen in LISTS.items()
    ],
)  # fmt: skip
def test_every_level_of_a_scene_can_be_computed_and_has_its_own_name(
    name: str, quick: bool, each_effect: bool
) -> None:
    scene = load_scene(name)
    levels = levels_of(scene, quick, each_effect)
    every = [levels.reference, *levels.levels]
    assert len({level.name for level in every}) == len(every)
    assert levels.neighbour in levels.levels
    for found in every:
        applied = found.applied(scene)
        assert not contradictions(applied.tier, applied.effects.rib is not None, applied.numerics.laminae)
        assert applied.defects == scene.defects
        Twin(applied)
    costs = [expected_cost(level) for level in levels.levels]
    assert costs == sorted(costs)
    assert expected_cost(levels.reference) > max(costs)
    own = (scene.tier, scene.effects, scene.numerics.laminae, scene.numerics.steps_per_sample)
    assert own in [
        (level.tier, level.effects, level.laminae, level.steps_per_sample) for level in levels.levels
    ]
    assert {level.tier for level in levels.levels} == {"lumped", "quasistatic", "full"}
    assert {"dry", "standard", "all"} <= {level.effects_name for level in levels.levels}


def test_effects_of_the_scene_itself_are_a_level(comparison: Comparison) -> None:
    scene = replace(comparison.scene, effects=replace(STANDARD, cage=None))
    levels = levels_of(scene)
    assert "of the scene" in {level.effects_name for level in levels.levels}
    # the scene's own choice may be the neighbour itself
    usual = levels.neighbour.applied(comparison.scene)
    assert len(levels_of(usual).levels) == len(levels_of(comparison.scene).levels)
    assert level_of(usual, "all") == levels.neighbour
    assert level_of(usual, "auto", name="auto 5 %").name == "auto 5 %"


def test_another_level_takes_its_place_by_cost(comparison: Comparison) -> None:
    levels = levels_of(comparison.scene, quick=True)
    more = level("auto 5 %", "quasistatic", laminae=4, steps=2)
    found = levels.including(more)
    assert more in found.levels
    assert set(found.levels) - {more} == set(levels.levels)
    assert [expected_cost(r) for r in found.levels] == sorted(expected_cost(r) for r in found.levels)

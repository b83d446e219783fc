"""Mistakes of a sweep are told at once, with file and key, before anything runs; each run is what it says."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.config import read_sweep, scene_text
from beardyn_core.population.draw import rows_of
from beardyn_core.population.request import make_plan
from beardyn_core.population.sweep_scenes import scenes_of
from test.population.sweeps import TINY, planned, tiny


def test_mistakes_name_the_file_and_the_key_and_how_many_runs_have_them(tmp_path: Path) -> None:
    wrong = tiny(
        vary=[
            *TINY["vary"],
            {"key": "end_play_mm", "kind": "uniform", "low": 1, "high": 3},
            {"key": "temprature_C", "kind": "choice", "one_of": [20]},
        ]
    )
    with pytest.raises(InputError) as refused:
        bd.sweep(wrong, tmp_path / "set")
    told = str(refused.value)
    assert "end_play_mm is " in told
    assert "it must be at most 2 (and " in told
    assert "sweep: run 0: temprature_C" in told
    assert "unknown key" in told
    assert not (tmp_path / "set").exists()


def test_mistakes_of_file_scene_and_runs_are_told_together(tmp_path: Path) -> None:
    """Whoever mends one must not find the next one only then."""
    file = {"samplng": "sobol", "runs": 0}
    wrong_draws = [
        {"key": "temperature_C", "kind": "gauss", "mean": 60},
        {"key": "operation..x", "kind": "uniform", "low": 1, "high": 2},
        {"key": "end_play_mm", "kind": "uniform", "low": 1, "high": 3},
        {"key": "sensors[0].noise_densty", "kind": "uniform", "low": 1, "high": 2},
    ]
    changes = {
        "set": {**TINY["set"], "tier": "lumpd", "lubricnt": "L055"},
        "vary": [*TINY["vary"], *wrong_draws],
    }
    scene_and_runs = (
        "set.tier is 'lumpd'",
        "set.lubricnt: unknown key",
        "'operation..x' is no key path",
        "end_play_mm is ",
        "sensors[0].noise_densty: unknown key",
    )
    for given, expected in (
        ({**TINY, **changes, **file}, ("samplng: unknown key", "runs is 0", "vary[4].kind is 'gauss'")),
        ({**TINY, **changes, "vary": [*TINY["vary"], *wrong_draws[1:]]}, ()),
    ):
        with pytest.raises(InputError) as refused:
            bd.sweep(given, tmp_path / "set")
        for mistake in (*expected, *scene_and_runs):
            assert [mistake in each for each in refused.value.problems].count(True) == 1
    assert not (tmp_path / "set").exists()


def test_mistakes_in_what_is_set_are_those_of_the_sweep() -> None:
    for key, value, mistake in (
        ("tier", "lumpd", "sweep: set.tier is 'lumpd'"),
        ("defects[3].width_mm", 2, "set.defects[3].width_mm: the scene has no such entry"),
        (
            "operation.speed_profile[0].speed_kmh",
            "fast",
            "sweep: set.operation.speed_profile[0].speed_kmh is",
        ),
    ):
        with pytest.raises(InputError) as refused:
            planned(set={**TINY["set"], key: value})
        assert mistake in str(refused.value)
    with pytest.raises(InputError, match="there is no scene 'smoth_run'"):
        planned(scene="smoth_run")


def test_a_signal_that_no_run_has_is_a_mistake() -> None:
    with pytest.raises(InputError, match=r"sweep: signals\[1\] is 'vibratoin'; allowed are vibration, force"):
        planned(signals=["force", "vibratoin"])


def test_a_key_that_no_run_has_is_a_mistake() -> None:
    with pytest.raises(InputError, match=r"waviness\[0\].order.*no run has such an entry"):
        planned(vary=[*TINY["vary"], {"key": "waviness[0].order", "kind": "choice", "one_of": [3]}])


def test_signals_of_different_lengths_and_runs_of_one_bearing_are_refused() -> None:
    with pytest.raises(InputError, match="duration_s is"):
        planned(vary=[*TINY["vary"], {"key": "duration_s", "kind": "choice", "one_of": [0.2, 0.4]}])
    without = {**TINY["set"], "scatter": {"grade": "none"}}
    with pytest.raises(InputError, match="one and the same bearing"):
        planned(set=without, vary=TINY["vary"][3:])


def test_each_run_is_the_scene_that_its_values_say() -> None:
    plan = planned()
    rows = rows_of(plan.sweep)
    scenes = [plan.scene(row) for row in rows]
    for row, scene in zip(rows, scenes, strict=True):
        values = plan.keys(row)[1]
        assert scene.seed == row.seed
        assert scene.scatter is not None
        assert scene.scatter.seed == row.lot
        assert scene.operation.speed_profile[0].speed * 3.6 == pytest.approx(  # type: ignore[union-attr]
            values["operation.speed_profile[0].speed_kmh"]
        )
        if scene.defects:
            (spall,) = scene.defects
            assert 1e3 * spall.width == pytest.approx(values["defects[0].width_mm"])  # type: ignore[union-attr]
            assert spall.length == pytest.approx(2.0 * spall.width, rel=1e-5)  # type: ignore[union-attr]
        else:
            assert values["defects[0].width_mm"] is None
    assert {bool(scene.defects) for scene in scenes} == {True, False}


@pytest.mark.slow
def test_what_a_scene_leaves_open_is_chosen_once_for_all_runs() -> None:
    """Else a learner would tell a spall by the effects that its run was computed with."""
    plan = planned(set={**TINY["set"], "effects": {"preset": "auto"}, "tier": "lumped"})
    scenes = [plan.scene(row) for row in rows_of(plan.sweep)]
    assert len({repr(scene.effects) for scene in scenes}) == 1
    assert len({scene.numerics for scene in scenes}) == 1
    assert plan.chosen
    assert all(scene.chosen == plan.chosen for scene in scenes)


def test_a_base_scene_may_come_from_anywhere(tmp_path: Path) -> None:
    """A file of one's own, beside the sweep."""
    (tmp_path / "mine.yaml").write_text(scene_text(planned().scene(rows_of(planned().sweep)[0])))
    (tmp_path / "own.yaml").write_text(json.dumps({**TINY, "scene": "mine.yaml", "set": {}, "runs": 2}))
    plan = scenes_of(*read_sweep(tmp_path / "own.yaml"))
    assert plan.scene(rows_of(plan.sweep)[1]).tier == "lumped"


def test_a_learner_is_warned_of_draws_that_go_together() -> None:
    said: list[str] = []
    make_plan({**TINY, "sampling": "sobol"}, said.append)
    assert any("take random for a set to learn from" in each for each in said)
    said.clear()
    make_plan({**TINY, "sampling": "random"}, said.append)
    assert not any("take random" in each for each in said)

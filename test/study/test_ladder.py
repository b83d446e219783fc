"""The ladder: which of its levels are efficient or good enough, and what a run of it leaves behind."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.choice import load_scene
from beardyn_core.cli.json_output import json_text
from beardyn_core.config import load_effects
from beardyn_core.effects import KinematicCage
from beardyn_core.study.ladder import REFERENCE_RUNS, climb, comparison_of, repeats_of, vary_start
from beardyn_core.study.ladder_levels import Level, LevelList, automatic, levels_of
from beardyn_core.study.ladder_picture import ladder_figure, ladder_picture
from beardyn_core.study.ladder_report import json_object, table
from beardyn_core.study.ladder_result import BAND_LIMIT_DB, Ladder, Part, errors
from beardyn_core.study.ladder_store import RUNS_FILE, store_of
from beardyn_core.study.level_run import Comparison
from beardyn_core.study.measures import MEASURES, QUANTITIES, Outcome
from test.study.fake_ladder import ASKED, FAST, LEVELS, REFERENCE, SIZES, FakeRuns, climbed, level


def test_efficient_levels_and_the_cheapest_good_one(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns())
    verdicts = {row.level.name: ladder.verdict(row) for row in ladder.rows}
    assert verdicts == {"fast": "no", "middle": "yes", "exact": "yes", "slow": "yes"}
    # `slow` costs more than `exact` and is not better
    assert [row.level.name for row in ladder.efficient] == ["fast", "middle", "exact"]
    assert ladder.cheapest is not None
    assert ladder.cheapest.level.name == "middle"


def test_what_is_good_enough_depends_on_the_accuracy_asked_for(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns(), accuracy=0.01)
    assert ladder.cheapest is not None
    assert ladder.cheapest.level.name == "exact"
    score = ladder.score(ladder.rows[1])
    assert score is not None
    assert score.quantity == "torque"
    assert score.value == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize(
    ("error", "band", "margin", "verdict"),
    [
        (0.03, 0.01, 0.004, "yes"),
        (-0.03, 0.01, 0.004, "yes"),
        (0.045, 0.01, 0.004, "yes"),
        (0.047, 0.01, 0.004, "open"),
        (-0.055, 0.01, 0.004, "open"),
        (0.0, 0.13, 0.06, "open"),
        (0.065, 0.01, 0.004, "no"),
        (-0.065, 0.01, 0.004, "no"),
    ],
)
def test_good_enough_needs_each_error_sure_and_not_so_one_beyond_its_whole_band(
    error: float, band: float, margin: float, verdict: str
) -> None:
    assert Part("mean", error, band, margin).verdict(0.05) == verdict


def test_a_level_that_fails_in_one_band_passes_with_five_percent_at_most() -> None:
    """Normal runs whose true error lies on the limit in one band and is none in the others."""
    generator, windows, trials = np.random.default_rng(3), 5, 400
    vibration = next(k for k, measure in enumerate(MEASURES) if measure.quantity == "vibration")
    off = np.zeros(SIZES[vibration])
    off[7] = BAND_LIMIT_DB

    def drawn(level: Float) -> Outcome:
        rows = level + generator.normal(0.0, 0.3, (windows, len(level)))
        found = [
            tuple(row if k == vibration else np.ones(size) for k, size in enumerate(SIZES))
            for row in (rows.mean(axis=0), *rows)
        ]
        return Outcome(found[0], tuple(found[1:]))

    def verdict(level: Float) -> str:
        found = errors([drawn(level) for _ in range(2)], [drawn(np.zeros_like(off)) for _ in range(3)])
        return next(each for each in found if each.quantity == "vibration").verdict(0.05)

    passed = sum(verdict(off) == "yes" for _ in range(trials))
    assert passed <= 0.05 * trials + 3.0 * math.sqrt(0.05 * 0.95 * trials)
    assert passed > 0
    assert sum(verdict(0.2 * off) == "yes" for _ in range(50)) > 25


def test_only_a_level_that_is_surely_within_is_the_cheapest_within(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns())
    middle = ladder.rows[1]
    torque = middle.of("torque")
    assert torque is not None
    parts = tuple(replace(part, margin=0.04) for part in torque.parts)
    assert all(abs(part.error) < 0.05 and part.margin < 0.05 for part in parts)
    changed = tuple(replace(e, parts=parts) if e.quantity == "torque" else e for e in middle.errors)
    rows = (ladder.rows[0], replace(middle, errors=changed), *ladder.rows[2:])
    unsure = replace(ladder, rows=rows)
    assert unsure.verdict(rows[1]) == "open"
    assert unsure.cheapest is not None
    assert unsure.cheapest.level.name == "exact"


def test_the_choices_of_the_automatic_level_stand_below_the_table(comparison: Comparison) -> None:
    """By what it holds when that is less, else by what it leaves out of the reference."""
    every = load_effects("all")
    levels = replace(LEVELS, reference=replace(REFERENCE, effects_name="all", effects=every))
    less = replace(every, drag=None, seal=None)
    auto = Level("auto 5 %", "full", "auto", less, 6, 7)
    own = Level("own", "full", "of the scene", replace(load_effects("dry"), gravity=None), 6, 8)
    ladder = climb(comparison, replace(levels, levels=(auto, own)), 0.05, ASKED, runner=FakeRuns())
    text = table(ladder)
    assert "auto 5 %: full tier, 6 laminae x 7, effects: all less drag, seal" in text
    assert f"own: full tier, 6 laminae x 8, effects: {', '.join(own.effects.names())}" in text
    found = json.loads(json_text("ladder", json_object(ladder)))["levels"][0]
    assert found["less_than_reference"] == ["drag", "seal"]
    assert found["effects"] == list(less.names())


def test_a_quantity_that_is_not_asked_for_does_not_count(comparison: Comparison) -> None:
    ladder = climb(comparison, LEVELS, 0.01, ("force",), runner=FakeRuns())
    assert ladder.cheapest is not None
    assert ladder.cheapest.level.name == "fast"


def test_an_error_inside_the_band_is_not_resolved_and_nothing_is_claimed(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns(scatter=0.2))
    middle = next(row for row in ladder.rows if row.level.name == "middle")
    torque = middle.of("torque")
    assert torque is not None
    assert torque.worst is not None
    assert not torque.worst.resolved
    assert ladder.verdict(middle) == "open"
    assert ladder.cheapest is None
    # a cheaper level that may be as good leaves a dearer one inefficient
    assert [row.level.name for row in ladder.efficient] == ["fast"]
    text = table(ladder)
    assert "(" in next(line for line in text.splitlines() if line.strip().startswith("middle"))
    assert "cheapest level within 5 %: none; open: " in text


def test_every_error_and_band_is_in_the_json_and_the_table_names_all_quantities(
    comparison: Comparison,
) -> None:
    ladder = climbed(comparison, FakeRuns())
    found = json.loads(json_text("ladder", json_object(ladder)), parse_constant=pytest.fail)
    assert [row["name"] for row in found["levels"]] == ["fast", "middle", "exact", "slow"]
    assert found["efficient"] == ["fast", "middle", "exact"]
    assert found["cheapest"] == "middle"
    assert found["neighbour"] == "slow"
    assert found["machine"]["cores"] >= 1
    assert found["versions"]["numpy"] == np.__version__
    fast = found["levels"][0]
    assert fast["wall_time_per_simulated_time"]["median"] == pytest.approx(0.1)
    assert fast["errors"]["torque"]["worst"]["error"] == pytest.approx(0.5, abs=0.01)
    assert len(fast["errors"]["vibration"]["parts"]) == 26
    assert set(fast["errors"]) == set(QUANTITIES)
    text = table(ladder)
    for name in ("fast", "middle", *QUANTITIES):
        assert name in text
    assert comparison.revolutions == 4
    assert ", 4 whole cage revolutions, in 4 windows from " in text
    assert ", 1 whole cage revolution, in 1 window from " in table(
        replace(ladder, revolutions=1, edges=ladder.edges[:2])
    )


def test_a_reference_that_is_not_converged_is_said_to_be_so(comparison: Comparison) -> None:
    assert climbed(comparison, FakeRuns()).unconverged == ()
    ladder = climb(comparison, replace(LEVELS, neighbour=FAST), 0.05, ASKED, runner=FakeRuns())
    assert ladder.unconverged == ("torque", "vibration")
    assert "not converged within 5 %: torque, vibration" in table(ladder)
    assert json_object(ladder)["unconverged"] == ("torque", "vibration")


def test_a_level_that_leaves_its_validity_is_reported_and_never_good(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns(invalid=4))
    middle = next(row for row in ladder.rows if row.level.name == "middle")
    assert ladder.verdict(middle) == "no"
    assert ladder.score(middle) is None
    assert [row.level.name for row in ladder.efficient] == ["fast", "exact"]
    assert "middle: the run ended at 0.1 s: a number became NaN" in table(ladder)
    json.loads(json_text("ladder", json_object(ladder)), parse_constant=pytest.fail)


def test_a_reference_that_leaves_its_validity_ends_the_ladder(comparison: Comparison) -> None:
    with pytest.raises(ValidityError, match="reference cannot be computed"):
        climbed(comparison, FakeRuns(invalid=16))


def test_an_interrupt_keeps_what_was_done(comparison: Comparison) -> None:
    ladder = climbed(comparison, FakeRuns(interrupted=7))
    assert ladder.interrupted
    assert [row.level.name for row in ladder.rows] == ["fast", "middle"]
    assert ladder.neighbour is None
    assert "some levels are missing" in table(ladder)
    with pytest.raises(KeyboardInterrupt):
        climbed(comparison, FakeRuns(interrupted=16))


def test_an_interrupted_study_goes_on_with_the_levels_that_it_has_not(
    comparison: Comparison, tmp_path: Path
) -> None:
    def steps_run(runs: FakeRuns) -> list[int]:
        return [round(scene.numerics.steps_per_sample) for scene in runs.scenes]

    def rows_of(ladder: Ladder) -> list[str]:
        return [repr((row.cost, row.errors)) for row in ladder.rows]

    def go(runs: FakeRuns, over: Comparison = comparison) -> Ladder:
        return climb(over, LEVELS, 0.05, ASKED, runner=runs, store=store_of(over, tmp_path))

    first = FakeRuns(interrupted=7)
    begun = go(first)
    assert begun.interrupted
    second = FakeRuns()
    whole = go(second)
    assert not whole.interrupted
    assert set(steps_run(second)) == {7, 8}
    assert rows_of(whole)[:2] == rows_of(begun)[:2]
    third = FakeRuns()
    assert rows_of(go(third)) == rows_of(whole)
    assert third.scenes == []
    # a level of which a run is lacking is timed anew, and so is all after an edit of what it depends on
    path = tmp_path / RUNS_FILE
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:2] + lines[3:]))
    fourth = FakeRuns()
    go(fourth)
    assert steps_run(fourth) == REFERENCE_RUNS * [16]
    with pytest.raises(InputError, match="interrupted study of static_80kN with other options"):
        go(FakeRuns(), comparison_of(load_scene("static_80kN"), 0.4, 0.1))
    other = replace(comparison, block_count=comparison.block_count + 1)
    fifth = FakeRuns()
    go(fifth, other)
    assert set(steps_run(fifth)) == {1, 4, 7, 8, 16}


def test_repeated_runs_begin_a_hair_apart_and_feel_the_same(comparison: Comparison) -> None:
    runs = FakeRuns()
    climbed(comparison, runs)
    reference = runs.scenes[:REFERENCE_RUNS]
    assert len({scene.end_play for scene in reference}) == REFERENCE_RUNS
    assert all(scene.seed == comparison.scene.seed for scene in runs.scenes)
    assert max(abs(scene.end_play - comparison.scene.end_play) for scene in runs.scenes) < 1e-8
    assert vary_start(comparison.scene, 0) is comparison.scene
    other = vary_start(comparison.scene, 1)
    assert other.effects.cage is not None
    assert comparison.scene.effects.cage is not None
    assert other.effects.cage.initial_speed_ratio == pytest.approx(1.0001)
    assert len(runs.scenes) == REFERENCE_RUNS + sum(repeats_of(level) for level in LEVELS.levels)


def test_levels_run_as_often_as_is_asked_each_a_hair_apart(comparison: Comparison) -> None:
    runs = FakeRuns()
    ladder = climb(comparison, LEVELS, 0.05, runner=runs, reference_runs=4, least_runs=5)
    assert [row.runs for row in ladder.rows] == [5] * len(LEVELS.levels)
    assert ladder.reference.runs == 4
    assert len(runs.scenes) == 4 + 5 * len(LEVELS.levels)


def test_cages_without_a_speed_of_their_own_begin_apart_by_the_end_play(comparison: Comparison) -> None:
    kinematic = replace(comparison.scene, effects=replace(comparison.scene.effects, cage=KinematicCage()))
    other = vary_start(kinematic, 1)
    assert other.effects.cage == kinematic.effects.cage
    assert other.end_play != kinematic.end_play


@pytest.mark.slow
def test_the_picture_names_the_efficient_levels(comparison: Comparison, tmp_path: Path) -> None:
    ladder = climbed(comparison, FakeRuns())
    figure = ladder_figure(ladder)
    axes, *sides = [each for each in figure.axes if each.get_visible()]
    figure.draw_without_rendering()
    sizes = [each.get_window_extent() for each in sides]
    assert min(each.height for each in sizes) > 200.0  # pixels: a panel of each quantity can be read
    assert min(each.width for each in sizes) > 200.0
    written = [text.get_text() for text in axes.texts]
    assert {"fast: torque", "middle: vibration"} <= set(written)
    assert any(text.startswith("exact: ") for text in written)
    assert not any(text.startswith("slow") for text in written)
    path = tmp_path / "ladder.png"
    ladder_picture(ladder, path)
    with Image.open(path) as picture:
        assert picture.size == (1600, 1000)
        assert np.unique(np.asarray(picture.convert("L"))).size > 50
    ladder_picture(climbed(comparison, FakeRuns(invalid=4)), path)


@pytest.mark.slow
def test_a_real_ladder_of_two_levels() -> None:
    """Full tier against rollers as springs: the same force, torque without sliding friction."""
    scene = load_scene("static_80kN")
    comparison = comparison_of(scene, 0.25, 0.1)
    neighbour = level("neighbour", steps=4, laminae=5)
    levels = LevelList(
        level("reference", steps=4), neighbour, (level("rollers as springs", "lumped"), neighbour)
    )
    ladder = climb(comparison, levels, 0.05, ASKED)
    balanced, near = ladder.rows
    assert ladder.revolutions == 2
    assert balanced.status == near.status == "complete"
    force, torque = balanced.of("force"), balanced.of("torque")
    assert force is not None
    assert torque is not None
    assert force.worst is not None
    assert torque.worst is not None
    assert abs(force.worst.error) < 0.01
    assert torque.worst.resolved
    assert ladder.verdict(balanced) == "no"
    load = near.of("roller_load")
    assert load is not None
    assert load.worst is not None
    assert 1e-6 < abs(load.worst.error) < 0.05
    assert near.cost.median > balanced.cost.median > 0.0


@pytest.mark.slow
def test_the_reference_is_converged() -> None:
    """Half the laminae and twice the step of the reference move it by less than the accuracy."""
    comparison = comparison_of(load_scene("static_80kN"), 0.5, 0.25)
    levels = levels_of(comparison.scene, quick=True)
    ladder = climb(comparison, replace(levels, levels=(levels.neighbour,)), 0.05, ASKED)
    assert ladder.neighbour is not None
    for quantity in ("force", "deflection", "roller_load", "torque"):
        error = ladder.neighbour.of(quantity)
        assert error is not None
        assert error.worst is not None
        assert abs(error.worst.error) - error.worst.band < 0.02, quantity
        assert math.isfinite(error.worst.band)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "duration", "settling"), [("static_80kN", 0.5, 0.25), ("cup_spall", 0.7, 0.3)]
)
def test_the_automatic_choice_is_not_surely_beyond_the_accuracy(
    name: str, duration: float, settling: float
) -> None:
    """What the accuracy asks for is judged against every effect, many laminae and a small step."""
    comparison = comparison_of(load_scene(name), duration, settling)
    levels, scene = levels_of(comparison.scene, quick=True), comparison.scene
    auto = automatic(scene, 0.05, scene.quantities)
    ladder = climb(comparison, replace(levels, levels=(auto,)), 0.05, scene.quantities)
    (row,) = ladder.rows
    assert row.status == "complete"
    assert ladder.verdict(row) != "no", table(ladder)

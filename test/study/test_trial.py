"""A trial: its matrix, its statistics, and scores that grow with the spall."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import beta

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import open_to_append
from beardyn_core.choice import load_trial, trial_scene
from beardyn_core.cli.json_output import json_text
from beardyn_core.config import config_folder
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.trial import FAULTS, HEALTHY, Cell, Trial
from beardyn_core.study import trial as trial_module
from beardyn_core.study.trial import RUNS_FILE, TrialRun, conduct, conduct_run, plan_of, read_runs, run_digest
from beardyn_core.study.trial_picture import trial_picture
from beardyn_core.study.trial_report import json_object, slices, table
from beardyn_core.study.trial_result import Rate, TrialResult


def run_of(cell: Cell, verdict: str, scores: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> TrialRun:
    alarms = 3 if verdict in ("cup", "cone", "roller") else 0
    return TrialRun(cell.key, "d", verdict, 3, alarms, scores, 4.0, 19.0, "complete", 0.1)


@pytest.fixture
def quick() -> Trial:
    return load_trial("quick")


def test_the_matrix_has_every_combination_once_and_the_check_its_share(quick: Trial) -> None:
    cells = quick.cells()
    own = [cell for cell in cells if not cell.checks]
    healthy = 5 * 1 * 1 * 3
    assert len(own) == healthy + 3 * 3 * 1 * 1 * 3
    assert len({cell.key for cell in cells}) == len(cells)
    assert {cell.wheel for cell in own} == {"round", "flat", "polygon"}
    assert len(cells) - len(own) == -(-len(own) // 5)


def test_a_run_has_its_own_seed_which_no_order_of_the_matrix_changes(quick: Trial) -> None:
    own = [cell for cell in quick.cells() if not cell.checks]
    assert len({cell.seed(1) for cell in own}) == len(own)
    other = replace(quick, speeds=(*quick.speeds, 20.0), wheels=quick.wheels[::-1])
    assert {cell.seed(1) for cell in own} < {cell.seed(1) for cell in other.cells()}
    assert own[0].seed(1) != own[0].seed(2)


def test_a_run_and_its_check_are_the_same_scene_in_another_tier(quick: Trial) -> None:
    check = next(cell for cell in quick.cells() if cell.checks and cell.fault != "none")
    own = next(cell for cell in quick.cells() if cell.conditions == check.conditions and not cell.checks)
    one, two = trial_scene(quick, own), trial_scene(quick, check)
    assert (one.tier, two.tier) == ("quasistatic", "full")
    assert (one.defects, one.operation) == (two.defects, two.operation)
    assert (one.seed, one.duration) == (two.seed, two.duration)
    assert one.scatter == two.scatter
    assert one.defects[0].on == own.fault
    assert one.defects[0].width == pytest.approx(own.size)  # type: ignore[union-attr]


def test_every_run_has_another_bearing_of_the_lot(quick: Trial) -> None:
    scatters = [trial_scene(quick, cell).scatter for cell in quick.cells() if not cell.checks]
    assert {scatter.grade for scatter in scatters if scatter} == {"G1"}
    assert len({scatter.seed for scatter in scatters if scatter}) == len(scatters)
    lot = replace(quick, scatter=None)
    first, second = (trial_scene(lot, cell).scatter for cell in lot.cells()[:2])
    assert first is not None
    assert second is not None
    assert first.grade == second.grade == "G1"
    assert first.seed != second.seed


def test_bearings_as_drawn_stay_so(quick: Trial, tmp_path: Path) -> None:
    lines = (config_folder() / "scenes" / "smooth_run.yaml").read_text(encoding="utf-8").splitlines()
    drawn = tmp_path / "drawn.yaml"
    drawn.write_text("\n".join(line for line in lines if not line.startswith("scatter")), encoding="utf-8")
    own = replace(quick, scatter=None, scene=str(drawn))
    assert trial_scene(own, own.cells()[0]).scatter is None


def test_the_shipped_trials_have_flats_and_polygons_with_every_fault_and_without() -> None:
    for name in ("default", "quick"):
        cells = load_trial(name).cells()
        assert {(cell.fault, cell.wheel) for cell in cells} == {
            (fault, wheel) for fault in (HEALTHY, *FAULTS) for wheel in ("round", "flat", "polygon")
        }


def test_a_trial_of_healthy_bearings_has_no_fault_and_a_sensor_of_its_own() -> None:
    trial = load_trial("healthy")
    cells = trial.cells()
    assert {cell.fault for cell in cells} == {HEALTHY}
    assert sorted(cell.tier for cell in cells) == ["full"] * 45 + ["quasistatic"] * 90
    assert [sensor.noise_density for sensor in trial_scene(trial, cells[0]).sensors] == [3e-4]
    alarm = TrialRun(
        cells[0].key, "", "cup", 2, 1, (7.0, 0.0, 0.0), 6.0, 7.7, "complete", 1.0, ("cup fault: 56 Hz",)
    )
    result = TrialResult.of(trial, "", [alarm])
    assert f"  {cells[0].key}: cup fault: 56 Hz" in table(result).splitlines()
    assert json_object(result)["alarms"] == [{"run": cells[0].key, "called": ["cup fault: 56 Hz"]}]


def test_shapes_and_sensors_are_runs_of_their_own() -> None:
    trial = replace(load_trial("shapes"), sensors=("piezo_axlebox", "mems_50g"), surfaces=())
    cells = trial.cells()
    assert len({cell.key for cell in cells}) == len(cells)
    seen = {}
    for cell in cells:
        if cell.fault == "cup" and cell.size == 0.004 and cell.sensor == "mems_50g":
            seen[cell.shape] = trial_scene(trial, cell)
    assert set(seen) == {"slot", "whole", "round", "irregular"}
    assert {scene.sensors[0].noise_density for scene in seen.values()} == {2.45e-4}
    patches = {shape: scene.defects for shape, scene in seen.items()}
    effective = seen["whole"].bearing.effective_length
    assert patches["whole"][0].length == pytest.approx(effective)  # type: ignore[union-attr]
    assert patches["slot"][0].length == pytest.approx(0.008)  # type: ignore[union-attr]
    widths = [patch.width for patch in patches["round"]]  # type: ignore[union-attr]
    assert len(widths) == 13
    assert widths == pytest.approx([0.004 * (1.0 - (i / 6.5) ** 2) ** 0.5 for i in range(-6, 7)])
    lengths = [patch.length for patch in patches["round"]]  # type: ignore[union-attr]
    assert sum(lengths) == pytest.approx(0.004)
    irregular = [patch.width for patch in patches["irregular"]]  # type: ignore[union-attr]
    assert len(set(irregular)) > 5
    assert 0.0016 <= min(irregular) < max(irregular) <= 0.004
    names = [name for name, _ in slices(TrialResult.of(trial, "", []))]
    assert {"whole spalls", "mems_50g"} <= set(names)


def test_a_monitor_that_fails_costs_no_other_run(monkeypatch: pytest.MonkeyPatch, quick: Trial) -> None:
    one, other = quick.cells()[:2]

    def fails(*_: object) -> None:
        raise InputError("the monitor mine:chain has failed: KeyError: 'x', mine.py, line 3, in chain")

    monkeypatch.setattr(trial_module, "results_over", fails)
    failed = conduct_run(quick, one, "", "d")
    assert failed.status.endswith("mine.py, line 3, in chain")
    result = TrialResult.of(quick, "", [failed, run_of(other, "healthy")])
    assert result.false_alarms().total == 1
    assert f"  {one.key}: {failed.status}" in table(result).splitlines()


def test_five_hundred_healthy_bearings_and_worn_pockets_can_be_put_on_trial(tmp_path: Path) -> None:
    cells = load_trial("healthy_500").cells()
    assert {cell.fault for cell in cells} == {HEALTHY}
    assert len(cells) >= 500
    trial = load_trial("cage")
    worn = next(cell for cell in trial.cells() if cell.fault == "cage")
    assert trial_scene(trial, worn).defects[0].on == "cage"
    result = TrialResult.of(trial, "", [run_of(worn, "healthy")])
    assert result.detection().count == 0
    assert result.detection().total == 1
    assert "cage" in table(result)
    trial_picture(result, tmp_path / "trial.png")
    assert (tmp_path / "trial.png").stat().st_size > 10_000


BAD = """trial: bad
purpose: Nothing is right.
scene: smooth_runs
tier: fast
sizes_mm: [2, 2]
speeds_kmh: []
tracks: [german_low]
wheels: [{name: round, defects: [{kind: oval}]}]
repeat: 3
"""


def test_every_mistake_in_a_trial_is_told_at_once(tmp_path: Path) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(BAD)
    with pytest.raises(InputError) as refused:
        load_trial(path)
    told = "\n".join(refused.value.problems)
    for mistake in ("'fast'", "speeds_kmh", "'oval'", "did you mean `repeats`"):
        assert mistake in told
    assert all(problem.startswith(str(path)) for problem in refused.value.problems)


def test_mistakes_that_only_the_scenes_show_are_told_with_the_trial(tmp_path: Path, quick: Trial) -> None:
    path = tmp_path / "wide.yaml"
    text = (Path(quick.folder) / "quick.yaml").read_text(encoding="utf-8")
    path.write_text(text.replace("[2, 6, 12]", "[2, 60]").replace("german_low", "german_lower"))
    with pytest.raises(InputError) as refused:
        load_trial(path)
    told = "\n".join(refused.value.problems)
    assert "german_lower" in told
    path.write_text(text.replace("scene: smooth_run", "scene: static_80kN"))
    with pytest.raises(InputError, match="quarter_vehicle"):
        load_trial(path)


def test_interval_of_a_rate_is_that_of_clopper_and_pearson() -> None:
    rate = Rate.of(17, 20)
    assert rate.low == pytest.approx(beta.ppf(0.025, 17, 4), rel=1e-6)
    assert rate.high == pytest.approx(beta.ppf(0.975, 18, 3), rel=1e-6)
    assert (Rate.of(0, 0).low, Rate.of(0, 0).high) == (0.0, 1.0)
    # the rule of three, one-sided 97.5 %
    assert Rate.of(0, 100).high == pytest.approx(0.0362, abs=1e-4)


def test_rates_and_smallest_size_are_counted_from_the_runs(quick: Trial) -> None:
    runs = []
    for cell in quick.cells():
        found = cell.fault != "none" and (cell.size > 5e-3 or (cell.fault == "cup" and cell.wheel == "round"))
        verdict = cell.fault if found else "healthy"
        if cell.fault == "none" and cell.wheel == "flat" and cell.repeat == 0 and not cell.checks:
            verdict = "cone"
        if cell.fault == "roller" and cell.size > 1e-2:
            verdict = "cup"
        runs.append(run_of(cell, verdict))
    result = TrialResult.of(quick, "", runs)
    assert (result.false_alarms().count, result.false_alarms().total) == (1, 15)
    assert result.false_alarms(lambda cell: cell.wheel == "flat").count == 1
    assert (result.false_analyses().count, result.false_analyses().total) == (3, 45)
    rows = {(row.fault, row.size): row for row in result.sizes()}
    assert rows["cup", 0.002].found.count == 1
    assert rows["roller", 0.012].wrong == 3
    smallest = {found.fault: found for found in result.smallest()}
    assert smallest["cup"].size == pytest.approx(0.006)
    assert smallest["cup"].low == pytest.approx(0.002)  # one of three may still be 90 %
    assert smallest["cup"].high is None  # three of three are not yet 90 %
    assert smallest["roller"].size is None
    told = table(result)
    assert "tier quasistatic" in told
    assert "against full" in told
    assert "cup: 6 mm (2 mm to beyond the largest)" in told
    json.loads(json_text("trial", json_object(result)), parse_constant=pytest.fail)


def test_an_interrupted_trial_goes_on_where_it_was(
    quick: Trial, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trial = replace(quick, check=None, sizes=(0.006,), faults=("cup",), healthy_repeats=1)
    done: list[str] = []

    def stand_in(trial: Trial, cell: Cell, algorithm: str, digest: str) -> TrialRun:
        if len(done) == 3:
            raise KeyboardInterrupt
        done.append(cell.key)
        return replace(run_of(cell, "healthy"), digest=digest)

    monkeypatch.setattr(trial_module, "conduct_run", stand_in)
    with pytest.raises(KeyboardInterrupt):
        conduct(plan_of(trial, "", tmp_path), tmp_path, 1, lambda run: None)
    kept = tmp_path / RUNS_FILE
    assert [run.key for run in read_runs(kept)] == done
    kept.write_text(kept.read_text() + '{"key": "cut o')  # killed in the middle of a line
    plan = plan_of(trial, "", tmp_path)
    assert set(plan.kept) == set(done)
    first = list(done)
    done.clear()
    runs = conduct(plan, tmp_path, 1, lambda run: None)
    assert [run.key for run in runs] == [cell.key for cell in trial.cells()]
    assert not set(first) & set(done)
    assert not plan_of(trial, "", tmp_path).missing


@pytest.fixture
def small(quick: Trial) -> Trial:
    return replace(quick, check=None, sizes=(0.006,), faults=("cup",), healthy_repeats=1)


@pytest.fixture
def conducted(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Keys of the runs that were conducted, with a stand-in for the simulation."""
    done: list[str] = []

    def stand_in(trial: Trial, cell: Cell, algorithm: str, digest: str) -> TrialRun:
        done.append(cell.key)
        return replace(run_of(cell, "healthy"), digest=digest)

    monkeypatch.setattr(trial_module, "conduct_run", stand_in)
    return done


def no_progress(_run: TrialRun) -> None:
    pass


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "monitor", "named"),
    [
        ({"interval": 0.5}, "", "interval is 1.0 there and 0.5 here"),
        ({"seed": 9}, "", "and 9 here"),
        ({}, "test.study.test_trial:no_monitor", 'monitor is "" there and "test.study'),
        ({"sizes": (0.002, 0.006)}, "", "sizes is [0.006] there and [0.002, 0.006] here"),
    ],
)
def test_a_folder_of_another_trial_or_monitor_is_refused_and_keeps_its_runs(
    small: Trial,
    tmp_path: Path,
    conducted: list[str],
    changes: dict[str, Any],
    monitor: str,
    named: str,
) -> None:
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    before = (tmp_path / RUNS_FILE).read_bytes()
    assert len(read_runs(tmp_path / RUNS_FILE)) == len(conducted) > 0
    with pytest.raises(InputError) as refused:
        plan_of(replace(small, **changes), monitor, tmp_path)
    assert named in str(refused.value)
    assert "force=True" in str(refused.value)
    assert (tmp_path / RUNS_FILE).read_bytes() == before


def no_monitor(*_: object) -> None:
    """Stand for somebody's algorithm; it is never called."""


def test_force_starts_a_folder_over(small: Trial, tmp_path: Path, conducted: list[str]) -> None:
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    other = replace(small, seed=9)
    conduct(plan_of(other, "", tmp_path, force=True), tmp_path, 1, no_progress)
    assert not plan_of(other, "", tmp_path).missing
    with pytest.raises(InputError, match="seed is 9 there"):
        plan_of(small, "", tmp_path)


def test_runs_of_changed_code_are_counted_and_stay_until_they_have_been_run_again(
    small: Trial, tmp_path: Path, conducted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    old, count = (tmp_path / RUNS_FILE).read_bytes(), len(conducted)
    monkeypatch.setattr(trial_module, "simulator_digest", lambda: "edited")
    plan = plan_of(small, "", tmp_path)
    assert (plan.outdated, len(plan.missing)) == (count, count)

    def stop(run: TrialRun) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        conduct(plan, tmp_path, 1, stop)
    assert (tmp_path / RUNS_FILE).read_bytes().startswith(old)
    assert plan_of(small, "", tmp_path).outdated == count - 1
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    assert len(read_runs(tmp_path / RUNS_FILE)) == count
    assert len(conducted) == 2 * count
    assert not plan_of(small, "", tmp_path).missing


def test_a_run_depends_on_the_content_of_its_files(
    quick: Trial, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the modes of a shipped box a scene has only the name."""
    tables = tmp_path / "structures"
    tables.mkdir()
    text = (config_folder() / "structures" / "metro.csv").read_text(encoding="utf-8")
    (tables / "metro.csv").write_text(text)
    scene = replace(
        trial_scene(quick, quick.cells()[0]), effects=EffectSet(structure=ModalStructure("metro"))
    )
    monkeypatch.setattr("beardyn_core.structure.mounted_box.config_folder", lambda: tmp_path)
    before = run_digest(scene, quick, "code")
    assert run_digest(scene, quick, "code") == before
    (tables / "metro.csv").write_text(f"{text}\n")
    assert run_digest(scene, quick, "code") != before


@pytest.mark.parametrize("preset", ["standard", "full"])
def test_a_preset_for_a_trial_leaves_the_box_of_the_scene_ringing(preset: str) -> None:
    trial = load_trial("default", effects=preset)
    for cell in trial.cells()[:2]:
        assert trial_scene(trial, cell).effects.structure == ModalStructure("high_speed")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_a_full_disk_is_a_sentence_that_says_how_many_runs_are_kept(
    small: Trial, tmp_path: Path, conducted: list[str]
) -> None:
    (tmp_path / RUNS_FILE).symlink_to("/dev/full")
    with pytest.raises(InputError, match="No space left on device; the 0 runs before are kept"):
        conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)


def test_two_trials_cannot_write_one_folder(small: Trial, tmp_path: Path, conducted: list[str]) -> None:
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    with (
        open_to_append(tmp_path / RUNS_FILE),
        pytest.raises(InputError, match="another trial is writing this file"),
    ):
        plan_of(small, "", tmp_path)


def test_a_folder_of_an_earlier_version_is_refused_when_it_has_other_runs(
    small: Trial, tmp_path: Path, conducted: list[str]
) -> None:
    conduct(plan_of(small, "", tmp_path), tmp_path, 1, no_progress)
    path = tmp_path / RUNS_FILE
    path.write_text("".join(path.read_text().splitlines(keepends=True)[1:]))  # the line about the trial
    assert not plan_of(small, "", tmp_path).missing
    with pytest.raises(InputError, match="has a run 'cup 6 mm"):
        plan_of(replace(small, sizes=(0.002,)), "", tmp_path)


# the smallest and the largest spall tell most
@pytest.mark.parametrize("sizes", [slice(0, None, 2), pytest.param(slice(None), marks=pytest.mark.slow)])
def test_scores_grow_with_the_spall_and_runs_repeat_bit_by_bit(quick: Trial, sizes: slice) -> None:
    """In the quasistatic tier, every part, round wheel; a healthy run stays below all thresholds.

    A score is the evidence against chance. Behind a good sensor it says that there is a spall, not how large:
    here white noise of 0.005 m/s2 per root Hz stands for surroundings that hide small ones.
    """
    one_wheel = replace(quick, sizes=quick.sizes[sizes], wheels=quick.wheels[:1], noise_density=0.005)
    trial = replace(one_wheel, revolutions=30.0, healthy_repeats=1, check=None)
    scores: dict[str, list[float]] = {}
    alarm = np.inf
    for cell in trial.cells():
        run = conduct_run(trial, cell, "", "d")
        assert run.complete, run.status
        if cell.fault == "none":
            assert run.alarms == 0
            assert run.verdict == "healthy"
            again = conduct_run(trial, cell, "", "d")
            assert replace(again, wall=0.0) == replace(run, wall=0.0)
        else:
            scores.setdefault(cell.fault, []).append(run.scores[("cup", "cone", "roller").index(cell.fault)])
            alarm = run.threshold
    for fault, values in scores.items():
        assert (np.diff(values) > 1.0).all(), f"{fault}: {values}"
        assert values[-1] > alarm

"""`beardyn ladder`: bad input, what it writes, what it prints."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.cli import main as command
from beardyn_core.scene.scene import USUAL_QUANTITIES
from beardyn_core.scene.tier import TIERS
from beardyn_core.study import ladder
from beardyn_core.study.ladder import climb
from beardyn_core.study.level_run import Comparison, Run
from beardyn_core.study.measures import MEASURES, Outcome

FAST = tuple((name, TIERS[name].steps_per_sample) for name in ("lumped", "quasistatic"))


def one_run(scene: Any, comparison: Comparison) -> Run:
    """Stands in for a run: torque and cost by step, nothing scatters but the last digit."""
    steps = scene.numerics.steps_per_sample
    values = tuple(
        np.full(
            40 if measure.weighed else len(measure.parts),
            1.0 + (1.0 / steps**2 if measure.quantity == "torque" else 0.0) + 1e3 * scene.end_play,
        )
        for measure in MEASURES
    )
    return Run(Outcome(values, (values, values)), np.full(3, 0.1 * steps), "complete")


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Levels that were run, with stand-ins for compiling and running, in this process."""
    seen: list[Any] = []

    def runner(scene: Any, comparison: Comparison) -> Run:
        seen.append(scene)
        return one_run(scene, comparison)

    monkeypatch.setattr(ladder, "climb", partial(climb, runner=runner))
    monkeypatch.setattr(ladder.Twin, "warm", lambda _twin: 0.0)
    return seen


def test_every_mistake_is_told_at_once_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], runs: list[Any]
) -> None:
    scene = tmp_path / "bad.yaml"
    scene.write_text("scene: bad\nbearing: HS130\nlubricant: L055\noperation: {kind: constant}\n")
    words = ["ladder", str(scene), "-o", str(tmp_path / "missing" / "out"), "--duration", "-1"]
    words += ["--accuracy", "0", "--quantities", "force,noise"]
    assert command.main(words) == command.BAD_INPUT
    told = capsys.readouterr()
    assert told.out == ""
    for mistake in ("'HS130'", "force_kN is missing", "missing", "--duration -1", "--accuracy 0", "'noise'"):
        assert mistake in told.err
    assert list(tmp_path.iterdir()) == [scene]
    assert not runs


@pytest.mark.parametrize(("percent", "good"), [("0.09", False), ("0.1", True), ("50", True), ("51", False)])
def test_the_accuracy_has_the_range_of_a_scene(
    percent: str, good: bool, capsys: pytest.CaptureFixture[str], runs: list[Any]
) -> None:
    words = ["ladder", "static_80kN", "--quick", "--duration", "0.3", "--accuracy", percent]
    assert command.main(words) == (command.DONE if good else command.BAD_INPUT)
    told = f"--accuracy {percent}: allowed is 0.1 to 50 percent"
    assert (told in capsys.readouterr().err) is not good
    assert bool(runs) is good


def test_an_output_that_is_a_file_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "taken"
    path.touch()
    assert command.main(["ladder", "static_80kN", "-o", str(path)]) == command.BAD_INPUT
    assert "is a file; give the name of a folder" in capsys.readouterr().err


def test_table_json_and_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str], runs: list[Any]) -> None:
    folder = tmp_path / "out"
    words = ["ladder", "static_80kN", "--quick", "--duration", "0.3", "--accuracy", "10", "-o", str(folder)]
    assert command.main(words) == command.DONE
    told = capsys.readouterr()
    assert "cheapest level within 10 %: effects " in told.out
    found = json.loads((folder / "ladder.json").read_text())
    assert found["accuracy"] == pytest.approx(0.1)
    # (1/4^2 - 1/8^2) / (1 + 1/8^2) = 4.6 %, with 2 steps 23 %
    verdicts = {(row["tier"], row["steps_per_sample"]): row["verdict"] for row in found["levels"]}
    # the automatic level is a fast one, for the cup is held and does not vibrate
    assert verdicts == dict.fromkeys(FAST, "no") | {("full", 4): "yes"}
    assert "auto 10 %: lumped tier, " in told.out
    assert [row["name"] for row in found["levels"] if row["name"].startswith("auto")] == ["auto 10 %"]
    assert (folder / "ladder.png").stat().st_size > 10_000
    assert {scene.tier for scene in runs} == {"lumped", "quasistatic", "full"}


def test_json_alone_on_standard_output(capsys: pytest.CaptureFixture[str], runs: list[Any]) -> None:
    assert command.main(["ladder", "static_80kN", "--quick", "--duration", "0.3", "--json"]) == command.DONE
    found = json.loads(capsys.readouterr().out)
    assert found["scene"] == "static_80kN"
    assert found["quantities"] == list(USUAL_QUANTITIES)


@pytest.mark.slow
def test_an_interrupt_keeps_the_levels_done_so_far(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, runs: list[Any]
) -> None:
    def impatient(scene: Any, comparison: Comparison) -> Run:
        if scene.tier == "full" and scene.numerics.steps_per_sample == 4:
            raise KeyboardInterrupt
        return one_run(scene, comparison)

    monkeypatch.setattr(ladder, "climb", partial(climb, runner=impatient))
    words = ["ladder", "static_80kN", "--quick", "--duration", "0.3", "-o", str(tmp_path / "out")]
    assert command.main(words) == command.INTERRUPTED
    told = capsys.readouterr()
    assert "interrupted: some levels are missing" in told.out
    found = json.loads((tmp_path / "out" / "ladder.json").read_text())
    assert found["interrupted"]
    done = {(row["tier"], row["steps_per_sample"]) for row in found["levels"]}
    assert done == set(FAST)

    def patient(scene: Any, comparison: Comparison) -> Run:
        runs.append(scene)
        return one_run(scene, comparison)

    monkeypatch.setattr(ladder, "climb", partial(climb, runner=patient))
    assert command.main(words) == command.DONE
    assert {scene.tier for scene in runs} == {"full"}
    assert not json.loads((tmp_path / "out" / "ladder.json").read_text())["interrupted"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["ladder.json", "ladder.png"]
    assert command.main(words) == command.BAD_INPUT


def test_what_cannot_be_compared_is_refused_before_anything_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], runs: list[Any]
) -> None:
    scene = tmp_path / "explicit.yaml"
    scene.write_text(
        "scene: explicit\nbearing: HS130x230\nlubricant: L055\nduration_s: 0.5\n"
        "numerics: {integrator: explicit, steps_per_sample: 391}\n"
        "operation: {kind: constant, force_kN: [0, 0, 80], speed_rpm: 1165}\n"
    )
    assert command.main(["ladder", str(scene), "--quantities", "force,fault_line"]) == command.BAD_INPUT
    told = capsys.readouterr().err
    assert "numerics.integrator" in told
    assert "has no fault" in told
    assert not runs

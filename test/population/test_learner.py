"""The learner to compare others with: features that tell the parts apart, tests on other bearings only."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.cli import main as command
from beardyn_core.population.difficulty import difficulty_of
from beardyn_core.population.features import NAMES, TRANSFERABLE, UNITS, VERDICT, features_of
from beardyn_core.population.folder import ABOUT
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.learner import Learner
from beardyn_core.population.table import FEATURES, RUNS, write_table
from test.cli.json_page import check

CONDITIONS = ("healthy", "cup", "cone", "roller")


def made_set(folder: Path, noise: float, seed: int = 0) -> LabelledSet:
    """Two hundred runs of a hundred bearings whose scores tell the condition, without signals."""
    random = np.random.default_rng(seed)
    rows, features = [], []
    for run in range(200):
        bearing = run // 2
        condition = CONDITIONS[bearing % 4]
        width = None if condition == "healthy" else 1e-3 * random.uniform(2.0, 10.0)
        part = "train" if bearing % 3 else "test"
        rows.append({"run": run, "bearing_id": f"b{bearing}", "split": part, "status": "complete",
                     "condition": condition, "fault_width_m": width})  # fmt: skip
        found = {name: random.normal() for name in NAMES}
        if width is not None:
            found[f"score_{condition}"] += 10.0
            found["kurtosis"] = 1e3 * width + 0.2 * random.normal()
        noisy = {name: value + noise * random.normal() for name, value in found.items()}
        features.append({"run": run, **noisy, VERDICT: condition if noise < 1.0 else "healthy"})
    folder.mkdir()
    write_table(folder / RUNS, rows, {}, {})
    write_table(folder / FEATURES, features, UNITS, {})
    hard = difficulty_of(rows, features)
    about = {"format": 1, "sweep": "made", "parts": {}, "failed": 0, "difficulty": hard}
    (folder / ABOUT).write_text(json.dumps(about))
    return LabelledSet(folder)


def test_a_learner_names_what_its_features_tell_and_nothing_else(tmp_path: Path) -> None:
    clear, blind = made_set(tmp_path / "clear", 0.3), made_set(tmp_path / "blind", 300.0)
    learner = Learner().fit(clear)
    found = learner.judged("clear", clear)
    assert found.count == 68
    assert found.accuracy > 0.95
    assert found.width_error < 0.15
    assert sum(sum(row.values()) for row in found.matrix.values()) == found.count
    assert Learner().fit(blind).judged("blind", blind).balanced < 0.45
    assert set(list(learner.importance())[:4]) == {"kurtosis", "score_cup", "score_cone", "score_roller"}


def test_it_learns_the_same_twice_and_from_chosen_features_alone(tmp_path: Path) -> None:
    runs = made_set(tmp_path / "set", 0.3)
    one, two = (Learner(TRANSFERABLE).fit(runs).judged("x", runs) for _ in range(2))
    assert one == two
    with pytest.raises(InputError, match="a learner needs ten runs"):
        Learner().fit(runs, "validation")


def test_the_command_prints_a_table_and_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made_set(tmp_path / "set", 0.3)
    made_set(tmp_path / "other", 1.0, seed=1)
    words = ["baseline", str(tmp_path / "set"), "--test", str(tmp_path / "other")]
    assert command.main(words) == command.DONE
    told = capsys.readouterr().out
    assert "68 runs" in told
    assert "200 runs" in told
    assert "width of the spall" in told
    assert "an easy set: the shipped monitor names the part in 100 % of faulty runs" in told
    assert "the shipped monitor names the part in 0 % of faulty runs" in told
    assert command.main([*words, "--json"]) == command.DONE
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    check("baseline", found)
    assert command.main(["baseline", str(tmp_path)]) == command.BAD_INPUT
    assert "is no set of runs" in capsys.readouterr().err


def test_features_of_a_spalled_cup_lead_with_the_cup() -> None:
    """From the same function for simulated, recorded and measured runs."""
    scene = bd.scene("cup_spall", tier="lumped", duration=2.0)
    run = bd.simulate(scene)
    found = features_of(run, fault_frequencies(scene.bearing), scene.bearing.roller_count)
    assert tuple(found) != ()
    assert set(found) == set(NAMES)
    assert all(np.isfinite(list(found.values())))
    assert found["score_cup"] > max(found["score_cone"], found["score_roller"])
    octaves = [10.0 ** (found[name] / 10.0) for name in NAMES if name.startswith("octave_")]
    assert 0.9 < sum(octaves) <= 1.0 + 1e-9


def test_too_short_a_run_has_features_that_are_not_known() -> None:
    scene = bd.scene("cup_spall", tier="lumped", duration=0.2)
    found = features_of(bd.simulate(scene), fault_frequencies(scene.bearing), scene.bearing.roller_count)
    assert np.isnan(found["score_cup"])
    assert np.isfinite(found["level"])

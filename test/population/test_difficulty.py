"""How hard a set is: the monitor's verdicts counted, classes compared, one line that says so."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.population.difficulty import card_lines, difficulty_line, difficulty_of
from beardyn_core.population.features import TRANSFERABLE, VERDICT
from beardyn_core.population.folder import ABOUT, CARD, read_about, write_about
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.table import FEATURES

CONDITIONS = ("healthy", "cup", "cone", "cup+roller")


def runs(noise: float, bearings: int = 40, each: int = 3, seed: int = 1) -> tuple[list[Any], list[Any]]:
    """Runs of bearings whose scores tell the condition, and as much noise."""
    random = np.random.default_rng(seed)
    rows, features = [], []
    for run in range(bearings * each):
        bearing = run // each
        condition = CONDITIONS[bearing % len(CONDITIONS)]
        rows.append({"run": run, "status": "complete", "condition": condition, "bearing_id": f"b{bearing}"})
        values = {name: noise * random.normal() for name in TRANSFERABLE}
        for part in condition.split("+"):
            if f"score_{part}" in values:
                values[f"score_{part}"] += 10.0
        features.append({"run": run, **values, VERDICT: "healthy"})
    return rows, features


def test_the_verdicts_are_counted_by_condition() -> None:
    rows, features = runs(0.1)
    said = {"healthy": "cup", "cup": "cup", "cone": "roller", "cup+roller": "roller"}
    for row, values in zip(rows, features, strict=True):
        values[VERDICT] = said[row["condition"]]
    features[0][VERDICT] = "not_diagnosable"  # one of 30 healthy runs
    found = difficulty_of(rows, features)
    assert found is not None
    assert found["monitor"]["cup"] == {"runs": 30, "right": 1.0, "false": 0.0}
    assert found["monitor"]["cone"] == {"runs": 30, "right": 0.0, "false": 1.0}
    assert found["monitor"]["cup+roller"] == {"runs": 30, "right": 1.0, "false": 0.0}
    assert found["monitor"]["healthy"]["right"] == pytest.approx(1 / 30)
    assert "names the part in 67 % of faulty runs, false alarms in 97 %" in difficulty_line(found)


def test_classes_that_are_far_apart_make_an_easy_set_and_noise_a_hard_one() -> None:
    easy, hard = difficulty_of(*runs(0.1)), difficulty_of(*runs(1e3))
    assert easy is not None
    assert hard is not None
    assert easy["linear"] == 1.0
    assert difficulty_line(easy).startswith("an easy set")
    assert easy["separation"]["cup"] == {"area": 1.0, "feature": "score_cup"}
    assert hard["linear"] < 0.4
    assert difficulty_line(hard).startswith("difficulty")
    assert "no skill" not in difficulty_line(hard)
    assert hard["separation"]["cup"]["area"] < 0.8
    assert easy["chance"] == hard["chance"] == 0.25
    text = "\n".join(card_lines(easy))
    assert "| cup | 30 | 0 % | 0 % | 1.000, `score_cup` |" in text
    json.dumps(easy)


def test_a_rule_does_not_learn_from_the_bearing_it_is_tested_on() -> None:
    """Each bearing has a place of its own, which says nothing of its condition."""
    rows, features = runs(0.0, bearings=200, each=4)
    random = np.random.default_rng(5)
    for bearing in range(200):
        values = {name: 50.0 * random.normal() for name in TRANSFERABLE}
        for values_of_run in features[4 * bearing : 4 * bearing + 4]:
            values_of_run.update(values)
    found = difficulty_of(rows, features)
    assert found is not None
    assert found["linear"] == pytest.approx(0.25, abs=0.1)


def test_the_area_is_the_share_of_pairs_in_the_right_order() -> None:
    rows, features = runs(4.0)
    found = difficulty_of(rows, features)
    assert found is not None
    best = found["separation"]["cone"]["feature"]
    one, other = (
        [values[best] for row, values in zip(rows, features, strict=True) if row["condition"] == name]
        for name in ("cone", "healthy")
    )
    share = np.mean([a > b for a, b in itertools.product(one, other)])
    assert found["separation"]["cone"]["area"] == pytest.approx(max(share, 1 - share))


def test_failed_runs_and_one_condition_have_no_difficulty() -> None:
    rows, features = runs(0.1)
    assert difficulty_of([{**row, "status": "failed"} for row in rows], features) is None
    assert difficulty_of([{**row, "condition": "cup"} for row in rows], features) is None
    assert difficulty_of([], []) is None
    assert "not known" in difficulty_line(None)
    assert card_lines(None)[0] == "## Difficulty"


def test_unknown_features_do_not_spoil_the_others() -> None:
    rows, features = runs(0.1)
    for values in features[::3]:
        values["kurtosis"] = float("nan")
    for values in features:
        values["crest"] = None
    found = difficulty_of(rows, features)
    assert found is not None
    assert found["linear"] == 1.0


def test_a_set_states_its_difficulty(made: tuple[Path, Any]) -> None:
    folder = made[0]
    found = read_about(folder)["difficulty"]
    opened = LabelledSet(folder)
    assert opened.difficulty == found
    assert difficulty_line(found) in repr(opened)
    assert "## Difficulty" in (folder / CARD).read_text(encoding="utf-8")
    verdicts = opened.features[VERDICT].astype(str)
    assert set(verdicts) <= {"healthy", "cup", "cone", "roller", "waiting", "not_diagnosable", "unexplained"}
    assert (folder / FEATURES).is_file()
    assert (folder / ABOUT).is_file()
    if found is not None:
        assert sum(each["runs"] for each in found["monitor"].values()) == len(opened.runs_of(None))


def test_a_set_of_one_bearing_is_strict_json_and_says_so(tmp_path: Path) -> None:
    rows, features = runs(0.1)
    found = difficulty_of([{**row, "bearing_id": "b0"} for row in rows], features)
    assert found is not None
    about = {"format": 1, "difficulty": found, "unknown": float("nan"), "folder": tmp_path}
    write_about(tmp_path, about)

    def refused(name: str) -> None:
        raise AssertionError(f"{name} is no JSON")

    written = json.loads((tmp_path / ABOUT).read_text(), parse_constant=refused)
    assert written["difficulty"]["linear"] is None
    # a set of an earlier version
    text = (tmp_path / ABOUT).read_text().replace('"linear": null', '"linear": NaN')
    assert "NaN" in text
    (tmp_path / ABOUT).write_text(text)
    for each in (found, read_about(tmp_path)["difficulty"]):
        assert difficulty_line(each).endswith("all runs are of one bearing")
        assert any("discriminant" in line for line in card_lines(each))

"""Estimators of a bearing in one call: mistakes first, then runs, then an estimator for each set of axes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml

import beardyn_core as bd
from beardyn_core.api import training as making
from beardyn_core.base.errors import InputError
from beardyn_core.cli.main import main
from beardyn_core.config import load_bearing
from beardyn_core.config.folders import find
from beardyn_core.follow import training
from beardyn_core.follow.estimator_choice import own_folder
from beardyn_core.population import training_sweep
from beardyn_core.population.labelled_set import LabelledSet
from test.cli.json_page import check
from test.follow.test_estimator_choice import of_axes

BEARING = "HS130x230"


@pytest.fixture
def calls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is simulated and learnt; runs are none, and an estimator has what was learnt before."""
    done: list[Any] = []

    def simulate(sweep: Any, folder: Path, *_: Any) -> list[Any]:
        done.append(("runs", sweep.bearing.name, folder))
        return [[], []]

    def train(runs: Any, *, calibration: Any, axes: tuple[str, ...]) -> Any:
        done.append("".join(axes))
        return of_axes("".join(axes))

    monkeypatch.setattr(making, "_simulate", simulate)
    monkeypatch.setattr(training, "train", train)
    monkeypatch.setenv("BEARDYN_DATA_DIR", str(tmp_path / "data"))
    return done


def test_every_set_of_axes_learns_from_the_same_runs(calls: list[Any]) -> None:
    made = bd.make_estimators(BEARING)
    folder = own_folder()
    assert calls == [("runs", BEARING, folder / "HS130x230_runs"), "xyz", "z"]
    assert [each.file for each in made] == [folder / "HS130x230_xyz.npz", folder / "HS130x230_z.npz"]
    assert all(each.is_new and each.file.is_file() for each in made)


def test_what_is_there_is_kept_and_made_anew_where_that_is_asked_for(calls: list[Any]) -> None:
    bd.make_estimators(BEARING, axes=["xyz"])
    calls.clear()
    made = bd.make_estimators(BEARING)
    assert [each.is_new for each in made] == [False, True]
    assert calls[1:] == ["z"]
    calls.clear()
    bd.make_estimators(BEARING, axes=["xyz"])
    assert not calls
    bd.make_estimators(BEARING, axes=["xyz"], force=True)
    assert calls[1:] == ["xyz"]


def test_an_estimator_of_another_scene_sweep_or_sensor_is_not_taken_for_it(
    calls: list[Any], tmp_path: Path
) -> None:
    file, scene = tmp_path / "box.npz", tmp_path / "mine.yaml"
    keys = yaml.safe_load(find("scenes", "service_high_speed").read_text(encoding="utf-8"))
    scene.write_text(yaml.safe_dump(keys), encoding="utf-8")
    assert bd.make_estimators(scene=scene, output=file, axes=["xyz"])[0].is_new
    assert not bd.make_estimators(scene=scene, output=file, axes=["xyz"])[0].is_new
    scene.write_text(yaml.safe_dump(keys | {"end_play_mm": 0.2}), encoding="utf-8")
    for bearing, sensor in ((None, ""), (BEARING, ""), (BEARING, "mems_50g")):
        mine = scene if bearing is None else None
        with pytest.raises(InputError, match="the file exists"):
            bd.make_estimators(bearing, file, scene=mine, sensor=sensor, axes=["xyz"])
    assert len(calls) == 2


def test_a_file_of_ones_own_has_the_axes_in_its_name_where_there_are_several(
    calls: list[Any], tmp_path: Path
) -> None:
    made = bd.make_estimators(load_bearing(BEARING), tmp_path / "one.npz", axes=["zx"])
    assert [each.file.name for each in made] == ["one.npz"]
    assert calls == [("runs", BEARING, tmp_path / "one_runs"), "xz"]
    made = bd.make_estimators(BEARING, tmp_path / "two.npz", axes=["z", "y"])
    assert [each.file.name for each in made] == ["two_z.npz", "two_y.npz"]
    (tmp_path / "three.npz").write_text("of somebody")
    with pytest.raises(InputError, match="the file exists"):
        bd.make_estimators(BEARING, tmp_path / "three.npz", axes=["z"])


def test_mistakes_are_told_before_anything_runs(
    calls: list[Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runs, file = tmp_path / "runs", str(tmp_path / "one.npz")
    for words, sentences in (
        (("-o", file), ["DIR, --bearing, --scene: give a set of runs, or what is simulated"]),
        (("--scene", "smooth_run"), ["--output: is missing"]),
        (("--scene", "smooth_run", "--bearing", BEARING), ["a scene has its bearing; give one of the two"]),
        (("--scene", "service_hihg", "-o", file), ["there is no scene 'service_hihg'"]),
        (("--scene", "smooth_run", "-o", file, "--test", str(runs)), ["--test: is of a set of runs"]),
        ((str(runs), "--bearing", BEARING, "-o", file), ["give one of the two"]),
        ((str(runs),), ["--output: is missing"]),
        ((str(runs), "-o", file, "--like", "fifty"), ["--like: is of a bearing that is simulated"]),
        (("--bearing", BEARING, "--test", str(runs)), ["--test: is of a set of runs"]),
        (("--bearing", BEARING, "--axes", "xq,z,z"), ["'xq' is no set of axes", "each once, such as xyz,z"]),
        (("--bearing", "HS130x231"), ["there is no bearing 'HS130x231'", "did you mean HS130x230?"]),
        (("--bearing", BEARING, "--sensor", "mems"), ["there is no sensor 'mems'"]),
        (("--bearing", BEARING, "--like", "fast"), ["there is no sweep 'fast'"]),
        (("--bearing", BEARING, "-o", str(tmp_path / "no" / "one.npz")), ["no does not exist"]),
    ):
        assert main(["train", *words]) == 2
        told = capsys.readouterr().err
        assert all(sentence in told for sentence in sentences), told
    assert not calls


def test_the_scene_of_one_axlebox_gives_its_bearing(calls: list[Any], tmp_path: Path) -> None:
    made = bd.make_estimators(scene="service_metro", output=tmp_path / "mine.npz", axes=["z"])
    assert [each.file.name for each in made] == ["mine.npz"]
    assert calls[0][1] == "METRO120x220"
    for bearing, scene in ((BEARING, "service_metro"), (None, None)):
        with pytest.raises(InputError, match="give one of the two"):
            bd.make_estimators(bearing, tmp_path / "other.npz", scene=scene)


def test_the_command_prints_a_table_or_json(calls: list[Any], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["train", "--bearing", BEARING, "--json"]) == 0
    told = capsys.readouterr()
    check("train", json.loads(told.out))
    assert json.loads(told.out)["other_files"] == [str(own_folder() / "HS130x230_z.npz")]
    assert "300 runs to learn from and 100 of full" in told.err
    assert main(["train", "--bearing", BEARING]) == 0
    assert capsys.readouterr().out.count("was there before; --force makes it anew") == 2


def test_a_recording_gives_its_bearing(calls: list[Any], tmp_path: Path) -> None:
    bd.simulate("static_80kN", bearing="METRO120x220", duration=0.02, record=tmp_path / "run.mcap")
    bd.make_estimators(tmp_path / "run.mcap", tmp_path / "one.npz", axes=["z"])
    assert calls[0][1] == "METRO120x220"


@pytest.mark.slow
def test_an_interrupted_call_goes_on_and_an_estimator_of_one_axis_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Fewer runs than usual, of a tenth of a minute each; the first call is left while runs are simulated."""
    monkeypatch.setenv("BEARDYN_DATA_DIR", str(tmp_path / "data"))
    monkeypatch.setattr(training_sweep, "MOST", {"learnt": 64, "full": 12})

    def leave(now: Any) -> None:
        if now.done >= 16:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bd.make_estimators("FR130x230x150", axes=["z"], workers=2, progress=leave)
    told: list[int] = []
    made = bd.make_estimators(
        "FR130x230x150", axes=["z"], workers=2, progress=lambda now: told.append(now.here)
    )
    runs = own_folder() / "FR130x230x150_runs"
    assert [len(LabelledSet(runs / part)) for part in ("learnt", "full")] == [64, 12]
    assert max(told) < 64  # those of the first call are kept
    keys = yaml.safe_load((runs / "full.yaml").read_text(encoding="utf-8"))
    assert (keys["set"]["tier"], keys["runs"]) == ("full", 12)
    assert made[0].estimator.axes == ("z",)
    path = tmp_path / "run.mcap"
    bd.simulate("service_freight", duration=2.2, tier="quasistatic", record=path)
    monkeypatch.setattr("beardyn_core.follow.estimator_choice.list_shipped", list)
    assert bd.estimate(path).stretches == 1

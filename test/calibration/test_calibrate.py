"""Which recordings and scenes fit each other, and what is written."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.calibration import intake
from beardyn_core.calibration.fitting import Fit
from beardyn_core.calibration.twin import Beside, Values, operation_at
from beardyn_core.calibration.unknowns import BY_NAME, UNKNOWNS
from beardyn_core.calibration.writing import scene_keys, scene_text
from beardyn_core.choice import load_scene
from beardyn_core.cli import main as command
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, write_mapping
from test.calibration.law import BASES, law
from test.cli.json_page import check
from test.recordings import import_noise
from test.scenes import RIGID

RATE = 25_600.0
SCENE = "service_high_speed"


def recording(folder: Path, bearing: str = "HS130x230", rate: float = RATE, rpm: float = 1150.0) -> Path:
    """Make a recording that fits the scene where nothing else is asked for."""
    return import_noise(folder / "run.mcap", bearing=bearing, rate=rate, speed_rpm=rpm, force=True)


def fits(**values: float) -> tuple[Fit, ...]:
    return tuple(
        Fit(BY_NAME[name], BASES[name], value, (0.9 * value, 1.1 * value), 0.1, "", 0.0)
        for name, value in values.items()
    )


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"bearing": "METRO120x220"}, "is of METRO120x220.*service_high_speed has HS130x230"),
        (
            {"rate": 12_800.0},
            "sampled at 12800 Hz, the accelerometer of the scene service_high_speed at 25600",
        ),
        ({"rpm": 300.0}, "turns 300 times a minute, that of the scene service_high_speed 1153 times"),
    ],
)
def test_recordings_that_do_not_fit_the_scene_are_refused(
    given: dict[str, Any], sentence: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=sentence):
        bd.calibrate(recording(tmp_path, **given), SCENE)


@pytest.mark.parametrize(
    ("scene", "options", "sentence"),
    [
        ("rigid.yaml", {"fit": ["frequency"]}, "fit frequency: the scene healthy_140 has no modes of a box"),
        ("service_high_speed_cup", {}, "has a fault"),
        (SCENE, {"fit": ["stiffness"]}, "'stiffness' is no unknown; allowed are frequency, damping"),
        (SCENE, {"fit": []}, "fit: names nothing"),
        (SCENE, {"budget": 3}, "budget: is 3; it must be at least"),
        (SCENE, {"tier": "coarse"}, "tier: is 'coarse'; allowed are"),
        (SCENE, {"output": "mine.txt"}, "let its name end in .yaml"),
    ],
)
def test_what_cannot_be_asked_for_is_refused(
    scene: str, options: dict[str, Any], sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    rigid = {
        key: value for key, value in read_file(find("scenes", "healthy_140")).items() if key != "effects"
    }
    Path("rigid.yaml").write_text(write_mapping(rigid), encoding="utf-8")
    with pytest.raises(InputError, match=sentence):
        bd.calibrate(recording(tmp_path), scene, **options)


def test_a_fault_that_the_monitor_receives_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = recording(tmp_path)
    healthy = bd.monitor(run)
    assert healthy.finding is not None
    spalled = replace(healthy, finding=replace(healthy.finding, verdict="cup", reason="the cup is spalled"))
    monkeypatch.setattr(intake, "conclude", lambda *_, **__: spalled)
    with pytest.raises(InputError, match=r"finds a fault \(the cup is spalled\)"):
        bd.calibrate(run, SCENE)


def test_the_library_that_lacks_is_named_with_its_extra(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "cma", None)
    with pytest.raises(InputError, match=r"needs cma, which is not installed.*beardyn\[calibrate\]"):
        bd.calibrate(recording(tmp_path), SCENE)


def test_written_keys_are_those_of_the_scene_and_the_fitted_values(tmp_path: Path) -> None:
    given = fits(frequency=1.1, damping=0.5, background=2.0, noise=0.01, end_play=0.07)
    base, twin = find("scenes", SCENE), load_scene(SCENE)
    keys = scene_keys(base, twin, (*given[:-1], replace(given[-1], reason="not determined")), 0, tmp_path)
    (tmp_path / "mine.yaml").write_text(scene_text(keys, ["one line"]), encoding="utf-8")
    assert (tmp_path / "mine.yaml").read_text(encoding="utf-8").startswith("# one line\n\nscene:")
    raw = yaml.safe_load(base.read_text(encoding="utf-8"))
    assert {name for name in raw if keys[name] != raw[name]} == {"effects", "background", "sensors"}
    made = load_scene(tmp_path / "mine.yaml")
    for unknown, each in zip(UNKNOWNS, given, strict=True):
        expected = 0.1 if unknown.name == "end_play" else each.value
        assert unknown.base_of(made, 0) == pytest.approx(expected, rel=1e-3)


def test_files_beside_the_scene_are_found_from_another_folder(tmp_path: Path) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    table = find("structures", "high_speed").with_suffix(".csv")
    (here / "box.csv").write_bytes(table.read_bytes())
    text = find("scenes", SCENE).read_text(encoding="utf-8").replace("table: high_speed}", "table: box.csv}")
    (here / "base.yaml").write_text(text, encoding="utf-8")
    twin = load_scene(here / "base.yaml")
    for folder, named in ((here, "box.csv"), (there, str((here / "box.csv").resolve()))):
        keys = scene_keys(here / "base.yaml", twin, fits(frequency=1.1), 0, folder)
        assert keys["effects"]["structure"]["table"] == named


def test_a_scene_without_structure_and_background_has_other_unknowns() -> None:
    scene = load_scene("healthy_140", effects=RIGID)
    assert [each.name for each in UNKNOWNS if each.base_of(scene, 0) is not None] == ["noise", "end_play"]


def test_the_twin_runs_at_the_speed_of_the_shaft() -> None:
    scene = load_scene("smooth_run")
    keys = operation_at(scene, 20.0)
    assert keys["speed_profile"][0]["speed_kmh"] == pytest.approx(72.0 * np.pi * 0.92, rel=1e-6)
    with pytest.raises(InputError, match="runs on a track"):
        operation_at(load_scene("santos_step"), 20.0)


def test_the_command_writes_the_scene_and_tells_every_documented_key(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    played = law()

    def power(self: Beside, values: Values, seed: int) -> Float:
        self.runs += 1
        return np.repeat(played.power({**BASES, **values}, seed)[:, :1], 3, axis=1)

    monkeypatch.setattr(Beside, "power", power)
    run, out = recording(tmp_path), tmp_path / "mine.yaml"
    words = ["calibrate", str(run), "--scene", SCENE, "-o", str(out), "--budget", "43"]
    assert command.main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    check("calibrate", told)
    assert load_scene(out).name == "mine"
    assert out.read_text(encoding="utf-8").startswith("# Scene of one axlebox: service_high_speed fitted to")
    assert command.main(words) == 2
    assert "the file exists" in capsys.readouterr().err

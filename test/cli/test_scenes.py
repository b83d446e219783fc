"""`beardyn scenes` and `beardyn new`: what there is, and a copy of it to start from."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from beardyn_core.choice import load_scene, load_trial
from beardyn_core.cli.main import BAD_INPUT, DONE, main
from beardyn_core.cli.new import POSSIBLE
from beardyn_core.cli.scenes import KINDS
from beardyn_core.config import (
    config_folder,
    load_any_bearing,
    load_background,
    load_box,
    load_effects,
    load_lubricant,
    load_sensor,
    load_vehicle,
    read_sweep,
    shipped_names,
)

LOADERS: dict[str, Any] = {
    "scenes": load_scene,
    "bearings": load_any_bearing,
    "lubricants": load_lubricant,
    "vehicles": load_vehicle,
    "effects": load_effects,
    "trials": load_trial,
    "sweeps": lambda name: read_sweep(name)[0],
    "structures": load_box,
    "sensors": load_sensor,
    "backgrounds": load_background,
}


def test_everything_shipped_is_listed_with_a_purpose(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes", "all", "--json"]) == DONE
    found = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert found["schema_version"] == 1
    for kind in KINDS:
        assert [entry["name"] for entry in found[kind]] == list(shipped_names(kind))
        assert all(len(entry["purpose"]) > 10 for entry in found[kind])
        assert not any("cannot be used" in entry["purpose"] for entry in found[kind])
        assert all(Path(entry["file"]).is_file() for entry in found[kind])
    cup_spall = next(entry for entry in found["scenes"] if entry["name"] == "cup_spall")
    assert cup_spall["vehicle_speed_m_per_s"] == pytest.approx([50.0, 200.0 / 3.6])
    assert cup_spall["shaft_speed_rad_per_s"] == pytest.approx([50.0 / 0.46, 200.0 / 3.6 / 0.46])
    assert cup_spall["bearing"] == "HS130x230"
    assert cup_spall["duration_s"] == 8.0
    assert "spall on the cup" in cup_spall["faults"][0]


@pytest.mark.parametrize("kind", ["effects", "sensors"])
def test_a_list_needs_nothing_that_was_read_before(kind: str) -> None:
    """What files may have besides their nouns is known however a process begins."""
    run = [sys.executable, "-m", "beardyn_core.cli.main", "scenes", kind]
    listed = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    assert set(shipped_names(kind)) <= set(listed.split())
    assert "cannot be used" not in listed


def test_table_has_duration_speed_bearing_and_purpose(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scenes"]) == DONE
    lines = capsys.readouterr().out.splitlines()
    line = next(line for line in lines if line.startswith("  cup_spall"))
    assert re.match(r"  cup_spall +8 s +180 to 200 km/h +HS130x230 +Spalled cup in the load zone", line)
    assert lines.index("fault of the bearing, under a train:") < lines.index(line)
    assert max(map(len, lines)) <= 120
    assert main(["scenes", "bearings"]) == DONE
    assert re.search(r"  HS130x230 +130 x 230 x 160 mm +2 x 17 rollers", capsys.readouterr().out)


def test_a_file_with_a_mistake_is_listed_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "mine.yaml").write_text("scene: mine\nbearing: HS130x230\n")
    monkeypatch.setenv("BEARDYN_CONFIG", str(tmp_path))
    assert main(["scenes"]) == DONE
    assert re.search(r"with mistakes:\n  mine +cannot be used: ", capsys.readouterr().out)


@pytest.mark.parametrize(("kind", "name"), [(kind, name) for kind in KINDS for name in shipped_names(kind)])
def test_a_copy_says_the_same_with_comments(kind: str, name: str, tmp_path: Path) -> None:
    target = tmp_path / "mine.yaml"
    assert main(["new", name, "-o", str(target)]) == DONE
    text = target.read_text()
    assert "docs/reference.md" in text
    for comment in re.findall(r"#.*", _file(kind, name).read_text()):
        assert comment in text
    copy, original = LOADERS[kind](str(target)), LOADERS[kind](name)
    if kind == "scenes":
        assert (copy.name, original.name) == ("mine", name)
        assert copy.bearing == original.bearing
        assert copy.defects == original.defects
        assert copy.effects == original.effects
        assert copy.duration == original.duration
    elif kind != "effects":
        assert copy.name == "mine"
    if kind == "effects":
        assert copy == original


def _file(kind: str, name: str) -> Path:
    return config_folder() / kind / f"{name}.yaml"


@pytest.mark.parametrize("key", POSSIBLE)
@pytest.mark.parametrize("name", ["smooth_run", "static_5kN"])
def test_what_a_copy_offers_can_be_taken(name: str, key: str, tmp_path: Path) -> None:
    target = tmp_path / "mine.yaml"
    assert main(["new", name, "-o", str(target)]) == DONE
    text = target.read_text()
    assert (f"\n# {key}:" in text) != (f"\n{key}:" in text)
    lines = text.split("\n# Also possible; take the # away:\n")[1].splitlines()
    taken, inside = [], False
    for line in lines:
        inside = line.startswith(f"# {key}:") or (inside and line.startswith("#   -"))
        taken.append(line.removeprefix("# ") if inside else line)
    target.write_text("\n".join([text.split("\n# Also possible")[0], *taken]))
    load_scene(str(target))


def test_files_that_a_scene_refers_to_come_along(tmp_path: Path) -> None:
    assert main(["new", "measured_run", "-o", str(tmp_path / "mine.yaml")]) == DONE
    assert (tmp_path / "measured_run.csv").is_file()
    operation = load_scene(str(tmp_path / "mine.yaml")).operation
    assert Path(operation.path).parent == tmp_path  # type: ignore[union-attr]


def test_nothing_is_replaced_without_being_asked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    mine = tmp_path / "mine.yaml"
    mine.write_text("precious")
    assert main(["new", "cup_spall", "-o", "mine.yaml"]) == BAD_INPUT
    assert "--output mine.yaml: the file exists; --force replaces it" in capsys.readouterr().err
    (tmp_path / "measured_run.csv").write_text("precious")
    assert main(["new", "measured_run", "-o", "other.yaml"]) == BAD_INPUT
    assert "measured_run.csv: the file exists" in capsys.readouterr().err
    assert mine.read_text() == (tmp_path / "measured_run.csv").read_text() == "precious"
    assert not (tmp_path / "other.yaml").exists()
    assert main(["new", "cup_spall", "-o", "mine.yaml", "--force"]) == DONE
    assert load_scene("./mine.yaml").name == "mine"
    assert main(["new", "cup_spall"]) == DONE
    assert (tmp_path / "cup_spall.yaml").is_file()


def test_a_shipped_file_is_never_written(capsys: pytest.CaptureFixture[str]) -> None:
    before = _file("scenes", "cup_spall").read_bytes()
    assert main(["new", "cup_spall", "-o", str(_file("scenes", "cup_spall")), "--force"]) == BAD_INPUT
    assert "is a shipped file and stays" in capsys.readouterr().err
    assert _file("scenes", "cup_spall").read_bytes() == before


def test_all_mistakes_are_named_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "cup_spal"]) == BAD_INPUT
    assert "did you mean cup_spall?" in capsys.readouterr().err
    assert main(["new", "cup_spall", "-o", str(tmp_path / "no" / "such")]) == BAD_INPUT
    error = capsys.readouterr().err
    assert "give it the ending .yaml" in error
    assert "does not exist" in error

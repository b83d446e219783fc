"""The shipped scenes are a library of railway operations, each with its purpose and place on the page."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from beardyn_core.choice import load_scene
from beardyn_core.config import shipped_names
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation
from beardyn_core.scene.scene import Scene

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def written() -> dict[str, Any]:
    return runpy.run_path(str(DOCS / "write_scenes.py"))


@pytest.fixture(scope="module")
def scenes() -> list[Scene]:
    every = [load_scene(name) for name in shipped_names("scenes")]
    return [s for s in every if isinstance(s.operation, (QuarterVehicleOperation, MeasuredOperation))]


def test_the_page_is_that_of_the_scenes(written: dict[str, Any]) -> None:
    assert written["problems"]() == []
    assert written["main"](["--check"]) == 0
    assert written["main"](["--chek"]) == 2


def test_check_finds_a_stale_page_and_a_missing_picture(
    written: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = written["problems"].__globals__
    monkeypatch.setitem(names, "PAGE", tmp_path / "scenes.md")
    monkeypatch.setitem(names, "FOLDER", tmp_path)
    monkeypatch.setitem(names, "shipped_names", lambda kind: ["smooth_run", "static_5kN"])
    (tmp_path / "scenes.md").write_text("# Scenes\n")
    found = written["problems"]()
    assert len(found) == 2
    assert "scenes.md is not what the scenes say" in found[0]
    assert "smooth_run.png is missing" in found[1]
    assert written["main"](["--check"]) == 1


def test_there_are_at_least_fourteen_operations_of_every_sort(scenes: list[Scene]) -> None:
    assert len(scenes) >= 14
    rails = [s.operation for s in scenes if isinstance(s.operation, QuarterVehicleOperation)]
    wheel = {type(defect).__name__ for operation in rails for defect in operation.wheel_defects}
    rail = {type(defect).__name__ for operation in rails for defect in operation.rail_defects}
    assert wheel == {"WheelFlat", "WheelPolygon", "WheelOutOfRound"}
    assert rail == {"DippedJoint", "DippedWeld", "Crossing", "Corrugation"}
    assert len({operation.irregularity.kind for operation in rails}) >= 6
    assert any(isinstance(s.operation, MeasuredOperation) for s in scenes)
    speeds = [speed * 3.6 for operation in rails for _, speed in operation.speed_profile]
    assert min(speeds) < 0.0 < max(speeds)
    assert max(speeds) == pytest.approx(300.0)
    assert {s.bearing.name for s in scenes} == {
        "HS130x230",
        "FR130x230x150",
        "METRO120x220",
        "WJ130x240",
        "WJ180x320",
        "SRB120x260",
    }


def test_a_monitor_meets_true_and_false_friends(scenes: list[Scene]) -> None:
    def strange(scene: Scene) -> bool:
        operation = scene.operation
        return isinstance(operation, QuarterVehicleOperation) and bool(
            operation.wheel_defects or operation.rail_defects
        )

    kinds = {(bool(scene.defects), strange(scene)) for scene in scenes}
    assert kinds == {(True, True), (True, False), (False, True), (False, False)}
    faulty = {getattr(defect, "on", "") for scene in scenes for defect in scene.defects}
    assert faulty == {"cup", "cone", "roller"}
    healthy = [scene.name for scene in scenes if not scene.defects and not strange(scene)]
    assert len(healthy) >= 4


def test_every_railway_scene_is_on_the_page_with_its_purpose_and_a_small_picture(
    written: dict[str, Any], scenes: list[Scene]
) -> None:
    page = (DOCS / "scenes.md").read_text(encoding="utf-8")
    for scene in scenes:
        assert (
            f"### {scene.name}\n\n{scene.purpose}\n\n![{scene.name}](pictures/scenes/{scene.name}.png)"
            in page
        )
        path = DOCS / "pictures" / "scenes" / f"{scene.name}.png"
        assert path.stat().st_size < written["LARGEST_PICTURE"] == 40_000
        with Image.open(path) as picture:
            assert (picture.format, picture.mode) == ("PNG", "P")
    for name in shipped_names("scenes"):
        assert name in page


def test_a_picture_is_drawn_from_the_scene(written: dict[str, Any]) -> None:
    png = written["picture"](load_scene("measured_run", duration=0.5))
    assert png.startswith(b"\x89PNG")
    assert len(png) < 40_000

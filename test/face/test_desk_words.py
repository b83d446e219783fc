"""What a desk user reads: compiling, the next free folder, the box that is shown, bounds of a choice."""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core import twin
from beardyn_core.base.announcements import announced_on_stderr
from beardyn_core.base.errors import InputError
from beardyn_core.choice.load import choice_for
from beardyn_core.cli.main import main
from beardyn_core.config import read_scene
from beardyn_core.record.rerun_view import about
from beardyn_core.record.view_title import faults_elsewhere, view_title
from beardyn_core.study.demo_report import FILES, demo_folder

LUMPED: dict[str, Any] = {"tier": "lumped", "effects": "standard", "duration": 0.02}


def test_simulate_prints_one_line_when_it_compiles_and_none_when_it_does_not(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    logger = logging.getLogger("beardyn")
    monkeypatch.setattr(logger, "level", logging.NOTSET)
    monkeypatch.setattr(logger, "handlers", [])
    logger.manager._clear_cache()  # type: ignore[attr-defined]
    scene = bd.scene("static_80kN", **LUMPED)
    bd.simulate("static_80kN", **LUMPED)
    capsys.readouterr()
    bd.simulate("static_80kN", **LUMPED)
    assert capsys.readouterr().err == ""
    rehearse = twin.Twin._rehearse

    def compiled(self: twin.Twin) -> None:
        logging.getLogger("beardyn").info(twin.COMPILING)
        rehearse(self)

    monkeypatch.setattr(twin.Twin, "_rehearse", compiled)
    for run in (lambda: bd.simulate("static_80kN", **LUMPED), lambda: list(bd.blocks(scene))):
        run()
        assert capsys.readouterr().err == f"beardyn: {twin.COMPILING}\n"
    assert "kept for later" in twin.COMPILING
    assert logger.handlers == []
    assert logger.level == logging.NOTSET


def test_a_program_with_levels_of_its_own_keeps_them(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    logger = logging.getLogger("beardyn")
    monkeypatch.setattr(logger, "handlers", [])
    before = logger.level
    try:
        logger.setLevel(logging.ERROR)
        with announced_on_stderr():
            logger.info("quiet")
        assert logger.level == logging.ERROR
    finally:
        logger.setLevel(before)
    assert capsys.readouterr().err == ""


def test_a_second_demo_takes_the_next_free_folder_and_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    said: list[str] = []
    first = demo_folder(None, said.append)
    assert (first, said) == (Path("demo"), [])
    for number, name in enumerate(FILES[:3], start=2):
        (first / name).write_text("kept")
        first = demo_folder(None, said.append)
        assert first == Path(f"demo_{number}")
        assert f"these go to demo_{number}" in said.pop()
    Path("demo_5").write_text("a file")
    (first / FILES[0]).write_text("kept")
    assert demo_folder(None, said.append) == Path("demo_6")
    assert demo_folder(None, said.append, force=True) == Path("demo")
    with pytest.raises(InputError, match="exists"):
        demo_folder(Path("demo"), said.append)


@pytest.mark.parametrize("known", [0.41, 0.001, math.nan])
def test_a_choice_states_bounds_of_the_difference_from_the_full_model(known: float) -> None:
    choice = choice_for(read_scene("static_80kN"))
    found = replace(choice, expected={"force": 0.0, "torque": known}, within=False).summary
    assert "more than asked for" not in found
    assert "expected error" not in found
    assert "differs from the full model by at most" in found
    assert ("bound is wider than the wanted torque 5 %" in found) == (known == 0.41)
    assert ("difference from the full model unknown for torque" in found) == math.isnan(known)


def test_view_names_the_axlebox_of_several_and_lists_the_others(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recording = tmp_path / "two.mcap"
    axles = {"axles": 1, "faulty": ["axle_1_right"]}
    run = bd.simulate("cup_spall", axleboxes=axles, record=recording, **LUMPED)
    read = bd.read(recording)
    for each in (run, read):
        assert {name: one.box for name, one in each.boxes.items()} == {name: name for name in each.boxes}
    spall = read.boxes["axle_1_right"].described().defects[0].described()
    assert "spall on the cup" in spall
    for name, faults in (
        ("axle_1_left", f"no fault here; in axle_1_right: {spall}"),
        ("axle_1_right", spall),
    ):
        one = read.boxes[name]
        title = view_title(one.described(), one.box, faults_elsewhere(one))
        assert title == f"cup_spall, axlebox {name}: bearing HS130x230, {faults}"
        assert f"Axlebox **{name}** of axle_1_left, axle_1_right." in about(one)
    assert main(["view", str(recording), "--save", str(tmp_path / "left.rrd")]) == 0
    assert capsys.readouterr().err.endswith(
        f"shows the axlebox axle_1_left; --box shows another: axle_1_right ({spall})\n"
    )

"""Inputs that were taken in silence, or refused unclearly: each has its sentence."""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.life import load_doubts, static_rating
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.cli import main as command
from beardyn_core.cli import simulate
from beardyn_core.config import config_folder, load_bearing
from beardyn_core.monitor.chain import MonitorResult
from beardyn_core.monitor.chain.timeout import WAITED_FOR, NoAnswerError, within
from beardyn_core.monitor.streaming import Monitor
from beardyn_core.rail.measured import read_measurement
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.scene.defect import doubts_about
from beardyn_core.scene.patch import width_problem
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.sensors.block import Block
from beardyn_core.study import desk_run
from test.record.synthetic_run import SyntheticRun
from test.recordings import write_recording

BEARING = load_bearing("HS130x230")
SCENE = """scene: mine
purpose: A test.
bearing: HS130x230
lubricant: L055
operation: {kind: constant, force_kN: [0, 0, FORCE], speed_rpm: 600}
duration_s: 0.1
effects: standard
defects: [{on: ON, row: 0, width_mm: WIDTH, depth_um: 20}]
sensors: [{name: "NAME"}]
"""


def scene_text(**values: object) -> str:
    text = SCENE
    for key, value in {"FORCE": 80, "WIDTH": 6, "ON": "cup", "NAME": "top", **values}.items():
        text = text.replace(key, str(value))
    return text


# --- defects and forces of a scene ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"WIDTH": 0.006}, "my.yaml: defects[0].width_mm is 0.006; it must be at least 0.03"),
        ({"WIDTH": 0.006, "ON": "roller"}, "defects[0].width_mm is 0.006; it must be at least"),
        ({"WIDTH": 200, "ON": "cone"}, None),
        ({"FORCE": 80_000_000}, "my.yaml: operation.force_kN: the force is 8e+10 N"),
        ({"FORCE": 80_000}, "times the static load rating of HS130x230"),
        (
            {"NAME": "top left"},
            "sensors[0].name is 'top left'; it must begin with a letter, and consist of letters a to z",
        ),
    ],
)
def test_a_scene_that_cannot_be_is_refused_with_file_and_key(
    values: dict[str, object], words: str | None
) -> None:
    if words is None:
        assert scene_from_text(scene_text(**values), "my.yaml").defects
        return
    with pytest.raises(InputError) as refused:
        scene_from_text(scene_text(**values), "my.yaml")
    assert words in str(refused.value)
    assert "^[A-Za-z]" not in str(refused.value)


def test_no_spall_is_wider_than_half_a_raceway() -> None:
    assert "half of the raceway" in width_problem(0.4, "cup", BEARING)
    assert width_problem(0.15, "cup", BEARING) == width_problem(1e-4, "cone", BEARING) == ""


def test_a_spall_that_several_rollers_are_in_at_once_is_doubted() -> None:
    scene = scene_from_text(scene_text(WIDTH=150))
    (doubt,) = doubts_about(scene.defects, scene.bearing)
    assert "defects[0]: spall on the cup, row 0, 150.0 mm wide" in doubt
    assert "between two rollers" in doubt
    usual = scene_from_text(scene_text())
    assert doubts_about(usual.defects, usual.bearing) == []
    for name in ("cup_spall", "brinelling"):
        shipped = load_scene(name)
        assert doubts_about(shipped.defects, shipped.bearing) == []


def test_forces_of_another_unit_are_doubted_or_refused() -> None:
    for usual in ((0.0, 0.0, 8e4), (0.0, 2e4, 5e3), (0.0, 0.0, 0.0)):
        assert load_doubts(BEARING, usual) == ("", "")
    assert "less than a thousandth" in load_doubts(BEARING, (0.0, 0.0, 80.0))[1]
    assert "keep marks" in load_doubts(BEARING, (0.0, 0.0, 1.1 * static_rating(BEARING)))[1]
    for absurd in (8e7, float("inf"), float("nan")):
        assert "static load rating" in load_doubts(BEARING, (0.0, 0.0, absurd))[0]


def test_the_bearing_command_refuses_and_doubts_loads(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["bearing", "HS130x230", "--load", "0", "0", "80000000N"]) == command.BAD_INPUT
    assert "--load: the force is 8e+07 N" in capsys.readouterr().err
    assert command.main(["bearing", "HS130x230", "--load", "0", "0", "80N"]) == command.DONE
    assert "warning: --load: the force is 80 N" in capsys.readouterr().err


# --- files of load -------------------------------------------------------------------------------------


HEADER = "time_s,speed_rpm,fx_N,fy_N,fz_N\n"


def table(force: float) -> str:
    return HEADER + "".join(f"{0.01 * row},600,0,0,{force}\n" for row in range(20))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("eu.csv", table(8e4).replace(",", ";"), "its columns are separated by semicolons; separate them by"),
        ("tab.csv", table(8e4).replace(",", "\t"), "its columns are separated by tabs"),
        (
            "load.xlsx",
            b"PK\x03\x04\x14\x00\x06\x00\x08\x00\x00\x00!\x00\xff\xfe",
            "is a spreadsheet, not CSV",
        ),
        ("load.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\x00\x00\xff", "is a spreadsheet, not CSV"),
        ("far.csv", table(8e7), "fz_N is 8e+07 at 0 s; allowed is up to 1e+07 N"),
    ],
)
def test_a_file_of_load_that_cannot_be_read_is_one_sentence(
    name: str, content: str | bytes, words: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InputError) as refused:
        read_measurement(path)
    (sentence,) = refused.value.problems
    assert sentence.startswith(str(path))
    assert words in sentence


@pytest.mark.parametrize(("force", "doubted"), [(80.0, True), (-80.0, True), (0.0, False), (8e4, False)])
def test_kilonewtons_under_a_header_of_newtons_are_doubted(
    force: float,
    doubted: bool,
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import logging

    monkeypatch.setattr(logging.getLogger("beardyn"), "propagate", True)
    path = tmp_path / "load.csv"
    path.write_text(table(force))
    read_measurement(path)
    assert (f"{path}: fz_N is the largest force and never exceeds 80 N" in caplog.text) == doubted


# --- sensors -------------------------------------------------------------------------------------------


def test_samples_at_the_end_of_a_sensor_s_range_are_counted_and_told() -> None:
    run = SyntheticRun()
    blocks: list[Block] = [run.block(index) for index in range(3)]
    received = np.concatenate([block.vibration[0].acceleration for block in blocks])
    largest = float(np.abs(received).max())
    for range_, count in (
        (2.0 * largest, 0),
        (largest, int((np.abs(received) >= largest).any(axis=1).sum())),
    ):
        trend = desk_run.Trend((Accelerometer(range=range_),))
        for block in blocks:
            trend.add(block)
        summary = trend.summary(load_scene("static_5kN"), 1.0, desk_run.COMPLETE)
        assert summary.clipped == ((("axlebox_top", count, len(received)),) if count else ())
        told = simulate.json_object(summary, None)["clipped_samples"]
        assert told == ({"axlebox_top": count} if count else {})


# --- monitors ------------------------------------------------------------------------------------------


def failing(*_: object) -> MonitorResult:
    return {"cup": 1}["cone"]  # type: ignore[return-value]


def misspelt(*_: object) -> MonitorResult:
    return MonitorResult("outer ring", "a fault", 0)


def short(*_: object) -> MonitorResult:
    return replace(MonitorResult("cup", "a fault", 0), scores=(1.0,))  # type: ignore[arg-type]


def wordless(*_: object) -> str:
    return "cup"


def endless(*_: object) -> MonitorResult:
    while True:
        pass


def asleep(*_: object) -> MonitorResult:
    time.sleep(4.0)
    return MonitorResult("cup", "a fault", 0)


def quitting(*_: object) -> MonitorResult:
    sys.exit(3)


@pytest.mark.parametrize(
    ("algorithm", "words"),
    [
        (endless, ["test_doubtful_inputs:endless has not answered within 0.5 s", __file__, "in endless"]),
        (asleep, ["test_doubtful_inputs:asleep has not answered within 0.5 s", __file__, "in asleep"]),
        (quitting, ["test_doubtful_inputs:quitting has failed: SystemExit: 3", __file__, "in quitting"]),
        (failing, ["test_doubtful_inputs:failing has failed: KeyError: 'cone'", __file__, "in failing"]),
        (misspelt, ["answered the verdict 'outer ring'; allowed are waiting, healthy, cup"]),
        (short, ["answered 1 scores; there must be one for each of cup, cone, roller"]),
        (wordless, ["answered a str; it must be a MonitorResult"]),
    ],
)
def test_a_monitor_of_one_s_own_that_goes_wrong_is_a_sentence(
    algorithm: Callable[..., MonitorResult], words: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from beardyn_core.bearing.kinematics import fault_frequencies

    monkeypatch.setattr("beardyn_core.monitor.chain.algorithm_by_name.PATIENCE_S", 0.5)

    monitor = Monitor(fault_frequencies(BEARING), BEARING.roller_count, algorithm=algorithm)
    time_ns = np.arange(0, 4 * 25_600, dtype=np.int64) * 1_000_000_000 // 25_600
    monitor.push_vibration(time_ns, np.zeros((len(time_ns), 3)))
    monitor.push_shaft(time_ns[::64], 0.2 * np.arange(len(time_ns[::64]), dtype=np.float64))
    with pytest.raises(InputError) as refused:
        monitor.result()
    for word in words:
        assert word in str(refused.value)


def test_a_monitor_that_never_answers_is_ended_and_takes_no_processor_time() -> None:
    with pytest.raises(NoAnswerError):
        within(0.05, endless)
    left = [each for each in threading.enumerate() if each.name == WAITED_FOR]
    for each in left:
        each.join(10.0)
        assert not each.is_alive()


def test_the_monitor_command_tells_of_a_cut_recording_and_of_another_bearing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_recording(tmp_path / "run.mcap", 30)
    assert command.main(["monitor", str(path), "--json"]) in (command.DONE, command.BAD_INPUT)
    before = capsys.readouterr()
    assert "warning" not in before.err
    path.write_bytes(path.read_bytes()[: path.stat().st_size * 3 // 4])
    scan = McapScan(path)
    list(scan.messages())
    command.main(["monitor", str(path), "--bearing", "METRO120x220", "--json"])
    told = capsys.readouterr()
    assert f"warning: {scan.problem}; monitored is what is there" in told.err
    if told.out:
        json.loads(told.out)


def test_another_bearing_than_the_recorded_one_is_told() -> None:
    from beardyn_core.cli.monitored_files import other_bearing

    other = load_bearing("METRO120x220")
    assert other_bearing(BEARING, BEARING) == ""
    assert other_bearing(replace(BEARING, name="the same"), BEARING) == ""
    told = other_bearing(other, BEARING)
    assert told.startswith(f"the recording is of HS130x230, {BEARING.roller_count} rollers in a row, BPFO")
    assert "METRO120x220 would show" in told


def test_a_scene_tells_of_a_force_of_another_unit_and_shipped_ones_of_nothing() -> None:
    (doubt,) = scene_from_text(scene_text(FORCE=0.08)).doubts
    assert doubt.startswith("operation.force_kN: the force is 80 N, less than a thousandth")
    assert scene_from_text(scene_text()).doubts == ()
    for name in ("static_80kN", "static_5kN", "light_coasting", "cup_spall"):
        assert load_scene(name).doubts == ()


def test_sensors_and_depths_of_another_unit_are_doubted() -> None:
    metres = bd.scene("static_80kN", sensors=[{"name": "top", "position_mm": [0, 0, 0.17]}])
    micrometres = bd.scene("static_80kN", sensors=[{"name": "top", "position_mm": [0, 0, 170_000]}])
    spall = bd.scene("static_80kN", faults=[{"on": "cup", "width_mm": 6, "depth_um": 0.05}])
    words = ("top is inside of the bearing", "top is further than 1 m", "shallower than 0.1 µm")
    for scene, word in zip((metres, micrometres, spall), words, strict=True):
        (doubt,) = scene.doubts
        assert word in doubt
        assert doubt.endswith("check the unit")


def test_explain_doubts_as_simulate_does(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (config_folder() / "scenes" / "static_5kN.yaml").read_text(encoding="utf-8")
    scene = tmp_path / "mine.yaml"
    scene.write_text(text.replace("[0, 0, 170]", "[0, 0, 0.17]"))
    assert command.main(["explain", str(scene)]) == command.DONE
    assert "warning: sensors[0].position_mm" in capsys.readouterr().err


def test_a_shaft_speed_that_no_scene_may_have_has_no_static_answer(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for ask in (bd.torque, bd.life, bd.fault_frequencies):
        with pytest.raises(InputError, match=r"speed_rpm is .*; give a number from -6000 to 6000"):
            ask("HS130x230", speed_rpm=1e9)
    with pytest.raises(InputError, match="speed_rpm is nan"):
        bd.torque("HS130x230", speed_rpm=float("nan"))
    assert command.main(["bearing", "HS130x230", "--speed", "200Hz"]) == command.BAD_INPUT
    assert "--speed is 200Hz; it must be at most 6000 rpm" in capsys.readouterr().err

"""Every `--json` object: strict JSON, one vocabulary, every key on docs/json.md."""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Annotated as A
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.plain_json import keyed_fields, plain
from beardyn_core.choice import load_scene, load_trial
from beardyn_core.cli import report as report_command
from beardyn_core.cli import simulate, simulate_train
from beardyn_core.cli.json_output import SCHEMA_VERSION, json_text
from beardyn_core.cli.main import COMMANDS, DONE, main, module_of
from beardyn_core.cli.monitor import json_object
from beardyn_core.config import load_plate
from beardyn_core.measured.about import Mounted
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.physics.statics.rating_life import RatingLife
from beardyn_core.physics.thermal import NODES
from beardyn_core.record.published import MissingMessages
from beardyn_core.record.reporting import Gap, report
from beardyn_core.scene.defect import MissingRoller, RollerError, WornPocket
from beardyn_core.scene.patch import Growth, Patch
from beardyn_core.sensors.stage_clock import StageTime
from beardyn_core.sensors.summary import torque_budget
from beardyn_core.study.desk_run import RunSummary
from beardyn_core.study.ladder import comparison_of
from beardyn_core.study.ladder_report import json_object as ladder_object
from beardyn_core.study.measures import FaultLine
from beardyn_core.study.monitored_recording import EXIT_CODES, Finding
from beardyn_core.study.smallest_spall import SmallestSpall, SmallestSpalls
from beardyn_core.study.trial_report import json_object as trial_object
from beardyn_core.study.trial_result import TrialResult
from test.cli.json_page import PAGE, check, documented
from test.measured.test_monitor_files import motor
from test.recordings import write_recording
from test.study.fake_ladder import FakeRuns, climbed
from test.study.test_trial import run_of

MEASURED = {
    "duration_s": 1.0,
    "files": [
        {
            "name": "a.csv", "format": "text", "size_bytes": 9, "begin_s": 0.0, "date": None,
            "says": {"fs": 12000.0},
        }
    ],
    "sensors": {"top": {"rate_Hz": 12000.0, "channels": {"z": "a"}, "m_per_s2_per_number": {"z": 9.80665}}},
    "speed": {"from": "constant", "channel": None, "constant_rad_per_s": 188.0},
    "load": {"channel": "Fz", "mean_N": 7e4, "rms_about_mean_N": 3e3, "uncertainty_N": 2e3},
    "bearings": {
        "drive_end": {
            "name": "6205", "description": "", "kind": None, "roller_count": 9, "roller_diameter_m": 0.00794,
            "pitch_diameter_m": 0.03904, "contact_angle_rad": 0.0, "bpfo": 3.585,
            "bpfi": 5.415, "bsf": 2.357, "ftf": 0.398, "sensor": None,
        }
    },
    "understood": ["a.csv: text"],
    "warnings": [],
}  # fmt: skip
UNITS = (
    *("m_per_s2", "m_per_s", "rad_per_s", "N_per_m", "m2_per_s", "kg_m2", "N_m", "per_rev", "bytes"),
    *("rev", "rad", "Pa", "Hz", "dB", "kg", "N", "W", "J", "K", "s", "m"),
)
MULTIPLES = (
    "mm",
    "um",
    "us",
    "kN",
    "MN",
    "kHz",
    "GPa",
    "MPa",
    "deg",
    "rpm",
    "kmh",
    "Nm",
    "percent",
    "h",
    "t",
)


def read(text: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(text, parse_constant=pytest.fail)
    assert list(found)[:2] == ["schema_version", "command"]
    assert found["schema_version"] == SCHEMA_VERSION
    return found


def printed(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, Any]:
    codes = set(EXIT_CODES.values()) if words[0] == "monitor" else {DONE}
    assert main([*words, "--json"]) in codes
    found = read(capsys.readouterr().out)
    assert found["command"] == words[0]
    return found


def test_numbers_become_strict_json() -> None:
    content = {"a": math.nan, "b": (1, math.inf), "c": np.array([[1.0, np.nan]]), "d": np.int64(3), "e": PAGE}
    assert plain(content) == {"a": None, "b": [1, None], "c": [[1.0, None]], "d": 3, "e": str(PAGE)}
    assert list(read(json_text("x", {"y": np.float64(0.5)}))) == ["schema_version", "command", "y"]


def test_bearing(capsys: pytest.CaptureFixture[str]) -> None:
    words = ("bearing", "HS130x230", "--laminae", "3", "--lubricant", "L055", "--speed", "1000")
    others = (printed(capsys, "bearing", name) for name in ("HS130x230", "WJ130x240", "SRB120x260"))
    check("bearing", printed(capsys, *words), *others)


def test_explain(capsys: pytest.CaptureFixture[str]) -> None:
    check("explain", printed(capsys, "explain", "static_80kN"))


def test_scenes(capsys: pytest.CaptureFixture[str]) -> None:
    check(
        "scenes", printed(capsys, "scenes", "all"), printed(capsys, "scenes", "catalogue", "--bore-mm", "25")
    )


def test_simulate() -> None:
    budget = torque_budget([0.0, 1.0], np.ones((2, LOSSES + 1)), 10.0)
    life = RatingLife(8e4, 1e9, math.inf, 1e9, 1e9, 1.5, 0.6, 3)
    summary = RunSummary(
        *("cup_spall", "full", ("film",), (), 1.0, 0.5, "complete", (1.0, 2.0, math.nan), -3.0, (1.0, 1.0)),
        energy_residual=None,
        budget=budget,
        averaged=(0.25, 1.0),
        cage_revolutions=5,
        life=life,
        temperatures=tuple((part, 300.0) for part in NODES),
        clipped=(("axlebox_top", 3, 512),),
        stages=(StageTime("sinks", 0.1), StageTime("rest", 0.1)),
    )
    found = read(json_text("simulate", simulate.json_object(summary, Path("run.mcap"))))
    assert found["mean_force_N"] == [1.0, 2.0, None]
    assert found["life"]["L10m_rev"] is None
    train = SimpleNamespace(
        summaries={"axle_1_left": summary}, failures=(), duration=1.0, wall_time=0.5,
        processor_time=0.9, real_time_factor=2.0,
    )  # fmt: skip
    several = read(json_text("simulate", simulate_train.json_object(train, Path("run.mcap"))))  # type: ignore[arg-type]
    assert several["axleboxes"]["axle_1_left"]["shaft_torque_N_m"] == -3.0
    check("simulate", found, several)


def test_monitor(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_recording(tmp_path / "run.mcap", 60)
    short = tmp_path / "record.csv"
    noise = np.random.default_rng(1).normal(size=2560)
    short.write_text(
        "time_s,az_g\n" + "".join(f"{k / 25600:.8f},{each:.5f}\n" for k, each in enumerate(noise))
    )
    motor_file = str(motor(tmp_path))
    mounted, spalls = Mounted("bearing", load_plate("6205")), (SmallestSpall("cup", math.nan, 21e-3, 21e-3),)
    check(
        "monitor",
        json_object(
            argparse.Namespace(files=["run.mcap"]),
            {mounted: [Finding("healthy", "", 1.0)]},
            {mounted: SmallestSpalls(spalls, "a scene")},
        ),
        printed(capsys, "monitor", str(path), "--bearing", "HS130x230"),
        printed(capsys, "monitor", str(short), "--trend"),
        printed(capsys, "monitor", motor_file, "--speed-rpm", "1800", "--bpfo", "3.585"),
        printed(capsys, "monitor", motor_file, "--speed-rpm", "1800", "--bearing", "6205"),
        printed(capsys, "monitor", motor_file, "--speed-rpm", "1800", "--which-bearing", "--bore-mm", "130"),
        printed(capsys, "monitor", motor_file, "--speed-rpm", "1800", "--which-bearing", "--bore-mm", "25"),
    )


def test_import(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a.csv"
    file.write_text("time_s,az_g\n" + "".join(f"{k / 1000:.4f},{k % 7}.5\n" for k in range(100)))
    check(
        "import", printed(capsys, "import", str(file), "-o", str(tmp_path / "run.mcap"), "--speed-rpm", "600")
    )


def test_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_recording(tmp_path / "run.mcap", 10)
    budget = torque_budget([0.0, 1.0], np.ones((2, LOSSES + 1)), 10.0)
    growing = Patch("cup", 0, 0.1, 6e-3, 1e-4, 25e-3, growth=Growth(0.1, 1.0))
    faults = (growing, RollerError(0, 3, 1e-5), WornPocket(1, 2, 5e-4), MissingRoller(1, 4))
    full = replace(
        report(path),
        budget=budget,
        gaps=(Gap("vibration", 0.5, 3),),
        faults=[asdict(fault) for fault in faults],
        missing_messages=(MissingMessages("imu", 80, 32),),
        malformed_messages={"load/blocks": 1},
        boxes={"axle_1_left": "healthy"},
        measured=MEASURED,
        pace=0.9998,
        late_blocks=3,
    )
    assert "pace     0.9998 simulated seconds in a second of wall time; late blocks: 3" in full.to_text()
    found = read(json_text("report", report_command.json_object(full, ())))
    assert found["defects"][0]["growth"]["width_grows"] is True
    assert found["defects"][0]["width_m"] == 6e-3
    assert found["faults"][1] == "roller 3, row 0, +10.0 µm in diameter"
    check("report", found, printed(capsys, "report", str(path)))


def test_ladder() -> None:
    ladder = climbed(comparison_of(load_scene("static_80kN"), 0.5, 0.1), FakeRuns())
    check(
        "ladder", read(json_text("ladder", ladder_object(replace(ladder, fault_line=FaultLine("BPFO", 7.3)))))
    )


def test_trial() -> None:
    quick = replace(load_trial("quick"), surfaces=("typical",))
    runs = [run_of(cell, "cup" if cell.checks else "healthy") for cell in quick.cells()]
    runs[0] = replace(runs[0], status="a number became NaN")
    found = read(json_text("trial", {**trial_object(TrialResult.of(quick, "", runs)), "complete": True}))
    assert [row["width_m"] for row in found["sizes"]][:3] == [0.002, 0.006, 0.012]
    check("trial", found)


def test_every_command_with_json_has_a_section() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for name in (name for names in COMMANDS.values() for name in names):
        source = (Path(simulate.__file__).parent / f"{module_of(name).rpartition('.')[2]}.py").read_text(
            encoding="utf-8"
        )
        told = f"## `beardyn {name}`" in text or f"## `beardyn {name} " in text  # or of its actions
        assert ("add_json(" in source) == told, name


def test_units_in_keys_are_si_without_multiples() -> None:
    commands = (
        "bearing",
        "explain",
        "scenes",
        "simulate",
        "monitor",
        "report",
        "ladder",
        "trial",
        "contacts",
    )
    for command in commands:
        for path in documented(command):
            for name in path.replace("[]", "").split("."):
                assert not name.endswith(tuple(f"_{unit}" for unit in MULTIPLES)), path
                assert not name.lower().endswith(("rtf", "_millimetres", "microseconds", "hours")), path


def test_every_unit_of_a_key_is_explained_on_the_page() -> None:
    head = PAGE.read_text(encoding="utf-8").split("## `beardyn")[0]
    for unit in UNITS:
        assert f"`_{unit}`" in head, unit


@dataclass(frozen=True)
class Turned:
    """What words of fields say of their units."""

    time: A[float, "of the last sample, [s]"]
    torque: A[float, "of seals, [N m]"]
    rms: A[float, "[m/s^2]"]
    level: A[float, "shape [band], [dB re 1 m/s^2]"]
    places: A[tuple[float, ...], "shape [axis]"]
    order: A[float, "per turn, [-]"]
    note: str = ""


def test_keys_of_a_dataclass_are_its_names_with_the_units_of_the_words() -> None:
    found = keyed_fields(Turned(1.0, 2.0, 3.0, 4.0, (5.0,), 6.0), without=("note",), order="turns")
    assert found == {
        "time_s": 1.0,
        "torque_N_m": 2.0,
        "rms_m_per_s2": 3.0,
        "level_dB": 4.0,
        "places": (5.0,),
        "turns": 6.0,
    }

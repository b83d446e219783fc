"""A monitor over measured files: any bearing, one axis or three, one bearing on the shaft or two."""

from __future__ import annotations

import json
import re
import shlex
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.cli.main import BAD_INPUT, DONE, build_parser, main
from beardyn_core.cli.monitor_settings import settings_of
from beardyn_core.config import load_any_bearing, load_plate, shipped_names
from beardyn_core.monitor.chain import REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.streaming import Monitor, measured_axes
from beardyn_core.study.monitored_recording import EXIT_CODES
from test.measured.files import RATE, G, frequencies, struck, table

PAGE = (Path(__file__).parents[2] / "docs" / "measured.md").read_text(encoding="utf-8")


def measured(folder: Path, name: str = "motor.csv", **columns: Any) -> Path:
    count = len(next(iter(columns.values())))
    return table(folder / name, {"time_s": np.arange(count) / RATE, **columns})


def motor(folder: Path) -> Path:
    columns = {"acc_z [g]": struck(frequencies("6205").bpfo)[:, 0] / G}
    return table(folder / "motor.csv", {"time_s": np.arange(48_000) / RATE, **columns})


def both(folder: Path) -> Path:
    faulty, sound = struck(frequencies("6203").bpfi)[:, 0], np.random.default_rng(5).normal(0.0, 2.0, 48_000)
    return measured(folder, "both.csv", de_g=sound / G, fe_g=faulty / G)


def commands(text: str) -> list[list[str]]:
    blocks = re.findall(r"```bash\n(.*?)```", text, re.DOTALL)
    lines = [line for block in blocks for line in block.replace("\\\n", " ").splitlines()]
    return [shlex.split(line)[1:] for line in lines if line.startswith("beardyn ")]


def test_the_page_leads_from_a_csv_file_to_a_verdict_in_three_commands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    motor(tmp_path)
    three = commands(PAGE)[:3]
    assert [words[0] for words in three] == ["import", "report", "monitor"]
    assert main(three[0]) == DONE
    shown = re.search(r"each line to be checked:\n\n```\n(.*?)```", PAGE, re.DOTALL)
    assert shown is not None
    told = capsys.readouterr().out
    assert _without_figures(told) == _without_figures(shown[1])
    assert main(three[1]) == DONE
    report = capsys.readouterr().out
    assert "measured motor.csv: 48000 samples at 12000 Hz, 4 s, time in time_s" in report
    assert "bearing  6205: 9 rolling elements of 7.94 mm on a circle of 39.04 mm" in report
    assert "no samples missing" in report
    assert main(three[2]) == EXIT_CODES["cup"]
    verdict, size = capsys.readouterr().out.splitlines()[-2:]
    assert verdict == "outer ring (cup): 7 of 7 analyses, confidence 0.99"
    assert size.startswith("size: not measurable: ")
    assert verdict in PAGE


def _without_figures(text: str) -> str:
    """Leave out level and size, which depend on the noise."""
    return re.sub(r"z [\d.]+ m/s2 rms|[\d.]+ MB", "", text)


def test_the_programs_and_other_commands_of_the_page_do_what_it_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    motor(tmp_path)
    both(tmp_path)
    inline = re.search(r"`beardyn (monitor motor\.csv [^`]*)`", PAGE)
    assert inline is not None
    assert main(shlex.split(inline[1])) == EXIT_CODES["cup"]
    verdict = capsys.readouterr().out.splitlines()[-2]
    assert verdict.startswith("outer ring (cup): 7 of 7 analyses, confidence 0.9")
    (program,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    exec(compile(program, "page", "exec"), {"bd": bd})
    assert "cup" in capsys.readouterr().out.splitlines()
    two = next(words for words in commands(PAGE) if "both.csv" in words)
    assert main(two) == EXIT_CODES["cone"]  # the worst decides
    healthy, cone, size, hidden = capsys.readouterr().out.splitlines()[-4:]
    assert healthy.startswith("drive_end healthy: 7 of 7 analyses, confidence 0.")
    assert cone.startswith("fan_end inner ring (cone): 7 of 7 analyses, confidence 0.9")
    assert size.startswith("fan_end size: not measurable: ")
    assert hidden == "fan_end not judged: rolling elements, whose lines are multiples of the shaft's"
    plate = re.search(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    assert plate is not None
    (tmp_path / "mine.yaml").write_text(plate[1])
    assert load_plate("mine.yaml").frequencies == load_plate("6205").frequencies


def test_a_recording_names_its_bearings_and_their_sensors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "run.mcap")
    words = ["--channels", "drive:z=de_g", "--channels", "fan:z=fe_g", "--speed-rpm", "1800"]
    names = ["--bearing", "drive_end=6205@drive", "--bearing", "fan_end=6203@fan"]
    assert main(["import", str(both(tmp_path)), "-o", out, *words, *names]) == DONE
    assert main(["monitor", out, "--json"]) == EXIT_CODES["cone"]
    found = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert [(b["label"], b["bearing"], b["sensor"], b["verdict"]) for b in found["bearings"]] == [
        ("drive_end", "6205", "drive", "healthy"),
        ("fan_end", "6203", "fan", "cone"),
    ]
    assert found["verdict"] == "cone"  # the worst
    run = bd.read(out)
    assert list(run.sensors) == ["drive", "fan"]
    assert bd.monitor(run, bearing=bd.name_plate("6203"), sensor="fan").verdict == "cone"
    with pytest.raises(bd.InputError, match="has the bearings drive_end, fan_end; give bearing"):
        bd.monitor(run)
    assert bd.monitor(run, bearing="6203", sensor="fan").verdict == "cone"
    with pytest.raises(bd.InputError, match="has no sensor 'top'; it has drive, fan"):
        bd.monitor(run, bearing=bd.name_plate("6203"), sensor="top")
    for kind, signals in (("csv", 4), ("wav", 1)):
        (path, *_) = getattr(run, f"to_{kind}")(tmp_path / f"out.{kind}", "vibration_fan")
        assert path.exists(), signals


def test_direct_and_recorded_verdicts_are_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = motor(tmp_path), tmp_path / "run.mcap"
    words = ["--speed-rpm", "1800", "--bearing", "6205"]
    assert main(["import", str(path), "-o", str(out), *words]) == DONE
    capsys.readouterr()
    told = []
    for each in ([str(path), *words], [str(out)]):
        assert main(["monitor", *each, "--json"]) == EXIT_CODES["cup"]
        told.append(json.loads(capsys.readouterr().out)["findings"])
    assert [f["verdict"] for f in told[0]] == [f["verdict"] for f in told[1]] == ["cup"] * 7
    for one, other in zip(*told, strict=True):
        # parts of 20 ms end elsewhere, so the windows are up to 240 samples apart, and as many again as they
        # are cut to lengths of fast transforms, and so are the phases that whitening leaves: 60 samples
        # change a score by half a decibel
        assert one["score_dB"] == pytest.approx(other["score_dB"], abs=1.5)


def test_python_judges_a_measured_file_as_the_command_does(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = motor(tmp_path)
    assert main(["monitor", str(path), "--speed-rpm", "1800", "--bearing", "6205", "--json"]) == 12
    shown = json.loads(capsys.readouterr().out)
    for source in (path, str(path), [path]):
        found = bd.monitor(source, speed_rpm=1800, bearing="6205")
        assert (found.verdict, found.agreeing) == (shown["verdict"], shown["agreeing"]) == ("cup", 7)
    width = bd.severity(path, speed_rpm=1800, bearing="6205")
    assert width is not None
    page = tmp_path / "page.html"
    bd.report(path, speed_rpm=1800, bearing="6205", html=page)
    assert "outer ring (cup)" in page.read_text(encoding="utf-8")


def test_python_says_what_a_measured_file_lacks(tmp_path: Path) -> None:
    path = motor(tmp_path)
    with pytest.raises(bd.InputError, match="does not name its bearing; give bearing"):
        bd.monitor(path, speed_rpm=1800)
    with pytest.raises(bd.InputError, match="speed"):
        bd.monitor(path, bearing="6205")
    with pytest.raises(bd.InputError, match="sped is no option of measured files; allowed are channels"):
        bd.monitor(path, sped=1800, bearing="6205")
    run = bd.read_measured(path, speed_rpm=1800, bearing="6205")
    with pytest.raises(bd.InputError, match=r"speed_rpm: for measured files; .* is read already"):
        bd.monitor(run, speed_rpm=1800)
    recording = tmp_path / "run.mcap"
    with pytest.raises(bd.InputError, match="No such file"):
        bd.monitor(recording, speed_rpm=1800)
    recording.touch()
    with pytest.raises(bd.InputError, match=r"speed_rpm: for measured files; .*run.mcap is a recording"):
        bd.monitor(recording, speed_rpm=1800)


def test_a_measured_file_is_sent_to_the_commands_that_take_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    for command in ("report", "view"):
        assert main([command, str(motor(tmp_path))]) == BAD_INPUT
        assert "`beardyn monitor` takes it as it is" in capsys.readouterr().err


def test_a_tacho_gives_the_same_verdict_as_a_constant_speed_when_the_shaft_speeds_up(tmp_path: Path) -> None:
    time = np.arange(60_000) / RATE
    turns = 25.0 * time + 1.0 * time**2
    signal = struck(frequencies("6205").bpfo, 5.0, turned=turns)[:, 0]
    tacho = np.where((turns * 4.0) % 1.0 < 0.3, 5.0, 0.0)
    path = measured(tmp_path, az_g=signal / G, tacho=tacho)
    options: dict[str, Any] = {"channels": "z=az_g", "bearing": "6205"}
    tracked = bd.monitor(bd.read_measured(path, tacho_channel="tacho", pulses_per_turn=4, **options))
    assert (tracked.verdict, tracked.agreeing) == ("cup", tracked.analyses)
    assert tracked.analyses >= 8
    smeared = bd.monitor(bd.read_measured(path, speed_rpm=1500, **options))
    assert smeared.verdict != "cup"


def test_the_monitor_asks_for_bearing_and_speed_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["monitor", str(motor(tmp_path))]) == BAD_INPUT
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 2
    assert "does not name its bearing; give --bearing" in told[0]
    assert "the speed of the shaft is not known, and a monitor needs it; give one of --speed-rpm" in told[1]
    words = ["--speed-rpm", "1800", "--bearing", "a=6205@top", "--bearing", "a=6203", "--bearing", "x=y=z"]
    assert main(["monitor", str(motor(tmp_path)), *words]) == BAD_INPUT
    err = capsys.readouterr().err
    assert "two bearings are called a" in err
    assert "must be NAME, LABEL=NAME or LABEL=NAME@SENSOR" in err


def test_a_low_rate_is_answered_with_a_sentence_and_not_with_healthy(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = table(
        tmp_path / "a.csv", {"time_s": np.arange(12_000) / 4000, "az_g": np.sin(np.arange(12_000.0) ** 2)}
    )
    words = ["monitor", str(path), "--speed-rpm", "1800", "--bearing", "6205"]
    assert main(words) == EXIT_CODES["not_diagnosable"]
    ending = capsys.readouterr().out.splitlines()[-1]
    assert ending == (
        "not_diagnosable: 5 of 5 analyses; the sampling rate is 4000 Hz; at least 6000 Hz are "
        "needed for a band above 1500 Hz"
    )


def test_a_record_shorter_than_an_analysis_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = measured(tmp_path, az_g=struck(3.58, 0.3)[:, 0])
    words = ["monitor", str(path), "--speed-rpm", "1800", "--bearing", "6205"]
    assert main(words) == EXIT_CODES["not_diagnosable"]
    assert "not_diagnosable: no analysis; the signal is shorter than the first" in capsys.readouterr().out


def test_one_axis_of_one_dimension_is_sample_by_sample() -> None:
    signal = struck(frequencies("6205").bpfo, 2.0)[:, 0]
    angle = np.linspace(0.0, 2.0 * np.pi * 60.0, len(signal), dtype=np.float64)
    orders, settings = frequencies("6205"), MonitorSettings()
    flat, column = (
        REFERENCE(Stretch(RATE, each, angle, np.nan, 0), orders, 9, settings)
        for each in (signal, signal[:, None])
    )
    assert flat.verdict == column.verdict == "cup"
    assert flat.score == column.score
    monitor = Monitor(orders, 9, RATE)
    time_ns = np.round(np.arange(len(signal)) * 1e9 / RATE).astype(np.int64)
    monitor.push_vibration(time_ns, signal)
    monitor.push_shaft(time_ns[::20], angle[::20])
    assert monitor.result().verdict == "cup"
    monitor.push_vibration(time_ns + time_ns[-1] + 83_333, np.zeros((len(signal), 3)))
    assert monitor.refused == 1


def test_axes_that_were_not_measured_are_left_out() -> None:
    nan = np.full(5, np.nan)
    values = np.stack([nan, np.arange(5.0), nan], axis=1)
    np.testing.assert_array_equal(measured_axes(values), np.arange(5.0)[:, None])
    assert measured_axes(np.full((5, 3), np.nan)).shape == (5, 3)
    whole = np.ones((5, 3))
    assert measured_axes(whole) is whole


@pytest.mark.parametrize("name", shipped_names("bearings"))
def test_the_name_plate_of_a_bearing_has_its_frequencies(name: str) -> None:
    plate = load_plate(name)
    assert plate.frequencies == fault_frequencies(load_any_bearing(name))
    assert plate.name == name


def test_shipped_name_plates_have_the_published_frequencies() -> None:
    """CWRU Bearing Data Center, bearing information: multiples of the running speed."""
    drive, fan = load_plate("6205").frequencies, load_plate("6203").frequencies
    assert (drive.bpfi, drive.bpfo, drive.ftf, 2 * drive.bsf) == pytest.approx(
        (5.4152, 3.5848, 0.39828, 4.7135), rel=5e-4
    )
    assert (fan.bpfi, fan.bpfo, fan.ftf, 2 * fan.bsf) == pytest.approx(
        (4.9469, 3.0530, 0.3816, 3.9874), rel=5e-4
    )


def test_a_name_plate_that_cannot_be_is_refused_with_every_mistake(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("name: mine\nroller_count: 2\nroller_diameter_mm: 8\npitch_diameter: 39\n")
    with pytest.raises(bd.InputError) as caught:
        load_plate(path)
    text = str(caught.value)
    for part in ("roller_count is 2", "pitch_diameter_mm", str(path)):
        assert part in text
    with pytest.raises(bd.InputError, match=r"15 rolling elements of 7\.94 mm fit on a circle of 39\.04 mm"):
        NamePlate(roller_count=16, roller_diameter=7.94e-3, pitch_diameter=39.04e-3)
    with pytest.raises(bd.InputError, match="pitch_diameter_mm is 7; it must be above roller_diameter_mm, 8"):
        bd.name_plate(roller_count=9, roller_diameter_mm=8, pitch_diameter_mm=7)
    with pytest.raises(bd.InputError, match=r"no bearing '6299'.*nearest are 6219.*scenes catalogue"):
        load_plate("6299")
    changed = bd.name_plate("6205", contact_angle_deg=15)
    assert changed.frequencies.bpfo > bd.name_plate("6205").frequencies.bpfo


def test_a_wrong_speed_is_unexplained_in_text_json_and_exit_code(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--speed-rpm", "1690", "--bearing", "6205"]
    assert main(words) == EXIT_CODES["unexplained"]
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.startswith("unexplained: ")
    assert "the outer ring (cup) of this bearing at 1" in last
    assert main([*words, "--json"]) == EXIT_CODES["unexplained"]
    found = json.loads(capsys.readouterr().out)
    assert found["verdict"] == found["bearings"][0]["verdict"] == "unexplained"
    assert found["findings"][-1]["fitting_shaft_frequency_Hz"] == pytest.approx(30.0, rel=0.01)


def test_a_wider_speed_uncertainty_names_the_part_that_a_narrow_one_leaves_unexplained(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--speed-rpm", "1690", "--bearing", "6205"]
    assert main([*words, "--speed-uncertainty", "7 %"]) == EXIT_CODES["cup"]
    assert main([*words, "--speed-uncertainty", "0"]) == EXIT_CODES["unexplained"]


def test_mistakes_of_certainty_and_of_the_file_are_reported_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--bearing", "6205"]
    assert main([*words, "--speed-uncertainty", "0.03", "--neighbour", "6999"]) == BAD_INPUT
    told = capsys.readouterr().err
    assert "--speed-uncertainty is '0.03'; it must be 0, or a number from 0.1 to 10 in per cent" in told
    assert "--neighbour 6999: " in told
    assert "--speed-rpm" in told  # no speed is given either


def test_limits_of_temperature_are_those_of_the_vehicle() -> None:
    parser = build_parser()

    def settings(*options: str) -> MonitorSettings:
        return settings_of(parser.parse_args(["monitor", "a.csv", *options]), 0.0)

    usual, own = MonitorSettings(), settings("--warm", "80", "--hot", "95.5")
    assert (settings().warm, settings().hot) == pytest.approx((usual.warm, usual.hot))
    assert (own.warm, own.hot) == pytest.approx((353.15, 368.65))
    with pytest.raises(InputError) as caught:
        settings("--warm", "130", "--hot", "-3")
    assert caught.value.problems == [
        "--hot is -3; it must be from 0 to 300 degrees Celsius",
        "--warm is 130; it must be at most --hot, which is -3",
    ]
    with pytest.raises(InputError, match="warm is 130 degrees Celsius; it must be at most hot, which is 120"):
        replace(usual, warm=403.15)

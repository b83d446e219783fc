"""Options that would do nothing, or come to nothing after a long time: refused, and at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_core.cli import main as command
from test.recordings import write_recording


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("recorded") / "run.mcap", 5)


def refused(capsys: pytest.CaptureFixture[str], *words: object) -> str:
    """What a command says that refuses its options."""
    assert command.main([str(word) for word in words]) == command.BAD_INPUT
    told = capsys.readouterr()
    assert told.out == ""
    return told.err


def too_late(*_: object, **__: object) -> None:
    raise AssertionError("the options were looked at too late")


# --- of a monitor --------------------------------------------------------------------------------------


def test_a_trend_refuses_every_option_that_it_would_leave_aside(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--bearing", "HS130x230", "--roller-count", 17, "--box", "left", "--monitor", "mine:listen"]
    told = refused(capsys, "monitor", recording, "--trend", *words, "--picture", tmp_path / "trend.png")
    for option in ("--bearing", "--roller-count", "--box", "--monitor", "--picture"):
        assert f"beardyn: {option}: --trend " in told
    assert len(told.splitlines()) == 5
    words = ["--warm", 80, "--hot", 90, "--neighbour", "6203", "--speed-uncertainty", 2, "--bore-mm", 25]
    told = refused(capsys, "monitor", recording, "--trend", *words)
    for option in ("--warm", "--hot", "--neighbour", "--speed-uncertainty", "--bore-mm"):
        assert f"beardyn: {option}: --trend " in told


def test_options_of_measured_files_are_refused_with_a_recording_of_a_run(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refused(capsys, "monitor", recording, "--speed-rpm", 1800, "--which-bearing")
    assert "--speed-rpm is for measured files" in told
    told = refused(capsys, "monitor", recording, "--speed-rpm", 1800)
    wanted = f"--speed-rpm is for measured files; {recording} is a recording, which is taken as it is"
    assert told == f"beardyn: {wanted}\n"
    words = ("--speed-rpm", 1800, "--unit", "g", "--picture", tmp_path / "found.txt")
    told = refused(capsys, "monitor", recording.parent, *words)
    assert f"--unit, --speed-rpm are for measured files; {recording.parent} is a recording" in told
    assert "let its name end in .png" in told
    told = refused(capsys, "monitor", tmp_path / "none.mcap", "--speed-rpm", 1800)
    assert "No such file" in told
    assert "is a recording" not in told


# --- of a viewer and of an export ----------------------------------------------------------------------


@pytest.mark.parametrize("port", ["0", "65536", "99999", "-1", "many"])
def test_a_port_that_there_is_not_is_refused(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        command.main(["view", "run.mcap", "--web", f"--port={port}"])
    assert ended.value.code == command.BAD_INPUT
    assert f"--port: is {port!r}; it must be a whole number from 1 to 65535" in capsys.readouterr().err


def test_a_port_without_a_page_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert "--port: is that of --web" in refused(capsys, "view", "run.mcap", "--port", 8080)


def test_signals_that_a_recording_has_not_are_named_with_those_it_has(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("export", recording, "-o", tmp_path / "run.csv", "--signals")
    told = refused(capsys, *words, "temperature")
    assert f"--signals: {recording} has no temperature; it has vibration, " in told
    assert told.count("temperature") == 1
    told = refused(capsys, *words, "vibration,temperature,sound")
    assert "has no temperature, no sound; it has vibration, " in told
    for empty in ("", " , ", "vibration,"):
        assert f"--signals {empty!r}: a name is empty" in refused(capsys, *words, empty)
    assert list(tmp_path.iterdir()) == []
    assert command.main(["export", str(recording), "-o", str(tmp_path / "run.csv")]) == command.DONE


# --- told before effects are chosen --------------------------------------------------------------------


@pytest.mark.parametrize("output", ["", "missing/run.mcap"])
def test_an_output_of_a_simulation_is_refused_before_effects_are_chosen(
    output: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("beardyn_core.choice.load.choice_for", too_late)
    words = ("simulate", "smooth_run", "--effects", "auto", "-o", tmp_path / output)
    assert f"--output {tmp_path / output}: " in refused(capsys, *words)
    told = refused(capsys, *words, "--duration", -1, "--vibration-to", 0, "--laminae", 0)
    for mistake in ("--duration -1", "--vibration-to 0", "--laminae 0", f"--output {tmp_path}"):
        assert mistake in told


def test_a_sweep_tells_of_its_options_and_of_its_file_at_once_and_early(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("beardyn_core.population.request.make_plan", too_late)
    told = refused(capsys, "sweep", "fifty", "--runs", -3, "--workers", 0, "-o", tmp_path / "missing" / "set")
    for mistake in ("runs is -3", "--workers 0: allowed is 1 to", "does not exist; create it first"):
        assert mistake in told
    assert "--workers 0" in refused(capsys, "sweep", "fifty", "--workers", 0, "-o", tmp_path / "set")


def test_a_calibration_refuses_a_scene_with_a_fault_before_its_recordings_are_read(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("beardyn_core.record.reading.read_run", too_late)
    told = refused(
        capsys, "calibrate", recording, "--scene", "cup_spall", "-o", tmp_path / "missing" / "mine.yaml"
    )
    assert "--scene cup_spall: has a fault (spall on the cup" in told
    assert "calibrate with the healthy scene" in told
    assert "does not exist; create it" in told

"""What is exported of a measured recording is imported again without an option."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.cli.main import DONE, main
from beardyn_core.study.monitored_recording import EXIT_CODES
from test.measured.files import noise, table

RATE = 12_000.0


@pytest.mark.parametrize("axes", [1, 2, 3])
@pytest.mark.parametrize("ending", ["csv", "parquet", "npz", "h5", "wav"])
def test_export_and_import_is_a_round_trip(ending: str, axes: int, tmp_path: Path) -> None:
    values = noise(6000, axes)
    columns = {f"a{axis} [g]": column for axis, column in zip("zxy"[:axes], values.T, strict=True)}
    path = table(tmp_path / "a.csv", {"time_s": np.arange(6000) / RATE, **columns})
    recording = bd.import_measured(path, tmp_path / "run.mcap", speed_rpm=1800)
    before = bd.read(recording)
    assert main(["export", str(recording), "-o", str(tmp_path / f"out.{ending}")]) == DONE
    again = bd.read_measured(tmp_path / f"out.{ending}")
    assert again.vibration.rate == before.vibration.rate
    np.testing.assert_allclose(again.vibration.values, before.vibration.values, rtol=1e-7)
    np.testing.assert_array_equal(again.vibration.time_ns, before.vibration.time_ns)
    if ending == "csv":
        heading = (tmp_path / "out.csv").read_text().splitlines()[0]
        assert heading == ",".join(["time [s]", *(f"a{axis} [m/s^2]" for axis in sorted("zxy"[:axes]))])
        monitored = ["monitor", str(tmp_path / "out.csv"), "--speed-rpm", "1800", "--bearing", "6205"]
        assert main(monitored) == EXIT_CODES["not_diagnosable"]  # too short for an analysis


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("ending", ["npz", "h5"])
def test_the_speed_makes_the_round_trip_too(ending: str, tmp_path: Path) -> None:
    time = np.arange(24_000) / RATE
    columns = {"time_s": time, "az [g]": noise(24_000)[:, 0], "n [rpm]": 600.0 + 300.0 * time}
    path = table(tmp_path / "a.csv", columns)
    recording = bd.import_measured(path, tmp_path / "run.mcap", channels="z=az", speed_channel="n")
    before = bd.read(recording)
    assert main(["export", str(recording), "-o", str(tmp_path / f"out.{ending}")]) == DONE
    again = bd.read_measured(tmp_path / f"out.{ending}", speed_channel="shaft.speed")
    np.testing.assert_allclose(again.vibration.values, before.vibration.values, rtol=1e-7)
    expected = np.interp(again.shaft.time, before.shaft.time, before.shaft.speed)
    np.testing.assert_allclose(again.shaft.speed, expected, rtol=1e-6)


def test_the_function_writes_what_the_command_does(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {"time_s": np.arange(6000) / RATE, "az [g]": noise(6000)[:, 0]})
    recording = bd.import_measured(path, tmp_path / "run.mcap", speed_rpm=1800)
    words = ["export", str(recording), "-o", str(tmp_path / "one.csv"), "--signals", "vibration,shaft"]
    assert main(words) == DONE
    written = bd.export(recording, tmp_path / "two.csv", signals=["vibration", "shaft"])
    assert [each.name for each in written] == ["two_vibration.csv", "two_shaft.csv", "two.csv.json"]
    for each in written:
        assert each.read_bytes() == each.with_name(each.name.replace("two", "one")).read_bytes()
    with pytest.raises(bd.InputError, match="exists"):
        bd.export(bd.read(recording), tmp_path / "two.csv")
    assert len(bd.export(bd.read(recording), tmp_path / "two.csv", force=True)) == 2


def test_a_wav_file_that_another_program_has_scaled_asks_for_its_unit(tmp_path: Path) -> None:
    soundfile = pytest.importorskip("soundfile")
    columns = {"time_s": np.arange(6000) / RATE, "az [g]": noise(6000)[:, 0]}
    recording = bd.import_measured(table(tmp_path / "a.csv", columns), tmp_path / "run.mcap", speed_rpm=1800)
    (wav, _) = bd.read(recording).to_wav(tmp_path / "a.wav")
    values, rate = soundfile.read(wav)
    with soundfile.SoundFile(wav) as exported:
        comment = exported.comment
    with soundfile.SoundFile(tmp_path / "b.wav", "w", rate, 1, "PCM_16") as scaled:
        scaled.comment = comment
        scaled.write(values / np.abs(values).max())
    with pytest.raises(bd.InputError, match="give unit"):
        bd.read_measured(tmp_path / "b.wav")

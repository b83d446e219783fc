"""Mistakes in files and options end in sentences, all at once, and nothing is written or lost."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.cli.main import BAD_INPUT, DONE, INTERRUPTED, main
from test.measured.files import COUNT, RATE, noise, problems, table

TIME = np.arange(COUNT) / RATE


def csv(folder: Path, name: str = "a.csv", **columns: Any) -> Path:
    return table(folder / name, {"time_s": TIME, "az_g": noise()[:, 0], **columns})


def test_every_mistake_of_every_file_is_told_at_once(tmp_path: Path) -> None:
    bad, dead = noise()[:, 0], np.zeros(COUNT)
    bad[[100, 200]] = np.nan
    backward = TIME.copy()
    backward[50] = backward[48]
    first = table(tmp_path / "a.csv", {"time_s": backward, "ax_g": bad, "az_g": dead})
    second = csv(tmp_path, "b.csv", ax_g=noise()[:, 0])
    found = problems([first, second, tmp_path / "missing.csv"], channels="x=ax_g,z=az_q")
    assert f"{first}: channels 'az_q' is no channel of the file; it has time_s, ax_g, az_g" in found
    assert f"{second}: channels 'az_q' is no channel of the file; it has time_s, az_g, ax_g" in found
    assert any("missing.csv: cannot be read (No such file or directory)" in each for each in found)
    found = problems([first, second, tmp_path / "missing.csv"], channels="x=ax_g,z=az_g")
    assert any(
        f"{first}, ax_g: 2 of {COUNT} samples are no finite number, the first is sample 101" in p
        for p in found
    )
    assert f"{first}, az_g: every sample is 0; the sensor is dead or not connected" in found
    assert f"{first}, time_s: the time goes back at sample 51; it must increase" in found
    assert len(found) == 4


def test_a_recording_is_not_taken_for_a_file_of_another_tool(tmp_path: Path) -> None:
    made = bd.import_measured(csv(tmp_path), tmp_path / "run.mcap")
    (found,) = problems(made)
    assert "is a recording of an axlebox; report, monitor, export and beardyn_core.read take it" in found
    again = bd.read_measured(made, channels="z=*vibration.az", unit="m/s2")
    assert len(again.vibration) == COUNT


def test_what_is_true_of_many_files_is_said_once(tmp_path: Path) -> None:
    loud = [csv(tmp_path, f"{k}.csv", az_g=noise(seed=k)[:, 0] * k) for k in range(1, 7)]
    found = problems(loud, channels="z=none")
    assert found == [f"{loud[0]} and 5 more: channels 'none' is no channel of the file; it has time_s, az_g"]
    assert len(problems(loud[:3], channels="z=none")) == 3
    understood = bd.read_measured(loud).measured["understood"]
    assert len(understood) == len(bd.read_measured(loud[0]).measured["understood"])
    assert f"{loud[0]} and 5 more: {COUNT} samples at 12000 Hz, 0.5 s, time in time_s" in understood
    (level,) = (each for each in understood if "varies" in each)
    low, high = map(float, re.findall(r"z ([\d.]+) to ([\d.]+) m/s2 rms", level)[0])
    assert high == pytest.approx(6.0 * low, rel=0.1)


def test_options_that_cannot_be_are_told_all_at_once(tmp_path: Path) -> None:
    with pytest.raises(bd.InputError) as caught:
        bd.read_measured(
            tmp_path / "none.csv", unit="gg", rate_Hz=-1.0, speed_rpm=100, speed_kmh=80, scale=0.0
        )
    text = str(caught.value)
    assert "unit is 'gg'; allowed are" in text
    assert "rate_Hz is -1; it must be greater than 0" in text
    with pytest.raises(bd.InputError) as caught:
        bd.read_measured(tmp_path / "none.csv", speed_rpm=100, speed_kmh=80, scale=0.0)
    assert [each.partition(": ")[2] for each in caught.value.problems] == [
        "speed_rpm and speed_kmh are given; give one of speed_rpm, speed_kmh, speed_range_rpm, "
        "speed_channel, tacho_channel",
        "wheel_diameter_mm is not given; the speed of a vehicle needs it",
        "scale is 0; it must be another number",
    ]
    with pytest.raises(
        bd.InputError, match=r"speeed_rpm is no option of measured files; allowed are channels, unit"
    ):
        bd.read_measured(tmp_path / "none.csv", speeed_rpm=100)
    with pytest.raises(bd.InputError, match=r"rate_Hz is '12k'; it must be a number"):
        bd.read_measured(tmp_path / "none.csv", rate_Hz="12k")


def test_options_on_the_command_line_are_told_as_they_are_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = csv(tmp_path), tmp_path / "run.mcap"
    words = ["--rate-hz", "-5", "--speed-kmh", "80", "--unit", "q"]
    assert (
        main(["import", str(path), "-o", str(out), *words, "--bearing", "6299", "--roller-count", "2"])
        == BAD_INPUT
    )
    told = capsys.readouterr().err
    for part in (
        "--rate-hz is -5",
        "--unit is 'q'",
        "'6299'",
        "nearest are 6219, 6209",
        "--roller-count is 2",
    ):
        assert part in told
    assert not out.exists()


def test_what_is_not_known_is_asked_for_with_what_the_file_has(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {"left": noise()[:, 0], "right": noise()[:, 0]})
    found = problems(path)
    assert len(found) == 3
    assert "give --channels z=NAME (or x=NAME,y=NAME,z=NAME), it has left, right" in found[0]
    assert "does not state the unit" in found[1]
    assert "does not state the rate at which" in found[2]
    found = problems(path, channels="z=left")
    assert "does not state the unit of left; give --unit" in found[0]


def test_an_unknown_unit_is_never_guessed(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {"time [s]": TIME, "signal [V]": noise()[:, 0]})
    (found,) = problems(path)
    assert "the unit of signal is 'V'; give --unit, one of m/s2, g," in found
    with pytest.warns(
        UserWarning, match=r"the unit of signal is V in the file; taken is g times 10, as asked"
    ):
        run = bd.read_measured(path, unit="g", scale=10.0)
    np.testing.assert_allclose(run.vibration.values[:, 2], noise()[:, 0] * 98.0665)


def test_a_rate_that_contradicts_the_time_is_told(tmp_path: Path) -> None:
    with pytest.warns(
        UserWarning, match=r"the time stamps time_s give 12000 Hz; taken are 48000 Hz, as asked"
    ):
        run = bd.read_measured(csv(tmp_path), rate_Hz=48_000.0)
    assert run.vibration.rate == 48_000.0


def test_a_file_that_says_two_rates_is_refused_until_an_option_decides(tmp_path: Path) -> None:
    import h5py

    path = tmp_path / "a.h5"
    with h5py.File(path, "w") as file:
        file["time"], file["az_g"] = TIME, noise()[:, 0]
        file["az_g"].attrs["fs"] = 25_600.0
    (found,) = problems(path)
    assert "states az_g.fs = 25600 (25600 Hz) and the time stamps time give 12000 Hz; give --rate-hz" in found
    with pytest.warns(UserWarning, match="states az_g.fs = 25600, 25600 Hz; taken are 12000 Hz"):
        assert bd.read_measured(path, rate_Hz=RATE).vibration.rate == RATE


@pytest.mark.parametrize(("unit", "factor"), [("us", 1e6), ("ms", 1e3), ("ns", 1e9)])
def test_stamps_without_a_unit_that_cannot_be_seconds_are_asked_about(
    unit: str, factor: float, tmp_path: Path
) -> None:
    """Taken for seconds, a file of a megabyte would become a recording of days."""
    path = table(tmp_path / "a.csv", {"t": TIME * factor, "az_g": noise()[:, 0]})
    (found,) = problems(path)
    assert "if they are in s, too slow for a vibration; give --time-unit, one of s, ms, us, ns" in found
    assert len(bd.read_measured(path, time_unit=unit).vibration) == COUNT
    assert len(bd.read_measured(path, rate_Hz=RATE, time_channel="none").vibration) == COUNT


@pytest.mark.parametrize("name", ["time_s", "Seconds", "sec", "Time (s)"])
def test_slow_stamps_that_say_their_unit_are_taken(name: str, tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {name: np.arange(COUNT) / 100.0, "az_g": noise()[:, 0]})
    with pytest.warns(UserWarning, match="100 Hz, slow for a vibration; give time_unit if"):
        assert bd.read_measured(path).vibration.rate == 100.0


def test_a_slow_speed_beside_a_fast_vibration_is_taken(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["vib/time"], file["vib/az_g"] = TIME, noise()[:, 0]
        slow = np.arange(0.0, TIME[-1] + 0.1, 0.02)
        file["slow/time"], file["slow/speed_rpm"] = slow, np.full(len(slow), 1800.0)
    run = bd.read_measured(tmp_path / "a.h5", speed_channel="*speed_rpm")
    assert run.vibration.rate == RATE


def test_a_speed_that_the_file_has_beside_what_was_asked_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, made = csv(tmp_path, speed_rpm=np.full(COUNT, 1800.0)), str(tmp_path / "run.mcap")
    assert main(["import", str(path), "--speed-rpm", "1000", "-o", made]) == DONE
    assert "has the column speed_rpm; taken is the speed 1000 rpm, as asked" in capsys.readouterr().err
    assert main(["import", str(path), "-o", made, "--force"]) == DONE
    assert "the file has speed_rpm; --speed-channel speed_rpm takes it" in capsys.readouterr().out
    assert main(["monitor", str(path), "--bearing", "6205"]) == BAD_INPUT
    assert "--speed-channel (the file has speed_rpm), --tacho-channel" in capsys.readouterr().err


def test_a_recording_without_speed_is_told_to_be_imported_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its bearing is asked for in the same go."""
    made = str(bd.import_measured(csv(tmp_path), tmp_path / "run.mcap"))
    assert main(["monitor", made]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "does not name its bearing; give --bearing" in said
    assert "has no speed of the shaft" in said
    assert "import the measured file again, or read it, with one of --speed-rpm" in said
    assert main(["monitor", made, "--speed-rpm", "1800", "--bearing", "6205"]) == BAD_INPUT
    assert "--speed-rpm is for measured files; " in capsys.readouterr().err


def test_two_rates_in_one_file_and_in_two_files_are_refused(tmp_path: Path) -> None:
    half = COUNT // 2
    faster = np.concatenate((TIME[:half], TIME[half - 1] + np.arange(1, half + 1) / 48_000))
    one = table(tmp_path / "one.csv", {"time_s": faster, "az_g": noise()[:, 0]})
    (found,) = problems(one)
    assert re.search(r"has two sampling rates, 12000 Hz and from about sample 2\d\d\d on 4[78]\d\d\d", found)
    slow = table(tmp_path / "slow.csv", {"time_s": 2.0 * TIME, "az_g": noise()[:, 0]})
    (found,) = problems([csv(tmp_path), slow])
    assert f"{slow}: is sampled at 6000 Hz and {tmp_path / 'a.csv'} at 12000 Hz" in found


def test_a_gap_in_the_time_is_refused_with_its_place(tmp_path: Path) -> None:
    late = TIME + np.where(np.arange(COUNT) >= 4000, 0.5, 0.0)
    (found,) = problems(table(tmp_path / "a.csv", {"time_s": late, "az_g": noise()[:, 0]}))
    assert "the time jumps by 0.500083 s at sample 4001, where the usual step is 8.3" in found


def test_a_wrong_unit_shows_in_the_numbers(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {"time_s": TIME, "az": 1e6 * noise()[:, 0]})
    (found,) = problems(path, unit="g")
    assert "allowed is up to 1e+06 m/s2: check unit and scale" in found


def test_files_one_after_the_other_are_one_measurement(tmp_path: Path) -> None:
    files = [csv(tmp_path, f"{k}.csv") for k in range(3)]
    run = bd.read_measured(files, speed_rpm=1800)
    assert len(run.vibration) == 3 * COUNT
    assert (np.diff(run.vibration.sample) == 1).all()
    assert np.ptp(np.diff(run.vibration.time_ns)) <= 1
    apart = bd.read_measured(files, speed_rpm=1800, file_interval_s=10.0)
    assert apart.duration == pytest.approx(20.5)
    assert np.flatnonzero(np.diff(apart.vibration.sample) != 1).tolist() == [COUNT - 1, 2 * COUNT - 1]
    assert (np.diff(apart.shaft.time_ns) > 0).all()
    found = problems(files, file_interval_s=0.1)
    assert "lasts 0.5 s, longer than file_interval_s 0.1" in found[0]


def test_nothing_existing_is_replaced_unasked_and_an_input_never(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = csv(tmp_path), tmp_path / "run.mcap"
    before = path.read_bytes()
    assert main(["import", str(path), "-o", str(out)]) == DONE
    first = out.read_bytes()
    assert main(["import", str(path), "-o", str(out), "--speed-rpm", "60"]) == BAD_INPUT
    assert "the file exists; --force replaces it" in capsys.readouterr().err
    assert out.read_bytes() == first
    assert main(["import", str(path), "-o", str(out), "--speed-rpm", "60", "--force"]) == DONE
    assert out.read_bytes() != first
    assert main(["import", str(path), "-o", str(path), "--force"]) == BAD_INPUT
    assert main(["import", str(path), "-o", str(tmp_path / "run.csv")]) == BAD_INPUT
    capsys.readouterr()
    assert path.read_bytes() == before
    bad = tmp_path / "bad.csv"
    bad.write_text(path.read_text() + "1.0,nan\n")
    assert main(["import", str(bad), "-o", str(tmp_path / "new.mcap")]) == BAD_INPUT
    assert not (tmp_path / "new.mcap").exists()


def test_what_is_no_measured_file_is_a_sentence(tmp_path: Path) -> None:
    import zipfile

    with zipfile.ZipFile(tmp_path / "a.xlsx", "w") as file:
        file.writestr("xl/workbook.xml", "<x/>")
    (tmp_path / "a.xls").write_bytes(b"\xd0\xcf\x11\xe0" + bytes(600))
    (tmp_path / "empty.csv").touch()
    files = [tmp_path / name for name in ("a.xlsx", "a.xls", "empty.csv")]
    found = problems([*files, tmp_path])
    assert "is a ZIP file without NumPy arrays; of a spreadsheet save the sheet as CSV" in found[0]
    assert "is of no known format; known are CSV, MATLAB 7.3, MATLAB, HDF5, WAV" in found[1]
    assert found[2] == f"{files[2]}: the file is empty"
    assert found[3] == f"{tmp_path}: is a folder; give the files in it"
    assert problems([]) == ["no measured file is given"]


def test_ctrl_c_keeps_what_is_done(tmp_path: Path) -> None:
    big = tmp_path / "a.npy"
    np.save(big, np.random.default_rng(1).normal(size=30_000_000).astype(np.float32))
    out = tmp_path / "run.mcap"
    words = ["import", str(big), "-o", str(out), "--unit", "g", "--rate-hz", "12000"]
    process = subprocess.Popen(
        [sys.executable, "-m", "beardyn_core.cli.main", *words],
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # jobs of a shell ignore it
    )
    for _ in range(600):
        if (out.exists() and out.stat().st_size > 500_000) or process.poll() is not None:
            break
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=60)
    assert process.returncode == INTERRUPTED, told
    assert "holds the measurement until" in told
    run = bd.read(out)
    assert run.complete
    assert run.status == "interrupted while it was imported"
    assert 0 < len(run.vibration) < 8_000_000


def _write_samples(path: Path, values: np.ndarray) -> None:
    if path.suffix == ".wav":
        import soundfile

        soundfile.write(path, values, 12_000, subtype="DOUBLE")
    elif path.suffix == ".h5":
        import h5py

        with h5py.File(path, "w") as file:
            file["acceleration"] = values
    elif path.suffix == ".npz":
        np.savez(path, acceleration=values)
    else:
        np.save(path, values)


@pytest.mark.parametrize(
    "name", ["a.npz", *(pytest.param(f"a.{end}", marks=pytest.mark.slow) for end in ("npy", "wav", "h5"))]
)
def test_files_in_blocks_are_not_held_in_memory(tmp_path: Path, name: str) -> None:
    """13 MB of samples are surveyed and written with less than half of that in memory."""
    import tracemalloc

    values = np.random.default_rng(1).normal(0.0, 0.1, 1_600_000)
    (tmp_path / "warm").mkdir()
    _write_samples(tmp_path / "warm" / name, values[:9999])
    _write_samples(tmp_path / name, values)
    bd.import_measured(tmp_path / "warm" / name, tmp_path / "warm" / "a.mcap", unit="g", rate_Hz=12_000)
    tracemalloc.start()
    try:
        bd.import_measured(tmp_path / name, tmp_path / f"{name}.mcap", unit="g", rate_Hz=12_000)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 0.5 * values.nbytes

"""Every format gives the samples that were written to it, as a run, as a recording, and block by block."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.measured import csv_text, source, stream
from beardyn_core.measured.formats import FORMATS, format_of
from test.measured.files import COUNT, KINDS, RATE, G, Kind, mcap, noise

EVERY = pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)


def tolerance(kind: Kind) -> float:
    return 1e-4 if kind.single else 1e-9


@EVERY
@pytest.mark.parametrize("axes", [1, 3])
def test_a_file_is_read_as_it_was_written(kind: Kind, axes: int, tmp_path: Path) -> None:
    values = noise(axes=axes)
    path = kind.make(tmp_path, values)
    run = bd.read_measured(path, speed_rpm=1800, **{**kind.needs, **(kind.one if axes == 1 else {})})
    assert run.vibration.rate == RATE
    assert run.vibration.values.shape == (COUNT, 3)
    np.testing.assert_allclose(run.vibration.values[:, 3 - axes :], values * G, atol=tolerance(kind) * G)
    assert np.isnan(run.vibration.values[:, : 3 - axes]).all()
    np.testing.assert_array_equal(run.vibration.sample, np.arange(COUNT))
    assert run.duration == pytest.approx(COUNT / RATE)
    np.testing.assert_allclose(run.shaft.speed, 1800 * np.pi / 30)
    np.testing.assert_allclose(run.shaft.angle, run.shaft.time * 1800 * np.pi / 30, atol=1e-6)
    assert run.truth == {}
    assert run.measured["files"][0]["name"] == path.name


@EVERY
def test_the_recording_of_a_file_is_the_run_of_the_file(kind: Kind, tmp_path: Path) -> None:
    path = kind.make(tmp_path, noise(axes=3))
    direct = bd.read_measured(path, speed_rpm=1800, bearing={"drive_end": "6205"}, **kind.needs)
    recording = bd.import_measured(
        path, tmp_path / "run.mcap", speed_rpm=1800, bearing={"drive_end": "6205"}, **kind.needs
    )
    read = bd.read(recording)
    assert read.complete
    assert read.status == "complete"
    assert read.measured == direct.measured
    assert read.truth == direct.truth == {}
    np.testing.assert_array_equal(read.vibration.time_ns, direct.vibration.time_ns)
    np.testing.assert_array_equal(read.vibration.values, direct.vibration.values.astype(np.float32))
    np.testing.assert_array_equal(read.shaft.angle, direct.shaft.angle)
    assert read.duration == pytest.approx(direct.duration, rel=1e-6)


@EVERY
def test_the_size_of_blocks_changes_nothing(
    kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = kind.make(tmp_path, noise(axes=3))
    whole = bd.read_measured(path, **kind.needs)
    monkeypatch.setattr(source, "BLOCK", 777)
    for name in ("npz", "wav", "mdf", "parquet"):
        monkeypatch.setattr(f"beardyn_core.measured.{name}.BLOCK", 777)
    monkeypatch.setattr("beardyn_core.record.other_messages._BLOCK", 777)
    monkeypatch.setattr(csv_text, "_CHARACTERS", 1001)
    monkeypatch.setattr(stream, "PART_S", 0.0137)
    cut = bd.read_measured(path, **kind.needs)
    np.testing.assert_array_equal(cut.vibration.values, whole.vibration.values)
    np.testing.assert_array_equal(cut.vibration.time_ns, whole.vibration.time_ns)


@EVERY
def test_a_format_is_known_by_its_bytes_and_not_by_its_name(kind: Kind, tmp_path: Path) -> None:
    path = kind.make(tmp_path, noise(200))
    right = format_of(path)
    other = path.rename(tmp_path / "measured.dat")
    assert format_of(other) == right
    assert right.name in ("text", *(each.name for each in FORMATS))


@EVERY
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.9])
def test_a_file_that_was_cut_off_ends_in_sentences_that_name_it(
    kind: Kind, share: float, tmp_path: Path
) -> None:
    path = kind.make(tmp_path, noise(axes=3))
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    problems = [str(path)]
    try:
        run = bd.read_measured(path, **kind.needs)
    except bd.InputError as error:
        problems = error.problems
    else:  # text without its end is a shorter text, and a log of segments a shorter log
        assert kind.name in ("csv", "tdms")
        assert 0 < len(run.vibration) < COUNT
    assert problems
    assert all(str(path) in problem for problem in problems)


@EVERY
def test_bytes_that_were_damaged_never_end_in_a_traceback(kind: Kind, tmp_path: Path) -> None:
    path = kind.make(tmp_path, noise(1000, axes=3))
    data = path.read_bytes()
    draw = np.random.default_rng(7)
    for _ in range(12):
        damaged = bytearray(data)
        for at in draw.integers(0, len(data), 20):
            damaged[at] = draw.integers(0, 256)
        path.write_bytes(damaged)
        with suppress(bd.InputError):
            bd.read_measured(path, **kind.needs)


def test_json_messages_are_read(tmp_path: Path) -> None:
    values = noise(300)
    path = mcap(tmp_path / "other.mcap", values, "json")
    run = bd.read_measured(path, channels="z=*.z", unit="m/s2")
    np.testing.assert_allclose(run.vibration.values[:, 2], values[:, 0] * G)
    assert run.vibration.rate == RATE


def test_what_is_exported_is_read_again(tmp_path: Path) -> None:
    run = bd.read_measured(KINDS[0].make(tmp_path, noise(axes=3)), speed_rpm=1800)
    for ending, options in (
        ("csv", {"unit": "m/s2"}),
        ("parquet", {"unit": "m/s2"}),
        ("npz", {"unit": "m/s2"}),
        ("h5", {}),
        ("wav", {"unit": "m/s2", "channels": "x=1,y=2,z=3"}),
    ):
        target = tmp_path / f"out.{ending}"
        (path, *_) = getattr(run, f"to_{ending.replace('h5', 'hdf5')}")(target, "vibration")
        again = bd.read_measured(path, **options)
        np.testing.assert_allclose(again.vibration.values, run.vibration.values, rtol=1e-6, atol=1e-6)
        assert again.vibration.rate == pytest.approx(RATE)


def test_one_axis_is_one_channel_of_a_wav_file(tmp_path: Path) -> None:
    import soundfile

    run = bd.read_measured(KINDS[0].make(tmp_path, noise()))
    (path, _) = run.to_wav(tmp_path / "a.wav")
    values, rate = soundfile.read(path)
    np.testing.assert_array_equal(values, run.vibration.values[:, 2].astype(np.float32))
    assert rate == RATE
    assert np.isnan(run.to_xarray().vibration.sel(axis="x")).all()
    assert "measured.csv" in repr(run)
    assert run.labels == {}
    with pytest.raises(bd.InputError, match="was measured, so there is no bearing in it to draw"):
        run.described()


def test_whole_numbers_of_a_wav_file_are_shares_of_full_scale(tmp_path: Path) -> None:
    import soundfile

    values = np.round(noise() / 8.0, 4)
    soundfile.write(tmp_path / "a.wav", values, round(RATE), subtype="PCM_24")
    run = bd.read_measured(tmp_path / "a.wav", unit="g", scale=50.0)
    np.testing.assert_allclose(run.vibration.values[:, 2], values[:, 0] * 50.0 * G, atol=50.0 * G * 2.0**-23)
    assert "shares of full scale" in run.measured["understood"][0]


@pytest.mark.parametrize("kind", [each for each in KINDS if each.name in ("tdms", "universal", "mdf", "wav")],
                         ids=lambda kind: kind.name)  # fmt: skip
def test_a_missing_library_is_a_sentence_with_the_command(
    kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    path = kind.make(tmp_path, noise(200))
    name = {"tdms": "nptdms", "universal": "pyuff", "mdf": "asammdf", "wav": "soundfile"}[kind.name]
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(bd.InputError, match=rf"needs {name}, .* pip install 'beardyn\[measured\]'"):
        bd.read_measured(path, **kind.needs)

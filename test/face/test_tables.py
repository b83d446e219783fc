"""Tables and files of a run: every number comes back, and the truth with it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.cli.main import main
from beardyn_core.record.exporting import KINDS, export
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.record.tables import SIGNALS, columns_of, parts_of, signal_of
from test.record.conftest import files_of_at_most
from test.recordings import write_recording


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("tables") / "run.mcap", 10)


@pytest.fixture(scope="module")
def run(recording: Path) -> Run:
    return read_run(recording)


def test_parquet_holds_the_columns_and_the_truth(run: Run, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    for name in SIGNALS:
        (path,) = run.to_parquet(tmp_path / f"{name}.parquet", [name])
        table = parquet.read_table(path)
        for key, values in columns_of(run, name).items():
            np.testing.assert_array_equal(table[key].to_numpy(zero_copy_only=False), values)
        said = json.loads(table.schema.metadata[b"beardyn"])
        assert said == {"signal": name, "truth": dict(run.truth)}


def test_csv_holds_the_columns_and_its_neighbour_the_truth(run: Run, tmp_path: Path) -> None:
    for name in ("vibration", "rollers", "contacts", "shaft"):
        path, beside = run.to_csv(tmp_path / f"{name}.csv", [name])
        headings = path.read_text(encoding="utf-8").splitlines()[0].split(",")
        names = [heading.partition(" [")[0] for heading in headings]  # without units
        table = np.genfromtxt(path, delimiter=",", names=names, skip_header=1, dtype=None, encoding="utf-8")
        for key, values in columns_of(run, name).items():
            if values.dtype.kind == "U":
                assert table[key].tolist() == values.tolist()
            else:
                np.testing.assert_allclose(table[key], values, rtol=1e-11)
        assert json.loads(beside.read_text()) == dict(run.truth)


def test_npz_and_hdf5_hold_every_array_and_the_truth(run: Run, tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    (flat,), (tree,) = run.to_npz(tmp_path / "run.npz"), run.to_hdf5(tmp_path / "run.h5")
    with np.load(flat) as arrays, h5py.File(tree) as file:
        for name in (*SIGNALS[:-1], "vibration_axlebox_end"):
            np.testing.assert_array_equal(arrays[f"{name}.time"], signal_of(run, name).time)
            for part, array in parts_of(run, name).items():
                np.testing.assert_array_equal(arrays[f"{name}.{part}"], array.values)
                np.testing.assert_array_equal(file[name][part][()], array.values)
                assert file[name][part].attrs["unit"] == array.unit
        assert json.loads(str(arrays["truth"])) == json.loads(file.attrs["truth"]) == dict(run.truth)
        assert "temperature" not in file  # the run has none
        assert file.attrs["seed"] == 1


def test_wav_is_the_vibration_in_si_units(run: Run, tmp_path: Path) -> None:
    from scipy.io import wavfile

    *files, beside = run.to_wav(tmp_path / "run.wav")
    assert [path.name for path in files] == ["run_vibration.wav", "run_vibration_axlebox_end.wav"]
    rate, values = wavfile.read(files[0])
    assert rate == 25_600
    np.testing.assert_array_equal(values, run.vibration.values.astype(np.float32))
    assert json.loads(beside.read_text())["scene"] == "synthetic"
    with pytest.raises(InputError, match="only vibration can"):
        run.to_wav(tmp_path / "force.wav", ["force"])


@pytest.mark.parametrize("kind", KINDS)
def test_a_full_disk_leaves_no_part_of_a_file_and_what_was_there(run: Run, kind: str, tmp_path: Path) -> None:
    for library in {"parquet": ("pyarrow",), "h5": ("h5py",)}.get(kind, ()):
        pytest.importorskip(library)
    path = tmp_path / f"run.{kind}"
    with files_of_at_most(4096), pytest.raises(InputError, match="cannot be written"):
        export(run, path)
    assert list(tmp_path.iterdir()) == []
    path.write_text("of last week")
    with files_of_at_most(4096), pytest.raises(InputError, match="cannot be written"):
        export(run, path, force=True)
    assert [each.read_text() for each in tmp_path.iterdir()] == ["of last week"]


def test_xarray_has_named_axes_and_the_truth(run: Run) -> None:
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert data.rollers_speed.dims == ("time_rollers", "row", "roller")
    np.testing.assert_array_equal(data.vibration.sel(axis="z").values, run.vibration.values[:, 2])
    np.testing.assert_array_equal(
        data.contacts_force.sel(kind="cone", row=1, roller=3, axis="z").values,
        run.contacts.force[:, 1, 3, run.contacts.of("cone"), 2],
    )
    assert data.force.attrs["units"] == "N, N m"
    assert json.loads(data.attrs["truth"]) == dict(run.truth)
    assert data.attrs["fault_on"] == "cup"
    assert data.bodies_pose.sel(body="cone", coordinate="qw").shape == (len(run.bodies),)


def test_pandas_has_a_row_a_sample(run: Run) -> None:
    pytest.importorskip("pandas")
    frame = run.to_pandas()
    assert list(frame.columns) == ["ax", "ay", "az"]
    np.testing.assert_array_equal(frame.index, run.vibration.time)
    np.testing.assert_array_equal(frame["az"], run.vibration.values[:, 2])
    rollers = run.to_pandas("rollers")
    np.testing.assert_array_equal(rollers["speed_1_16"], run.rollers.speed[:, 1, 16])
    assert list(run.to_pandas("torque").columns) == ["torque"]
    assert list(run.to_pandas("load").columns)[:3] == ["fx", "fy", "fz"]
    contacts = run.to_pandas("contacts")
    assert set(contacts["kind"]) == {"cup", "cone", "rib"}
    assert len(contacts) == run.contacts.touching.sum()
    with pytest.raises(InputError, match="allowed are vibration"):
        run.to_pandas("sound")


def test_a_missing_library_is_named_with_its_remedy(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    for name in ("xarray", "pandas", "h5py", "pyarrow"):
        monkeypatch.setitem(sys.modules, name, None)
    for ask in (run.to_xarray, run.to_pandas, lambda: run.to_hdf5("never.h5")):
        with pytest.raises(InputError, match=r"pip install 'beardyn\[data\]'"):
            ask()
    assert not Path("never.h5").exists()


def test_the_command_refuses_what_exists_and_what_is_the_input(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "run.npz"
    assert main(["export", str(recording), "-o", str(target), "--signals", "vibration,force"]) == 0
    with np.load(target) as arrays:
        signals = {f"{name}.{part}" for name in ("vibration", "force") for part in ("time", "values")}
        units = {"vibration.values.unit": "m/s^2", "force.values.unit": "N, N m"}
        assert set(arrays) == {"truth"} | signals | set(units)
        assert {name: str(arrays[name]) for name in units} == units  # by which an import knows them
    before = target.read_bytes()
    assert main(["export", str(recording), "-o", str(target)]) == 2
    assert "the file exists; --force replaces it, or" in capsys.readouterr().err
    assert target.read_bytes() == before
    assert main(["export", str(recording), "-o", str(target), "--force", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["command"] == "export"
    assert (told["recording"], told["files"]) == (str(recording), [str(target)])
    assert target.read_bytes() != before
    kept = recording.read_bytes()
    link = tmp_path / "run.csv"
    link.symlink_to(recording)
    assert main(["export", str(recording), "-o", str(link), "--force", "--signals", "vibration"]) == 2
    assert "an input is never replaced" in capsys.readouterr().err
    assert recording.read_bytes() == kept


def test_every_mistake_is_said_at_once(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code = main(["export", str(recording), "-o", str(tmp_path / "run.xlsx"), "--signals", "noise,vibration"])
    said = capsys.readouterr().err
    assert code == 2
    assert "'noise' is not one of the run" in said
    assert ".parquet, .csv, .npz, .h5, .wav" in said

"""Tables of one file keep their own starts, files their gaps and their order; what is invalid is a gap."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.measured.alignment import Begun, align_files
from beardyn_core.measured.claimed_start import Start
from test.examples import examples
from test.measured.files import RATE, noise, problems, table

SECONDS = 5.0
LATE = 2.0  # [s], by which the speed begins behind the vibration
VIBRATION = noise(round(SECONDS * RATE))[:, 0]
SLOW = LATE + 0.1 * np.arange(40)  # [s]
EPOCH = np.datetime64("2026-01-01T00:00:00")


def rpm(time: Any) -> Any:
    return 600.0 + 120.0 * time


def _tdms(path: Path, fast: dict[str, Any], slow: dict[str, Any]) -> Path:
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(path)) as writer:
        said = {"wf_increment": 1.0 / RATE, "unit_string": "g", **fast}
        its = {"wf_increment": 0.1, "unit_string": "rpm", **slow}
        writer.write_segment(
            [
                ChannelObject("fast", "az", VIBRATION, properties=said),
                ChannelObject("slow", "speed", rpm(SLOW), properties=its),
            ]
        )
    return path


def tdms_dates(folder: Path) -> Path:
    late = EPOCH + np.timedelta64(2, "s")
    return _tdms(folder / "a.tdms", {"wf_start_time": EPOCH}, {"wf_start_time": late})


def tdms_offsets(folder: Path) -> Path:
    return _tdms(folder / "a.tdms", {"wf_start_offset": 0.0}, {"wf_start_offset": LATE})


def hdf5_times(folder: Path, first: float = 0.0) -> Path:
    import h5py

    with h5py.File(folder / "a.h5", "w") as file:
        file["fast/time"], file["fast/az_g"] = first + np.arange(len(VIBRATION)) / RATE, VIBRATION
        file["slow/time"], file["slow/speed_rpm"] = first + SLOW, rpm(SLOW)
    return folder / "a.h5"


def hdf5_epoch(folder: Path) -> Path:
    return hdf5_times(folder, 1_700_000_000.0)


def hdf5_attributes(folder: Path) -> Path:
    import h5py

    with h5py.File(folder / "a.h5", "w") as file:
        file["fast/az_g"], file["slow/speed_rpm"] = VIBRATION, rpm(SLOW)
        file["fast"].attrs.update({"fs": RATE, "t0": 10.0})
        file["slow"].attrs.update({"fs": 10.0, "t0_ms": 12_000.0})
    return folder / "a.h5"


def matlab_structs(folder: Path) -> Path:
    from scipy.io import savemat

    time = np.arange(len(VIBRATION)) / RATE
    slow = {"t": SLOW, "speed_rpm": rpm(SLOW)}
    savemat(folder / "a.mat", {"fast": {"t": time, "az_g": VIBRATION}, "slow": slow})
    return folder / "a.mat"


def mdf_groups(folder: Path) -> Path:
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        file.append([Signal(VIBRATION, np.arange(len(VIBRATION)) / RATE, name="az", unit="g")])
        file.append([Signal(rpm(SLOW), SLOW, name="speed", unit="rpm")])
        file.save(folder / "a.mf4", overwrite=True)
    return folder / "a.mf4"


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize(
    "make",
    [tdms_dates, tdms_offsets, hdf5_times, hdf5_epoch, hdf5_attributes, matlab_structs, mdf_groups],
    ids=lambda make: make.__name__,
)
def test_a_speed_that_begins_later_keeps_its_start(make: Callable[[Path], Path], tmp_path: Path) -> None:
    run = bd.read_measured(make(tmp_path), channels="z=*az*", speed_channel="*speed*")
    assert run.shaft.time[0] == pytest.approx(LATE, abs=1e-3)
    np.testing.assert_allclose(run.shaft.speed, rpm(run.shaft.time) * np.pi / 30.0, rtol=1e-6)
    assert len(run.vibration) == len(VIBRATION)
    assert any("gives a speed for 3 of 5 s, from 2 to 5 s" in each for each in run.measured["warnings"])


@given(late=some.floats(-6.0, 6.0), slow_rate=some.sampled_from([5.0, 10.0, 40.0]))
@example(late=-3.875, slow_rate=5.0)
@settings(max_examples=examples(60), deadline=None)
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_any_start_of_the_speed_is_kept(
    late: float, slow_rate: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.mktemp("starts") / "a.npz"
    time, slow = np.arange(6000) / RATE, late + np.arange(round(4.0 * slow_rate)) / slow_rate
    arrays: dict[str, Any] = {
        "v.time": time,
        "v.az_g": VIBRATION[:6000],
        "s.time": slow,
        "s.n_rpm": 2000.0 + 100.0 * slow,
    }
    np.savez(path, **arrays)
    # the vibration lasts half a second; the last speed stands an interval before the end of its table
    if late >= 0.5 or late + 4.0 <= 1.0 / slow_rate:
        assert any("they have no time together" in each for each in problems(path, speed_channel="s.n_rpm"))
        return
    run = bd.read_measured(path, speed_channel="s.n_rpm")
    np.testing.assert_allclose(run.shaft.speed, (2000.0 + 100.0 * run.shaft.time) * np.pi / 30.0, rtol=1e-6)
    assert run.shaft.time.min() >= 0.0
    assert run.shaft.time.max() <= 0.5


def test_a_start_that_only_one_table_has_and_two_clocks_are_told(tmp_path: Path) -> None:
    path = _tdms(tmp_path / "a.tdms", {"wf_start_time": EPOCH}, {})
    with pytest.warns(UserWarning, match="does not state when speed began; taken is with the others"):
        bd.read_measured(path, channels="z=az", speed_channel="speed")
    path = _tdms(tmp_path / "a.tdms", {"wf_start_time": EPOCH}, {"wf_start_offset": 1.0})
    with pytest.warns(UserWarning, match="az and speed are of different clocks, a date and seconds"):
        bd.read_measured(path, channels="z=az", speed_channel="speed")


def stamped(folder: Path, starts: list[float], seconds: float = 1.0) -> list[Path]:
    count = round(seconds * RATE)
    return [
        table(
            folder / f"{k}.csv",
            {"time_s": start + np.arange(count) / RATE, "az_g": noise(count, seed=k)[:, 0]},
        )
        for k, start in enumerate(starts)
    ]


def test_files_whose_times_are_out_of_order_are_warned_of(tmp_path: Path) -> None:
    with pytest.warns(
        UserWarning, match=r"2.csv: begins by its own time 0.8 s before the beginning of .*1.csv"
    ):
        bd.read_measured(stamped(tmp_path, [0.0, 0.9, 0.1], 0.1))
    with pytest.warns(UserWarning, match="joined in the order given"):  # they overlap
        bd.read_measured(stamped(tmp_path, [0.0, 0.05], 0.1))


def test_gaps_between_files_by_their_own_times_are_kept(tmp_path: Path) -> None:
    with pytest.warns(
        UserWarning, match="1 gaps between the files, up to 0.7 s and 0.7 s in all; they are kept"
    ):
        run = bd.read_measured(stamped(tmp_path, [3.0, 3.1, 3.9], 0.1))
    step = np.diff(run.vibration.sample)
    assert np.flatnonzero(step > 1).tolist() == [2399]
    assert run.duration == pytest.approx(1.0)
    assert not bd.read_measured(stamped(tmp_path, [3.0, 3.1, 3.2], 0.1)).measured["warnings"]
    assert not bd.read_measured(stamped(tmp_path, [0.0, 0.0, 0.0], 0.1)).measured["warnings"]
    with pytest.warns(UserWarning, match="differ from file_interval_s 1 by up to"):
        bd.read_measured(stamped(tmp_path, [3.0, 3.1, 3.9], 0.1), file_interval_s=1.0)


@given(
    order=some.permutations(range(5)),
    gaps=some.lists(some.sampled_from([0.0, 0.5, 3.0]), min_size=5, max_size=5),
    dated=some.booleans(),
)  # fmt: skip
@settings(max_examples=examples(150), deadline=None)
def test_any_order_of_files_is_placed_by_its_times_or_warned_of(
    order: list[int], gaps: list[float], dated: bool
) -> None:
    true = np.concatenate(([0.0], np.cumsum(1.0 + np.array(gaps[:4])))) + (1.7e9 if dated else 4.0)
    files = [(Path(f"{k}.csv"), Begun("", Start(round(true[k] * 1e9), dated), 1.0)) for k in order]
    begins, warnings = align_files(files, None, 1e-3)
    if order == sorted(order):
        np.testing.assert_allclose(np.array(begins) * 1e-9, true - true[0], atol=1e-6)
        assert bool(warnings) == bool(any(gaps[:4]))
    else:
        assert "in the order of their times" in warnings[0]
        assert begins == [round(k * 1e9) for k in range(5)]


def test_samples_that_the_file_marks_as_invalid_are_a_gap(tmp_path: Path) -> None:
    from asammdf import MDF, Signal

    count = 12_000
    invalid = np.zeros(count, bool)
    invalid[5000:5120] = True
    values = noise(count)[:, 0]
    with MDF(version="4.10") as file:
        time = np.arange(count) / RATE
        signals = [Signal(values, time, name="az", unit="g", invalidation_bits=invalid)]
        file.append([*signals, Signal(values, time, name="other", unit="V")])
        file.save(tmp_path / "a.mf4", overwrite=True)
    with pytest.warns(UserWarning, match="marks 120 of 12000 samples as invalid, the first is sample 5001"):
        run = bd.read_measured(tmp_path / "a.mf4", channels="z=az")
    assert len(run.vibration) == count - 120
    assert np.flatnonzero(np.diff(run.vibration.sample) != 1).tolist() == [4999]
    np.testing.assert_allclose(run.vibration.values[5000, 2], values[5120] * 9.80665)
    recording = bd.import_measured(tmp_path / "a.mf4", tmp_path / "run.mcap", channels="z=az")
    np.testing.assert_array_equal(bd.read(recording).vibration.sample, run.vibration.sample)


@pytest.mark.parametrize("code", [-1, -2, -3, 1, 2, 3])
def test_a_response_against_an_axis_is_turned(code: int, tmp_path: Path) -> None:
    import pyuff

    values = noise(500)[:, 0]
    one = pyuff.prepare_58(
        binary=0, func_type=1, rsp_node=1, rsp_dir=code, ref_dir=0, ref_node=0, data=values,
        x=np.arange(500) / RATE, id1="NONE", rsp_ent_name="NONE", ref_ent_name="NONE", abscissa_spacing=1,
        abscissa_spec_data_type=17, ordinate_spec_data_type=12, orddenom_spec_data_type=0,
        z_axis_spec_data_type=0, ordinate_axis_units_lab="g", ord_data_type=4, abscissa_inc=1.0 / RATE,
    )  # fmt: skip
    pyuff.UFF(str(tmp_path / "a.uff")).write_sets([one], mode="overwrite")
    run = bd.read_measured(tmp_path / "a.uff")
    found = run.vibration.values[:, abs(code) - 1]
    np.testing.assert_allclose(found, np.sign(code) * values * 9.80665, rtol=1e-5)
    told = any("its sign is turned" in each for each in run.measured["understood"])
    assert told == (code < 0)

"""`bd.plot`: what is drawn is what the arrays hold, on the axes that were given, of runs and of statics."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

import beardyn_core as bd

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.projections.polar import PolarAxes

BEARING = "HS130x230"


def offsets(axes: Any, number: int) -> np.ndarray:
    """Places of the marks of a collection, shape [mark, 2]."""
    return np.asarray(axes.collections[number].get_offsets(), np.float64)


def data_of(line: Any) -> tuple[np.ndarray, np.ndarray]:
    """Points of a line."""
    across, up = line.get_data()
    return np.asarray(across, np.float64), np.asarray(up, np.float64)


@pytest.fixture(autouse=True)
def _no_figures_left() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def run() -> bd.Run:
    fault = {"on": "cup", "width_mm": 6}
    scene = bd.scene(load_kN=60, speed_rpm=900, faults=[fault], effects="standard", tier="lumped")
    return bd.simulate(scene, duration=1.0)


@pytest.fixture(scope="module")
def run_up() -> bd.Run:
    return bd.simulate(
        {
            "scene": "run_up",
            "bearing": BEARING,
            "lubricant": "L055",
            "tier": "lumped",
            "effects": "standard",
            "duration_s": 2.0,
            "operation": {
                "kind": "stepped",
                "steps": [
                    {"time_s": 0.0, "force_kN": [0, 0, 60], "speed_rpm": 300},
                    {"time_s": 0.05, "force_kN": [0, 0, 60], "speed_rpm": 1200},
                ],
                "ramp_s": 1.95,
            },
        }
    )


def test_importing_the_package_and_its_plots_imports_no_matplotlib() -> None:
    program = "import sys, beardyn_core as bd; bd.plot.load_zone; print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_a_load_zone_of_statics_has_a_mark_for_each_roller() -> None:
    found = bd.equilibrium(BEARING, 80)
    axes = bd.plot.load_zone(found)
    marks = [offsets(axes, 1), offsets(axes, 3)]  # behind the lines of each row
    np.testing.assert_allclose(marks[0][:, 0], 2 * np.pi * np.arange(17) / 17)
    np.testing.assert_allclose(marks[1][:, 1], 1e-3 * found.cup_load[1])
    pressed = bd.plot.load_zone(found, pressure=True)
    top = max(offsets(pressed, 1)[:, 1].max(), offsets(pressed, 3)[:, 1].max())
    assert top == pytest.approx(1e-9 * found.cup_pressure.max())
    assert isinstance(pressed, PolarAxes)
    assert pressed.get_theta_offset() == pytest.approx(np.pi / 2)  # 0 is up
    assert pressed.get_theta_direction() == -1  # +x, forward, to the right


def test_a_load_zone_of_a_run_is_at_a_moment_or_all_of_it(run: bd.Run) -> None:
    whole, one = bd.plot.load_zone(run), bd.plot.load_zone(run, at=0.5)
    count = sum(len(offsets(whole, number)) for number in range(len(whole.collections)))
    assert count == 2 * 17 * int((run.contacts.time >= 0.25).sum())
    index = int(np.abs(run.contacts.time - 0.5).argmin())
    row = offsets(one, 1)
    np.testing.assert_allclose(row[:, 1], 1e-3 * run.contacts.load[index, 0, :, run.contacts.of("cup")])
    near = int(np.abs(run.rollers.time - run.contacts.time[index]).argmin())
    off = np.mod(row[:, 0] - run.rollers.angle[near, 0] + 0.1, 2 * np.pi)
    assert (off < 0.2).all()


def test_the_axes_that_are_given_are_drawn_on(run: bd.Run) -> None:
    _, (left, right) = plt.subplots(1, 2)
    assert bd.plot.spectrum(run, ax=left) is left
    assert bd.plot.envelope_spectrum(run, ax=right) is right
    assert len(plt.get_fignums()) == 1
    assert left.lines
    assert right.lines
    with pytest.raises(bd.InputError, match="not polar"):
        bd.plot.load_zone(run, ax=left)


def test_a_spectrum_has_the_power_of_the_signal(run: bd.Run) -> None:
    axes = bd.plot.spectrum(run, axes="z")
    frequency, density = data_of(axes.lines[0])
    z = run.vibration.values[:, 2]
    assert np.sum(density**2) * (frequency[1] - frequency[0]) == pytest.approx(z.var(), rel=0.1)
    short = bd.plot.spectrum(run, axes="xz", highest_Hz=2000)
    assert len(short.lines) == 2
    assert short.get_xlim()[1] <= 2000
    step = frequency[1] - frequency[0]
    lowest = data_of(bd.plot.spectrum(run, axes="z", highest_Hz=1.2 * step).lines[0])[0]
    np.testing.assert_allclose(lowest, [step])
    assert bd.plot.waterfall(run, highest_Hz=5).collections


def test_an_envelope_spectrum_peaks_at_the_fault_and_names_its_lines(run: bd.Run) -> None:
    axes = bd.plot.envelope_spectrum(run, harmonics=3)
    order, level = max(map(data_of, axes.lines), key=lambda each: len(each[0]))
    bpfo = bd.fault_frequencies(BEARING)["BPFO"]
    near = np.abs(order - bpfo) < 0.1
    assert level[near].max() > np.median(level) + 10.0
    labels = {each.get_text() for each in axes.texts}
    assert {"BPFO", "2×BPFO", "3×BPFO", "BPFI", "2 BSF", "FTF"} <= labels


def test_a_waterfall_of_a_run_up_is_over_the_speed(run: bd.Run, run_up: bd.Run) -> None:
    axes = bd.plot.waterfall(run_up, highest_Hz=3000)
    assert "rpm" in axes.get_ylabel()
    low, high = axes.get_ylim()
    assert 280 < low < 450  # half a row below the slowest
    assert 1050 < high < 1230
    bpfo = next(each for each in axes.lines if each.get_linestyle() == "-")
    hertz, rpm = data_of(bpfo)
    np.testing.assert_allclose(hertz, bd.fault_frequencies(BEARING)["BPFO"] * rpm / 60.0)
    assert "time" in bd.plot.waterfall(run).get_ylabel()


def test_curves_are_the_answers_of_statics() -> None:
    plays = [-0.05, 0.0, 0.1]
    stiff = bd.plot.stiffness_curve(BEARING, 60, end_play_mm=plays)
    np.testing.assert_allclose(
        data_of(stiff.lines[2])[1], 1e-6 * bd.stiffness(BEARING, 60, end_play_mm=plays)[:, 2, 2]
    )
    speeds = [200.0, 800.0]
    turned = bd.plot.torque_curve(BEARING, 60, speed_rpm=speeds)
    np.testing.assert_allclose(data_of(turned.lines[0])[1], bd.torque(BEARING, speeds, 60))
    clear = bd.plot.stiffness_curve("WJ130x240", 60, radial_clearance_mm=[0.05, 0.15])
    assert clear.get_xlabel() == "radial clearance [mm]"


@pytest.mark.parametrize("name", [BEARING, "WJ130x240", "SRB120x260"])
def test_a_stiffness_curve_of_any_kind_is_over_its_own_play(name: str) -> None:
    axes = bd.plot.stiffness_curve(name)
    play, stiffness = data_of(axes.lines[2])
    key = "end_play_mm" if name == BEARING else "radial_clearance_mm"
    assert axes.get_xlabel() == f"{key.removesuffix('_mm').replace('_', ' ')} [mm]"
    for place in (0, len(play) - 1):
        own: dict[str, Any] = {key: float(play[place])}
        again = bd.stiffness(name, 80, **own)
        assert stiffness[place] == pytest.approx(1e-6 * again[2, 2], rel=1e-9)


def test_a_curve_over_the_radial_clearance_keeps_an_end_play_that_is_given() -> None:
    clearances = [0.05, 0.15]
    with_play = bd.plot.stiffness_curve(
        "WJ130x240", (0, 10, 60), radial_clearance_mm=clearances, end_play_mm=0.3
    )
    expected = bd.stiffness("WJ130x240", (0, 10, 60), radial_clearance_mm=clearances, end_play_mm=0.3)
    np.testing.assert_allclose(data_of(with_play.lines[1])[1], 1e-6 * expected[:, 1, 1])
    with pytest.raises(bd.InputError, match="end_play_mm is a sequence"):
        bd.plot.stiffness_curve("WJ130x240", radial_clearance_mm=clearances, end_play_mm=[0.2, 0.3])


def test_recordings_and_measured_files_are_plotted(run: bd.Run, tmp_path: Path) -> None:
    source = tmp_path / "motor.csv"
    run.to_csv(source)
    measured = bd.read_measured(source, speed_rpm=900, bearing=BEARING)
    axes = bd.plot.envelope_spectrum(measured)
    assert "BPFO" in {each.get_text() for each in axes.texts}
    assert bd.plot.spectrum(measured).lines
    assert bd.plot.waterfall(measured, highest_Hz=2000).collections
    with pytest.raises(bd.InputError, match="no contacts"):
        bd.plot.load_zone(measured)


def test_a_measured_file_that_states_rate_and_unit_is_plotted_by_its_path(tmp_path: Path) -> None:
    rate, count = 10_000, 20_000
    noise = np.random.default_rng(1).normal(size=count)
    stated, bare = tmp_path / "stated.csv", tmp_path / "bare.csv"
    table = np.column_stack([np.arange(count) / rate, noise])
    np.savetxt(stated, table, delimiter=",", header="time [s],z [m/s^2]", comments="")
    np.savetxt(bare, noise, header="z", comments="")

    frequency, density = data_of(bd.plot.spectrum(str(stated)).lines[0])
    assert frequency[-1] == rate / 2
    step = frequency[1] - frequency[0]
    assert np.sum(density**2) * step == pytest.approx(noise.var(), rel=0.05)
    assert density[10:-10].min() > 0.3 * np.median(density)  # eight parts: no line is far below the others
    assert bd.plot.waterfall(stated, highest_Hz=2000).collections
    with pytest.raises(bd.InputError, match=r"no speed of the shaft; bd\.read_measured\(file, speed_rpm"):
        bd.plot.envelope_spectrum(stated, bearing=BEARING)
    with pytest.raises(bd.InputError, match="no contacts"):
        bd.plot.load_zone(stated)
    for draw in (bd.plot.spectrum, bd.plot.waterfall):
        with pytest.raises(bd.InputError, match=r"bd\.read_measured\('.*bare\.csv', unit=") as error:
            draw(str(bare))
        assert any("state the rate" in problem for problem in error.value.problems)


def test_a_recording_of_any_name_is_read_as_one(run: bd.Run, tmp_path: Path) -> None:
    recorded, named = tmp_path / "run.mcap", tmp_path / "run.recording"
    source = tmp_path / "motor.csv"
    run.to_csv(source)
    bd.import_measured(source, recorded, speed_rpm=900, bearing=BEARING)
    named.write_bytes(recorded.read_bytes())
    drawn = [data_of(bd.plot.spectrum(each).lines[0]) for each in (recorded, named)]
    np.testing.assert_array_equal(drawn[0], drawn[1])
    assert bd.plot.envelope_spectrum(named).lines
    recorded.write_bytes(b"no recording at all")
    for path in (recorded, tmp_path / "absent.csv"):
        with pytest.raises(bd.InputError) as error:
            bd.plot.spectrum(path)
        assert "read_measured" not in str(error.value)


def test_what_cannot_be_drawn_is_answered_in_a_sentence(run: bd.Run) -> None:
    for call, said in (
        (lambda: bd.plot.spectrum(run, axes="q"), "one or more of x, y and z"),
        (lambda: bd.plot.spectrum(run, sensor="roof"), "no sensor 'roof'"),
        (lambda: bd.plot.load_zone(run, at=5.0), "at is 5"),
        (lambda: bd.plot.waterfall(run, segment_s=9.0), "segment_s"),
        (lambda: bd.plot.waterfall(run, highest_Hz=-5), "highest_Hz is -5; give a frequency of 5 Hz"),
        (lambda: bd.plot.waterfall(run, highest_Hz=4.9), "highest_Hz is 4.9"),
        (
            lambda: bd.plot.spectrum(run, highest_Hz=0),
            r"highest_Hz is 0; give a frequency of \d\.?\d* Hz or more",
        ),
        (lambda: bd.plot.spectrum(run, highest_Hz=float("nan")), "highest_Hz is nan"),
        (lambda: bd.plot.envelope_spectrum(run, harmonics=0), "harmonics is 0"),
        (lambda: bd.plot.stiffness_curve(BEARING, end_play_mm=0.1), "two numbers or more"),
    ):
        with pytest.raises(bd.InputError, match=said):
            call()

"""Every kind of operation becomes a load on the 2 kHz grid; bad files are refused in sentences."""

import dataclasses

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_history
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import (
    ConstantOperation,
    Irregularity,
    MeasuredOperation,
    QuarterVehicleOperation,
    Step,
    SteppedOperation,
    Vehicle,
)
from beardyn_core.scene.running import distance_at

HEADER = "time_s,speed_rpm,fx_N,fy_N,fz_N\n"


def _written(folder, text):
    path = folder / "load.csv"
    path.write_text(text)
    return MeasuredOperation(path)


@pytest.mark.parametrize("duration", [0.02, 0.0203, 1.0, 3.3])
def test_grid_starts_at_zero_and_just_covers_the_duration(duration):
    history = load_history(ConstantOperation((1.0, 2.0, 3.0), 4.0, (5.0, 6.0, 7.0)), Mounting(), duration, 0)
    assert history.time_ns[0] == 0
    assert (np.diff(history.time_ns) == 500_000).all()
    assert history.time_ns[-2] < duration * 1e9 - 1e-3 <= history.time_ns[-1]
    assert (history.wrench == [1, 2, 3, 5, 6, 7]).all()
    assert (history.shaft_speed == 4.0).all()


def test_steps_hold_their_levels_and_ramp_along_a_cosine():
    operation = SteppedOperation(
        (
            Step(0.0, (0.0, 0.0, 1e4), 50.0),
            Step(1.0, (0.0, 2e3, 6e4), 100.0),
            Step(2.0, (0.0, 0.0, 3e4), 80.0),
        ),
        ramp=0.5,
    )
    history = load_history(operation, Mounting(), 3.0, 0)
    time = history.time_ns * 1e-9
    assert (history.wrench[time <= 1.0, 2] == 1e4).all()
    assert np.allclose(history.wrench[(time >= 1.5) & (time <= 2.0), 2], 6e4)
    assert np.allclose(history.wrench[time >= 2.5, 1], 0.0)
    assert history.wrench[2500, 2] == pytest.approx(3.5e4)
    assert history.shaft_speed[2500] == pytest.approx(75.0)
    assert np.abs(np.diff(history.wrench[:, 2])).max() <= 5e4 * np.pi / 2 / 0.5 / 2000 * 1.001


def test_overlapping_ramps_are_refused():
    with pytest.raises(InputError, match="ramp"):
        SteppedOperation(tuple(Step(t, (0.0, 0.0, 1e4), 50.0) for t in (0.0, 1.0, 1.1)), ramp=0.5)


def test_distance_is_the_integral_of_the_speed_profile():
    profile = ((-1.0, 0.0), (1.0, 10.0), (3.0, 20.0), (4.0, 0.0))
    time = np.linspace(0.0, 6.0, 60_001)
    speed = np.interp(time, [-1.0, 1.0, 3.0, 4.0], [0.0, 10.0, 20.0, 0.0])
    summed = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))))
    assert np.allclose(distance_at(profile, time), summed, rtol=0, atol=1e-9)


def test_shaft_speed_is_vehicle_speed_over_wheel_radius_and_lateral_force_is_passed_on():
    vehicle = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
    operation = QuarterVehicleOperation(
        vehicle, Irregularity(), ((0.0, 200 / 3.6), (1.0, 220 / 3.6)), 0.92, 5e3
    )
    history = load_history(operation, Mounting(), 2.0, 1)
    assert history.shaft_speed[0] == pytest.approx(200 / 3.6 / 0.46)
    assert history.shaft_speed[-1] == pytest.approx(220 / 3.6 / 0.46)
    assert (history.wrench[:, 1] == 5e3).all()
    assert (history.wrench[:, 3:] == 0.0).all()


def test_rail_model_takes_suspension_and_masses_from_the_mounting():
    vehicle = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
    operation = QuarterVehicleOperation(vehicle, Irregularity(), ((0.0, 55.0),))
    soft = load_history(operation, Mounting(), 2.0, 1)
    stiff = load_history(operation, dataclasses.replace(Mounting(), stiffness=(1e7, 5e6, 6e6)), 2.0, 1)
    heavy = load_history(operation, dataclasses.replace(Mounting(), journal_mass=1500.0), 2.0, 1)
    assert stiff.bogie[:, 2].std() != pytest.approx(soft.bogie[:, 2].std(), rel=0.01)
    assert heavy.wrench[0, 2] == pytest.approx(soft.wrench[0, 2], rel=1e-6)
    assert heavy.wrench[:, 2].std() > 1.1 * soft.wrench[:, 2].std()


def test_csv_is_read_in_any_column_order_with_comments_and_offset_time(tmp_path):
    text = "# a run\nfz_N,fy_N,fx_N,time_s,shaft_speed_rad_s,my_Nm\n10,2,3,100.0,50,7\n20,2,3,101.0,60,7\n"
    history = load_history(_written(tmp_path, text), Mounting(), 1.0, 0)
    assert history.wrench[0] == pytest.approx([3, 2, 10, 0, 7, 0])
    assert history.wrench[1000, 2] == pytest.approx(15.0)
    assert history.shaft_speed[-1] == pytest.approx(60.0)


def test_csv_speed_in_rpm_becomes_rad_per_s(tmp_path):
    history = load_history(_written(tmp_path, HEADER + "0,60,0,0,1\n1,60,0,0,1\n"), Mounting(), 1.0, 0)
    assert np.allclose(history.shaft_speed, 2 * np.pi)


def test_csv_finer_than_the_grid_is_filtered_before_it_is_thinned(tmp_path):
    time = np.arange(20_001) / 10_000
    for frequency, gain in ((100.0, 1.0), (2100.0, 0.0)):  # 2.1 kHz would fold to 100 Hz
        force = 1e4 * np.sin(2 * np.pi * frequency * time)
        rows = "\n".join(f"{t:.4f},600,0,0,{f:.6f}" for t, f in zip(time, force, strict=True))
        history = load_history(_written(tmp_path, HEADER + rows + "\n"), Mounting(), 2.0, 0)
        amplitude = np.sqrt(2) * history.wrench[200:-200, 2].std()
        assert amplitude == pytest.approx(1e4 * gain, abs=20.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["empty", "time_s"]),
        (HEADER, ["no rows"]),
        ("time,speed_rpm,fx_N,fy_N\n0,1,2,3\n", ["unknown column 'time'", "'time_s' is missing", "'fz_N'"]),
        ("time_s,fx_N,fy_N,fz_N\n0,1,2,3\n1,1,2,3\n", ["speed_rpm, shaft_speed_rad_s"]),
        (
            "time_s,speed_rpm,shaft_speed_rad_s,fx_N,fy_N,fz_N\n0,1,2,3,4,5\n1,1,2,3,4,5\n",
            ["both speed_rpm and shaft_speed_rad_s are there", "exactly one"],
        ),
        (
            HEADER + "0,60,0,0,1\n1,60,0,nan,1\n2,inf,0,0,1\n",
            ["line 3: fy_N is nan", "line 4: speed_rpm is inf"],
        ),
        (HEADER + "0,60,0,0,1\n1,fast,0,0,x\n", ["line 3: speed_rpm is 'fast'", "line 3: fz_N is 'x'"]),
        (HEADER + "0,60,0,0,1\n2,60,0,0,1\n1,60,0,0,1\n1,60,0,0,1\n", ["lines 4, 5", "does not increase"]),
        (HEADER + "0,60,0,0,1\n1,60,0,0\n", ["line 3", "not 5 values"]),
        (
            HEADER + "".join(f"{t / 100},60,0,0,1\n" for t in (*range(50), 200, 201)),
            ["line 52", "jumps by 1.51 s", "0.01 s"],
        ),
        (HEADER + "0,60,0,0,1\n0.5,60,0,0,1\n", ["covers 0.5 s", "needs 1 s"]),
    ],
)
def test_bad_csv_is_refused_with_file_line_and_what_is_allowed(tmp_path, text, words):
    operation = _written(tmp_path, text)
    with pytest.raises(InputError) as caught:
        load_history(operation, Mounting(), 1.0, 0)
    for word in ["load.csv", *words]:
        assert word in str(caught.value)


def test_missing_csv_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.csv: no such file"):
        load_history(MeasuredOperation(tmp_path / "none.csv"), Mounting(), 1.0, 0)

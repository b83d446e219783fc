"""Force or speed from a file while the other is modelled; bad files, every mistake at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_history
from beardyn_core.rail.measured import read_measurement, speed_points
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import MeasuredOperation

BOTH = "time_s,speed_rpm,fx_N,fy_N,fz_N\n"


def written(folder: Path, text: str) -> Path:
    path = folder / "run.csv"
    path.write_text(text)
    return path


def test_a_row_of_the_right_units_is_passed_over(tmp_path):
    plain = read_measurement(written(tmp_path, BOTH + "0,60,1,2,3\n1,60,1,2,3\n"))
    (tmp_path / "other").mkdir()
    units = read_measurement(
        written(tmp_path / "other", "# logger\n" + BOTH + "[s],[rpm],N,N,(N)\n0,60,1,2,3\n1,60,1,2,3\n")
    )
    assert np.array_equal(plain.wrench, units.wrench)
    assert np.array_equal(plain.time, units.time)


def test_measured_force_goes_with_a_modelled_speed(tmp_path):
    path = written(tmp_path, "time_s,fx_N,fy_N,fz_N\n0,0,0,5e4\n2,0,1e3,7e4\n")
    operation = MeasuredOperation(path, "force", ((0.0, 10.0), (2.0, 20.0)), 0.8)
    history = load_history(operation, Mounting(), 2.0, 1)
    assert history.wrench[[0, 2000, 4000], 2] == pytest.approx([5e4, 6e4, 7e4])
    assert history.wrench[-1, 1] == pytest.approx(1e3)
    assert history.shaft_speed[[0, 2000, 4000]] == pytest.approx([25.0, 37.5, 50.0])


def test_a_speed_in_the_file_is_not_taken_with_the_force(tmp_path):
    path = written(tmp_path, BOTH + "0,600,0,0,5e4\n2,600,0,0,5e4\n")
    operation = MeasuredOperation(path, "force", ((0.0, 0.0),))
    assert not load_history(operation, Mounting(), 1.0, 1).shaft_speed.any()


def test_measured_speed_goes_with_a_given_force(tmp_path):
    path = written(tmp_path, "time_s,shaft_speed_rad_s\n0,10\n1,30\n")
    operation = MeasuredOperation(path, "speed", force=(0.0, 1e3, 8e4))
    history = load_history(operation, Mounting(), 1.0, 1)
    assert np.allclose(history.wrench, [0, 1e3, 8e4, 0, 0, 0])
    assert history.shaft_speed[[0, 1000, 2000]] == pytest.approx([10.0, 20.0, 30.0])


def test_measured_speed_becomes_a_speed_profile(tmp_path):
    time = np.arange(0, 4.0001, 0.001)
    rng = np.random.default_rng(1)
    speed = 50.0 + 5.0 * time + rng.normal(scale=0.1, size=len(time))
    rows = "\n".join(f"{t:.3f},{w:.6f}" for t, w in zip(time, speed, strict=True))
    profile = np.array(speed_points(written(tmp_path, f"time_s,shaft_speed_rad_s\n{rows}\n"), 0.9))
    assert np.diff(profile[:, 0]).min() > 0.0
    assert 190 <= len(profile) <= 202
    assert profile[:, 1] == pytest.approx(0.45 * (50 + 5 * profile[:, 0]), abs=0.06)
    slow = written(tmp_path, "time_s,speed_rpm\n0,60\n10,120\n")
    assert np.array(speed_points(slow, 1.0)) == pytest.approx(np.array([[0.0, np.pi], [10.0, 2 * np.pi]]))
    fast = written(tmp_path, "time_s,speed_rpm\n0,60\n10,9000\n")
    with pytest.raises(InputError, match=r"reaches 1696 km/h on a wheel of 1000 mm; allowed is up to 400"):
        speed_points(fast, 1.0)


def test_a_file_that_changed_is_read_again(tmp_path):
    import os

    path = written(tmp_path, BOTH + "0,60,0,0,1\n1,60,0,0,1\n")
    assert read_measurement(path).wrench[0, 2] == 1.0
    written(tmp_path, BOTH + "0,60,0,0,2\n1,60,0,0,2\n")
    os.utime(path, ns=(1, 1))
    assert read_measurement(path).wrench[0, 2] == 2.0


@pytest.mark.parametrize(
    ("text", "take", "words"),
    [
        (
            "time_s,fz_kN\n0,1\n1,1\n",
            "force",
            ["column 'fz_kN'; did you mean fz_N?", "'fx_N' is missing"],
        ),
        (BOTH + "s,rpm,N,N,kN\n0,60,0,0,80\n1,60,0,0,80\n", "both", ["line 2", "'kN' for fz_N", "'N'"]),
        (
            BOTH + "s,km/h,N,N,N\n0,60,0,0,80\n1,60,0,0,80\n",
            "both",
            ["'km/h' for speed_rpm", "'rpm'"],
        ),
        (
            "time_s,fx_N,fy_N,fz_N\n0,0,0,1\n1,0,0,1\n",
            "speed",
            ["none of these columns", "speed_rpm"],
        ),
        ("time_s,fx_N,fy_N,fz_N\n0,0,0,1\n1,0,0,1\n", "both", ["give exactly one of speed_rpm"]),
        (
            "time_s,speed_rpm\n0,1\n1,1\n",
            "both",
            ["'fx_N' is missing", "'fz_N' is missing"],
        ),
        (BOTH + "0,60,0,0,1\n", "both", ["only one row"]),
        (BOTH + "0;60;0;0;1\n1;60;0;0;1\n", "both", ["line 2", "not 5 values"]),
        (BOTH + "0,60,0,0,\n1,60,0,0,1\n", "both", ["line 2: fz_N is ''; it must be a number"]),
        ("# nothing\n", "both", ["the file is empty"]),
    ],
)
def test_a_bad_file_is_refused_with_file_line_and_what_is_allowed(tmp_path, text, take, words):
    with pytest.raises(InputError) as caught:
        read_measurement(written(tmp_path, text), take)
    for word in ["run.csv", *words]:
        assert word in str(caught.value)


def test_everything_wrong_with_a_file_is_told_at_once(tmp_path):
    rows = [f"{t / 100},60,0,0,1" for t in range(40)]
    rows[5] = "0.05,60,nan,0,1"
    rows[7] = "0.05,sixty,0,0,1"
    rows[9] = "0.09,60,0,0"
    rows += ["2.0,60,0,0,1", "2.01,60,0,0,inf"]
    text = "time_s,speed_rpm,fx_N,fy_N,fz_N\ns,rpm,N,N,kN\n" + "\n".join(rows) + "\n"
    with pytest.raises(InputError) as caught:
        read_measurement(written(tmp_path, text))
    found = caught.value.problems
    expected = [
        "line 2: the row of units has 'kN' for fz_N",
        "line 12: not 5 values as in the header",
        "line 10: speed_rpm is 'sixty'",
        "line 8: fx_N is nan",
        "line 44: fz_N is inf",
        "line 10: time_s does not increase",
        "line 43: time_s jumps by 1.61 s",
    ]
    for words in expected:
        assert any(words in problem for problem in found), words
    assert len(found) == len(expected)
    assert all(problem.startswith(str(tmp_path)) for problem in found)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"take": "all"}, ["take is 'all'", "both, force, speed"]),
        ({"take": "force"}, ["speed_profile is missing; take is 'force'"]),
        ({"take": "speed"}, ["force_kN is missing; take is 'speed'"]),
        ({"take": "speed", "force": (0.0, 0.0, float("inf"))}, ["force_kN is (0.0, 0.0, inf)", "finite"]),
        (
            {"take": "force", "speed_profile": ((0.0, 1.0), (0.0, 2.0))},
            ["[1].time_s is 0", "greater than the 0"],
        ),
        (
            {"take": "force", "speed_profile": ((0.0, 200.0),)},
            ["[0]: speed_kmh is 720", "at most 400"],
        ),
        ({"wheel_diameter": 2.0}, ["wheel_diameter_mm is 2000", "at most 1500"]),
    ],
)
def test_an_operation_that_cannot_be_is_refused_in_a_sentence(options, words):
    with pytest.raises(InputError) as caught:
        MeasuredOperation(Path("run.csv"), **options)
    (problem,) = caught.value.problems
    for word in words:
        assert word in problem

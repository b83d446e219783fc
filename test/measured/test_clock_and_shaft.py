"""Rates from time stamps, and the angle of the shaft from a constant, a channel and tacho pulses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.measured.clock import Clock
from beardyn_core.measured.shaft import Constant, Measured, Pulses
from test.examples import examples
from test.measured.files import RATE, noise, table

SPEED = 2.0 * np.pi * 30.0


def clocked(time: np.ndarray, *cuts: int) -> Clock:
    clock = Clock(1.0)
    for part in np.split(time, list(cuts)):
        clock.take(part)
    clock.end()
    return clock


@given(
    rate=some.sampled_from([997.0, 12_000.0, 25_600.0, 51_200.0, 97_656.25]),
    digits=some.sampled_from([3, 4, 5, 7, 9]),
    start=some.sampled_from([0.0, 12.5, 86_399.0]),
    cut=some.integers(2, 4999),
)
@settings(max_examples=examples(90), deadline=None)
def test_rounded_stamps_give_the_rate_and_no_complaint(
    rate: float, digits: int, start: float, cut: int
) -> None:
    time = np.round(start + np.arange(40_000) / rate, digits)
    clock = clocked(time, cut + 20_000)
    assert clock.problems("f") == []
    assert clock.rate == pytest.approx(rate, rel=1e-3 + clock.uncertainty)
    assert clock.uncertainty < 1e-3 or digits == 3


@given(at=some.integers(30, 39_000), cut=some.integers(2, 39_999), lost=some.integers(1, 5000))
@settings(max_examples=examples(60), deadline=None)
def test_a_lost_sample_anywhere_is_found(at: int, cut: int, lost: int) -> None:
    number = np.arange(40_000)
    time = (number + lost * (number >= at)) / 12_000.0
    (problem,) = clocked(time, cut).problems("f")
    assert f"at sample {at + 1}" in problem


@given(at=some.integers(2, 39_998), cut=some.integers(2, 39_999))
@settings(max_examples=examples(60), deadline=None)
def test_time_that_goes_back_or_stands_still_is_found_anywhere(at: int, cut: int) -> None:
    time = np.arange(40_000) / 12_000.0
    time[at] = time[at - 1]
    assert f"stands still at sample {at + 1}" in clocked(time, cut).problems("f")[0]
    time[at] = time[at - 1] - 1e-5
    assert f"goes back at sample {at + 1}" in clocked(time, cut).problems("f")[0]


def test_stamps_that_jitter_give_their_mean_rate() -> None:
    draw = np.random.default_rng(2)
    time = np.arange(30_000) / 1000.0 + draw.uniform(0.0, 4e-4, 30_000)
    clock = clocked(time, 9999)
    assert clock.problems("f") == []
    assert clock.rate == pytest.approx(1000.0, rel=1e-4)


def test_a_constant_speed_has_points_at_the_end_of_every_part() -> None:
    shaft = Constant(SPEED)
    parts = [shaft.until(k * 20_000_000, (k + 1) * 20_000_000) for k in range(50)]
    time = np.concatenate([part.time_ns for part in parts])
    assert time[0] == 0
    assert time[-1] == 1_000_000_000
    assert (np.diff(time) > 0).all()
    angle = np.concatenate([part.angle for part in parts])
    np.testing.assert_allclose(angle, SPEED * 1e-9 * time, atol=1e-6)
    assert np.diff(angle).max() <= np.pi / 2 + 1e-9


@given(rate=some.sampled_from([10.0, 50.0, 1000.0, 12_000.0]), cuts=some.integers(1, 9))
@settings(max_examples=examples(30), deadline=None)
def test_a_linear_speed_is_integrated_exactly_in_parts_of_any_size(rate: float, cuts: int) -> None:
    time = np.round(np.arange(0.0, 4.0, 1.0 / rate) * 1e9).astype(np.int64)
    speed = 50.0 + 30.0e-9 * time
    shaft = Measured(170.0)
    parts = [
        shaft.take(t, v) for t, v in zip(np.array_split(time, cuts), np.array_split(speed, cuts), strict=True)
    ]
    grid = np.concatenate([part.time_ns for part in parts]) * 1e-9
    angle = np.concatenate([part.angle for part in parts])
    np.testing.assert_allclose(angle, 50.0 * grid + 15.0 * grid**2, atol=1e-4)
    np.testing.assert_allclose(np.concatenate([part.speed for part in parts]), 50.0 + 30.0 * grid, atol=1e-6)
    assert np.diff(angle).max() < np.pi / 2


@given(
    per_turn=some.sampled_from([1, 6, 60]), hertz=some.floats(3.0, 80.0), duty=some.floats(0.1, 0.9),
    cuts=some.integers(1, 40), upside_down=some.booleans(),
)  # fmt: skip
@settings(max_examples=examples(60), deadline=None)
def test_pulses_give_the_angle_whatever_their_width_and_the_blocks(
    per_turn: int, hertz: float, duty: float, cuts: int, upside_down: bool
) -> None:
    rate = 24_000.0
    assume(min(duty, 1.0 - duty) * rate > 4.0 * hertz * per_turn)  # both halves of a pulse are sampled
    time = np.arange(30_000) / rate
    turns = hertz * time + 0.3 + 0.05 * np.sin(2.0 * np.pi * 0.7 * time)
    phase = (turns * per_turn) % 1.0
    volts = np.where(phase < duty, 5.0, 0.0) + np.random.default_rng(1).normal(0.0, 0.05, len(time))
    volts = 5.0 - volts if upside_down else volts
    shaft = Pulses(float(volts.min()), float(volts.max()), None, per_turn)
    stamps = np.round(time * 1e9).astype(np.int64)
    parts = [
        shaft.take(t, v)
        for t, v in zip(np.array_split(stamps, cuts), np.array_split(volts, cuts), strict=True)
    ]
    grid = np.concatenate([part.time_ns for part in parts]) * 1e-9
    angle = np.concatenate([part.angle for part in parts])
    expected = 2.0 * np.pi * np.interp(grid, time, turns)
    error = angle - expected - (angle - expected).mean()
    # a sample of the tacho, and the bend of the angle between two pulses
    assert np.abs(error).max() < 2.0 * np.pi * (1.5 * hertz / rate + 0.13 / (hertz * per_turn) ** 2 + 1e-3)
    assert (np.diff(grid) > 0).all()
    assert np.diff(angle).max() < np.pi
    assert shaft.irregular == 0


def test_a_second_accelerometer_turns_no_shaft_back() -> None:
    shaft = Constant(SPEED)
    first = shaft.until(0, 50_000_000)
    assert not len(shaft.until(0, 40_000_000).time_ns)
    after = shaft.until(50_000_000, 100_000_000)
    time = np.concatenate((first.time_ns, after.time_ns))
    assert np.all(np.diff(time) > 0)
    np.testing.assert_allclose(np.concatenate((first.angle, after.angle)), SPEED * 1e-9 * time)


def test_gaps_between_files_are_not_in_the_rate(tmp_path: Path) -> None:
    files = [table(tmp_path / f"{k}.csv", {"az_g": noise(2560)[:, 0]}) for k in range(3)]
    run = bd.read_measured(files, rate_Hz=25_600.0, file_interval_s=10.0)
    assert run.vibration.rate == 25_600.0


def test_missing_and_doubled_pulses_are_told(tmp_path: Path) -> None:
    time = np.arange(48_000) / RATE
    volts = np.where((30.0 * time) % 1.0 < 0.2, 5.0, 0.0)
    volts[(time > 1.0) & (time < 1.04)] = 0.0
    path = table(tmp_path / "a.csv", {"time_s": time, "az_g": noise(48_000)[:, 0], "tacho": volts})
    with pytest.warns(UserWarning, match=r"of 1\d\d intervals between tacho pulses differ by more than 60 %"):
        run = bd.read_measured(path, channels="z=az_g", tacho_channel="tacho")
    assert run.shaft.speed.mean() == pytest.approx(2.0 * np.pi * 30.0, rel=0.02)
    (told,) = run.measured["warnings"]
    assert "check --tacho-level" in told


def test_a_speed_channel_of_a_vehicle_turns_the_wheel(tmp_path: Path) -> None:
    time = np.arange(24_000) / RATE
    speed = 80.0 + 10.0 * time
    path = table(tmp_path / "a.csv", {"time_s": time, "az_g": noise(24_000)[:, 0], "v [km/h]": speed})
    run = bd.read_measured(path, channels="z=az_g", speed_channel="v", wheel_diameter_mm=920.0)
    expected = np.interp(run.shaft.time, time, speed) / 3.6 / 0.46
    np.testing.assert_allclose(run.shaft.speed, expected, rtol=1e-6)
    constant = bd.read_measured(path, channels="z=az_g", speed_kmh=80.0, wheel_diameter_mm=920.0)
    np.testing.assert_allclose(constant.shaft.speed, 80.0 / 3.6 / 0.46)


def test_a_number_in_the_file_may_be_the_speed(tmp_path: Path) -> None:
    from scipy.io import savemat

    savemat(tmp_path / "a.mat", {"X097_DE_time": noise(), "X097RPM": 1796.0})
    options: dict[str, Any] = {"unit": "g", "rate_Hz": 12_000}
    run = bd.read_measured(tmp_path / "a.mat", speed_channel="*RPM", **options)
    np.testing.assert_allclose(run.shaft.speed, 1796.0 * np.pi / 30.0)
    without = bd.read_measured(tmp_path / "a.mat", **options)
    assert len(without.shaft) == 0
    assert any("--speed-channel X097RPM takes it" in each for each in without.measured["understood"])


def test_a_slow_speed_channel_beside_fast_vibration_is_merged_in_time(tmp_path: Path) -> None:
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        fast = {"wf_increment": 1.0 / RATE, "unit_string": "g"}
        slow = {"wf_increment": 0.1, "unit_string": "rpm"}
        writer.write_segment(
            [
                ChannelObject("fast", "az", noise(24_000)[:, 0], properties=fast),
                ChannelObject("slow", "speed", np.linspace(600.0, 1200.0, 21), properties=slow),
            ]
        )
    run = bd.read_measured(tmp_path / "a.tdms", channels="z=az", speed_channel="speed")
    np.testing.assert_allclose(run.shaft.speed, (600.0 + 300.0 * run.shaft.time) * np.pi / 30.0, rtol=1e-9)
    recording = bd.import_measured(
        tmp_path / "a.tdms", tmp_path / "run.mcap", channels="z=az", speed_channel="speed"
    )
    np.testing.assert_array_equal(bd.read(recording).shaft.angle, run.shaft.angle)


@pytest.mark.parametrize("rate", [12_000.0, 25_600.0, 51_200.0])
def test_stamps_of_seven_digits_have_one_rate_beyond_ten_seconds(rate: float) -> None:
    """Written with %.7g, stamps have steps of 1 us below 10 s and of 10 us beyond."""
    stamps = np.array([float(f"{each:.7g}") for each in np.arange(int(14.0 * rate)) / rate])
    clock = Clock(1.0)
    for part in np.array_split(stamps, 7):
        clock.take(part)
    clock.end()
    assert clock.problems("here") == []
    assert clock.rate == pytest.approx(rate, rel=1e-5)

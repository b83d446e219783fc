"""Welds, crossings and out-of-round wheels: geometry, what the load makes of them, mistakes in a sentence."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_history
from beardyn_core.rail.excitation import rail_height, waves_of, wheel_height
from beardyn_core.rail.patch import wave_gain
from beardyn_core.rail.vehicle import quarter_vehicle
from beardyn_core.scene.excitation import (
    Corrugation,
    Crossing,
    DippedJoint,
    DippedWeld,
    WheelOutOfRound,
    WheelPolygon,
)
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Vehicle
from test.analytic.rail_rides import ride_of

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
SMOOTH = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 120 / 3.6),))
RADIUS = 0.5 * SMOOTH.wheel_diameter


def test_a_weld_is_a_long_hollow_with_a_short_one_in_it():
    weld = DippedWeld(10.0, 0.4e-3, 1.0, 0.1e-3, 0.1, 36.0)
    x = np.array([9.5, 9.75, 9.95, 10.0, 10.05, 10.25, 10.5])
    long = 0.2e-3 * (1 + np.cos(2 * np.pi * (x - 10.0)))
    expected = -long - np.where(np.abs(x - 10) < 0.05, 0.1e-3 * np.cos(10 * np.pi * (x - 10.0)) ** 2, 0.0)
    assert rail_height((weld,), x) == pytest.approx(expected, abs=1e-12)
    assert rail_height((weld,), x + 36.0) == pytest.approx(expected, abs=1e-12)
    assert not rail_height((weld,), x - 36.0).any()  # the rail before the first is sound
    single = dataclasses.replace(weld, spacing=None)
    assert not rail_height((single,), x + 36.0).any()


def test_a_crossing_is_a_v_of_its_depth_lengths_and_angle():
    crossing = Crossing(20.0, 2e-3, 0.4, 0.2)
    x = np.array([19.5, 19.6, 19.8, 20.0, 20.1, 20.2, 20.5])
    assert 1e3 * rail_height((crossing,), x) == pytest.approx([0, 0, -1, -2, -1, 0, 0], abs=1e-9)
    step = 1e-6
    before, after = (rail_height((crossing,), np.array([a, a + step])) for a in (20.0 - step, 20.0))
    turned = (np.diff(after) - np.diff(before)) / step
    assert turned[0] == pytest.approx(crossing.angle, rel=1e-6)
    assert crossing.angle == pytest.approx(15e-3)


def test_the_strike_of_a_crossing_grows_with_angle_and_speed():
    def peak(depth: float, speed_kmh: float) -> float:
        operation = dataclasses.replace(
            SMOOTH, speed_profile=((0.0, speed_kmh / 3.6),), rail_defects=(Crossing(10.0, depth),)
        )
        response, _ = ride_of(operation, Mounting(), 36.0 / speed_kmh + 0.5, seed=1)
        return float(response.contact_force.max() - quarter_vehicle(operation, Mounting()).static_force)

    shallow, deep, fast = peak(1e-3, 40.0), peak(3e-3, 40.0), peak(1e-3, 80.0)
    assert shallow > 10e3  # a seventh of the static force at 40 km/h
    assert deep > 1.5 * shallow
    assert fast > 1.3 * shallow


def test_a_long_weld_and_a_crossing_as_long_as_a_joint_strike_alike():
    # the same change of slope at the same place: the first millisecond is the same
    joint, crossing = DippedJoint(10.0, 10e-3, 2.0), Crossing(10.0, 5e-3, 1.0, 1.0)
    peaks = []
    for defect in (joint, crossing):
        operation = dataclasses.replace(SMOOTH, rail_defects=(defect,))
        response, step = ride_of(operation, Mounting(), 0.4, seed=1)
        near = slice(int(0.299 / step), int(0.302 / step))
        peaks.append(response.contact_force[near].max())
    assert peaks[0] == pytest.approx(peaks[1], rel=0.1)


def test_an_out_of_round_wheel_is_the_sum_of_its_waves():
    amplitudes = (200e-6, 50e-6, 80e-6, 0.0, 10e-6)
    wheel = WheelOutOfRound(amplitudes, 3)
    position = np.arange(4096) / 4096 * 2 * np.pi * RADIUS
    height = wheel_height((wheel,), RADIUS, position)
    orders = 2 * np.abs(np.fft.rfft(height)) / 4096
    assert orders[1:6] == pytest.approx(amplitudes, abs=1e-12)
    assert orders[6:].max() < 1e-12
    waves = waves_of(wheel)
    assert [wave.order for wave in waves] == [1, 2, 3, 4, 5]
    assert np.allclose(wheel_height(waves, RADIUS, position), height)
    assert waves_of(WheelOutOfRound(amplitudes, 3)) == waves
    assert waves_of(WheelOutOfRound(amplitudes, 4)) != waves


def test_the_load_has_the_lines_of_an_out_of_round_wheel():
    operation = dataclasses.replace(SMOOTH, wheel_defects=(WheelOutOfRound((0.0, 0.0, 60e-6, 0.0, 20e-6)),))
    history = load_history(operation, Mounting(), 6.0, seed=1)
    force = history.wrench[10_000:60_000, 2]
    amplitude = np.abs(np.fft.rfft((force - force.mean()) * np.hanning(len(force))))
    line = np.fft.rfftfreq(len(force), 1e-4) * 2 * np.pi * RADIUS / (120 / 3.6)
    found = [line[np.argmax(np.where(np.abs(line - order) < 0.5, amplitude, 0.0))] for order in (3, 5)]
    assert found == pytest.approx([3.0, 5.0], abs=0.03)
    between = amplitude[(line > 3.4) & (line < 4.6)].max()
    assert min(amplitude[np.argmin(np.abs(line - order))] for order in (3, 5)) > 50 * between


def test_the_contact_patch_takes_from_short_waves_and_leaves_long_ones():
    x = np.linspace(0.0, 3.0, 30_001)
    for wavelength in (0.03, 0.3):
        gain = wave_gain(2 * np.pi / wavelength, 0.012)
        rail = Corrugation(wavelength, 1e-5)
        assert rail_height((rail,), x, 0.012) == pytest.approx(gain * rail_height((rail,), x), abs=1e-15)
    wheel = WheelPolygon(40, 1e-5)
    gain = wave_gain(40 / RADIUS, 0.012)
    assert gain < 0.98
    smoothed = wheel_height((wheel,), RADIUS, x, 0.012)
    assert smoothed == pytest.approx(gain * wheel_height((wheel,), RADIUS, x), abs=1e-15)
    # and the load is that of the smoothed wave
    forces = []
    for amplitude, patch in ((1e-5, 0.012), (gain * 1e-5, 0.0)):
        operation = dataclasses.replace(
            SMOOTH, wheel_defects=(WheelPolygon(40, amplitude),), contact_patch=patch
        )
        forces.append(ride_of(operation, Mounting(), 0.5, seed=1)[0].contact_force)
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)


def test_short_waves_reach_the_load_at_ten_kilohertz():
    rough = dataclasses.replace(SMOOTH, irregularity=Irregularity("none", short_waves="iso_3095"))
    history = load_history(rough, Mounting(), 1.0, seed=1)
    assert (np.diff(history.time_ns) == 100_000).all()
    force = history.wrench[3000:, 2]
    power = np.abs(np.fft.rfft(force - force.mean())) ** 2
    frequency = np.fft.rfftfreq(len(force), 1e-4)
    # waves longer than two metres are missing: nothing below 33 m/s over 2 m
    assert power[frequency < 13.0].sum() < 0.02 * power.sum()
    assert 100.0 < force.std() < 20e3


def test_a_run_that_turns_back_meets_the_same_rail_again():
    there_and_back = dataclasses.replace(
        SMOOTH,
        irregularity=Irregularity("german_low"),
        speed_profile=((0.0, 5.0), (1.0, 5.0), (3.0, -5.0)),
        rail_defects=(Crossing(7.0, 2e-3),),
    )
    history = load_history(there_and_back, Mounting(), 4.0, seed=1)
    force = history.wrench[:, 2]
    assert np.isfinite(force).all()
    assert history.shaft_speed[-1] == pytest.approx(-5.0 / RADIUS)
    time, apart = history.time_ns * 1e-9, np.abs(force - np.median(force))
    there, back = (np.flatnonzero((time > low) & (time < low + 1.5)) for low in (0.5, 2.0))
    # 7 m are passed at 1.5528 s; the way is even about 2 s
    assert time[there[np.argmax(apart[there])]] == pytest.approx(1.5528, abs=0.08)
    assert time[back[np.argmax(apart[back])]] == pytest.approx(4.0 - 1.5528, abs=0.08)
    assert apart[there].max() > 5 * apart[(time > 0.3) & (time < 1.4)].std()


@pytest.mark.parametrize(
    ("defects", "words"),
    [
        ({"rail_defects": (DippedWeld(1.0, 6e-3),)}, ["rail_defects[0]: depth_mm is 6", "at most 5"]),
        (
            {"rail_defects": (DippedWeld(1.0, 1e-3, spacing=0.5),)},
            ["spacing_m is 0.5", "at least length_m"],
        ),
        ({"rail_defects": (DippedWeld(1.0, 1e-3, short_length=2.0),)}, ["short_length_m is 2"]),
        ({"rail_defects": (DippedWeld(float("nan"), 1e-3),)}, ["position_m is nan"]),
        ({"rail_defects": (Crossing(1.0, 0.009, 0.1, 0.1),)}, ["turns by 180 mrad", "shallower or longer"]),
        (
            {"rail_defects": (Crossing(1.0, 0.02, 3.0, 3.0),)},
            ["[0]: depth_mm is 20", "at most 10"],
        ),
        ({"wheel_defects": (WheelOutOfRound(()),)}, ["amplitudes_um is empty", "at least 1"]),
        ({"wheel_defects": (WheelOutOfRound((1e-4, -1.0)),)}, ["amplitudes_um[1] is -1e+06"]),
        (
            {"wheel_defects": (WheelOutOfRound((0.0,) * 80),), "wheel_diameter": 0.4},
            ["80 orders", "at most 62 waves"],
        ),
        ({"contact_patch": 0.1}, ["contact_patch_mm is 100"]),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(defects, words):
    with pytest.raises(InputError) as caught:
        dataclasses.replace(SMOOTH, **defects)
    (problem,) = caught.value.problems
    for word in words:
        assert word in problem

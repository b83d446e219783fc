"""Curves, braking, starting, timetables and reversing against closed forms."""

from __future__ import annotations

import dataclasses
from itertools import pairwise

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_vehicle
from beardyn_core.rail.build import load_history
from beardyn_core.rail.vehicle import GRAVITY, quarter_vehicle
from beardyn_core.rail.wheelset import HALF_GAUGE
from beardyn_core.scene.excitation import WheelFlat
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Vehicle
from beardyn_core.scene.running import Braking, Curve, Starting, Stop, Timetable, distance_at, speed_at
from test.analytic.rail_rides import ride_of

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
SMOOTH = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 30.0),))
MOUNTING = Mounting()
RADIUS = 0.46
WEIGHT = (47.8e3 / 8 + 3.5e3 / 4 + 100.0) * GRAVITY
CURVE = Curve(600.0, 0.06, 30.0, 500.0, 60.0)


def on_curve(curve, speed, **changes):
    """Mean load on the arc, where all has settled."""
    operation = dataclasses.replace(SMOOTH, curves=(curve,), speed_profile=((0.0, speed),), **changes)
    end = (curve.end - curve.transition) / speed
    history = load_history(operation, MOUNTING, end, 1)
    return history, history.wrench[history.time_ns > (end - 3.0) * 1e9].mean(axis=0)


def unbalanced(curve, speed):
    """Lateral acceleration outwards and what presses onto the track beyond gravity."""
    sine = curve.cant / 1.5
    cosine = np.sqrt(1 - sine**2)
    square = speed**2 / curve.radius
    return square * cosine - GRAVITY * sine, square * sine + GRAVITY * (cosine - 1.0)


@pytest.mark.parametrize("hand", ["left", "right"])
@pytest.mark.parametrize(("speed", "cant"), [(30.0, 0.06), (30.0, 0.15), (15.0, 0.15)])
def test_quasi_static_load_on_a_curve(hand, speed, cant):
    """Cant deficiency and excess, outer and inner axlebox: F = m a_q, dF = a_q sum m (h - r) / (2 b)."""
    curve = dataclasses.replace(CURVE, hand=hand, cant=cant)
    _, load = on_curve(curve, speed)
    outwards, pressing = unbalanced(curve, speed)
    outer = -1.0 if hand == "left" else 1.0  # +y is left: outside in a right-hand curve
    body, frame = 47.8e3 / 8, 3.5e3 / 4
    # rails push the axle inwards: all but the half wheelset goes through the bearing
    assert load[1] == pytest.approx(-outer * (body + frame + 100.0) * outwards, rel=0.01, abs=10.0)
    lever = body * (1.7 - RADIUS) + frame * (0.6 - RADIUS)
    transfer = outer * outwards * lever / 1.0
    pressed = (body + frame + 100.0) * pressing
    assert load[2] == pytest.approx(WEIGHT + transfer + pressed, rel=2e-3)


def test_wheel_loads_carry_the_whole_moment_about_the_rails():
    """dQ = a_q M h / (2 b0) with all masses: the closed form of EN 14363's quasi-static wheel load."""
    curve = dataclasses.replace(CURVE, hand="right")
    operation = dataclasses.replace(SMOOTH, curves=(curve,))
    response, step = ride_of(operation, MOUNTING, 15.0, 1)
    outwards, pressing = unbalanced(curve, 30.0)
    shares = {1.7: 47.8e3 / 8, 0.6: 3.5e3 / 4, RADIUS: 1000.0}
    moment = sum(mass * height for height, mass in shares.items())
    expected = sum(shares.values()) * (GRAVITY + pressing) + outwards * moment / HALF_GAUGE
    assert response.contact_force[-round(3.0 / step) :].mean() == pytest.approx(expected, rel=2e-3)


def test_at_the_balanced_speed_a_curve_pushes_nowhere():
    balanced = np.sqrt(GRAVITY * np.tan(np.arcsin(0.06 / 1.5)) * 600.0)
    _, load = on_curve(CURVE, balanced)
    # conicity steers the wheelset outwards all the same; no net force is left
    assert abs(load[1]) < 20.0
    assert load[2] == pytest.approx(WEIGHT / np.sqrt(1 - (0.06 / 1.5) ** 2), rel=1e-3)


def test_the_load_rises_over_the_transition():
    """Nothing before the curve, half in the middle of the transition, all on the arc."""
    history, load = on_curve(CURVE, 20.0)
    time = history.time_ns * 1e-9
    assert np.abs(history.wrench[time < 1.4, 1]).max() < 0.01 * abs(load[1])
    middle = np.abs(time - (30.0 + 30.0) / 20.0) < 0.3
    assert history.wrench[middle, 1].mean() == pytest.approx(0.5 * load[1], rel=0.15)


def test_left_and_right_curves_mirror_each_other():
    left, _ = on_curve(CURVE, 30.0)
    right, _ = on_curve(dataclasses.replace(CURVE, hand="right"), 30.0)
    assert np.allclose(left.wrench[:, :2], -right.wrench[:, :2], atol=1.0)
    assert np.allclose(left.bogie[:, 1], -right.bogie[:, 1], atol=1e-7)


def test_without_anything_to_run_on_sideways_nothing_moves_sideways():
    history = load_history(dataclasses.replace(SMOOTH, lateral=True), MOUNTING, 1.0, 1)
    assert (history.wrench[:, [0, 1, 3, 4, 5]] == 0.0).all()
    assert np.allclose(history.wrench[:, 2], WEIGHT, rtol=1e-9)
    assert (history.bogie[:, :2] == 0.0).all()


def test_alignment_moves_the_bogie_less_than_the_axle_and_starts_without_a_jerk():
    operation = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_high"), lateral=True)
    history = load_history(operation, MOUNTING, 6.0, 3)
    lateral = history.wrench[:, 1]
    assert np.abs(lateral[:20]).max() < 0.01 * np.abs(lateral).max()
    assert 100.0 < lateral.std() < 5e3
    again = load_history(operation, MOUNTING, 6.0, 3)
    assert np.array_equal(history.wrench, again.wrench)


BRAKED = dataclasses.replace(SMOOTH, speed_profile=((0.0, 30.0), (2.0, 30.0), (12.0, 20.0)))
SHARE = 47.8e3 / 8 + 3.5e3 / 4 + 1000.0  # of the vehicle's mass on one axlebox


@pytest.mark.parametrize(
    ("braking", "forwards", "upwards"),
    [
        (None, 900.0, 0.0),
        (Braking("clasp"), 900.0 - SHARE, 0.0),
        (Braking("disc", 0.5), 900.0 - 0.5 * SHARE, 0.5 * SHARE * RADIUS / 0.25),
        (Braking("disc", ahead=False), 900.0 - SHARE, -SHARE * RADIUS / 0.25),
        (Braking("block"), 900.0 - SHARE - SHARE / 0.25, SHARE),
    ],
)
def test_braking_at_1_m_s2_pushes_the_journal_back_and_the_brake_holds_it(braking, forwards, upwards):
    """The rail brakes the wheel, inertia of the half wheelset pushes it on; blocks push and lift it."""
    history = load_history(dataclasses.replace(BRAKED, braking=braking), MOUNTING, 11.0, 1)
    late = history.time_ns > 8e9
    assert history.wrench[late, 0].mean() == pytest.approx(forwards, rel=1e-3)
    assert history.wrench[late, 2].mean() == pytest.approx(WEIGHT + upwards, rel=1e-3)
    before = history.time_ns < 1.4e9
    assert np.abs(history.wrench[before, 0]).max() < 1e-6
    # brakes build up within a second, without a jump
    assert np.abs(np.diff(history.wrench[:, 0])).max() < 1.1 * abs(forwards) / 2000


def test_starting_pulls_the_journal_forwards():
    started = dataclasses.replace(
        SMOOTH, speed_profile=((0.0, 0.0), (2.0, 0.0), (22.0, 10.0)), starting=Starting(2.0)
    )
    history = load_history(started, MOUNTING, 15.0, 1)
    late = history.time_ns > 10e9
    assert history.wrench[late, 0].mean() == pytest.approx(0.5 * (2.0 * SHARE - 900.0), rel=1e-3)
    assert np.allclose(history.wrench[:, 2], WEIGHT, rtol=1e-6)


def test_a_timetable_keeps_its_distances_and_limits():
    table = Timetable((Stop(1200.0, 10.0, 25.0), Stop(100.0, 5.0, 40.0)), 0.5, 0.8, 2.0)
    profile = table.speed_profile()
    stops = [time for (time, one), (_, two) in pairwise(profile) if one == two == 0.0]
    assert distance_at(profile, np.array(stops)) == pytest.approx([0.0, 1200.0, 1300.0])
    time = np.linspace(0.0, profile[-1][0], 200_001)
    speed = speed_at(profile, time)
    assert speed.max() == pytest.approx(25.0)
    slope = np.diff(speed) / np.diff(time)
    assert slope.max() == pytest.approx(0.5, rel=1e-6)
    assert slope.min() == pytest.approx(-0.8, rel=1e-6)
    # the way to the second stop is too short for its top speed
    last = time > stops[1] + 1.0
    assert speed[last].max() == pytest.approx(np.sqrt(100.0 / (0.5 / 0.5 + 0.5 / 0.8)), rel=1e-3)


def test_a_train_stops_and_runs_back():
    """Speed through zero: the wheel turns back and every flat comes in the reverse order."""
    turning = dataclasses.replace(
        SMOOTH,
        irregularity=Irregularity("german_low"),
        speed_profile=((0.0, 10.0), (1.0, 10.0), (5.0, -10.0)),
        wheel_defects=(WheelFlat(0.04),),
        lateral=True,
        braking=Braking(),
        starting=Starting(),
    )
    history = load_history(turning, MOUNTING, 7.0, 2)
    assert np.isfinite(history.wrench).all()
    assert history.shaft_speed[0] == pytest.approx(10.0 / RADIUS)
    assert history.shaft_speed[-1] == pytest.approx(-10.0 / RADIUS)
    time = history.time_ns * 1e-9
    force = np.convolve(history.wrench[:, 0], np.ones(5000) / 5000, mode="same")
    # 5 m/s^2 backwards: at first it brakes, then it drives, the rail pushes the same way
    for moment in (2.0, 4.3):
        assert force[np.searchsorted(time, moment)] == pytest.approx(-5.0 * (SHARE - 900.0), rel=0.1)


def test_an_empty_freight_wagon_is_light_and_a_laden_one_heavy():
    """20 t and 22.5 t an axle: 18 and 104 kN on the journal, with the mounting of a freight axle."""
    mounting = dataclasses.replace(Mounting(), journal_mass=620.0, box_mass=80.0)
    empty = dataclasses.replace(SMOOTH, vehicle=load_vehicle("freight_y25"))
    for operation, axle_load in ((empty, 5.0e3), (dataclasses.replace(empty, payload=70e3), 22.5e3)):
        vehicle = quarter_vehicle(operation, mounting)
        assert vehicle.static_force == pytest.approx(0.5 * axle_load * GRAVITY, rel=0.01)
        history = load_history(operation, mounting, 0.5, 1)
        assert np.allclose(history.wrench[:, 2], vehicle.static_force - 620.0 * GRAVITY, rtol=1e-9)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"curves": (CURVE,), "lateral": False}, ["lateral is false", "a curve needs"]),
        ({"curves": (CURVE, CURVE)}, ["curve[1].begin_m is 30", "at least 530"]),
        ({"payload": -1.0}, ["payload_t is -0.001", "at least 0"]),
        ({"speed_profile": ((0.0, -120.0),)}, ["speed_kmh is -432", "-400"]),
    ],
)
def test_what_cannot_be_run_is_refused(changes, words):
    with pytest.raises(InputError) as caught:
        dataclasses.replace(SMOOTH, **changes)
    for word in words:
        assert word in str(caught.value)


def test_every_mistake_of_the_running_parts_is_named_at_once():
    with pytest.raises(InputError) as caught:
        Curve(10.0, 1.0, -1.0, 3.0, 2.0, "middle")
    assert len(caught.value.problems) == 5
    with pytest.raises(InputError) as caught:
        Braking("drum", -1.0, 0.9, 1.0)
    assert len(caught.value.problems) == 4
    with pytest.raises(InputError, match="stops is empty"):
        Timetable(())

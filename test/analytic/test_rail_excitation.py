"""Flats and polygons of the wheel, dips and corrugation of the rail: geometry, repetition, contact loss."""

import dataclasses

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_history
from beardyn_core.rail.excitation import rail_height, wheel_height
from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.rail.vehicle import BOX, WHEEL, quarter_vehicle, ride
from beardyn_core.scene.excitation import Corrugation, DippedJoint, WheelFlat, WheelPolygon
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Vehicle
from beardyn_core.scene.running import distance_at
from test.analytic.rail_rides import ride_of
from test.examples import fast_ones

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
# contact in a point, as in the heights that are computed here
SMOOTH = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 120 / 3.6),), contact_patch=0.0)
RADIUS = 0.5 * SMOOTH.wheel_diameter
CIRCUMFERENCE = 2 * np.pi * RADIUS
FLAT = WheelFlat(0.035)
SETTLED = 0.3  # the excitation fades in over 0.2 s


def with_flat(speed_kmh, flat=FLAT):
    return dataclasses.replace(SMOOTH, speed_profile=((0.0, speed_kmh / 3.6),), wheel_defects=(flat,))


def landings(force, static_force, step, quiet=0.01):
    """Times at which the force first exceeds 1.5 times the static one after a quiet while."""
    high = np.flatnonzero(force > 1.5 * static_force) * step
    first = np.concatenate(([True], np.diff(high) > quiet))
    return high[first]


def test_a_fresh_flat_sinks_along_an_arc_and_meets_in_a_kink():
    flat = WheelFlat(0.04, azimuth=np.pi)
    x = np.linspace(-0.03, 0.03, 6001)
    height = wheel_height((flat,), RADIUS, x)
    # rolling about the sharp end, the centre sinks along a circle of the wheel's radius
    turning = (x > -0.02) & (x < 0.0)
    sunk = RADIUS * (1.0 - np.cos((x[turning] + 0.02) / RADIUS))
    assert np.allclose(-height[turning], sunk, rtol=2e-4, atol=1e-12)
    assert (height[np.abs(x) > 0.02] == 0.0).all()
    assert np.allclose(height, height[::-1], rtol=0, atol=1e-15)
    # the jump of the slope in the middle is L / R: at the speed v the centre turns round by v L / R
    slope = np.diff(height) / np.diff(x)
    assert slope[3000] - slope[2999] == pytest.approx(0.04 / RADIUS, rel=2e-3)


def test_a_rounded_flat_is_a_haversine_without_kinks():
    flat = WheelFlat(0.04, shape="rounded", azimuth=np.pi)
    x = np.linspace(-0.03, 0.03, 6001)
    height = wheel_height((flat,), RADIUS, x)
    depth = 0.04**2 / (16 * RADIUS)
    within = np.abs(x) <= 0.02
    assert np.allclose(height[within], -0.5 * depth * (1 + np.cos(2 * np.pi * x[within] / 0.04)), atol=1e-12)
    assert height.min() == pytest.approx(-depth, rel=1e-9)
    assert np.abs(np.diff(height, 2)).max() < 1.01 * 0.5 * depth * (2 * np.pi / 0.04) ** 2 * 1e-5**2


@pytest.mark.parametrize("shape", ["fresh", "rounded"])
def test_a_given_depth_is_the_depth(shape):
    length = 0.05
    depth = 0.9 * length**2 / (8 * RADIUS) if shape == "rounded" else length**2 / (8 * RADIUS) * 1.03
    height = wheel_height((WheelFlat(length, depth, shape, np.pi),), RADIUS, np.zeros(1))
    assert height[0] == pytest.approx(-depth, rel=1e-12)


@pytest.mark.parametrize("azimuth_deg", [0.0, 90.0, 180.0, 270.0, -90.0])
def test_a_spot_comes_down_to_the_rail_from_where_it_is_at_the_start(azimuth_deg):
    position = np.arange(0.0, 3 * CIRCUMFERENCE, 1e-4)
    height = wheel_height((WheelFlat(0.03, azimuth=np.radians(azimuth_deg)),), RADIUS, position)
    lowest = position[np.isclose(height, height.min(), rtol=2e-2)]
    turned = (180.0 - azimuth_deg) % 360.0 / 360.0
    assert np.allclose(np.abs((lowest / CIRCUMFERENCE - turned + 0.5) % 1.0 - 0.5), 0.0, atol=2e-4)
    assert (height < 0).sum() == pytest.approx(3 * 0.03 / 1e-4, abs=4 + (azimuth_deg == 180.0) * 4)


def test_a_crest_of_a_polygon_lifts_where_it_is():
    polygon = WheelPolygon(20, 30e-6, azimuth=np.radians(35.0))
    on_rail = (np.pi - polygon.azimuth) * RADIUS
    assert wheel_height((polygon,), RADIUS, np.array([on_rail]))[0] == pytest.approx(30e-6)
    position = np.arange(4000) * CIRCUMFERENCE / 2000
    lines = np.abs(np.fft.rfft(wheel_height((polygon,), RADIUS, position))) / 2000
    assert lines[40] == pytest.approx(30e-6)
    assert np.delete(lines, 40).max() < 1e-15


def test_overlapping_flats_are_as_deep_as_the_deeper():
    x = np.linspace(-0.05, 0.05, 1001)
    one, two = WheelFlat(0.04, azimuth=np.pi), WheelFlat(0.03, azimuth=np.pi + 0.01)
    both = wheel_height((one, two), RADIUS, x)
    assert np.array_equal(both, np.minimum(wheel_height((one,), RADIUS, x), wheel_height((two,), RADIUS, x)))


def test_a_dip_has_its_angle_and_comes_back_with_its_spacing():
    x = np.linspace(-20.0, 80.0, 1_000_001)
    height = rail_height((DippedJoint(10.0, 10e-3, 1.0, spacing=18.0),), x)
    kinks = x[height <= height.min() + 1e-12]
    assert np.allclose(kinks, [10.0, 28.0, 46.0, 64.0], atol=2e-4)
    at = np.searchsorted(x, 10.0)
    slope = np.diff(height[at - 2 : at + 3]) / 1e-4
    assert slope.max() - slope.min() == pytest.approx(10e-3, rel=1e-3)
    assert -height.min() == pytest.approx(10e-3 * 1.0 / 8)
    assert np.array_equal(rail_height((DippedJoint(10.0, 10e-3),), x) < 0, (np.abs(x - 10.0) < 0.5 - 1e-9))


def test_corrugation_stays_on_its_stretch():
    x = np.linspace(0.0, 40.0, 400_001)
    height = rail_height((Corrugation(0.05, 20e-6, 10.0, 20.0),), x)
    assert (height[(x < 10.0) | (x > 20.0)] == 0.0).all()
    inside = (x > 10.1) & (x < 19.9)
    assert height[inside].max() == pytest.approx(20e-6, rel=1e-6)
    assert np.sqrt(2) * height[inside].std() == pytest.approx(20e-6, rel=1e-3)
    assert np.abs(np.diff(height)).max() < 1.02 * 20e-6 * 2 * np.pi / 0.05 * 1e-4


def test_without_defects_the_load_is_the_one_of_the_irregularity_alone():
    operation = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_high", short_waves="none"))
    response, step = ride_of(operation, Mounting(), 1.0, seed=5)
    time = np.arange(len(response.contact_force)) / round(1.0 / step)
    position = distance_at(operation.speed_profile, time)
    height = rail_profile(operation.irregularity, float(position[-1]), 5).height_at(position)
    height = (height - height[0]) * (0.5 - 0.5 * np.cos(np.pi * np.clip(time / 0.2, 0.0, 1.0)))
    alone = ride(quarter_vehicle(operation, Mounting()), height, step)
    assert np.array_equal(response.contact_force, alone.contact_force)
    assert np.array_equal(response.bogie, alone.bogie)


def test_a_defect_of_no_depth_changes_no_bit_of_the_load():
    operation = dataclasses.replace(SMOOTH, irregularity=Irregularity("german_low", short_waves="none"))
    nothing = dataclasses.replace(
        operation,
        wheel_defects=(WheelPolygon(20, 0.0), WheelFlat(0.03, 0.0, "rounded")),
        rail_defects=(DippedJoint(5.0, 0.0), Corrugation(0.05, 0.0)),
    )
    one, _ = ride_of(operation, Mounting(), 0.5, seed=1)
    two, _ = ride_of(nothing, Mounting(), 0.5, seed=1)
    assert np.array_equal(one.contact_force, two.contact_force)
    assert np.array_equal(one.bogie, two.bogie)
    # a load with defects is sampled finer, and is the same load
    coarse = load_history(operation, Mounting(), 0.5, seed=1)
    fine = load_history(nothing, Mounting(), 0.5, seed=1)
    assert (np.diff(coarse.time_ns) == 500_000).all()
    assert (np.diff(fine.time_ns) == 100_000).all()
    assert np.allclose(fine.wrench[::5], coarse.wrench, rtol=0, atol=50.0)
    assert np.array_equal(fine.shaft_speed[::5], coarse.shaft_speed)


def test_the_delivered_load_keeps_the_strike():
    operation = with_flat(120.0)
    history = load_history(operation, Mounting(), 1.5, seed=1)
    response, step = ride_of(operation, Mounting(), 1.5, seed=1)
    weight = quarter_vehicle(operation, Mounting()).journal_weight
    settled = history.wrench[history.time_ns > SETTLED * 1e9, 2]
    force = response.contact_force[int(SETTLED / step) :]
    assert settled.max() + weight == pytest.approx(force.max(), rel=0.08)
    # in the air there is nothing but the weight of the half wheelset, and the ringing of the filter,
    # 7 kN of the 200 kN that come down
    assert settled.min() + weight > -8e3


@pytest.mark.parametrize("speed_kmh", [40.0, 120.0, 200.0])
def test_a_flat_strikes_once_a_revolution(speed_kmh):
    response, step = ride_of(with_flat(speed_kmh), Mounting(), 3.0, seed=1)
    static_force = quarter_vehicle(SMOOTH, Mounting()).static_force
    strikes = landings(response.contact_force, static_force, step)
    strikes = strikes[strikes > SETTLED]
    repetition = speed_kmh / 3.6 / CIRCUMFERENCE
    assert len(strikes) == pytest.approx(repetition * (3.0 - SETTLED), abs=1.0)
    assert 1.0 / np.diff(strikes).mean() == pytest.approx(repetition, rel=2e-3)
    # and not once more in between
    assert np.diff(strikes).std() < 0.01 / repetition


def test_the_delivered_load_has_its_lines_at_multiples_of_the_revolution():
    revolutions, period = 32, 0.09  # a revolution is 900 samples
    history = load_history(with_flat(3.6 * CIRCUMFERENCE / period), Mounting(), 6.0, seed=1)
    force = history.wrench[-900 * revolutions :, 2]
    lines = np.abs(np.fft.rfft((force - force.mean()) * np.hanning(len(force))))
    order = np.arange(len(lines)) / revolutions
    near = np.abs(order - np.round(order)) < 2.5 / revolutions
    # the body's own slow motion is below the first order
    assert lines[~near & (order > 0.5)].max() < 0.01 * lines[near].max()
    strong = order[lines > 0.1 * lines.max()]
    assert len(np.unique(np.round(strong))) > 20


def test_braking_stretches_the_time_between_strikes_and_not_the_way():
    braking = dataclasses.replace(with_flat(120.0), speed_profile=((0.0, 120 / 3.6), (4.0, 60 / 3.6)))
    response, step = ride_of(braking, Mounting(), 4.0, seed=1)
    static_force = quarter_vehicle(braking, Mounting()).static_force
    strikes = landings(response.contact_force, static_force, step)
    strikes = strikes[strikes > SETTLED]
    assert np.diff(strikes)[-1] > 1.5 * np.diff(strikes)[0]
    way = np.diff(distance_at(braking.speed_profile, strikes))
    assert np.allclose(way, CIRCUMFERENCE, rtol=0.01)


def test_at_a_walk_the_wheel_keeps_contact_and_at_speed_it_flies_and_lands():
    static_force = quarter_vehicle(SMOOTH, Mounting()).static_force
    slow, _ = ride_of(with_flat(15.0), Mounting(), 3.0, seed=1)
    assert slow.contact_force.min() > 0.0
    fast, step = ride_of(with_flat(80.0), Mounting(), 3.0, seed=1)
    settled = np.arange(len(fast.contact_force)) * step > SETTLED
    force = fast.contact_force[settled]
    flying = force == 0.0
    takeoffs = np.flatnonzero(np.diff(flying.astype(int)) == 1)
    revolutions = (3.0 - SETTLED) * 80 / 3.6 / CIRCUMFERENCE
    assert len(takeoffs) >= int(revolutions)
    # in the air the static force pulls the wheel down; it lands before the flat has passed
    landed = np.flatnonzero(np.diff(flying.astype(int)) == -1)
    landed = landed[landed > takeoffs[0]]
    flights = landed - takeoffs[: len(landed)]
    assert flights.max() * step < 0.035 / (80 / 3.6)
    longest = takeoffs[: len(landed)][np.argmax(flights)]
    way = fast.wheel[settled][longest + 1 : longest + flights.max() + 1]
    mass = quarter_vehicle(SMOOTH, Mounting()).mass[[WHEEL, BOX]].sum()
    assert np.diff(way, 2).mean() / step**2 == pytest.approx(-static_force / mass, rel=0.1)
    # between strikes the force is back at the static one
    assert np.median(force) == pytest.approx(static_force, rel=0.05)


def test_the_strike_of_a_fresh_flat_is_worst_at_a_middling_speed_and_grows_with_its_length():
    def peak(speed_kmh, length):
        response, step = ride_of(with_flat(speed_kmh, WheelFlat(length)), Mounting(), 2.0, seed=1)
        return response.contact_force[int(SETTLED / step) :].max()

    over_speed = [peak(speed, 0.035) for speed in (10.0, 30.0, 80.0, 200.0, 400.0)]
    assert np.argmax(over_speed) == 3
    over_length = [peak(120.0, length) for length in (0.02, 0.03, 0.04, 0.06)]
    assert (np.diff(over_length) > 0).all()


def test_rounding_halves_the_strike_at_a_walk_and_changes_little_at_speed():
    def strike(speed_kmh, shape):
        flat = WheelFlat(0.035, shape=shape)
        response, step = ride_of(with_flat(speed_kmh, flat), Mounting(), 2.0, seed=1)
        static_force = quarter_vehicle(SMOOTH, Mounting()).static_force
        return response.contact_force[int(SETTLED / step) :].max() - static_force

    assert strike(20.0, "rounded") < 0.5 * strike(20.0, "fresh")
    assert strike(200.0, "rounded") == pytest.approx(strike(200.0, "fresh"), rel=0.1)


@pytest.mark.parametrize("speed_kmh", [20.0, 80.0, 400.0])
def test_a_finer_step_changes_the_strike_by_no_more_than_two_percent(speed_kmh):
    operation = with_flat(speed_kmh, WheelFlat(0.04))
    vehicle = quarter_vehicle(operation, Mounting())
    peaks = []
    for rate in (40_000, 400_000):
        position = distance_at(operation.speed_profile, np.arange(rate) / rate)
        height = wheel_height(operation.wheel_defects, RADIUS, position)
        force = ride(vehicle, height, 1.0 / rate).contact_force
        peaks.append(force[rate // 4 :].max())
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)


@pytest.mark.parametrize(
    "speed_kmh", fast_ones([0.0, 3.0, 10.0, 25.0, 50.0, 100.0, 200.0, 300.0, 400.0], 0, 4, 8)
)
@pytest.mark.parametrize("shape", ["fresh", "rounded"])
def test_stable_at_every_speed_with_all_excitations_at_once(speed_kmh, shape):
    operation = dataclasses.replace(
        SMOOTH,
        irregularity=Irregularity("german_high", short_waves="none"),
        speed_profile=((0.0, speed_kmh / 3.6),),
        wheel_defects=(WheelFlat(0.1, shape=shape), WheelPolygon(20, 100e-6), WheelPolygon(1, 0.3e-3)),
        rail_defects=(DippedJoint(5.0, 20e-3, 1.0, 18.0), Corrugation(0.05, 40e-6)),
    )
    vehicle = quarter_vehicle(operation, Mounting())
    response, step = ride_of(operation, Mounting(), 5.0, seed=2)
    force = response.contact_force
    assert np.isfinite(force).all()
    assert force.min() >= 0.0
    if speed_kmh < 10.0:
        assert force.max() < 5.0 * vehicle.static_force
        return
    # the rail carries the weight on average, and half of the step gives the same strikes
    assert force.mean() == pytest.approx(vehicle.static_force, rel=0.03)
    fine = ride(
        vehicle, height_of(operation, round(4 / step), len(force) * 4, seed=2), step / 4
    ).contact_force
    assert force.std() == pytest.approx(fine.std(), rel=0.02)
    assert force.max() == pytest.approx(fine.max(), rel=0.03)
    assert np.isfinite(load_history(operation, Mounting(), 1.0, seed=2).wrench).all()


def height_of(operation, rate, count, seed):
    """Profile under the wheel as the load is made from it, on any grid."""
    time = np.arange(count) / rate
    position = distance_at(operation.speed_profile, time)
    height = rail_profile(operation.irregularity, float(position[-1]), seed).height_at(position)
    height += wheel_height(operation.wheel_defects, RADIUS, position)
    height += rail_height(operation.rail_defects, position)
    return (height - height[0]) * (0.5 - 0.5 * np.cos(np.pi * np.clip(time / 0.2, 0.0, 1.0)))


@pytest.mark.parametrize(
    ("defects", "words"),
    [
        ({"wheel_defects": (WheelFlat(0.04, 1e-3),)}, ["depth_mm is 1", "0.435 mm deep while fresh"]),
        ({"wheel_defects": (WheelFlat(0.04, 1e-3, "rounded"),)}, ["at most 0.435 mm", "0.217 mm"]),
        ({"wheel_defects": (WheelFlat(0.04, shape="oval"),)}, ["'oval'", "fresh, rounded"]),
        ({"wheel_defects": (WheelFlat(0.5),)}, ["length_mm is 500"]),
        ({"wheel_defects": (WheelFlat(float("nan")),)}, ["length_mm is nan"]),
        ({"wheel_defects": (WheelPolygon(0, 1e-5),)}, ["order is 0"]),
        ({"wheel_defects": (WheelPolygon(80, 1e-5),), "wheel_diameter": 0.4}, ["at most 62 waves of 20 mm"]),
        ({"rail_defects": (DippedJoint(1.0, 0.01, 1.0, 0.5),)}, ["spacing_m is 0.5"]),
        ({"rail_defects": (Corrugation(0.05, 1e-5, 3.0, 3.1),)}, ["to_m is 3.1", "four waves"]),
    ],
)
def test_a_defect_that_cannot_be_is_refused_in_a_sentence(defects, words):
    with pytest.raises(InputError) as caught:
        dataclasses.replace(SMOOTH, **defects)
    (problem,) = caught.value.problems
    for word in words:
        assert word in problem

"""The quarter vehicle against equilibrium, linear theory, step halving and its own limits."""

import dataclasses

import numpy as np
import pytest

from beardyn_core.rail.build import RIDE_RATE, load_history
from beardyn_core.rail.vehicle import BOX, GRAVITY, WHEEL, quarter_vehicle, ride
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Vehicle
from test.examples import fast_ones

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
FLAT = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 55.0),))
STEP = 1.0 / RIDE_RATE


def test_on_a_flat_rail_nothing_moves():
    history = load_history(FLAT, Mounting(), 1.0, seed=1)
    weight = (47.8e3 / 8 + 3.5e3 / 4 + 100.0) * GRAVITY
    assert np.allclose(history.wrench[:, 2], weight, rtol=1e-12, atol=0)
    assert np.abs(history.bogie).max() < 1e-15


@pytest.mark.parametrize("frequency", [1.0, 8.0, 50.0, 300.0])
def test_small_waves_give_the_linear_frequency_response(frequency):
    vehicle = quarter_vehicle(FLAT, Mounting())
    amplitude = 2e-8 if frequency > 20 else 1e-6
    time = np.arange(int(14.0 / STEP)) * STEP
    response = ride(vehicle, amplitude * np.sin(2 * np.pi * frequency * time), STEP)
    last = time >= time[-1] - 2.0 + 0.5 * STEP
    wave = np.exp(-2j * np.pi * frequency * time[last])
    measured = 2j * np.mean((response.contact_force[last] - vehicle.static_force) * wave) / amplitude
    contact = 1.5 * vehicle.static_force ** (1 / 3) / vehicle.contact_flexibility
    omega = 2 * np.pi * frequency
    dynamic = vehicle.stiffness + 1j * omega * vehicle.damping - omega**2 * np.diag(vehicle.mass)
    rail = vehicle.rail
    sinks = rail.residual_flexibility / (1 + 1j * omega * rail.residual_time)
    for rates, inverse_mass in zip(rail.rates(), rail.inverse_mass, strict=True):
        sinks += inverse_mass * np.linalg.inv(1j * omega * np.eye(6) - rates)[0, 3]
    rises = np.linalg.inv(dynamic)[WHEEL, WHEEL]
    expected = 1 / (1 / contact + sinks + rises)
    # second order in the step; 12 s after the start the body mode (0.86 Hz, 15 % damping) is 1e-4
    assert abs(measured - expected) < 2e-3 * abs(expected)


def test_halving_the_step_changes_the_force_by_less_than_a_percent_of_its_scatter():
    vehicle = quarter_vehicle(FLAT, Mounting())
    time = np.arange(80_000 * 4) * STEP / 4
    bump = 2e-3 * np.exp(-(((time - 0.5) / 0.01) ** 2)) + 1e-5 * np.sin(2 * np.pi * 400 * time) * (time > 0.2)
    error = []
    reference = ride(vehicle, bump, STEP / 4).contact_force
    for factor in (4, 2):
        coarse = ride(vehicle, bump[::factor], STEP / 4 * factor).contact_force
        error.append(np.std(coarse - reference[::factor]) / np.std(reference))
    assert error[0] < 0.02
    # errors against the quarter step go as 15 : 3 for a method of second order
    assert error[0] / error[1] == pytest.approx(5.0, rel=0.25)


def test_over_a_sharp_dip_the_wheel_takes_off_and_falls_freely():
    vehicle = quarter_vehicle(FLAT, Mounting())
    time = np.arange(40_000) * STEP
    drop = -20e-3 * np.clip((time - 0.1) / 0.01, 0.0, 1.0)
    response = ride(vehicle, drop, STEP)
    flying = response.contact_force == 0.0
    assert flying.sum() * STEP > 5e-3
    assert response.contact_force.min() == 0.0
    assert np.isfinite(response.contact_force).all()
    # with the primary suspension nearly as compressed as at rest, the static force pulls the wheel down
    first = np.flatnonzero(flying)[0]
    fall = response.wheel[first + 1 : first + 80]
    acceleration = np.polyfit(np.arange(len(fall)) * STEP, fall, 2)[0] * 2
    falling = vehicle.mass[[WHEEL, BOX]].sum()
    assert acceleration == pytest.approx(-vehicle.static_force / falling, rel=0.1)


def test_mean_force_over_irregular_track_is_the_static_load():
    operation = dataclasses.replace(FLAT, irregularity=Irregularity("german_low"))
    history = load_history(operation, Mounting(), 30.0, seed=2)
    weight = (47.8e3 / 8 + 3.5e3 / 4 + 100.0) * GRAVITY
    # the mean acceleration of the body over 30 s is left: mm of irregularity, a few mm/s at the end
    assert history.wrench[:, 2].mean() == pytest.approx(weight, rel=2e-3)
    assert history.wrench[:, 2].std() > 0.03 * weight


@pytest.mark.parametrize("speed_kmh", fast_ones([0.0, 30.0, 200.0, 400.0], 1, 3))
@pytest.mark.parametrize("kind", ["german_high", "fra_6"])
def test_stable_at_every_speed(speed_kmh, kind):
    operation = dataclasses.replace(
        FLAT, irregularity=Irregularity(kind, 0.02), speed_profile=((0.0, speed_kmh / 3.6),)
    )
    history = load_history(operation, Mounting(), 10.0, seed=9)
    first, last = history.wrench[2000:8_000, 2].std(), history.wrench[-6000:, 2].std()
    assert np.isfinite(history.wrench).all()
    assert last < 2.0 * first + 1.0


def test_starts_without_a_jerk():
    operation = dataclasses.replace(FLAT, irregularity=Irregularity("german_high"))
    history = load_history(operation, Mounting(), 1.0, seed=3)
    force = history.wrench[:, 2]
    assert abs(force[0] - (47.8e3 / 8 + 3.5e3 / 4 + 100.0) * GRAVITY) < 1e-4 * force[0]
    assert np.abs(np.diff(force[:20])).max() < 0.1 * np.abs(np.diff(force)).max()


def test_same_seed_same_load_other_seed_other_load():
    operation = dataclasses.replace(FLAT, irregularity=Irregularity("german_low"))
    one = load_history(operation, Mounting(), 1.0, seed=3)
    again = load_history(operation, Mounting(), 2.0, seed=3)
    other = load_history(operation, Mounting(), 1.0, seed=4)
    assert np.array_equal(one.wrench, again.wrench[: len(one)])
    assert not np.allclose(one.wrench, other.wrench)

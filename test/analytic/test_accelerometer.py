"""The accelerometer reads gravity, lever arms and tilt; its noise does not depend on the blocks."""

import itertools

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from beardyn_core.base.jit import entry
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.sensors.accelerometer import GRAVITY, NoiseStream, force_at, reading

NOTHING = np.zeros((1, 3))


def specific_force(position, acceleration, angular_velocity, angular_acceleration, rotation):
    force = np.empty(acceleration.shape)
    all_forces(np.array(position), acceleration, angular_velocity, angular_acceleration, rotation, force)
    return force


@entry
def all_forces(position, acceleration, angular_velocity, angular_acceleration, rotation, force):
    for i in range(len(force)):
        force_at(
            position, acceleration[i], angular_acceleration[i], angular_velocity[i], rotation[i], force[i]
        )


def white_noise(seed, sensor, first_sample, count):
    return NoiseStream(seed, sensor).at(first_sample, count)


def test_at_rest_it_reads_plus_g_on_z():
    force = specific_force((0.1, 0.0, 0.2), NOTHING, NOTHING, NOTHING, NOTHING)
    assert force[0] == pytest.approx([0, 0, GRAVITY])


def test_in_free_fall_it_reads_nothing():
    fall = np.array([[0.0, 0.0, -GRAVITY]])
    assert specific_force((0.1, 0.0, 0.2), fall, NOTHING, NOTHING, NOTHING)[0] == pytest.approx([0, 0, 0])


def test_turning_box_adds_tangential_and_centripetal_acceleration_at_the_arm():
    spin, change = np.array([[0.0, 3.0, 0.0]]), np.array([[0.0, 40.0, 0.0]])
    force = specific_force((0.0, 0.0, 0.17), NOTHING, spin, change, NOTHING)
    assert force[0] == pytest.approx([40 * 0.17, 0.0, GRAVITY - 9 * 0.17])


def test_small_tilt_turns_gravity_as_the_exact_rotation_does():
    rotation = np.array([[1e-3, -2e-3, 5e-4]])
    exact = Rotation.from_rotvec(rotation[0]).inv().apply([1.0, 2.0, 3.0 + GRAVITY])
    force = specific_force((0.0, 0.0, 0.0), np.array([[1.0, 2.0, 3.0]]), NOTHING, NOTHING, rotation)
    assert np.abs(force[0] - exact).max() < np.linalg.norm(rotation) ** 2 * 15.0


def test_noise_is_the_same_for_any_cut_into_blocks():
    whole = white_noise(7, 0, 0, 1000)
    cuts = [0, 1, 2, 5, 12, 13, 512, 777, 1000]
    parts = [white_noise(7, 0, a, b - a) for a, b in itertools.pairwise(cuts)]
    assert np.array_equal(np.concatenate(parts), whole)


def test_noise_is_that_of_the_textbook_formulas():
    """Philox by NumPy, Box and Muller with its logarithm and circular functions."""
    key = np.random.SeedSequence([0x61636365, 7, 3]).generate_state(2, np.uint64)
    raw = np.random.Philox(key=key, counter=500).random_raw(4 * 20_000).reshape(-1, 4)
    uniform = ((raw >> np.uint64(11)).astype(np.float64) + 1.0) * 2.0**-53
    radius, turn = np.sqrt(-2.0 * np.log(uniform[:, :2])), 2.0 * np.pi * uniform[:, 2:]
    expected = np.column_stack((radius * np.cos(turn), radius[:, 0] * np.sin(turn[:, 0])))
    np.testing.assert_allclose(white_noise(7, 3, 500, 20_000), expected, rtol=0.0, atol=1e-7)


def test_specific_force_is_that_of_vector_products():
    random = np.random.default_rng(5)
    motion, position = random.normal(size=(4, 50, 3)), (0.1, -0.2, 0.3)
    acceleration, omega, change, tilt = motion
    tilt = 1e-3 * tilt
    arm = np.asarray(position) + np.cross(tilt, np.asarray(position))
    force = acceleration + np.cross(change, arm) + np.cross(omega, np.cross(omega, arm))
    force[:, 2] += GRAVITY
    expected = force - np.cross(tilt, force)
    found = specific_force(position, acceleration, omega, change, tilt)
    np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_noise_is_standard_normal_and_independent_between_axes_sensors_and_seeds():
    noise = white_noise(7, 0, 0, 200_000)
    assert np.abs(noise.mean(axis=0)).max() < 4 / np.sqrt(2e5)
    assert np.abs(noise.std(axis=0) - 1).max() < 4 / np.sqrt(4e5)
    assert np.mean(noise**4, axis=0) == pytest.approx([3, 3, 3], abs=4 * np.sqrt(96 / 2e5))
    others = np.column_stack([noise, white_noise(7, 1, 0, 200_000), white_noise(8, 0, 0, 200_000)])
    assert np.abs(np.corrcoef(others.T) - np.eye(9)).max() < 5 / np.sqrt(2e5)
    assert np.abs(np.mean(noise[1:] * noise[:-1], axis=0)).max() < 4 / np.sqrt(2e5)


def test_noise_density_is_one_sided_and_the_range_clips():
    sensor = Accelerometer(noise_density=0.02, range=50.0)
    still = reading(sensor, np.zeros((100_000, 3)), 25_600.0, NoiseStream(1, 0), 0)
    assert still.std() == pytest.approx(0.02 * np.sqrt(12_800), rel=0.01)
    loud = reading(sensor, np.array([[1e3, -1e3, 0.0]]), 25_600.0, NoiseStream(1, 0), 0)
    assert loud[0, :2].tolist() == [50.0, -50.0]

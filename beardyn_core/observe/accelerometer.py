"""What an accelerometer on the axlebox reads: motion at its place, gravity, noise, clipping."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.sensor import Accelerometer

Float = NDArray[np.float64]

GRAVITY = 9.80665
_STREAM = 0x61636365  # keeps the sensors' random numbers apart from those of the rail


def specific_force(
    position: tuple[float, float, float],
    acceleration: Float,
    angular_velocity: Float,
    angular_acceleration: Float,
    rotation: Float,
) -> Float:
    """Specific force at the sensor, in the sensor's own axes: +g on z at rest.

    Parameters
    ----------
    position : tuple of 3 floats
        Of the sensor from the point whose acceleration is given, box axes, [m].
    acceleration : float64 array, shape [sample, 3]
        Of the box at that point, world axes, without gravity, [m/s^2].
    angular_velocity : float64 array, shape [sample, 3]
        [rad/s].
    angular_acceleration : float64 array, shape [sample, 3]
        [rad/s^2].
    rotation : float64 array, shape [sample, 3]
        Small rotation of the box from the world axes, [rad].

    Returns
    -------
    float64 array, shape [sample, 3]
        [m/s^2].

    Notes
    -----
    First order in the rotation (1 mrad turns 10 mm/s^2 of gravity into x or y; the neglected second
    order is 5e-6 m/s^2). Sign convention of REP-145.
    """
    arm = np.asarray(position) + np.cross(rotation, np.asarray(position))
    force = acceleration + np.cross(angular_acceleration, arm)
    force += np.cross(angular_velocity, np.cross(angular_velocity, arm))
    force[:, 2] += GRAVITY
    return force - np.cross(rotation, force)


def white_noise(seed: int, sensor: int, first_sample: int, count: int) -> Float:
    """Standard normal numbers that depend on the sample index only, not on the cut into blocks.

    Parameters
    ----------
    seed, sensor : int
        Of the run; running number of the sensor.
    first_sample, count : int

    Returns
    -------
    float64 array, shape [count, 3]

    References
    ----------
    Counter-based generator Philox4x64: Salmon et al. (2011), Parallel random numbers: as easy as
    1, 2, 3. One counter a sample; Box and Muller (1958) for the normal distribution.
    """
    key = np.random.SeedSequence([_STREAM, seed, sensor]).generate_state(2, np.uint64)
    raw = np.random.Philox(key=key, counter=first_sample).random_raw(4 * count).reshape(count, 4)
    # 53 bits each, in (0, 1]: the logarithm stays finite
    uniform = ((raw >> np.uint64(11)).astype(np.float64) + 1.0) * 2.0**-53
    radius = np.sqrt(-2.0 * np.log(np.ascontiguousarray(uniform[:, :2])))
    turn = 2.0 * np.pi * np.ascontiguousarray(uniform[:, 2:])
    return np.column_stack((radius * np.cos(turn), radius[:, 0] * np.sin(turn[:, 0])))


def reading(
    sensor: Accelerometer, signal: Float, rate: float, seed: int, index: int, first_sample: int
) -> Float:
    """Add the sensor's noise to the anti-aliased specific force and clip at its range.

    Parameters
    ----------
    sensor : Accelerometer
    signal : float64 array, shape [sample, 3]
        At the output rate, [m/s^2].
    rate : float
        Output rate, [Hz].
    seed, index : int
        Of the run; running number of the sensor.
    first_sample : int
        Running index of the block's first sample.

    Returns
    -------
    float64 array, shape [sample, 3]
        [m/s^2].
    """
    deviation = sensor.noise_density * np.sqrt(0.5 * rate)
    noise = deviation * white_noise(seed, index, first_sample, len(signal))
    return np.clip(signal + noise, -sensor.range, sensor.range)

"""What an accelerometer on the axlebox reads: motion at its place, gravity, noise, clipping."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.jit import entry
from beardyn_core.kernels.lane_math import at_least, at_most, cos_sin, log2
from beardyn_core.scene.sensor import Accelerometer

Float = NDArray[np.float64]

GRAVITY = 9.80665
_STREAM = 0x61636365  # keeps the sensors' random numbers apart from those of the rail
_TWICE_LN_2 = 1.3862943611198906
_TWO_PI = 6.283185307179586


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
    force = np.empty(acceleration.shape)
    _specific_force(
        np.array(position, dtype=np.float64), acceleration, angular_velocity, angular_acceleration, rotation,
        force,
    )  # fmt: skip
    return force


@entry
def _specific_force(position, acceleration, angular_velocity, angular_acceleration, rotation, force):
    px, py, pz = position
    for i in range(len(force)):
        ax, ay, az = rotation[i, 0], rotation[i, 1], rotation[i, 2]
        wx, wy, wz = angular_velocity[i, 0], angular_velocity[i, 1], angular_velocity[i, 2]
        cx, cy, cz = angular_acceleration[i, 0], angular_acceleration[i, 1], angular_acceleration[i, 2]
        rx, ry, rz = px + ay * pz - az * py, py + az * px - ax * pz, pz + ax * py - ay * px
        vx, vy, vz = wy * rz - wz * ry, wz * rx - wx * rz, wx * ry - wy * rx
        fx = acceleration[i, 0] + (cy * rz - cz * ry) + (wy * vz - wz * vy)
        fy = acceleration[i, 1] + (cz * rx - cx * rz) + (wz * vx - wx * vz)
        fz = acceleration[i, 2] + (cx * ry - cy * rx) + (wx * vy - wy * vx) + GRAVITY
        force[i, 0] = fx - (ay * fz - az * fy)
        force[i, 1] = fy - (az * fx - ax * fz)
        force[i, 2] = fz - (ax * fy - ay * fx)


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
    """
    return NoiseStream(seed, sensor).at(first_sample, count)


class NoiseStream:
    """White noise of one sensor; see `white_noise`.

    Parameters
    ----------
    seed, sensor : int

    References
    ----------
    Counter-based generator Philox4x64: Salmon et al. (2011), Parallel random numbers: as easy as
    1, 2, 3. One counter a sample; Box and Muller (1958) for the normal distribution.
    """

    def __init__(self, seed: int, sensor: int) -> None:
        self._key = np.random.SeedSequence([_STREAM, seed, sensor]).generate_state(2, np.uint64)
        self._bits = np.random.Philox(key=self._key)
        self._next = 0

    def at(self, first_sample: int, count: int) -> Float:
        """Numbers of some samples, shape [count, 3]; the next samples in a row come cheapest."""
        if first_sample != self._next:
            self._bits = np.random.Philox(key=self._key, counter=first_sample)
        self._next = first_sample + count
        noise = np.empty((count, 3))
        _normal(self._bits.random_raw(4 * count), noise)
        return noise


@entry
def _normal(raw, noise):
    for i in range(len(noise)):
        # 53 bits each, in (0, 1]: the logarithm stays finite; at 1 it may be above zero by its error
        first = (np.float64(raw[4 * i] >> np.uint64(11)) + 1.0) * 2.0**-53
        second = (np.float64(raw[4 * i + 1] >> np.uint64(11)) + 1.0) * 2.0**-53
        turn = (np.float64(raw[4 * i + 2] >> np.uint64(11)) + 1.0) * (2.0**-53 * _TWO_PI)
        other = (np.float64(raw[4 * i + 3] >> np.uint64(11)) + 1.0) * (2.0**-53 * _TWO_PI)
        radius = np.sqrt(at_least(-_TWICE_LN_2 * log2(first), 0.0))
        cosine, sine = cos_sin(turn)
        noise[i, 0] = radius * cosine
        noise[i, 1] = np.sqrt(at_least(-_TWICE_LN_2 * log2(second), 0.0)) * cos_sin(other)[0]
        noise[i, 2] = radius * sine


def reading(
    sensor: Accelerometer, signal: Float, rate: float, stream: NoiseStream, first_sample: int
) -> Float:
    """Add the sensor's noise to the anti-aliased specific force and clip at its range.

    Parameters
    ----------
    sensor : Accelerometer
    signal : float64 array, shape [sample, 3]
        At the output rate, [m/s^2].
    rate : float
        Output rate, [Hz].
    stream : NoiseStream
        Of this sensor.
    first_sample : int
        Running index of the block's first sample.

    Returns
    -------
    float64 array, shape [sample, 3]
        [m/s^2].
    """
    out = stream.at(first_sample, len(signal))
    _add_noise(signal, sensor.noise_density * math.sqrt(0.5 * rate), sensor.range, out)
    return out


@entry
def _add_noise(signal, deviation, largest, out):
    """Turn noise of deviation 1 into the reading, in place."""
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = at_most(at_least(signal[i, j] + deviation * out[i, j], -largest), largest)

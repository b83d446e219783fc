"""Reading of an accelerometer on the axlebox: motion at its place, gravity, noise, clipping."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.jit import entry, inline
from beardyn_core.kernels.lane_math import at_least, at_most, cos_sin, log2
from beardyn_core.scene.sensor import Accelerometer

GRAVITY = 9.80665
_STREAM = 0x61636365  # keeps the sensors' random numbers apart from those of the rail
_TWICE_LN_2 = 1.3862943611198906
_TWO_PI = 6.283185307179586
_PIECE = 256


@inline
def force_at(position, acceleration, angular_acceleration, angular_velocity, rotation, force):
    """Compute the specific force at the sensor, in its own axes: +g on z at rest; one sample, in `force`.

    `position` is that of the sensor from the point whose acceleration is given, box axes, [m]; motion in
    world axes without gravity, [m/s^2], [rad/s^2], [rad/s]; `rotation` is small, from the world axes, [rad].

    Notes
    -----
    First order in the rotation (1 mrad turns 10 mm/s^2 of gravity into x or y; the neglected second
    order is 5e-6 m/s^2). Sign convention of REP-145.
    """
    px, py, pz = position[0], position[1], position[2]
    ax, ay, az = rotation[0], rotation[1], rotation[2]
    wx, wy, wz = angular_velocity[0], angular_velocity[1], angular_velocity[2]
    cx, cy, cz = angular_acceleration[0], angular_acceleration[1], angular_acceleration[2]
    rx, ry, rz = px + ay * pz - az * py, py + az * px - ax * pz, pz + ax * py - ay * px
    vx, vy, vz = wy * rz - wz * ry, wz * rx - wx * rz, wx * ry - wy * rx
    fx = acceleration[0] + (cy * rz - cz * ry) + (wy * vz - wz * vy)
    fy = acceleration[1] + (cz * rx - cx * rz) + (wz * vx - wx * vz)
    fz = acceleration[2] + (cx * ry - cy * rx) + (wx * vy - wy * vx) + GRAVITY
    force[0] = fx - (ay * fz - az * fy)
    force[1] = fy - (az * fx - ax * fz)
    force[2] = fz - (ax * fy - ay * fx)


class NoiseStream:
    """White noise of one sensor: it depends on the sample index only, not on the cut into blocks.

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
        """Draw standard normal numbers, shape [count, 3]; consecutive samples are the fastest."""
        if first_sample != self._next:
            self._bits = np.random.Philox(key=self._key, counter=first_sample)
        self._next = first_sample + count
        noise = np.empty((count, 3))
        _normal(self._bits.random_raw(4 * count), noise)
        return noise


@entry
def _normal(raw, noise):
    # pieces that stay in the cache; within them one simple loop each, which the compiler turns into lanes
    uniform, normal = np.empty((4, _PIECE)), np.empty((3, _PIECE))
    for start in range(0, len(noise), _PIECE):
        count = min(_PIECE, len(noise) - start)
        for i in range(count):
            for k in range(4):
                # 53 bits, in (0, 1]: the logarithm stays finite; at 1 it may be above zero by its error
                uniform[k, i] = (
                    np.float64(np.int64(raw[4 * (start + i) + k] >> np.uint64(11))) + 1.0
                ) * 2.0**-53
        _box_muller(uniform[0], uniform[1], uniform[2], uniform[3], normal[0], normal[1], normal[2])
        for i in range(count):
            for k in range(3):
                noise[start + i, k] = normal[k, i]


@inline
def _box_muller(first, second, turn, other, x, y, z):
    for i in range(_PIECE):
        radius = np.sqrt(at_least(-_TWICE_LN_2 * log2(first[i]), 0.0))
        cosine, sine = cos_sin(_TWO_PI * turn[i])
        x[i] = radius * cosine
        z[i] = radius * sine
        y[i] = np.sqrt(at_least(-_TWICE_LN_2 * log2(second[i]), 0.0)) * cos_sin(_TWO_PI * other[i])[0]


def reading(
    sensor: Accelerometer, signal: Float, rate: float, stream: NoiseStream, first_sample: int
) -> Float:
    """Add the sensor's noise to the anti-aliased specific force and clip at its range.

    Parameters
    ----------
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

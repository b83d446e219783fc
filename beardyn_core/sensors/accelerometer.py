"""Reading of an accelerometer on the axlebox: motion, gravity, its own response, noise, clipping."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.physics.lanes.lane_math import at_least, at_most, cos_sin, log2
from beardyn_core.scene.sensor import Accelerometer

LOOKAHEAD = 12  # samples; the gain is within 0.02 dB
_HIGHEST_POLE = 0.475  # of the rate; above that the gain over the band is smooth enough without poles
_BAND_POINTS = 400


def resonance_gain(frequency: Float, resonance: float, damping_ratio: float) -> NDArray[np.complex128]:
    """Compute the acceleration of a mass on a spring over that of its base, at frequencies in [Hz].

    The resonance is the undamped one, [Hz].

    Notes
    -----
    That is the reading over the true acceleration: a piezoelectric accelerometer measures the force in
    its spring, which is the mass times its acceleration, damping left out against the stiffness.
    """
    r = np.asarray(frequency) / resonance
    return np.asarray(1.0 / (1.0 - r * r + 2j * damping_ratio * r))


def low_pass_gain(frequency: Float, corner: float | None) -> NDArray[np.complex128]:
    """Compute the gain of an amplifier with a low pass of second order (Butterworth), at frequencies in [Hz].

    The corner is where it is 3 dB down, [Hz]; ``None``: 1.
    """
    r = np.asarray(frequency) / (np.inf if corner is None else corner)
    return np.asarray(1.0 / (1.0 - r * r + np.sqrt(2.0) * 1j * r))


def filter_coefficients(
    resonance: float | None, damping_ratio: float, rate: float, band: float, low_pass: float | None = None
) -> tuple[Float, Float]:
    """Design the filter: 2 poles, factors of the last output and the one before; taps, the oldest first.

    Notes
    -----
    The poles are those of the mass, exactly. What is left of the gain has no poles in the band, so few
    taps match it there: least squares of the relative error, gain 1 at rest.
    """
    poles = np.zeros(2)
    if resonance is None:
        resonance = np.inf
    elif resonance < _HIGHEST_POLE * rate:
        turn = 2.0 * np.pi * resonance / rate
        pole = np.exp(turn * (-damping_ratio + 1j * np.sqrt(1.0 - damping_ratio**2)))
        poles = np.array([2.0 * pole.real, -(abs(pole) ** 2)])
    frequency = np.linspace(0.0, band, _BAND_POINTS)
    late = np.exp(-2j * np.pi * frequency / rate)
    gain = resonance_gain(frequency, resonance, damping_ratio) * low_pass_gain(frequency, low_pass)
    rest = gain * (1.0 - poles[0] * late - poles[1] * late**2)
    offered = late[:, None] ** np.arange(LOOKAHEAD, -LOOKAHEAD - 1, -1) / rest[:, None]
    system = np.concatenate((offered.real, offered.imag))
    wanted = np.repeat([1.0, 0.0], _BAND_POINTS)
    taps = np.linalg.lstsq(system, wanted, rcond=None)[0]
    return poles, taps * (1.0 - poles.sum()) / taps.sum()


class Response:
    """The filter of one sensor: mounting resonance and low pass; its output comes `LOOKAHEAD` samples late.

    Cutting the stream into other blocks gives the same bits.

    Parameters
    ----------
    sensor : Accelerometer
        With a resonance or a low pass.
    band : float
        Up to here the gain is that of `resonance_gain` and `low_pass_gain`, [Hz].
    initial : float64 array, shape [channel]
        What the stream held before its first sample.
    """

    def __init__(self, sensor: Accelerometer, band: float, initial: Float) -> None:
        self._poles, self._taps = filter_coefficients(
            sensor.mounting_resonance, sensor.mounting_damping_ratio, sensor.rate, band, sensor.low_pass
        )
        self._inputs = np.tile(initial, (2 * LOOKAHEAD, 1))
        self._outputs = np.tile(initial, (2, 1))

    def push(self, block: Float) -> Float:
        """Filter a block, shape [sample, channel], and return as many samples."""
        stretch = np.concatenate((self._inputs, block))
        out = np.empty((len(block) + 2, block.shape[1]))
        out[:2] = self._outputs
        _ring(stretch, self._taps, self._poles, out)
        self._inputs, self._outputs = stretch[len(block) :], out[len(block) :].copy()
        return out[2:]


@entry
def _ring(stretch, taps, poles, out):
    for i in range(2, len(out)):
        for j in range(out.shape[1]):
            total = poles[0] * out[i - 1, j] + poles[1] * out[i - 2, j]
            for k in range(len(taps)):
                total += taps[k] * stretch[i - 2 + k, j]
            out[i, j] = total


GRAVITY = STANDARD_GRAVITY
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


@partial(entry, allocates=True)
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

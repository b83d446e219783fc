"""All accelerometers of a scene: from box motion at the step rate to the reading of each."""

from __future__ import annotations

from functools import partial

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.jit import entry
from beardyn_core.model.build import BLOCK_NS, WAVEFORM_RATE
from beardyn_core.model.layout import SIGNAL_ACCELERATION, SIGNAL_ANGULAR_ACCELERATION, SIGNAL_CHANNELS
from beardyn_core.observe.accelerometer import GRAVITY, LOOKAHEAD, NoiseStream, Resonance, force_at, reading
from beardyn_core.observe.block import Vibration
from beardyn_core.observe.resampling import DELAY, Decimator
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import RATES, Accelerometer, steps_do_not_fit

REST = np.array([0.0, 0.0, GRAVITY])
BLOCKS_PER_SECOND = 1_000_000_000 // BLOCK_NS
_PASS_BAND = 0.4  # of a rate, behind its anti-alias filter


def lookahead(scene: Scene) -> int:
    """Count the samples of 25.6 kHz by which all waveforms wait for the filter of a mounting resonance."""
    if all(sensor.mounting_resonance is None for sensor in scene.sensors):
        return 0
    return -(-LOOKAHEAD // round(scene.numerics.steps_per_sample))


class Sensors:
    """Accelerometers of a run.

    A rigidly mounted one at 25.6 kHz reads the box motion that has been decimated for all. Any other one
    has a chain of its own: specific force at every step, resonance, anti-alias filter to its rate. Noise
    and clipping come last.

    Parameters
    ----------
    delay : int
        Samples by which the decimated box motion comes late.

    Attributes
    ----------
    delays : list of int
        Samples by which each accelerometer reads late, at its rate.
    """

    def __init__(self, scene: Scene, delay: int) -> None:
        steps = scene.numerics.steps_per_sample
        problem = steps_do_not_fit(scene.sensors, steps)
        if problem:
            raise ValueError(problem)
        self._sensors = scene.sensors
        self._noise = [NoiseStream(scene.seed, number) for number in range(len(scene.sensors))]
        self._chains = [
            None
            if sensor.mounting_resonance is None and sensor.rate == RATES[0]
            else _Chain(sensor, number, round(steps), lookahead(scene))
            for number, sensor in enumerate(scene.sensors)
        ]
        self.delays = [delay if chain is None else chain.delay for chain in self._chains]

    def read(self, index: int, waves: Float, signals: Float, motion: Float) -> list[Float]:
        """Compute the readings of every accelerometer, shapes [sample, 3], [m/s^2].

        Parameters
        ----------
        index : int
            Running number of the block of 20 ms that the signals begin with.
        waves : float64 array, shape [sample, SIGNAL_CHANNELS]
            At 25.6 kHz.
        signals : float64 array, shape [step, SIGNAL_CHANNELS]
        motion : float64 array, shape [trend + 2, 6]
            Rotation and angular velocity of the box at 400 Hz; the second row is that before the first step.
        """
        found = []
        for number, (sensor, chain, delay, noise) in enumerate(
            zip(self._sensors, self._chains, self.delays, self._noise, strict=True)
        ):
            if chain is None:
                signal = box_force(sensor.position, waves, motion, delay, number)
            else:
                signal = chain.push(signals, motion)
            first = self._first(index, sensor, delay)
            skipped = max(0, -first)
            signal[skipped:] = reading(sensor, signal[skipped:], sensor.rate, noise, first + skipped)
            found.append(signal)
        return found

    def vibration(self, index: int, readings: list[Float]) -> tuple[Vibration, ...]:
        """Stamp readings with their time; those before the start of the run are left out."""
        found = []
        for sensor, delay, values in zip(self._sensors, self.delays, readings, strict=True):
            first = self._first(index, sensor, delay)
            skipped = max(0, -first)
            sample = np.arange(first + skipped, first + len(values), dtype=np.int64)
            time_ns = sample * 1_000_000_000 // round(sensor.rate)
            found.append(Vibration(sensor.rate, first + skipped, time_ns, values[skipped:]))
        return tuple(found)

    @staticmethod
    def _first(index: int, sensor: Accelerometer, delay: int) -> int:
        return index * round(sensor.rate / BLOCKS_PER_SECOND) - delay


class _Chain:
    """From the steps to the samples of one accelerometer."""

    def __init__(self, sensor: Accelerometer, number: int, steps: int, wait: int) -> None:
        factor = round(WAVEFORM_RATE * steps / sensor.rate)
        wait *= steps
        self.delay = (DELAY if factor > 1 else 0) + wait // factor
        self._position, self._number = sensor.position, number
        self._resonance: Resonance | None = None
        if sensor.mounting_resonance is not None:
            # behind an anti-alias filter the gain is right wherever anything is left
            band = (_PASS_BAND if factor == 1 else 1.0 - _PASS_BAND) * sensor.rate
            self._resonance = Resonance(
                sensor.mounting_resonance, sensor.mounting_damping_ratio, WAVEFORM_RATE * steps, band, REST
            )
            wait -= LOOKAHEAD
        # a step's signals are those of its end: sample 0 stands at the end of the step before the first
        self._decimator = Decimator(factor, 3, REST, held_back=1 + wait)

    def push(self, signals: Float, motion: Float) -> Float:
        """Compute the specific force at the rate of the sensor, shape [sample, 3], [m/s^2]."""
        force = box_force(self._position, signals, motion, -1, self._number)
        return self._decimator.push(force if self._resonance is None else self._resonance.push(force))


def box_force(
    position: tuple[float, float, float], signals: Float, motion: Float, delay: int, sensor: int = 0
) -> Float:
    """Compute the specific force at a place of the box [m], see `force_at`, shape [sample, 3], [m/s^2].

    Signals, shape [sample, SIGNAL_CHANNELS], come late by ``delay`` samples, at most those of a row; the
    motion, shape [trend + 2, 6], is as of `Sensors.read` and linear in between. Where the modes of the box
    shake the seat of each ``sensor``, what they give it stands behind the other signals.
    """
    force = np.empty((len(signals), 3))
    _box_force(*position, signals, motion, len(signals) // (len(motion) - 2), delay, force)
    if signals.shape[1] > SIGNAL_CHANNELS:
        force += signals[:, SIGNAL_CHANNELS + 3 * sensor : SIGNAL_CHANNELS + 3 * sensor + 3]
    return force


@partial(entry, allocates=True)
def _box_force(px, py, pz, signals, motion, stride, delay, force):
    slope, first = np.empty(6), np.empty(6)
    at = stride - delay  # samples after the first row
    row = min(at // stride, len(motion) - 2)
    end = 0
    while end < len(signals):
        start = end
        since = at - row * stride
        end = len(signals) if row == len(motion) - 2 else min(len(signals), start + stride - since)
        for j in range(6):
            slope[j] = (motion[row + 1, j] - motion[row, j]) / stride
            first[j] = motion[row, j]
        for i in range(start, end):
            late = float(since + i - start)
            force_at(
                (px, py, pz),
                signals[i, SIGNAL_ACCELERATION : SIGNAL_ACCELERATION + 3],
                signals[i, SIGNAL_ANGULAR_ACCELERATION : SIGNAL_ANGULAR_ACCELERATION + 3],
                (first[3] + late * slope[3], first[4] + late * slope[4], first[5] + late * slope[5]),
                (first[0] + late * slope[0], first[1] + late * slope[1], first[2] + late * slope[2]),
                force[i],
            )
        at += end - start
        row += 1

"""All accelerometers of a scene: from box motion at the step rate to the reading of each."""

from __future__ import annotations

from functools import partial

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.layout import (
    SIGNAL_ACCELERATION,
    SIGNAL_ANGULAR_ACCELERATION,
    SIGNAL_CHANNELS,
)
from beardyn_core.physics.bodies.rates import BLOCK_NS, WAVEFORM_RATE
from beardyn_core.rail.transfer_path import path_read
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import AXES, PASSBAND, RATES, Accelerometer, rates_do_not_fit, steps_do_not_fit
from beardyn_core.sensors.accelerometer import GRAVITY, LOOKAHEAD, NoiseStream, Response, force_at, reading
from beardyn_core.sensors.block import Vibration
from beardyn_core.sensors.path_filter import PATH_LOOKAHEAD, PathFilter
from beardyn_core.sensors.pickup import PickupStream
from beardyn_core.sensors.resampling import DELAY, Decimator

REST = np.array([0.0, 0.0, GRAVITY])
BLOCKS_PER_SECOND = 1_000_000_000 // BLOCK_NS
TREND_RATE = 400


def lookahead(scene: Scene) -> int:
    """Count the samples of the force waveform by which all wait for what sensors have of their own."""
    rate = round(scene.waveform_rate)
    return max((-(-_late(sensor) * rate // round(sensor.rate)) for sensor in scene.sensors), default=0)


def _responds(sensor: Accelerometer) -> bool:
    return sensor.mounting_resonance is not None or sensor.low_pass is not None


def _late(sensor: Accelerometer) -> int:
    """Count the samples, at its rate, by which a sensor's own filters look ahead."""
    return LOOKAHEAD * _responds(sensor) + PATH_LOOKAHEAD * bool(sensor.measured_paths)


class Sensors:
    """Accelerometers of a run.

    Specific force at their place, from the box motion decimated for all or from every step (51.2 kHz);
    measured path, mounting resonance and low pass; electrical pickup, noise and clipping.

    Parameters
    ----------
    delay : int
        Samples by which the decimated box motion comes late.

    Attributes
    ----------
    delays : list of int
        Samples by which each accelerometer reads late, at its rate.
    kept : int
        Rows of earlier motion that `read` needs.
    """

    def __init__(self, scene: Scene, delay: int) -> None:
        steps = scene.numerics.steps_per_sample
        problem = rates_do_not_fit(scene.sensors) or steps_do_not_fit(scene.sensors, steps)
        if problem:
            raise ValueError(problem)
        self.kept = 1 + max(1, -(-delay * TREND_RATE // round(scene.waveform_rate)))
        self._chains = [
            _Chain(sensor, number, scene, round(steps), delay, self.kept)
            for number, sensor in enumerate(scene.sensors)
        ]
        self.delays = [chain.delay for chain in self._chains]

    def read(self, index: int, waves: Float, signals: Float, motion: Float, speed: Float) -> list[Float]:
        """Compute the readings of every accelerometer, shapes [sample, 3], [m/s^2].

        Parameters
        ----------
        index : int
            Running number of the block of 20 ms that the signals begin with.
        waves : float64 array, shape [sample, SIGNAL_CHANNELS]
            At the rate of the force waveform.
        signals : float64 array, shape [step, SIGNAL_CHANNELS]
        motion : float64 array, shape [trend + kept, 6]
            Rotation and angular velocity of the box at 400 Hz; the last one kept is that before the steps.
        speed : float64 array, shape [step + 1]
            Of the shaft, [rad/s].
        """
        return [chain.push(index, waves, signals, motion, speed) for chain in self._chains]

    def vibration(self, index: int, readings: list[Float]) -> tuple[Vibration, ...]:
        """Stamp readings with their time; those before the start of the run are left out."""
        found = []
        for chain, values in zip(self._chains, readings, strict=True):
            first = chain.first(index)
            skipped = max(0, -first)
            sample = np.arange(first + skipped, first + len(values), dtype=np.int64)
            time_ns = sample * 1_000_000_000 // round(chain.sensor.rate)
            found.append(Vibration(chain.sensor.rate, first + skipped, time_ns, values[skipped:]))
        return tuple(found)


class _Chain:
    """From the motion of the box to the samples of one accelerometer."""

    def __init__(
        self, sensor: Accelerometer, number: int, scene: Scene, steps: int, delay: int, kept: int
    ) -> None:
        self.sensor, self._number, self._kept = sensor, number, kept
        self._waves_late = delay
        self._decimator: Decimator | None = None
        wait = lookahead(scene)
        if sensor.rate > RATES[0]:
            factor = round(WAVEFORM_RATE * steps / sensor.rate)
            # a step's signals are those of its end: sample 0 stands at the end of the step before the first
            self._decimator = Decimator(factor, 3, REST, held_back=1)
            delay, wait = (DELAY if factor > 1 else 0), wait * round(sensor.rate / RATES[0])
        self.delay = delay + wait
        self._held_back = Decimator(1, 3, REST, held_back=wait - _late(sensor))
        self._response = Response(sensor, PASSBAND * sensor.rate, REST) if _responds(sensor) else None
        self._path: PathFilter | None = None
        if sensor.measured_paths:
            paths = {
                AXES.index(axis): path_read(each.content, each.path)
                for each in sensor.measured_paths
                for axis in each.axes
            }
            self._path = PathFilter(paths, sensor.rate, REST)
        self._noise = NoiseStream(scene.seed, number)
        pickup = None if scene.background is None else scene.background.pickup
        self._pickup: PickupStream | None = None
        if pickup is not None:
            self._pickup = PickupStream(pickup, sensor.rate, scene.seed, number)
            self._pickup_held_back = Decimator(1, 1, held_back=self.delay)

    def first(self, index: int) -> int:
        """Find the running number of the first sample that a block brings."""
        return index * round(self.sensor.rate / BLOCKS_PER_SECOND) - self.delay

    def push(self, index: int, waves: Float, signals: Float, motion: Float, speed: Float) -> Float:
        """Compute the reading at the rate of the sensor, shape [sample, 3], [m/s^2]."""
        place = self.sensor.position
        if self._decimator is None:
            signal = box_force(place, waves, motion, self._waves_late, self._number, self._kept)
        else:
            fine = box_force(place, signals, motion, -1, self._number, self._kept)
            signal = self._decimator.push(fine)
        signal = self._held_back.push(signal)
        if self._path is not None:
            signal = self._path.push(signal)
        if self._response is not None:
            signal = self._response.push(signal)
        if self._pickup is not None:
            at = np.arange(len(signal)) * ((len(speed) - 1) / len(signal))
            volts = self._pickup.push(np.interp(at, np.arange(len(speed)), speed))
            signal = signal + self._pickup_held_back.push(volts[:, None]) / self.sensor.sensitivity
        first = self.first(index)
        skipped = max(0, -first)
        signal[skipped:] = reading(
            self.sensor, signal[skipped:], self.sensor.rate, self._noise, first + skipped
        )
        return signal


def box_force(
    position: tuple[float, float, float],
    signals: Float,
    motion: Float,
    delay: int,
    sensor: int = 0,
    kept: int = 2,
) -> Float:
    """Compute the specific force at a place of the box [m], see `force_at`, shape [sample, 3], [m/s^2].

    Signals, shape [sample, SIGNAL_CHANNELS], come late by ``delay`` samples, at most those of ``kept - 1``
    rows; the motion, shape [trend + kept, 6], is as of `Sensors.read` and linear in between. Where the modes
    of the box shake the seat of each ``sensor``, what they give it stands behind the other signals.
    """
    force = np.empty((len(signals), 3))
    stride = len(signals) // (len(motion) - kept)
    _box_force(*position, signals, motion, stride, (kept - 1) * stride - delay, force)
    if signals.shape[1] > SIGNAL_CHANNELS:
        force += signals[:, SIGNAL_CHANNELS + 3 * sensor : SIGNAL_CHANNELS + 3 * sensor + 3]
    return force


@partial(entry, allocates=True)
def _box_force(px, py, pz, signals, motion, stride, first_at, force):
    slope, first = np.empty(6), np.empty(6)
    at = first_at  # samples after the first row
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

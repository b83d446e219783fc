"""From the kernel's raw signals to the channels of a block: filtered, delay-compensated, named."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    CUP_BODY,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    TILT,
    TRENDS_PER_SNAPSHOT,
)
from beardyn_core.physics.bodies.rates import BLOCK_NS, WAVEFORM_RATE
from beardyn_core.physics.tiers.kinematics import (
    INSTANT_CAGES,
    INSTANT_ROLLERS,
    INSTANT_SHAFT,
    Instants,
    Snapshots,
    write_instants,
)
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.scene.scene import SNAPSHOT_RATES, Scene
from beardyn_core.scene.sensor import RATES
from beardyn_core.sensors.block import Block, EnergyAudit
from beardyn_core.sensors.resampling import DELAY, AnyDecimator, Decimator, Interpolator, decimator, delay
from beardyn_core.sensors.sensor_set import BLOCKS_PER_SECOND, REST, TREND_RATE, Sensors, lookahead

TRENDS_PER_BLOCK = BLOCK_NS * TREND_RATE // 1_000_000_000
_TREND_NS = 1_000_000_000 // TREND_RATE
_TREND_CHANNELS = 10


class Observer:
    """Turns the kernel's signals of a block into a `Block`.

    Waveforms pass an anti-alias filter from the step rate to 25.6 kHz or the slower one of the sensors, or
    are interpolated to it from longer steps, and trends pass another filter to 400 Hz. The delay of all
    filters is compensated: samples carry their true time and come a little later, so the first blocks hold
    fewer of them.

    Parameters
    ----------
    signal : float64 array, shape [SIGNAL_CHANNELS and those of the seats]
        Signals at rest, which fill the filters.
    """

    def __init__(self, scene: Scene, arrangement: Arrangement, parameters: Parameters, signal: Float) -> None:
        self._count = arrangement.roller_count
        self._finer = round(scene.snapshot_rate / SNAPSHOT_RATES[0])  # instants for each trend
        self._roller = parameters.roller
        self._cage_place = 0.5 * scene.bearing.row_spacing
        # a step's signals are those of its end: sample 0 stands at the end of the step before the first
        self._rate, wait = round(scene.waveform_rate), lookahead(scene)
        steps = scene.numerics.steps_per_sample * WAVEFORM_RATE / self._rate  # for each waveform sample
        self._waveforms: Decimator | Interpolator
        longer = round(1 / steps)  # samples of a step that is longer than one
        if steps < 1:
            self._waveforms = Interpolator(longer, SIGNAL_TORQUE, signal[:SIGNAL_TORQUE])
            late = delay(longer)
        else:
            every = round(steps)
            self._waveforms = Decimator(every, len(signal), signal, held_back=1)
            late = DELAY if every > 1 else 0
        self._sensors = Sensors(scene, late)
        channels = self._waveforms.channels
        self._held_back = Decimator(1, channels, signal[:channels], held_back=wait)
        self._waveform_delay = late + wait
        rest = np.concatenate([signal[:6], REST, signal[SIGNAL_TORQUE : SIGNAL_TORQUE + 1]])
        per_trend = self._rate // TREND_RATE
        carry = -self._waveform_delay % per_trend
        trends = (self._waveform_delay + carry) // per_trend
        # force and torque are decimated before anything is put between them
        self._slow_decimator: AnyDecimator | None = None
        if steps < 1:
            every = per_trend // longer
            slow = np.delete(rest, [6, 7, 8])
            self._slow_decimator = decimator(every, len(slow), slow, held_back=trends * every + 1)
            rest = REST
        self._trend_decimator = decimator(per_trend, len(rest), rest, held_back=carry)
        self._trend_delay = DELAY + trends
        # trends of a first accelerometer that runs faster than the other waveforms
        self._fast_decimator: AnyDecimator | None = None
        if scene.sensors and scene.sensors[0].rate > RATES[0]:
            per_trend = round(scene.sensors[0].rate / TREND_RATE)
            carry = (self._trend_delay - DELAY) * per_trend - self._sensors.delays[0]
            self._fast_decimator = decimator(per_trend, 3, REST, held_back=carry)
        # blocks hold views of it, so every block gets one of its own; the newest instant is the last
        self._instants = np.zeros((self._trend_delay + 1, INSTANT_ROLLERS + 4 * self._count))
        self._box_motion = np.zeros((self._sensors.kept, 6))

    def first_instant(self, rollers: Float, bodies: Float, load: Float) -> None:
        """Remember the instant t = 0.

        Parameters
        ----------
        rollers, bodies : float64 arrays
            State of the kernel.
        load : float64 array, shape [6]
        """
        rows = np.stack([load, load])
        write_instants(rollers[None], bodies[None], rows, 1, self._count, self._instants[-1:])

    def observe(
        self,
        index: int,
        signals: Float,
        loads: Float,
        rollers: Float | Instants,
        bodies: Float,
        status: int,
        audit: EnergyAudit | None,
        wall_s: float,
        temperature: Float | None = None,
    ) -> Block:
        """Make the block of the signals that the kernel just wrote.

        Parameters
        ----------
        index : int
            Running number of the block, the first one of several.
        signals : float64 array, shape [step, SIGNAL_CHANNELS]
        loads : float64 array, shape [step + 1, 10]
        rollers, bodies : float64 arrays, shape [instant, ...]
            Copies of the state at twice the rate of the snapshots, or for the rollers what makes them; the
            block keeps them.
        temperature : float64 array or None, shape [node]
            [K].
        """
        pictures = self._pictures(rollers, bodies)
        slow = slice(self._finer - 1, None, self._finer)
        rollers, bodies = rollers[slow], np.ascontiguousarray(bodies[slow])
        if isinstance(rollers, np.ndarray):
            rollers = np.ascontiguousarray(rollers)
        waves = self._waveforms.push(signals)
        readings = self._sensors.read(index, waves, signals, self._motion(bodies), loads[:, 6])
        waves = self._held_back.push(waves)
        first_wave = index * (self._rate // BLOCKS_PER_SECOND) - self._waveform_delay
        reading = readings[0] if readings and self._fast_decimator is None else np.tile(REST, (len(waves), 1))
        blocks = len(bodies) // TRENDS_PER_BLOCK
        first_trend = index * TRENDS_PER_BLOCK - self._trend_delay
        keep_wave = slice(max(0, -first_wave), None)
        keep_trend = slice(min(max(0, -first_trend), len(bodies)), None)
        trends = self._trends(signals, waves, reading)
        if self._fast_decimator is not None:
            trends[:, 6:9] = self._fast_decimator.push(readings[0])
        trends = trends[keep_trend]
        first_kept = first_trend + keep_trend.start
        instants = self._remember(index + blocks, rollers, bodies, loads, first_kept, len(trends))
        waveform_sample = first_wave + keep_wave.start
        wave_index = np.arange(waveform_sample, first_wave + len(waves), dtype=np.int64)
        per_trend = self._finer / TRENDS_PER_SNAPSHOT
        first_snapshot = round(index * TRENDS_PER_BLOCK * per_trend) + 1
        snapshots = np.arange(first_snapshot, first_snapshot + round(len(bodies) * per_trend), dtype=np.int64)
        angles = INSTANT_ROLLERS + 2 * self._count
        return Block(
            index=index,
            start_ns=index * BLOCK_NS,
            end_ns=(index + blocks) * BLOCK_NS,
            waveform_sample=waveform_sample,
            waveform_time_ns=wave_index * 1_000_000_000 // self._rate,
            force_waveform=waves[keep_wave, SIGNAL_FORCE : SIGNAL_FORCE + 6],
            vibration=self._sensors.vibration(index, readings),
            trend_sample=first_kept,
            trend_time_ns=np.arange(first_kept, first_kept + len(trends), dtype=np.int64) * _TREND_NS,
            force=trends[:, :6],
            load=instants[:, :INSTANT_SHAFT],
            specific_force=trends[:, 6:9],
            shaft_angle=instants[:, INSTANT_SHAFT],
            shaft_speed=instants[:, INSTANT_SHAFT + 1],
            shaft_torque=trends[:, 9],
            cage_angle=instants[:, INSTANT_CAGES : INSTANT_CAGES + 2],
            cage_speed=instants[:, INSTANT_CAGES + 2 : INSTANT_ROLLERS],
            roller_angle=instants[:, INSTANT_ROLLERS:angles].reshape(-1, 2, self._count),
            roller_speed=instants[:, angles:].reshape(-1, 2, self._count),
            snapshot_sample=first_snapshot,
            snapshot_time_ns=snapshots * round(_TREND_NS / per_trend),
            pictures=pictures,
            status=status,
            audit=audit,
            wall_s=wall_s,
            temperature=temperature,
        )

    def _pictures(self, rollers: Float | Instants, bodies: Float) -> Snapshots:
        """Take the instants of the snapshots."""
        shown = slice(TRENDS_PER_SNAPSHOT - 1, None, TRENDS_PER_SNAPSHOT)
        return Snapshots(rollers[shown], bodies[shown], self._count, self._roller, self._cage_place)

    def _trends(self, signals: Float, waves: Float, reading: Float) -> Float:
        """Gather force, moment, specific force and torque at 400 Hz, shape [trend, 10]."""
        if self._slow_decimator is None:
            channels = np.empty((len(waves), _TREND_CHANNELS))
            _select(waves, reading, channels)
            return self._trend_decimator.push(channels)
        slow = np.empty((len(signals), 7))
        slow[:, :6] = signals[:, SIGNAL_FORCE : SIGNAL_FORCE + 6]
        slow[:, 6] = signals[:, SIGNAL_TORQUE]
        slow = self._slow_decimator.push(slow)
        trends = np.empty((len(slow), _TREND_CHANNELS))
        trends[:, :6], trends[:, 9] = slow[:, :6], slow[:, 6]
        trends[:, 6:9] = self._trend_decimator.push(reading)
        return trends

    def _remember(
        self, end: int, rollers: Float | Instants, bodies: Float, loads: Float, first: int, count: int
    ) -> Float:
        """Keep the instants number `first` and following; the newest is the beginning of block `end`."""
        kept = len(self._instants)
        instants = np.empty((kept + len(bodies), self._instants.shape[1]))
        instants[:kept] = self._instants
        stride = (len(loads) - 1) // len(bodies)
        orbits = rollers if isinstance(rollers, np.ndarray) else rollers.orbits()
        write_instants(orbits, bodies, loads, stride, self._count, instants[kept:])
        self._instants = instants[-kept:]
        place = len(instants) - 1 - end * TRENDS_PER_BLOCK + first
        return instants[place : place + count]

    def _motion(self, bodies: Float) -> Float:
        """Gather rotation and angular velocity of the box at 400 Hz, after those that filters still need."""
        kept = len(self._box_motion)
        motion = np.empty((len(bodies) + kept, 6))
        motion[:kept] = self._box_motion
        motion[kept:, :3] = bodies[:, CUP_BODY, TILT : TILT + 3]
        motion[kept:, 3:] = bodies[:, CUP_BODY, ANGULAR : ANGULAR + 3]
        self._box_motion = motion[-kept:]
        return motion


@entry
def _select(waves, reading, channels):
    """Copy the channels that the trends are made of: force, moment, specific force, torque."""
    for i in range(len(waves)):
        for j in range(6):
            channels[i, j] = waves[i, SIGNAL_FORCE + j]
        for j in range(3):
            channels[i, 6 + j] = reading[i, j]
        channels[i, 9] = waves[i, SIGNAL_TORQUE]

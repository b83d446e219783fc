"""From the kernel's raw signals to the channels of a block: filtered, delay-compensated, named."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.build import BLOCK_NS, SAMPLES_PER_BLOCK, WAVEFORM_RATE
from beardyn_core.model.layout import (
    ANGULAR,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    RATE,
    SIGNAL_ACCELERATION,
    SIGNAL_ANGULAR_ACCELERATION,
    SIGNAL_CHANNELS,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    TILT,
    TURN,
)
from beardyn_core.model.parameters import Parameters
from beardyn_core.observe.accelerometer import reading, specific_force
from beardyn_core.observe.block import Block, EnergyAudit
from beardyn_core.observe.decimate import DELAY, Decimator
from beardyn_core.observe.kinematics import RollerViews, ring_pose, ring_twist
from beardyn_core.scene.scene import Scene

Float = NDArray[np.float64]

TREND_RATE = 400
TRENDS_PER_BLOCK = BLOCK_NS * TREND_RATE // 1_000_000_000
TRENDS_PER_SNAPSHOT = 2
_WAVEFORMS_PER_TREND = WAVEFORM_RATE // TREND_RATE
_TREND_NS = 1_000_000_000 // TREND_RATE


@dataclass
class _Instant:
    """What the trends need of one instant at 400 Hz."""

    load: Float
    shaft_angle: float
    shaft_speed: float
    cage_angle: Float
    cage_speed: Float
    roller_angle: Float
    roller_speed: Float


class Observer:
    """Turns what the kernel wrote during a block into a `Block`.

    Waveforms pass an anti-alias filter from the step rate to 25.6 kHz and trends another one to 400 Hz.
    Both filters' delay is compensated: samples carry their true time and come a little later, so the
    first blocks hold fewer of them.

    Parameters
    ----------
    scene : Scene
    arrangement : Arrangement
    parameters : Parameters
    signal : float64 array, shape [SIGNAL_CHANNELS]
        Signals at rest, which fill the filters.
    """

    def __init__(self, scene: Scene, arrangement: Arrangement, parameters: Parameters, signal: Float) -> None:
        self._scene = scene
        self._arrangement = arrangement
        self._roller = parameters.roller
        self._cage_place = 0.5 * scene.bearing.row_spacing
        self._decimator = Decimator(scene.numerics.steps_per_sample, SIGNAL_CHANNELS, signal)
        self._waveform_delay = DELAY if scene.numerics.steps_per_sample > 1 else 0
        self._last_signal = signal[None].copy()
        rest = np.concatenate([signal[:6], [0.0, 0.0, 9.80665], signal[SIGNAL_TORQUE : SIGNAL_TORQUE + 1]])
        self._trend_decimator = Decimator(_WAVEFORMS_PER_TREND, 10, rest)
        carry = -self._waveform_delay % _WAVEFORMS_PER_TREND
        self._trend_delay = DELAY + (self._waveform_delay + carry) // _WAVEFORMS_PER_TREND
        self._carry = np.repeat(rest[None], carry, axis=0)
        self._instants: deque[_Instant] = deque(maxlen=self._trend_delay + TRENDS_PER_BLOCK + 1)
        self._box_motion = np.zeros((1, 6))

    def first_instant(self, rollers: Float, bodies: Float, load: Float) -> None:
        """Remember the instant t = 0.

        Parameters
        ----------
        rollers, bodies : float64 arrays
            State of the kernel.
        load : float64 array, shape [6]
        """
        self._remember(rollers[None], bodies[None], load[None])

    def _remember(self, rollers: Float, bodies: Float, loads: Float) -> RollerViews:
        views = RollerViews(rollers, bodies, self._arrangement, self._roller)
        for i in range(len(bodies)):
            self._instants.append(
                _Instant(
                    load=loads[i].copy(),
                    shaft_angle=float(bodies[i, CONE_BODY, TURN]),
                    shaft_speed=float(bodies[i, CONE_BODY, RATE]),
                    cage_angle=bodies[i, CAGE_BODY:, TURN].copy(),
                    cage_speed=bodies[i, CAGE_BODY:, RATE].copy(),
                    roller_angle=views.orbit_angle[i].copy(),
                    roller_speed=views.orbit_speed[i].copy(),
                )
            )
        return views

    def observe(
        self,
        index: int,
        signals: Float,
        loads: Float,
        rollers: Float,
        bodies: Float,
        status: int,
        audit: EnergyAudit | None,
        wall_s: float,
    ) -> Block:
        """The block of what the kernel just wrote.

        Parameters
        ----------
        index : int
            Running number of the block.
        signals : float64 array, shape [step, SIGNAL_CHANNELS]
        loads : float64 array, shape [step + 1, 10]
        rollers, bodies : float64 arrays, shape [trend, ...]
            Copies of the state at 400 Hz.
        status : int
        audit : EnergyAudit or None
        wall_s : float

        Returns
        -------
        Block
        """
        stream = np.concatenate([self._last_signal, signals[:-1]])
        self._last_signal = signals[-1:].copy()
        waves = self._decimator.push(stream)
        first_wave = index * SAMPLES_PER_BLOCK - self._waveform_delay
        acceleration = self._accelerations(waves, first_wave, bodies)
        first_sensor = acceleration[0] if len(acceleration) else np.tile([0.0, 0.0, 9.80665], (len(waves), 1))
        channels = np.concatenate(
            [
                waves[:, SIGNAL_FORCE : SIGNAL_FORCE + 6],
                first_sensor,
                waves[:, SIGNAL_TORQUE : SIGNAL_TORQUE + 1],
            ],
            axis=1,
        )
        held_back = np.concatenate([self._carry, channels])
        self._carry = held_back[len(channels) :]
        trends = self._trend_decimator.push(held_back[: len(channels)])
        first_trend = index * TRENDS_PER_BLOCK - self._trend_delay

        stride = len(signals) // TRENDS_PER_BLOCK
        views = self._remember(rollers, bodies, loads[stride::stride, :6])
        keep_wave = slice(max(0, -first_wave), None)
        keep_trend = slice(min(max(0, -first_trend), TRENDS_PER_BLOCK), None)
        trends = trends[keep_trend]
        first_kept = first_trend + keep_trend.start
        instants = self._instants_from(index, first_kept, len(trends))
        waveform_sample = first_wave + keep_wave.start
        wave_index = waveform_sample + np.arange(len(waves[keep_wave]))
        shown = slice(TRENDS_PER_SNAPSHOT - 1, None, TRENDS_PER_SNAPSHOT)
        snapshots = np.arange(TRENDS_PER_BLOCK)[shown] + 1 + index * TRENDS_PER_BLOCK
        pose = ring_pose(bodies[shown], self._cage_place)
        count = (len(snapshots), 2 * self._arrangement.roller_count)
        return Block(
            index=index,
            start_ns=index * BLOCK_NS,
            end_ns=(index + 1) * BLOCK_NS,
            waveform_sample=waveform_sample,
            waveform_time_ns=wave_index.astype(np.int64) * 1_000_000_000 // WAVEFORM_RATE,
            force_waveform=waves[keep_wave, SIGNAL_FORCE : SIGNAL_FORCE + 6],
            acceleration=acceleration[:, keep_wave],
            trend_sample=first_kept,
            trend_time_ns=(first_kept + np.arange(len(trends), dtype=np.int64)) * _TREND_NS,
            force=trends[:, :6],
            load=_stacked([i.load for i in instants], (6,)),
            specific_force=trends[:, 6:9],
            shaft_angle=_stacked([i.shaft_angle for i in instants], ()),
            shaft_speed=_stacked([i.shaft_speed for i in instants], ()),
            shaft_torque=trends[:, 9],
            cage_angle=_stacked([i.cage_angle for i in instants], (2,)),
            cage_speed=_stacked([i.cage_speed for i in instants], (2,)),
            roller_angle=_stacked([i.roller_angle for i in instants], (2, self._arrangement.roller_count)),
            roller_speed=_stacked([i.roller_speed for i in instants], (2, self._arrangement.roller_count)),
            snapshot_sample=int(snapshots[0]) // TRENDS_PER_SNAPSHOT,
            snapshot_time_ns=snapshots.astype(np.int64) * _TREND_NS,
            body_pose=np.concatenate([pose, views.pose()[shown].reshape(*count, 7)], axis=1),
            body_twist=np.concatenate(
                [ring_twist(bodies[shown]), views.twist()[shown].reshape(*count, 6)], axis=1
            ),
            contacts=views.contacts()[shown],
            status=status,
            audit=audit,
            wall_s=wall_s,
        )

    def _instants_from(self, index: int, first: int, count: int) -> list[_Instant]:
        """Remembered instants number `first` and following; the newest is the end of block `index`."""
        newest = (index + 1) * TRENDS_PER_BLOCK
        oldest = newest - len(self._instants) + 1
        held = list(self._instants)
        return held[first - oldest : first - oldest + count]

    def _accelerations(self, waves: Float, first_wave: int, bodies: Float) -> Float:
        """Readings of all accelerometers, shape [sensor, sample, 3]."""
        motion = np.concatenate(
            [self._box_motion, bodies[:, CUP_BODY, [*range(TILT, TILT + 3), *range(ANGULAR, ANGULAR + 3)]]]
        )
        held = np.arange(len(motion)) * _WAVEFORMS_PER_TREND
        at = np.arange(len(waves)) - self._waveform_delay
        tilt = np.stack([np.interp(at, held, motion[:, i]) for i in range(6)], axis=-1)
        self._box_motion = motion[-1:]
        first = max(first_wave, 0)
        skipped = first - first_wave
        readings = np.zeros((len(self._scene.sensors), len(waves), 3))
        for number, sensor in enumerate(self._scene.sensors):
            signal = specific_force(
                sensor.position,
                waves[:, SIGNAL_ACCELERATION : SIGNAL_ACCELERATION + 3].copy(),
                tilt[:, 3:],
                waves[:, SIGNAL_ANGULAR_ACCELERATION : SIGNAL_ANGULAR_ACCELERATION + 3],
                tilt[:, :3],
            )
            readings[number] = signal
            readings[number, skipped:] = reading(
                sensor, signal[skipped:], WAVEFORM_RATE, self._scene.seed, number, first
            )
        return readings

    def snapshot(self) -> tuple[object, ...]:
        """Everything the next block depends on."""
        return (
            self._decimator.state,
            self._trend_decimator.state,
            self._last_signal.copy(),
            self._carry.copy(),
            tuple(self._instants),
            self._box_motion.copy(),
        )

    def restore(self, snapshot: tuple[object, ...]) -> None:
        """Go back to a `snapshot`."""
        decimator, trend_decimator, last_signal, carry, instants, box_motion = snapshot
        self._decimator.restore(decimator)  # type: ignore[arg-type]
        self._trend_decimator.restore(trend_decimator)  # type: ignore[arg-type]
        self._last_signal = last_signal.copy()  # type: ignore[attr-defined]
        self._carry = carry.copy()  # type: ignore[attr-defined]
        self._instants = deque(instants, maxlen=self._instants.maxlen)  # type: ignore[call-overload]
        self._box_motion = box_motion.copy()  # type: ignore[attr-defined]


def _stacked(values: list[float] | list[Float], shape: tuple[int, ...]) -> Float:
    return np.array(values, dtype=np.float64).reshape(len(values), *shape)

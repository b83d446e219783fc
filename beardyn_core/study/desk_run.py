"""A desk run: one scene as fast as the machine can, every block into the sinks, and a summary."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.errors import InputError, ValidityError
from beardyn_core.integrate.status import describe
from beardyn_core.model.heat import NODES
from beardyn_core.observe.block import Block
from beardyn_core.observe.stage_clock import REST, SINKS, StageClock, StageTime
from beardyn_core.observe.torque_budget import TorqueBudget, torque_budget
from beardyn_core.rail.build import load_history
from beardyn_core.record.description import RunDescription
from beardyn_core.record.sinks import Sink
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.study.rating_life import RatingLife, scene_life
from beardyn_core.twin import Twin

COMPLETE = "complete"
# Oscillations of the start have died away by then; shorter runs are averaged over their second half.
SETTLING_S = 0.25

Float = NDArray[np.float64]


@dataclass(frozen=True)
class RunSummary:
    """What a run came to; means over the last whole cage revolutions.

    Parameters
    ----------
    scene, tier : str
    effects : tuple of str
        Names of the effects that were present.
    not_in_tier : tuple of str
        Names of the effects that the scene asks for and the tier does not represent.
    duration : float
        Simulated, [s].
    wall_time : float
        Spent in the simulation itself, without compiling, recording and drawing, [s].
    status : str
        ``complete``, or the sentence that says how the run left its validity.
    mean_force : tuple of 3 floats
        Of the rollers on the cup, world axes, [N].
    shaft_torque : float
        Mean torque of the bearing on the shaft, [N m].
    cage_speed_ratio : tuple of floats, one a row
        Cage speed over FTF and shaft speed, nominal 1; NaN with the shaft at rest.
    energy_residual : float or None
        Of the audit at the end; ``None`` without audit.
    budget : TorqueBudget or None
        Losses by source over the whole blocks of the means; ``None`` without audit.
    averaged : tuple of 2 floats
        First and last time of the means, [s].
    cage_revolutions : int
        Whole revolutions of the cage that the means cover; 0 when the run was shorter than one.
    life : RatingLife or None
        Under the run's load history; ``None`` when the shaft stood, or no equilibrium carries a load class.
    faults : tuple of str
        Defects and waviness of the scene in words.
    temperatures : tuple of (part, temperature) pairs
        At the end, with the thermal effect, [K].
    clipped : tuple of (sensor, samples, all samples) tuples
        Accelerometers that have read their largest value, and how often.
    stages : tuple of StageTime
        Where the wall time from the first block to the last went, recording and drawing included.
    """

    scene: str
    tier: str
    effects: tuple[str, ...]
    not_in_tier: tuple[str, ...]
    duration: float
    wall_time: float
    status: str
    mean_force: tuple[float, float, float]
    shaft_torque: float
    cage_speed_ratio: tuple[float, ...]
    energy_residual: float | None
    budget: TorqueBudget | None
    averaged: tuple[float, float]
    cage_revolutions: int
    life: RatingLife | None = None
    faults: tuple[str, ...] = ()
    temperatures: tuple[tuple[str, float], ...] = ()
    clipped: tuple[tuple[str, int, int], ...] = ()
    stages: tuple[StageTime, ...] = ()

    @property
    def real_time_factor(self) -> float:
        """Simulated over wall time."""
        return self.duration / self.wall_time if self.wall_time > 0.0 else math.inf

    @property
    def nothing_to_average(self) -> bool:
        """Whether the run ended before its first trend sample had passed the filters."""
        return self.averaged[1] == 0.0

    @property
    def complete(self) -> bool:
        """Whether the run came to its end inside the model's validity."""
        return self.status.startswith(COMPLETE)


def run(
    scene: Scene,
    sinks: Sequence[Sink] = (),
    progress: Callable[[Block], None] | None = None,
) -> RunSummary:
    """Simulate a scene to its end.

    Parameters
    ----------
    scene : Scene
    sinks : sequence of Sink
        Opened, fed and closed here; closed also when the run fails or is interrupted.
    progress : callable, optional
        Called with every block once the sinks have it.

    Raises
    ------
    InputError
        The load could not be made and no sink has been opened; or a sink could not be written, then all
        are closed.
    """
    twin = Twin(scene)
    block_count = max(1, math.ceil(scene.duration * 1e9 / twin.block_ns - 1e-6))
    load = load_history(scene.operation, scene.mounting, block_count * twin.block_ns * 1e-9, scene.seed)
    twin.warm()
    twin.start(load)
    description = RunDescription.of(scene, twin.truth(), twin.body_names, load)

    trend = _Trend(scene.sensors)
    wall_time = 0.0
    status = COMPLETE
    opened: list[Sink] = []
    closing = "the run was interrupted before its end"
    try:
        for sink in sinks:
            sink.open(description)
            opened.append(sink)
        # who records gets every block by itself
        at_once = 1 if sinks else twin.blocks_at_once
        for first in range(0, block_count, at_once):
            began = time.perf_counter()
            try:
                block = twin.advance(min(at_once, block_count - first))
            except ValidityError as error:
                wall_time += time.perf_counter() - began
                status = str(error)
                if isinstance(error.block, Block):
                    _deliver(error.block, opened, trend, progress, twin.stages)
                break
            wall_time += time.perf_counter() - began
            _deliver(block, opened, trend, progress, twin.stages)
        if status == COMPLETE and trend.warnings:
            status = f"{COMPLETE}, but {describe(trend.warnings)}"
        closing = "" if status.startswith(COMPLETE) else status
    except InputError as error:
        _close(opened, str(error))
        raise
    except BaseException:
        _close(opened, closing)
        raise
    if failures := _close(opened, closing):
        raise InputError(failures)
    return replace(
        trend.summary(scene, wall_time, status),
        life=_life(scene, load.until(trend.end_ns)),
        stages=twin.stages.times(),
    )


def _life(scene: Scene, load: LoadHistory) -> RatingLife | None:
    """Rating life under the load of the run; a load that nothing can carry has none.

    The standards rate the whole bearing: neither has one that lacks rollers.
    """
    if scene.rows != 2 or scene.missing_rollers:
        return None
    try:
        return scene_life(scene, load)
    except ValidityError:
        return None


def _close(sinks: Sequence[Sink], status: str) -> list[str]:
    """Close every sink, also when one fails; gives what went wrong."""
    failures: list[str] = []
    with _undisturbed():
        for sink in sinks:
            try:
                sink.close(status)
            except InputError as error:  # the others are closed all the same
                failures += error.problems
    return failures


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Ignore Ctrl-C: an impatient second one must not cut the file that the first one closes."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before if before is not None else signal.SIG_DFL)


def _deliver(
    block: Block,
    sinks: Sequence[Sink],
    trend: _Trend,
    progress: Callable[[Block], None] | None,
    clock: StageClock,
) -> None:
    trend.add(block)
    clock.lap(REST)
    for sink in sinks:
        sink.write(block)
    if sinks:
        clock.lap(SINKS)
    if progress is not None:
        progress(block)
    clock.lap(REST)


class _Trend:
    """The 400 Hz signals of a run that its means are taken from."""

    def __init__(self, sensors: Sequence[Accelerometer]) -> None:
        self._sensors = sensors
        self._clipped = np.zeros((len(sensors), 2), np.int64)  # samples at the end of the range, and all
        self._blocks: list[tuple[Float, Float, Float, Float, Float]] = []
        self.end_ns = 0
        self._start_ns: int | None = None
        self._residual: float | None = None
        self._lost: list[tuple[float, ...]] = []  # block start [s], energy lost by source [J]
        self._temperature: Float | None = None
        self.warnings = 0

    def add(self, block: Block) -> None:
        """Keep the trend of a block."""
        if self._start_ns is None:
            self._start_ns = block.start_ns
        self.end_ns = block.end_ns
        self.warnings |= block.status
        self._temperature = block.temperature
        for counts, sensor, heard in zip(self._clipped, self._sensors, block.vibration, strict=True):
            counts[0] += int((np.abs(heard.acceleration) >= sensor.range).any(axis=1).sum())
            counts[1] += len(heard.acceleration)
        self._residual = None if block.audit is None else block.audit.residual
        if block.audit is not None and block.audit.losses:
            self._lost.append((block.start_ns * 1e-9, *block.audit.losses, block.audit.numerical))
        self._blocks.append(
            (
                block.trend_time_ns.astype(np.float64) * 1e-9,
                block.force[:, :3],
                block.shaft_torque,
                block.shaft_speed,
                block.cage_speed,
            )
        )

    def summary(self, scene: Scene, wall_time: float, status: str) -> RunSummary:
        """Means over the last whole cage revolutions after the settling time."""
        duration = round((self.end_ns - (self._start_ns or 0)) * 1e-9, 9)
        force, torque, shaft = (math.nan, math.nan, math.nan), math.nan, math.nan
        cage: tuple[float, ...] = (math.nan, math.nan)
        averaged, revolutions = (0.0, 0.0), 0
        budget = None
        # The filters' delay is compensated, so the first block may hold no trend yet.
        if any(len(times) for times, *_ in self._blocks):
            parts = zip(*self._blocks, strict=True)
            times, forces, torques, shafts, cages = (np.concatenate(part) for part in parts)
            first, revolutions = averaging_start(times, cages[:, 0])
            averaged = (first, float(times[-1]))
            fx, fy, fz = (time_mean(times, component, first) for component in forces.T)
            force, torque, shaft = (
                (fx, fy, fz),
                time_mean(times, torques, first),
                time_mean(times, shafts, first),
            )
            cage = tuple(time_mean(times, row, first) for row in cages.T)
            budget = self._budget(times, shafts, first)
        epicyclic = fault_frequencies(scene.bearing).ftf * shaft
        return RunSummary(
            scene=scene.name,
            tier=scene.tier,
            effects=tuple(name for name in scene.effect_names if name not in scene.missing_effects),
            not_in_tier=scene.missing_effects,
            duration=duration,
            wall_time=wall_time,
            status=status,
            mean_force=force,
            shaft_torque=torque,
            cage_speed_ratio=tuple(
                speed / epicyclic if epicyclic else math.nan for speed in cage[: scene.rows]
            ),
            energy_residual=self._residual,
            budget=budget,
            averaged=averaged,
            cage_revolutions=revolutions,
            faults=scene.fault_sentences,
            clipped=tuple(
                (sensor.name, int(count), int(total))
                for sensor, (count, total) in zip(self._sensors, self._clipped, strict=True)
                if count
            ),
            temperatures=()
            if self._temperature is None
            else tuple(zip(NODES, self._temperature.tolist(), strict=True)),
        )

    def _budget(self, times: Float, shaft_speed: Float, first: float) -> TorqueBudget | None:
        """Losses from the first block that begins in the averaged time to the begin of the last block."""
        lost = [row for row in self._lost if row[0] >= first]
        if len(lost) < 2:
            lost = self._lost
        if len(lost) < 2:
            return None
        energies = np.array(lost)
        within = (times >= energies[0, 0]) & (times <= energies[-1, 0])
        speed = float(np.abs(shaft_speed[within]).mean()) if within.any() else math.nan
        return torque_budget(energies[:, 0].tolist(), energies[:, 1:], speed)


def averaging_start(times: Float, cage_speed: Float) -> tuple[float, int]:
    """Where the last whole cage revolutions begin, not before the start has settled.

    Parameters
    ----------
    times : float64 array, shape [sample]
        [s].
    cage_speed : float64 array, shape [sample]
        [rad/s].

    Returns
    -------
    float
        Begin of the means, [s]. A run without a whole revolution is averaged from the settling time on.
    int
        Whole revolutions from there to the end.
    """
    settled = times[0] + min(SETTLING_S, 0.5 * (times[-1] - times[0]))
    if len(times) < 2:
        return float(settled), 0
    turned = _running_integral(times, np.abs(cage_speed)) / (2.0 * math.pi)
    to_end = turned[-1] - turned
    revolutions = int(turned[-1] - np.interp(settled, times, turned) + 1e-9)
    if revolutions == 0:
        return float(settled), 0
    return float(np.interp(-revolutions, -to_end, times)), revolutions


def time_mean(times: Float, values: Float, first: float) -> float:
    """Mean of a sampled signal, linear between its samples, from ``first`` to the last sample."""
    if len(times) < 2:
        return float(values[-1])
    integral = _running_integral(times, values)
    return float((integral[-1] - np.interp(first, times, integral)) / (times[-1] - first))


def _running_integral(times: Float, values: Float) -> Float:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
    return np.concatenate([[0.0], np.cumsum(steps)])

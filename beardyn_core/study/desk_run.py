"""A desk run: one scene as fast as the machine can, every block into the sinks, and a summary."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.interrupts import held_back, whole
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.physics.hertz_pressure import largest_pressure
from beardyn_core.physics.thermal import NODES
from beardyn_core.physics.tiers.status import describe
from beardyn_core.record.description import RunDescription
from beardyn_core.record.run_summary import life_of
from beardyn_core.record.sinks import MemorySink, Sink
from beardyn_core.run import Simulation, start
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.sensors.block import Block
from beardyn_core.sensors.stage_clock import REST, SINKS
from beardyn_core.sensors.summary import (
    COMPLETE,
    RunSummary,
    TorqueBudget,
    TrendMeans,
    torque_budget,
    trend_means,
)


def run(
    scene: Scene,
    sinks: Sequence[Sink] = (),
    progress: Callable[[Block], None] | None = None,
    life: bool = True,
) -> RunSummary:
    """Simulate a scene to its end.

    Parameters
    ----------
    scene : Scene
    sinks : sequence of Sink
        Opened, fed and closed here; closed also when the run fails or is interrupted.
    progress : callable, optional
        Called with every block once the sinks have it.
    life : bool
        Whether the summary holds the rating life, which can take longer than a short run.

    Raises
    ------
    InputError
        The load could not be made and no sink has been opened; or a sink could not be written, then all
        are closed.
    """
    return _run_started(start(scene), scene, sinks, progress, life)


@held_back()
def _run_started(
    simulation: Simulation,
    scene: Scene,
    sinks: Sequence[Sink],
    progress: Callable[[Block], None] | None,
    life: bool,
) -> RunSummary:
    """Run a started simulation; Ctrl-C finds no sink in the middle of a block."""
    twin, load = simulation.twin, simulation.load
    description = RunDescription.of(scene, twin.truth(), twin.body_names, load)

    trend = Trend(scene.sensors)
    wall_time = 0.0
    status = COMPLETE
    opened: list[Sink] = []

    def deliver(block: Block) -> None:
        trend.add(block)
        twin.stages.lap(REST)
        with whole():
            for sink in opened:
                sink.write(block)
        if opened:
            twin.stages.lap(SINKS)
        if progress is not None:
            progress(block)
        twin.stages.lap(REST)

    closing = "the run was interrupted before its end"
    try:
        for sink in sinks:
            sink.open(description)
            opened.append(sink)
        # a file gets every block by itself, so that it is current and each message has its own time
        several = all(isinstance(sink, MemorySink) for sink in sinks)
        clock = time.perf_counter
        began = clock()
        try:
            for block in simulation.blocks(twin.blocks_at_once if several else 1):
                wall_time += clock() - began
                deliver(block)
                began = clock()
        except ValidityError as error:
            wall_time += clock() - began
            status = str(error)
            if isinstance(error.block, Block):
                deliver(error.block)
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
        life=life_of(scene, load.until(trend.end_ns)) if life else None,
        stages=twin.stages.times(),
    )


def _close(sinks: Sequence[Sink], status: str) -> list[str]:
    """Close every sink, also when one fails; gives what went wrong."""
    failures: list[str] = []
    with ignore_interrupts():
        for sink in sinks:
            try:
                sink.close(status)
            except InputError as error:  # the others are closed all the same
                failures += error.problems
    return failures


@contextmanager
def ignore_interrupts() -> Iterator[None]:
    """Ignore Ctrl-C: an impatient second one must not cut the file that the first one closes."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before if before is not None else signal.SIG_DFL)


class Trend:
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
        self._largest = np.zeros(3)  # loads of a roller with cup, cone and rib, [N]
        self.warnings = 0

    def add(self, block: Block) -> None:
        """Keep the trend of a block."""
        if self._start_ns is None:
            self._start_ns = block.start_ns
        self.end_ns = block.end_ns
        self.warnings |= block.status
        self._temperature = block.temperature
        self._largest = np.maximum(self._largest, block.largest_loads)
        for counts, sensor, vibration in zip(self._clipped, self._sensors, block.vibration, strict=True):
            counts[0] += int((np.abs(vibration.acceleration) >= sensor.range).any(axis=1).sum())
            counts[1] += len(vibration.acceleration)
        self._residual = None if block.audit is None else block.audit.residual
        if block.audit is not None and block.audit.losses:
            self._lost.append((block.start_ns * 1e-9, *block.audit.losses, block.audit.numerical))
        times = block.trend_time_ns.astype(np.float64) * 1e-9
        channels = times, block.force[:, :3], block.shaft_torque, block.shaft_speed, block.cage_speed
        self._blocks.append(channels)

    def summary(self, scene: Scene, wall_time: float, status: str) -> RunSummary:
        """Summarise the run so far."""
        means, budget = TrendMeans(), None
        # The filters' delay is compensated, so the first block may hold no trend yet.
        if any(len(times) for times, *_ in self._blocks):
            times, *signals = (np.concatenate(part) for part in zip(*self._blocks, strict=True))
            means = trend_means(times, *signals)
            budget = self._budget(times, signals[2], means.averaged[0])
        return RunSummary(
            scene=scene.name,
            tier=scene.tier,
            effects=tuple(name for name in scene.effect_names if name not in scene.missing_effects),
            not_in_tier=scene.missing_effects,
            chosen=next(iter(scene.chosen), ""),
            duration=round((self.end_ns - (self._start_ns or 0)) * 1e-9, 9),
            wall_time=wall_time,
            status=status,
            mean_force=means.force,
            shaft_torque=means.torque,
            cage_speed_ratio=means.cage_speed_ratio(fault_frequencies(scene.bearing).ftf, scene.rows),
            energy_residual=self._residual,
            budget=budget,
            averaged=means.averaged,
            cage_revolutions=means.revolutions,
            faults=scene.fault_sentences,
            clipped=tuple(
                (sensor.name, int(count), int(total))
                for sensor, (count, total) in zip(self._sensors, self._clipped, strict=True)
                if count
            ),
            temperatures=()
            if self._temperature is None
            else tuple(zip(NODES, self._temperature.tolist(), strict=True)),
            shaft_speed=means.shaft_speed,
            largest_roller_load=float(self._largest[0]),
            largest_pressure=largest_pressure(scene.bearing, *self._largest[:2].tolist()),
            wheel_diameter=scene.operation.wheel_diameter
            if isinstance(scene.operation, QuarterVehicleOperation)
            else None,
        )

    def _budget(self, times: Float, shaft_speed: Float, first: float) -> TorqueBudget | None:
        """Sum up the losses from the first block within the averaged time to the begin of the last block."""
        lost = [row for row in self._lost if row[0] >= first]
        if len(lost) < 2:
            lost = self._lost
        if len(lost) < 2:
            return None
        energies = np.array(lost)
        within = (times >= energies[0, 0]) & (times <= energies[-1, 0])
        speed = float(np.abs(shaft_speed[within]).mean()) if within.any() else math.nan
        return torque_budget(energies[:, 0].tolist(), energies[:, 1:], speed)

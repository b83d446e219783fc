"""A run of several axleboxes at once: those of a wheelset, a bogie, a car or a train, in one process.

Kernels leave the interpreter free, so a few threads share the boxes of each round; the blocks are written in
the order of the boxes, so a recording has the same messages whatever the threads do.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Annotated as A

from beardyn_core import run
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.interrupts import held_back, whole
from beardyn_core.config.boxes import scene_of_box
from beardyn_core.physics.bodies.rates import BLOCK_NS
from beardyn_core.rail.build import length_of_load
from beardyn_core.rail.train import TrainLoads
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import Batch
from beardyn_core.record.sinks import TrainSink
from beardyn_core.run import Simulation
from beardyn_core.scene.axleboxes import Box
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.sensors.summary import COMPLETE, RunSummary
from beardyn_core.study.desk_run import Trend, ignore_interrupts

MOST_THREADS = 8
CLOSED_EARLY = "the run was interrupted before its end"


@dataclass
class BoxRun:
    """One axlebox on its way."""

    box: Box
    scene: A[Scene, "of this box alone"]
    simulation: Simulation
    description: RunDescription
    trend: Trend
    status: str = COMPLETE
    kept: A[list[Block], "blocks so far, where they are kept"] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the box."""
        return self.box.name

    def advance(self, blocks: int) -> Block | None:
        """Advance; ``None`` for a box whose model has left its validity before."""
        if self.status != COMPLETE:
            return None
        try:
            return self.simulation.twin.advance(blocks)
        except ValidityError as error:
            self.status = str(error)
            return error.block if isinstance(error.block, Block) else None

    def summary(self, wall_time: float) -> RunSummary:
        """Summarise the run of this box."""
        return self.trend.summary(self.scene, wall_time, self.status)


@dataclass(frozen=True)
class TrainRun:
    """The run of a train: every box with its summary."""

    boxes: tuple[BoxRun, ...]
    duration: A[float, "simulated, [s]"]
    wall_time: A[float, "of the rounds, recording included, [s]"]
    processor_time: A[float, "of all threads in them, [s]"]

    @property
    def summaries(self) -> dict[str, RunSummary]:
        """Summary of each box; the wall time is that of all together."""
        return {each.name: each.summary(self.wall_time) for each in self.boxes}

    @property
    def failures(self) -> tuple[str, ...]:
        """Boxes whose model has left its validity, and how, a sentence each."""
        return tuple(f"{each.name}: {each.status}" for each in self.boxes if each.status != COMPLETE)

    @property
    def real_time_factor(self) -> float:
        """Simulated time of all boxes at once over wall time."""
        return self.duration / self.wall_time if self.wall_time else math.inf


def start(scene: Scene) -> tuple[BoxRun, ...]:
    """Make the loads of all boxes, compile their kernels and solve their equilibria.

    Raises
    ------
    InputError, ValidityError
        The loads cannot be made, or there is no equilibrium under one.
    """
    train = scene.axleboxes
    assert train is not None
    blocks = max(1, math.ceil(scene.duration * 1e9 / BLOCK_NS - 1e-6))
    seconds = blocks * BLOCK_NS * 1e-9
    loads = TrainLoads(scene, train, train.boxes, length_of_load(scene, seconds))
    return tuple(_start_box(scene, box, loads, seconds) for box in train.boxes)


def _start_box(scene: Scene, box: Box, loads: TrainLoads, seconds: float) -> BoxRun:
    own, load = scene_of_box(scene, box), loads.of(box)
    try:
        simulation = run.start(own, seconds, load.history)
    except ValidityError as error:
        raise ValidityError(f"{box.name}: {error}") from error
    twin = simulation.twin
    place = {
        "name": box.name,
        "axle": box.axle,
        "side": box.side,
        "behind_first_wheel_m": load.behind,
        "begins_in_scene_s": load.begins,
    }
    truth = {**twin.truth(), "box": place}
    description = RunDescription.of(own, truth, twin.body_names, simulation.load)
    return BoxRun(box, own, simulation, description, Trend(own.sensors))


@held_back()
def advance(
    boxes: tuple[BoxRun, ...],
    sink: TrainSink | None = None,
    keep: bool = False,
    progress: Callable[[Mapping[str, Block]], None] | None = None,
) -> TrainRun:
    """Advance all boxes to the end, round by round.

    Parameters
    ----------
    boxes : tuple of BoxRun
        From `start`.
    sink : TrainSink, optional
        Opened, fed and closed here; closed also when the run fails or is interrupted.
    keep : bool
        Whether the blocks stay in memory, in `BoxRun.kept`.
    progress : callable, optional
        Called with the blocks of every round.

    Raises
    ------
    InputError
        The sink could not be written; it is closed.
    """
    began, processor, closing = time.perf_counter(), time.process_time(), CLOSED_EARLY
    if sink is not None:
        sink.open({each.name: each.description for each in boxes})
    try:
        for blocks, batches in _rounds(boxes, sink):
            with whole():
                for each in boxes:
                    if (block := blocks.get(each.name)) is not None:
                        each.trend.add(block)
                        if keep:
                            each.kept.append(block)
                        if sink is not None:
                            sink.write(batches[each.name])
            if progress is not None:
                progress(blocks)
        closing = "; ".join(f"{each.name}: {each.status}" for each in boxes if each.status != COMPLETE)
    except InputError as error:
        closing = str(error)
        raise
    finally:
        if sink is not None:
            with ignore_interrupts():
                sink.close(closing)
    seconds = max(each.trend.end_ns for each in boxes) * 1e-9
    return TrainRun(boxes, seconds, time.perf_counter() - began, time.process_time() - processor)


def _rounds(
    boxes: tuple[BoxRun, ...], sink: TrainSink | None
) -> Iterator[tuple[dict[str, Block], dict[str, list[Batch]]]]:
    """Advance every box by as many blocks as all may take at once, and encode them, in a few threads."""
    at_once = min(each.simulation.twin.blocks_at_once for each in boxes)
    count = boxes[0].simulation.block_count

    def advanced(each: BoxRun, blocks: int) -> tuple[str, Block | None, list[Batch]]:
        block = each.advance(blocks)
        return each.name, block, [] if sink is None or block is None else sink.encode(each.name, block)

    waiting: list[tuple[str, Block | None, list[Batch]]] = []
    workers = min(MOST_THREADS, os.cpu_count() or 1, len(boxes))
    with ThreadPoolExecutor(workers, thread_name_prefix="box") as pool:
        for first in range(0, count, at_once):
            size = min(at_once, count - first)
            going = [pool.submit(advanced, each, size) for each in boxes]
            if waiting:  # written while the next round is computed
                yield _sort_results(waiting)
            waiting = [each.result() for each in going]
        yield _sort_results(waiting)


def _sort_results(
    found: list[tuple[str, Block | None, list[Batch]]],
) -> tuple[dict[str, Block], dict[str, list[Batch]]]:
    blocks = {name: block for name, block, _ in found if block is not None}
    return blocks, {name: batches for name, _, batches in found}

"""Two bearings at once on two cores: two threads of one process, and two processes.

One twin alone, two in threads and two in processes take turns of some blocks each; every ratio compares
turns that follow each other. The first run of a turn is not measured: it fills the caches that the other
kind has emptied.
"""

from __future__ import annotations

import multiprocessing
import os
import statistics
import threading
import time
from collections.abc import Callable
from multiprocessing.connection import Connection

from beardyn_core.choice import load_scene
from beardyn_core.twin import Twin
from benchmarks.runs import Table, started

SCENE = "static_80kN"
BLOCKS = 10
TWINS = 2


def _advance(twin: Twin, blocks: int) -> tuple[float, float]:
    """Measure the wall time and the kernel's share of it, [s]."""
    began, kernel = time.perf_counter(), 0.0
    for _ in range(blocks):
        kernel += twin.advance().wall_s
    return time.perf_counter() - began, kernel


def _child(connection: Connection, blocks: int) -> None:
    """Run a twin in its own process: as many blocks as the connection asks for; 0 ends it."""
    twin = started(load_scene(SCENE, effects="standard"), blocks)
    connection.send(None)
    while count := connection.recv():
        connection.send(_advance(twin, count))


class _Children:
    """Twins in processes of their own."""

    def __init__(self, blocks: int) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipes: list[Connection] = []
        self._children = []
        for _ in range(TWINS):
            ours, theirs = context.Pipe()
            child = context.Process(target=_child, args=(theirs, blocks), daemon=True)
            child.start()
            self._pipes.append(ours)
            self._children.append(child)
        for pipe in self._pipes:
            pipe.recv()

    def run(self, blocks: int) -> float:
        """Measure the wall time until all have advanced, [s]."""
        began = time.perf_counter()
        for pipe in self._pipes:
            pipe.send(blocks)
        for pipe in self._pipes:
            pipe.recv()
        return time.perf_counter() - began

    def end(self) -> None:
        """Let them go."""
        for pipe, child in zip(self._pipes, self._children, strict=True):
            pipe.send(0)
            child.join()


def _in_threads(twins: list[Twin], blocks: int) -> float:
    """Measure the wall time until all have advanced, [s]."""
    threads = [threading.Thread(target=_advance, args=(twin, blocks)) for twin in twins]
    began = time.perf_counter()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return time.perf_counter() - began


def parallel(turns: int) -> Table:
    """Measure the throughput of two twins against one."""
    blocks = turns * (BLOCKS + 1) + 1
    twins = [started(load_scene(SCENE, effects="standard"), 2 * blocks) for _ in range(TWINS)]
    children = _Children(blocks)
    shares: list[float] = []

    def alone(count: int) -> float:
        wall, kernel = _advance(twins[0], count)
        shares.append(1.0 - kernel / wall)
        return wall

    kinds: dict[str, Callable[[int], float]] = {
        "one twin": alone,
        "two threads": lambda count: _in_threads(twins, count),
        "two processes": children.run,
    }
    walls: dict[str, list[float]] = {name: [] for name in kinds}
    try:
        for turn in range(turns):
            for name in kinds if turn % 2 else reversed(kinds):
                kinds[name](1)
                walls[name].append(kinds[name](BLOCKS))
    finally:
        children.end()
    rows = []
    for name, taken in walls.items():
        count = 1 if name == "one twin" else TWINS
        ratios = [count * one / two for one, two in zip(walls["one twin"], taken, strict=True)]
        rtf = count * BLOCKS * twins[0].block_ns * 1e-9 / statistics.median(taken)
        rows.append((name, rtf, statistics.median(ratios), min(ratios), max(ratios)))
    python = statistics.median(shares)
    return Table(
        "parallel",
        f"Two bearings in parallel, {SCENE}, {turns} turns of {BLOCKS} blocks",
        ("run", "simulated s per wall s", "throughput against one", "least", "most"),
        rows,
        f"{100 * python:.1f} % of a block is outside the time step and holds the interpreter lock at most; "
        f"{os.cpu_count()} cores, {len(os.sched_getaffinity(0))} of them ours, "
        f"load average {os.getloadavg()[0]:.2f}",
    )

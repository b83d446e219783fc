"""Twins that take turns, and the tables that measurements end in."""

from __future__ import annotations

import os
import platform
import statistics
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numba
import numpy as np

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

SETTLING_BLOCKS = 3
Cell = str | float | int


@dataclass(frozen=True)
class Table:
    """A result: for the terminal, for JSON and for the documentation.

    Parameters
    ----------
    name : str
        Key in the JSON file.
    title, note : str
    columns : tuple of str
    rows : sequence of tuples of cells
    """

    name: str
    title: str
    columns: tuple[str, ...]
    rows: Sequence[tuple[Cell, ...]]
    note: str = ""

    def lines(self) -> list[str]:
        """Write the table for the terminal."""
        cells = [self.columns, *(tuple(shown(cell) for cell in row) for row in self.rows)]
        widths = [max(len(row[i]) for row in cells) for i in range(len(self.columns))]
        text = [
            "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in cells
        ]
        return ["", self.title, "-" * len(self.title), *text, *([self.note] if self.note else [])]

    def to_json(self) -> dict[str, Any]:
        """Gather title, note and rows as objects."""
        rows = [dict(zip(self.columns, row, strict=True)) for row in self.rows]
        return {"title": self.title, "note": self.note, "columns": list(self.columns), "rows": rows}


def shown(cell: Cell) -> str:
    """Write three significant digits, whole numbers whole."""
    if isinstance(cell, float):
        return f"{cell:.0f}" if abs(cell) >= 1000.0 else f"{cell:.3g}"
    return str(cell)


@dataclass
class Timing:
    """Wall times of the blocks of one twin, in the order of the turns, [s]."""

    twin: Twin
    kernel: list[float] = field(default_factory=list)
    total: list[float] = field(default_factory=list)

    def step_us(self) -> float:
        """Compute the median time of a step in the kernel, [us]."""
        return 1e6 * statistics.median(self.kernel) / (512 * self.twin.scene.numerics.steps_per_sample)

    def real_time_factor(self) -> float:
        """Divide simulated by wall time of the median block, all channels included."""
        return self.twin.block_ns * 1e-9 / statistics.median(self.total)

    def ratio_to(self, other: Timing) -> float:
        """Compute the median over the turns of the time against that of another twin."""
        return statistics.median(a / b for a, b in zip(self.total, other.total, strict=True))


def started(scene: Scene, blocks: int) -> Twin:
    """Make a twin at t = 0 with load for some blocks."""
    return start(scene, blocks * Twin.block_ns * 1e-9).twin


def take_turns(scenes: dict[str, Scene], turns: int) -> dict[str, Timing]:
    """Run scenes block by block in turns, so that a machine that slows down slows all of them."""
    count = turns + SETTLING_BLOCKS
    timings = {name: Timing(started(scene, count)) for name, scene in scenes.items()}
    for turn in range(count):
        for name in scenes if turn % 2 else reversed(scenes):
            timing = timings[name]
            began = time.perf_counter()
            block = timing.twin.advance()
            took = time.perf_counter() - began
            if turn >= SETTLING_BLOCKS:
                timing.total.append(took)
                timing.kernel.append(block.wall_s)
    return timings


STRETCH_S = 0.25
STRETCHES = 5


def measure_alone(
    scenes: dict[str, Scene], stretches: int = STRETCHES
) -> dict[str, tuple[float, float, float]]:
    """Measure the real-time factors of runs that each have the machine to themselves for a while.

    Parameters
    ----------
    scenes : dict
    stretches : int
        A stretch is a quarter of a second of one run, and the runs take turns with them, so that each
        has its data in the caches and a machine that slows down still slows all of them.

    Returns
    -------
    dict of name to 3 floats
        Medians over all advances: with blocks of 20 ms, with as many in one as a desk run takes, and with
        these and all that a block works out only when it is used.
    """
    found = {}
    for name, scene in scenes.items():
        probe = started(scene, SETTLING_BLOCKS + 1)
        began = time.perf_counter()
        for _ in range(SETTLING_BLOCKS):
            probe.advance()
        block_s = (time.perf_counter() - began) / SETTLING_BLOCKS
        found[name] = max(2 * probe.blocks_at_once, round(STRETCH_S / block_s))
    twins = {name: started(scene, 3 * stretches * found[name]) for name, scene in scenes.items()}
    walls: dict[str, tuple[list[float], ...]] = {name: ([], [], []) for name in scenes}
    for turn in range(stretches):
        for name in scenes if turn % 2 else reversed(scenes):
            twin = twins[name]
            for kind, at_once in enumerate((1, twin.blocks_at_once, twin.blocks_at_once)):
                took = []
                for _ in range(found[name] // at_once):
                    began = time.perf_counter()
                    block = twin.advance(at_once)
                    if kind == 2:
                        _ = block.body_pose, block.body_twist, block.contacts
                    took.append((time.perf_counter() - began) / at_once)
                walls[name][kind].extend(took[1:])
    found_factors = {}
    for name, kinds in walls.items():
        one, several, looked = (twins[name].block_ns * 1e-9 / statistics.median(kind) for kind in kinds)
        found_factors[name] = (one, several, looked)
    return found_factors


@dataclass(frozen=True)
class Line:
    """Straight line through measurements: value at 0, slope, coefficient of determination."""

    offset: float
    slope: float
    fit: float


def straight_line(x: list[float], y: list[float]) -> Line:
    """Fit a straight line by least squares."""
    slope, offset = np.polyfit(x, y, 1)
    left = np.asarray(y) - (offset + slope * np.asarray(x))
    spread = np.asarray(y) - np.mean(y)
    return Line(float(offset), float(slope), float(1.0 - (left @ left) / (spread @ spread)))


def machine() -> dict[str, Cell]:
    """Describe the machine on which the numbers were measured."""
    name = platform.processor() or platform.machine()
    cpu = Path("/proc/cpuinfo")
    if cpu.exists():
        models = [line.split(":")[1].strip() for line in cpu.read_text().splitlines() if "model name" in line]
        name = models[0] if models else name
    return {
        "processor": f"{name}, {LANE_WIDTH} rollers at once",
        "cores": os.cpu_count() or 1,
        "load_average_before": os.getloadavg()[0],
        "python": platform.python_version(),
        "numba": numba.__version__,
        "python_loop_s": _python_loop(),
    }


def _python_loop() -> float:
    """Time ten million turns of a plain loop, by which cores can be compared, median of three, [s]."""
    took = []
    for _ in range(3):
        began, total = time.perf_counter(), 0
        for number in range(10_000_000):
            total += number
        took.append(time.perf_counter() - began)
    return statistics.median(took)

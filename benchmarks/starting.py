"""Time until a run moves: compiling with an empty cache, and a cold start with a warm one.

Every measurement is a process of its own.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from itertools import pairwise
from pathlib import Path

from benchmarks.real_time_factor import SETS
from benchmarks.runs import Table

_ROOT = Path(__file__).resolve().parents[1]
_COMPILE = """
import json, sys, time
from beardyn_core.choice import load_scene
from beardyn_core.twin import Twin
twin = Twin(load_scene("static_80kN", effects=sys.argv[1], tier=sys.argv[2]))
cpu, wall = time.process_time(), time.perf_counter()
twin.warm()
print(json.dumps([time.perf_counter() - wall, time.process_time() - cpu]))
"""
# time.time() is the one clock that parent and child share
_START = """
import json, sys, time
stamps = [time.time()]
from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.study import desk_run
from beardyn_core.twin import Twin
stamps.append(time.time())
scene = load_scene(sys.argv[1], duration=0.1, effects="standard")
stamps.append(time.time())
twin = Twin(scene)
twin.warm()
stamps.append(time.time())
twin.start(load_history(scene.operation, scene.mounting, 0.1, scene.seed))
stamps.append(time.time())
twin.advance()
stamps.append(time.time())
print(json.dumps(stamps))
"""
_PARTS = ("interpreter", "imports", "scene", "kernels from the cache", "equilibrium", "first block")


def _run(code: str, *words: str, cache: str | None = None) -> list[float]:
    environment = {**os.environ, "PYTHONPATH": str(_ROOT)}
    if cache is not None:
        environment["BEARDYN_CACHE_DIR"] = cache
    done = subprocess.run(
        [sys.executable, "-c", code, *words], env=environment, capture_output=True, text=True, check=True
    )
    return [float(number) for number in json.loads(done.stdout)]


def compiling(sets: tuple[str, ...] = SETS) -> Table:
    """Compile the full tier for every shipped set, and the fast tiers for the standard one, with the time."""
    rows = []
    for tier, name in [("full", name) for name in sets] + [
        (t, "standard") for t in ("quasistatic", "lumped")
    ]:
        with tempfile.TemporaryDirectory() as cache:
            wall, processor = _run(_COMPILE, name, tier, cache=cache)
        rows.append((tier, name, wall, processor))
    return Table(
        "compiling",
        "Compiling the kernels, empty cache",
        ("tier", "effects", "wall s", "processor s"),
        rows,
    )


def cold_start(repetitions: int, scene: str = "smooth_run") -> Table:
    """Time from the start of the process to the end of the first block."""
    _run(_START, scene)  # fills the cache
    durations = []
    for _ in range(repetitions):
        begin = time.time()
        stamps = [begin, *_run(_START, scene)]
        durations.append([b - a for a, b in pairwise(stamps)])
    rows: list[tuple[str, float]] = [
        (part, statistics.median(column))
        for part, column in zip(_PARTS, zip(*durations, strict=True), strict=True)
    ]
    rows.append(("to the first block", statistics.median(sum(each) for each in durations)))
    return Table(
        "cold_start", f"Cold start of {scene}, kernels in the cache", ("part", "s"), rows,
        f"Medians of {repetitions} processes.",
    )  # fmt: skip

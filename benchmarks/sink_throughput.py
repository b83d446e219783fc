"""How fast blocks are recorded."""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

from beardyn_core.choice import load_scene
from beardyn_core.record.description import RunDescription
from beardyn_core.record.sinks import McapSink, MemorySink, Sink
from beardyn_core.run import start
from beardyn_core.twin import Twin
from benchmarks.runs import Table


def sinks(blocks: int, repetitions: int) -> Table:
    """Write the blocks of one run into every sink, opening and closing included."""
    scene = load_scene("static_80kN", effects="standard")
    simulation = start(scene, blocks * Twin.block_ns * 1e-9)
    twin = simulation.twin
    description = RunDescription.of(scene, twin.truth(), twin.body_names, simulation.load)
    run = list(simulation.blocks())
    simulated = blocks * twin.block_ns * 1e-9
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.mcap"
        for name in ("mcap", "memory"):
            times = []
            for _ in range(repetitions):
                sink: Sink = McapSink(path, replace=True) if name == "mcap" else MemorySink()
                began = time.perf_counter()
                sink.open(description)
                for block in run:
                    sink.write(block)
                sink.close()
                times.append(time.perf_counter() - began)
            took = statistics.median(times)
            written = 1e-6 * path.stat().st_size if name == "mcap" else 0.0
            rows.append((name, blocks / took, written / took, written / simulated, 100.0 * took / simulated))
    return Table(
        "sinks",
        "Recording",
        ("sink", "blocks/s", "MB/s", "MB per simulated s", "% of a real-time second"),
        rows,
        f"Medians of {repetitions} recordings of {blocks} blocks of 20 ms.",
    )

"""How fast sets are made and read: throughput of the engine, memory, formats."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from beardyn_core.base.optional import library
from beardyn_core.config import read_sweep
from beardyn_core.experiments import Cluster, Engine, core_count
from beardyn_core.population.batch import run_batch
from beardyn_core.population.draw import rows_of
from beardyn_core.population.folder import done_rows, size_of
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.sweep_scenes import scenes_of
from evidence.population.sets import TRAINED

WORKERS = (1, 2, 4, 8)
CORES = (1, 2)  # of real runs
TOGETHER = 8  # runs of a task
SLOW_S = 0.5  # of a simulated slow run: it waits and takes no core
TASKS_A_WORKER = 12
RUNS_TIMED = 24  # of each worker, beside as many that only make it warm
BATCH = 64  # runs of a random batch
REPEATS = 3


def waited(number: int, seconds: float) -> int:
    """Take as long as a run, without a core."""
    time.sleep(seconds)
    return number


def engine_scaling() -> list[dict[str, float]]:
    """Measure the throughput of the engine on simulated slow runs, over the number of workers."""
    rows = []
    for workers in WORKERS:
        with Engine(Cluster(workers=workers)) as engine:
            list(engine.run(waited, range(workers), 0.01))  # every process has begun
            count = TASKS_A_WORKER * workers
            began = time.perf_counter()
            done = sum(1 for _ in engine.run(waited, range(count), SLOW_S))
            wall = time.perf_counter() - began
            assert engine.local is not None
            processes = psutil.Process(engine.local.process_id).children(recursive=True)
            memory = max(each.memory_info().rss for each in processes)
        ideal = SLOW_S * count / workers
        rows.append(
            {"workers": workers, "runs": done, "wall_s": wall, "efficiency": ideal / wall, "bytes": memory}
        )
    return rows


def formats(runs: LabelledSet) -> list[dict[str, Any]]:
    """Write the vibration of a set in several ways; measure size and time to read a random batch."""
    zarr, parquet, arrow = (
        library(name, "the comparison of formats", "sweep") for name in ("zarr", "pyarrow.parquet", "pyarrow")
    )
    chosen = runs.runs_of()
    values = np.stack([runs.arrays["vibration"][int(run)] for run in chosen[:256]])
    count, random = len(values), np.random.default_rng(0)
    batches = [random.choice(count, min(BATCH, count), replace=False) for _ in range(REPEATS)]
    blosc = [zarr.codecs.BloscCodec(cname="zstd", clevel=3, shuffle="bitshuffle")]
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for name, shards, chunks in (
            ("Zarr, a file for each run", None, 1),
            ("Zarr, 8 runs in a file, each by itself", 8, 1),
            ("Zarr, 8 runs in a file, together", None, 8),
        ):
            path = Path(folder) / name
            array = zarr.create_array(
                str(path), shape=values.shape, dtype="f4", chunks=(chunks, *values.shape[1:]),
                shards=None if shards is None else (shards, *values.shape[1:]), compressors=blosc,
            )  # fmt: skip
            array[:] = values
            opened = zarr.open_array(str(path), mode="r")
            read = _timed(batches, lambda batch, opened=opened: [opened[int(k)] for k in batch])
            found.append({"format": name, **_size(path, values, count), "read_s": read})
        for name, group in (("Parquet, a group of rows for each run", 1), ("Parquet, 8 runs in a group", 8)):
            path = Path(folder) / f"{name}.parquet"
            flat = np.moveaxis(values, 1, -1).reshape(count, -1)
            kind = arrow.list_(arrow.float32(), flat.shape[1])
            column = arrow.FixedSizeListArray.from_arrays(arrow.array(flat.reshape(-1)), type=kind)
            parquet.write_table(
                arrow.table({"vibration": column}), path, row_group_size=group, compression="zstd",
                use_dictionary=False, use_byte_stream_split=True,
            )  # fmt: skip
            file = parquet.ParquetFile(path)

            def rows_of(batch: Any, file: Any = file, group: int = group) -> list[Any]:
                groups = [(file.read_row_group(int(k) // group), int(k) % group) for k in batch]
                return [each["vibration"][k].values.to_numpy() for each, k in groups]

            read = _timed(batches, rows_of)
            found.append({"format": name, **_size(path, values, count), "read_s": read})
    return found


def _timed(batches: list[Any], read: Any) -> float:
    """Time the fastest reading of a batch, [s]."""
    walls = []
    for batch in batches:
        began = time.perf_counter()
        read(batch)
        walls.append(time.perf_counter() - began)
    return min(walls)


def _size(path: Path, values: Any, count: int) -> dict[str, float]:
    files = [path] if path.is_file() else [each for each in path.rglob("*") if each.is_file()]
    whole = sum(each.stat().st_size for each in files)
    return {"bytes_a_run": whole / count, "share": whole / values.nbytes}


def core_scaling() -> list[dict[str, float]]:
    """Measure real runs on one and on two processes: rate, processor time, time of workers without a run.

    Wall times are those of a machine that may have other work; processor times, and the share of a worker's
    time that it is in a run, are not.
    """
    rows = []
    for workers in CORES:
        count = RUNS_TIMED * workers
        sweep, label = read_sweep(TRAINED, runs=2 * count)
        scenes, drawn = scenes_of(sweep, label), rows_of(sweep)
        tasks = [tuple(drawn[first : first + TOGETHER]) for first in range(0, 2 * count, TOGETHER)]
        half = len(tasks) // 2
        with Engine(Cluster(workers=workers)) as engine:
            list(engine.run(run_batch, tasks[:half], scenes))
            before, own, began = _processor(engine), time.process_time(), time.perf_counter()
            batches = [ended.value for ended in engine.run(run_batch, tasks[half:], scenes)]
            wall = time.perf_counter() - began
            load = os.getloadavg()[0]
            spent = _processor(engine) - before + time.process_time() - own
        runs = [made for batch in batches for made in batch]
        inside = sum(made.processor for made in runs)
        rows.append(
            {
                "workers": workers,
                "runs": len(runs),
                "wall_s": wall,
                "load": load,
                "processor_s": inside / len(runs),
                "besides_s": (spent - inside) / len(runs),
                "bytes": max(batch.memory for batch in batches),
                "busy": sum(made.seconds for made in runs) / (workers * wall),
            }
        )
    return rows


def _processor(engine: Engine) -> float:
    """Sum the processor time of the scheduler and its workers, [s]."""
    assert engine.local is not None
    host = psutil.Process(engine.local.process_id)
    times = [each.cpu_times() for each in (host, *host.children(recursive=True))]
    return float(sum(each.user + each.system for each in times))


def made(runs: LabelledSet) -> dict[str, Any]:
    """Say what a set has taken: from its journal and its files."""
    done = done_rows(runs.folder)
    return {
        "sweep": runs.about["sweep"],
        "runs": len(done),
        "failed": runs.about["failed"],
        "processes": len({each["worker"] for each in done.values()}),
        "cores": core_count(),
        "worker_s": sum(float(each["seconds"]) for each in done.values()),
        "bytes_a_run": size_of(runs.folder) / len(done),
    }


PARTS: dict[str, Callable[[LabelledSet], Any]] = {
    "made": made,
    "engine": lambda _: engine_scaling(),
    "cores": lambda _: core_scaling(),
    "formats": formats,
}
"""What is measured, by the name of its part of the page."""

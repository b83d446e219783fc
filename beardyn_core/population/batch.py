"""What a worker does: several runs in one process, each to its signals, labels and features."""

from __future__ import annotations

import os
import platform
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.experiments.code_digest import simulator_digest
from beardyn_core.population.draw import Row
from beardyn_core.population.features import NAMES, VERDICT, judge_run
from beardyn_core.population.sweep_scenes import SweepScenes, bearing_name, check_rows
from beardyn_core.record.description import RunDescription
from beardyn_core.record.run import Run
from beardyn_core.record.tables import parts_of, signal_of
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.study.compiling import warm_once

try:
    import resource
except ImportError:  # Windows
    resource = None  # type: ignore[assignment]

DONE, FAILED = "complete", "failed"
_WIDE = ("angle",)  # grows without end: of eight bytes, the others of four


@dataclass(frozen=True)
class Array:
    """One array of a signal of a run."""

    values: A[NDArray[Any], "shape [sample, ...]"]
    dims: A[tuple[str, ...], "names of the axes after the time"]
    unit: str
    signal: A[str, "whose time it has"]


@dataclass(frozen=True)
class Made:
    """One run that is done."""

    run: int
    labels: A[dict[str, Any], "a row of the table"]
    features: A[dict[str, Any], "by `features.NAMES`"]
    arrays: A[dict[str, NDArray[Any]], "by name; empty where the run did not begin"]
    seconds: A[float, "wall time on its worker, [s]"]
    processor: A[float, "processor time of its worker meanwhile, [s]"] = 0.0
    shapes: A[
        dict[str, Array], "what the arrays are, without values; of the first whole run of a task alone"
    ] = field(default_factory=dict)
    times: A[dict[str, NDArray[np.int64]], "of each signal, [ns]; of the same run"] = field(
        default_factory=dict
    )
    code: A[str, "digest of the code of the worker; empty for a run that no worker has ended"] = ""
    worker: A[str, "process that did it: machine and process"] = "none"
    memory: A[int, "most that process had held by the end of the task, [byte]"] = 0


def run_batch(rows: Sequence[Row], scenes: SweepScenes) -> list[Made]:
    """Simulate runs one after the other in this process."""
    made, told = list[Made](), False
    for row in rows:
        done, arrays, times = _made(row, scenes)
        if arrays and not told and done.labels["status"] == DONE:
            shapes = {
                name: Array(each.values[:0], each.dims, each.unit, each.signal)
                for name, each in arrays.items()
            }
            done, told = replace(done, shapes=shapes, times=times), True
        made.append(done)
    process, memory = f"{platform.node()}:{os.getpid()}", most_memory()
    return [replace(each, code=code_digest(), worker=process, memory=memory) for each in made]


def most_memory() -> int:
    """Tell the most memory that this process has held at a time, [byte]; 0 where the system does not say."""
    if resource is None:
        return 0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else 1024 * most


def checked_batch(rows: Sequence[Row], scenes: SweepScenes) -> list[str]:
    """List what is wrong with the scenes of runs; see `check_rows`."""
    return check_rows(scenes, rows)


def code_digest() -> str:
    """Hash the code of this worker, and how many rollers its kernels take at once, which sets the bits."""
    return f"{simulator_digest()}-{LANE_WIDTH}"


def _made(row: Row, scenes: SweepScenes) -> tuple[Made, dict[str, Array], dict[str, NDArray[np.int64]]]:
    began, spent = time.perf_counter(), time.process_time()
    values = scenes.keys(row)[1]
    labels: dict[str, Any] = {"run": row.run, "status": FAILED, "reason": "", "bearing_id": ""}
    arrays: dict[str, Array] = {}
    times: dict[str, NDArray[np.int64]] = {}
    features: dict[str, Any] = {**dict.fromkeys(NAMES, float("nan")), VERDICT: ""}
    try:
        scene = scenes.scene(row)
        labels |= {"bearing_id": bearing_name(scene), "bearing_kind": scene.bearing.kind}
        run = simulated(scene)
        complete = run.status == DONE
        labels |= {"status": DONE if complete else FAILED, "reason": "" if complete else run.status}
        labels |= {name: value for name, value in run.labels.items() if name not in labels}
        arrays, times = arrays_of(run, scenes.sweep.signals)
        worked_out, verdict = judge_run(run, fault_frequencies(scene.bearing), scene.bearing.roller_count)
        features = {**worked_out, VERDICT: verdict}
    except (InputError, ValidityError) as error:
        labels |= {"status": FAILED, "reason": str(error)}
    except Exception as error:  # one run of thousands must not end the others
        labels |= {"status": FAILED, "reason": f"{type(error).__name__}: {error}"}
    labels = {name: value for name, value in labels.items() if name not in _NOT_LABELS} | values
    plain = {name: each.values for name, each in arrays.items()}
    took, spent = time.perf_counter() - began, time.process_time() - spent
    return Made(row.run, labels, features, plain, took, spent), arrays, times


# of no use to a learner, or the same in all runs and on the data card
_NOT_LABELS = (
    "purpose",
    "versions_beardyn",
    "versions_numba",
    "versions_numpy",
    "scene",
    "step_s",
    "laminae",
)


def simulated(scene: Scene) -> Run:
    """Simulate a scene; what ended it early is in the status of the run."""
    warm_once(scene)
    simulation = start(scene)
    twin, status, blocks = simulation.twin, DONE, list[Block]()
    description = RunDescription.of(scene, twin.truth(), twin.body_names, simulation.load, text="")
    try:
        blocks.extend(simulation.blocks(twin.blocks_at_once))
    except ValidityError as error:
        status = str(error)
        if isinstance(error.block, Block):
            blocks.append(error.block)
    return Run.of_blocks(blocks, description, status)


def arrays_of(run: Run, signals: tuple[str, ...]) -> tuple[dict[str, Array], dict[str, NDArray[np.int64]]]:
    """Take the arrays of some signals of a run, and the times of each, [ns]."""
    arrays: dict[str, Array] = {}
    times: dict[str, NDArray[np.int64]] = {}
    for signal in signals:
        times[signal] = signal_of(run, signal).time_ns
        for part, array in parts_of(run, signal).items():
            kept = np.float64 if part in _WIDE else np.float32
            name = signal if part == "values" else f"{signal}_{part}"
            arrays[name] = Array(np.asarray(array.values, kept), array.dims, array.unit, signal)
    return arrays, times

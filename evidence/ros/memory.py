"""Whether the memory of the nodes stays flat: ``python -m evidence.ros.memory [--minutes 10]``."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np

from evidence.ros.costs import FAKE, NODES, start_all
from test.ros.graph import Graph

SAMPLE_PERIOD_S = 2.0
WARM_UP = 0.4  # of the time: buffers and pools fill, every branch has run
LARGEST_GROWTH = 20.0  # MB in an hour: what a day may add is then less than half a gigabyte
LOOP_S = 600.0
CURVE_MIN = (1, 2, 5, 10, 20, 30, 40, 50, 60)  # when the memory of every node is told


@dataclass(frozen=True)
class Growth:
    """How the memory of one node went on after the warm-up."""

    node: str
    begin: A[float, "resident, median of the first tenth, [MB]"]
    end: A[float, "the same of the last tenth, [MB]"]
    slope: A[float, "of a straight line through all, [MB/h]"]
    error: A[float, "standard error of it, neighbours taken as dependent, [MB/h]"]


def memory(
    graph: Graph, scene: str, seconds: float, speed: float, output: Path
) -> tuple[float, list[Growth]]:
    """Run all nodes and watch their resident memory.

    Parameters
    ----------
    graph : Graph
    scene : str
        `costs.FAKE` for a twin without physics.
    seconds : float
        On the wall clock, [s].
    speed : float
        Speed factor.
    output : Path
        Of the recorder.

    Returns
    -------
    tuple
        Simulated time, [s], and the growth of each node.
    """
    start_all(graph, scene, output, speed, duration=LOOP_S, loop=True)
    times: list[float] = []
    found: list[list[float]] = []
    moments = [60.0 * minutes for minutes in CURVE_MIN]
    begin = time.monotonic()
    while time.monotonic() - begin < seconds:
        graph.until(lambda: time.monotonic() >= begin + len(times) * SAMPLE_PERIOD_S, "the next look")
        times.append(time.monotonic() - begin)
        found.append([resident(graph.processes.pid(node)) for node in NODES])
        if moments and times[-1] >= moments[0]:
            each = ", ".join(f"{node} {mb:.1f}" for node, mb in zip(NODES, found[-1], strict=True))
            print(f"after {moments.pop(0) / 60.0:g} min: {each} MB", flush=True)
        del graph.messages["/diagnostics"][:-50]
    simulated = float(graph.statuses("twin")[-1].value("simulated_time"))
    late = np.array(times) > WARM_UP * seconds
    return simulated, [
        growth_of(node, np.array(times)[late], column[late])
        for node, column in zip(NODES, np.array(found).T, strict=True)
    ]


def growth_of(node: str, times: np.ndarray, resident_mb: np.ndarray) -> Growth:
    """Fit a straight line.

    Parameters
    ----------
    node : str
    times : array, shape [sample]
        [s].
    resident_mb : array, shape [sample]
        [MB].
    """
    hours = times / 3600.0
    slope, offset = np.polyfit(hours, resident_mb, 1)
    rest = resident_mb - slope * hours - offset
    deviation = np.sqrt(rest @ rest / max(len(rest) - 2, 1))
    # memory moves in steps: what is left beside the line is far from independent
    near = float(np.clip(rest[1:] @ rest[:-1] / max(rest @ rest, 1e-12), 0.0, 0.98))
    error = deviation / (np.std(hours) * np.sqrt(len(hours))) * np.sqrt((1.0 + near) / (1.0 - near))
    tenth = max(len(times) // 10, 1)
    return Growth(
        node, float(np.median(resident_mb[:tenth])), float(np.median(resident_mb[-tenth:])), slope, error
    )


def resident(pid: int) -> float:
    """Read the resident memory of a process that nobody else has, [MB]."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("RssAnon:"):
            return int(line.split()[1]) * 1024 / 1e6
    raise AssertionError(f"/proc/{pid}/status has no RssAnon")


def main(words: Sequence[str] | None = None) -> int:
    """Measure and print a table; gives 1 unless every node is shown to be flat."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.memory", description=__doc__)
    parser.add_argument("--scene", default=FAKE, help=f"scene by name or path; default {FAKE}: no physics")
    parser.add_argument("--minutes", type=float, default=10.0, help="on the wall clock (default 10)")
    parser.add_argument("--speed", type=float, default=3.0, help="speed factor (default 3)")
    args = parser.parse_args(words)
    with tempfile.TemporaryDirectory(prefix="memory-") as name, Graph(Path(name)) as graph:
        simulated, found = memory(graph, args.scene, 60.0 * args.minutes, args.speed, Path(name) / "run.mcap")
    print(f"{args.scene}: {args.minutes:g} min on the wall clock, {simulated / 60.0:.1f} min simulated")
    for each in found:
        print(
            f"{each.node:10}{each.begin:8.1f} ->{each.end:7.1f} MB, "
            f"{each.slope:+7.1f} +-{2.0 * each.error:5.1f} MB/h"
        )
    growing = [each.node for each in found if each.slope - 2.0 * each.error > LARGEST_GROWTH]
    flat = [each.node for each in found if each.slope + 2.0 * each.error <= LARGEST_GROWTH]
    unsure = [node for node in NODES if node not in growing + flat]
    for nodes, verdict in ((growing, "grow"), (unsure, "not shown flat, measure longer"), (flat, "flat")):
        if nodes:
            print(f"{verdict}: {', '.join(nodes)}")
    return int(len(flat) < len(NODES))


if __name__ == "__main__":
    sys.exit(main())

"""Processor time and memory of every node per simulated second: ``python -m evidence.ros.costs``."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import yaml

from beardyn_core.config.folders import find
from beardyn_ros.rig import SCENE_OWN
from test.ros.graph import Graph

NODES = ("twin", "load", "recorder", "monitor")
START_S = 6.0  # imports, discovery and the first analyses are not counted
FAKE = "fake"
PATIENCE_S = 900.0


@dataclass(frozen=True)
class Cost:
    """What one node took."""

    node: str
    cpu: A[float, "processor time per simulated second, [-]"]
    memory_before: A[float, "resident, [MB]"]
    memory_after: float


def costs(
    graph: Graph,
    scene: str,
    duration: float,
    output: Path,
    tier: str = SCENE_OWN,
    monitor: Mapping[str, object] | None = None,
) -> tuple[float, list[Cost], dict[str, str]]:
    """Run all nodes in real time and measure them.

    Parameters
    ----------
    graph : Graph
    scene : str
        `FAKE` for a twin without physics.
    duration : float
        Simulated time that is measured, [s].
    output : Path
        Of the recorder.
    tier : str
        Of the twin; by default the best that keeps the pace.
    monitor : mapping, optional
        Parameters of the monitor.

    Returns
    -------
    tuple
        Simulated time, the cost of each node, and the last values of the twin's diagnostic, of which
        `late_blocks` are those since the start-up; `pace` and `most_lag` are over the time measured, the lag
        as the diagnostic shows it every 0.2 s.
    """
    start_all(graph, scene, output, 1.0, tier, monitor, duration=duration + 2.0 * START_S, loop=False)
    begin, before = _at(graph, START_S)
    first = dict(graph.statuses("twin")[-1].values)
    lags: list[float] = []
    end, after = _at(graph, START_S + duration, lags)
    found = [Cost(n, (after[n][0] - before[n][0]) / (end - begin), before[n][1], after[n][1]) for n in NODES]
    values = dict(graph.statuses("twin")[-1].values)
    values["late_blocks"] = str(int(values["late_blocks"]) - int(first["late_blocks"]))
    simulated, wall = (float(values[key]) - float(first[key]) for key in ("simulated_time", "wall_time"))
    values["pace"], values["most_lag"] = f"{simulated / wall:.5f}", f"{max(lags):.3f}"
    return end - begin, found, values


def start_all(
    graph: Graph,
    scene: str,
    output: Path,
    speed: float,
    tier: str = SCENE_OWN,
    monitor: Mapping[str, object] | None = None,
    **replay: object,
) -> None:
    """Start all nodes, the load when everybody listens.

    Parameters
    ----------
    graph : Graph
    scene : str
        `FAKE` for a twin without physics.
    output : Path
        Of the recorder.
    speed : float
        Speed factor.
    tier : str
        Of the twin.
    monitor : mapping, optional
        Parameters of the monitor.
    **replay
        Parameters of the load node.
    """
    if scene == FAKE:
        graph.fake_twin(speed_factor=speed)
    else:
        graph.node_process("twin", scene=scene, speed_factor=speed, tier=tier)
    graph.node_process("recorder", output=str(output))
    graph.node_process("monitor", **(monitor or {}))
    listeners = ("recorder", "monitor")
    graph.until(
        lambda: all(any(s.value("connected") == "true" for s in graph.statuses(n)) for n in listeners),
        "recorder and monitor",
        timeout=PATIENCE_S,
    )
    if scene == FAKE:
        graph.fake_load(**replay)
    else:
        graph.node_process("load", scene=scene, **replay)


def _at(
    graph: Graph, moment: float, lags: list[float] | None = None
) -> tuple[float, dict[str, tuple[float, float]]]:
    """Wait for a simulated time; return it, and processor time and memory of each node; `lags` grows."""

    def simulated() -> float:
        found = graph.statuses("twin")
        if lags is not None:
            lags.append(max((float(each.value("lag") or 0.0) for each in found), default=0.0))
        del graph.messages["/diagnostics"][:-50]
        return float(found[-1].value("simulated_time") or 0.0) if found else 0.0

    graph.until(
        lambda: simulated() >= moment, f"simulated time {moment:g} s", timeout=PATIENCE_S + 2 * moment
    )
    return simulated(), {node: usage(graph.processes.pid(node)) for node in NODES}


def automatic(scene: str, folder: Path) -> str:
    """Write a scene with `numerics: auto`, and the standard effects if it names none; its path.

    Parameters
    ----------
    scene : str
        By name or path.
    folder : Path
    """
    content = yaml.safe_load(find("scenes", scene).read_text(encoding="utf-8"))
    path = folder / f"{content['scene']}_auto.yaml"
    path.write_text(
        yaml.safe_dump({"effects": "standard", **content, "numerics": "auto"}, sort_keys=False),
        encoding="utf-8",
    )
    return str(path)


def usage(pid: int) -> tuple[float, float]:
    """Read processor time [s] and resident memory [MB] of a process."""
    words = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    ticks = int(words[11]) + int(words[12])
    return ticks / os.sysconf("SC_CLK_TCK"), pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def main(words: Sequence[str] | None = None) -> int:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.costs", description=__doc__)
    parser.add_argument("--scene", default=FAKE, help=f"scene by name or path; default {FAKE}: no physics")
    parser.add_argument("--tier", default=SCENE_OWN, help="of the twin; default: as it chooses")
    parser.add_argument("--auto", action="store_true", help="with `numerics: auto` in the scene")
    parser.add_argument("--seconds", type=float, default=60.0, help="simulated time (default 60)")
    parser.add_argument(
        "--monitor", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the monitor"
    )
    args = parser.parse_args(words)
    monitor = dict(each.split("=", 1) for each in args.monitor)
    with tempfile.TemporaryDirectory(prefix="costs-") as name, Graph(Path(name)) as graph:
        scene = automatic(args.scene, Path(name)) if args.auto else args.scene
        span, found, values = costs(graph, scene, args.seconds, Path(name) / "run.mcap", args.tier, monitor)
    keys = ("pace", "late_blocks", "last_late_time", "most_lag")
    told = ", ".join(f"{key} {values.get(key)}" for key in keys)
    print(f"{args.scene}{' with numerics: auto' if args.auto else ''}: {span:.1f} s simulated, {told}")
    if values.get("tier_note"):
        print(values["tier_note"])
    for each in found:
        print(
            f"{each.node:10}{each.cpu:7.3f} CPU-s/s,{each.cpu / found[0].cpu:6.2f} of the twin's "
            f"{each.memory_before:8.1f} ->{each.memory_after:7.1f} MB"
        )
    print(f"{'others':10}{sum(each.cpu for each in found if each.node != 'twin'):7.3f} CPU-s/s")
    return 0


if __name__ == "__main__":
    sys.exit(main())

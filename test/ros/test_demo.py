"""The demonstration as a user starts it."""

from __future__ import annotations

import signal
from pathlib import Path

import psutil
import pytest

from test.ros.graph import Graph


def children_of(graph: Graph, name: str) -> list[psutil.Process]:
    return psutil.Process(graph.processes.pid(name)).children(recursive=True)


def test_demo_refuses_an_unknown_scene_and_starts_nothing(graph: Graph) -> None:
    out = graph.folder / "out"
    graph.processes.start(
        "demo", "-m", "beardyn_ros", "demo", "--scene", "no_such_scene", "--output", str(out)
    )
    assert graph.exit_code("demo") == 2
    log = graph.processes.log("demo")
    assert "no_such_scene" in log
    assert "Traceback" not in log
    assert not out.exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_no_node_outlives_a_demo_that_is_interrupted_or_killed(graph: Graph, number: signal.Signals) -> None:
    out = graph.folder / "out"
    graph.processes.start("demo", "-m", "beardyn_ros", "demo", "--output", str(out))
    graph.until(lambda: len(children_of(graph, "demo")) >= 3, "the nodes of the demo")
    nodes = children_of(graph, "demo")
    graph.processes.signal("demo", number)
    code = graph.exit_code("demo")
    _, alive = psutil.wait_procs(nodes, timeout=20.0)
    assert alive == []
    assert code == (130 if number == signal.SIGINT else -signal.SIGKILL)
    assert "Traceback" not in graph.processes.log("demo")


@pytest.mark.slow
def test_demo_finds_the_spall_and_leaves_its_files(graph: Graph) -> None:
    out = graph.folder / "out"
    words = ["--scene", "cup_spall", "--duration", "2.5", "--no-view", "--output", str(out)]
    graph.processes.start("demo", "-m", "beardyn_ros", "demo", *words)
    assert graph.processes.wait("demo", timeout=280.0) == 0, graph.processes.log("demo")
    log = graph.processes.log("demo")
    assert "monitor found         fault of the outer ring (cup)" in log
    assert "the monitor is right" in log
    assert "real-time factor" in log
    for name in ("run.mcap", "run.rrd", "summary.png"):
        assert (Path(out) / name).stat().st_size > 10_000

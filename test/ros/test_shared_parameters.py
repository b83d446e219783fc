"""One parameter file for all nodes: what one of them does not know is left to the others."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_ros.parameters import own_parameters
from test.ros.graph import Graph

SHARED = """
/**:
  ros__parameters:
    scene: fake
    exit_when_done: false
    start_timeout: 60.0
    wheel_profile: worn
"""


def started(graph: Graph, name: str, *words: str) -> None:
    file = graph.folder / "shared.yaml"
    graph.start(name, *words, "--ros-args", "--params-file", str(file))


def test_a_file_shared_by_all_nodes_starts_them_all(graph: Graph) -> None:
    (graph.folder / "shared.yaml").write_text(SHARED)
    started(graph, "twin", "test.ros.fake_twin", "twin")
    started(graph, "load", "test.ros.fake_twin", "load")
    for name in ("recorder", "monitor"):
        started(graph, name, "beardyn_ros", name)
    graph.until(
        lambda: all(graph.statuses(part) for part in ("twin", "load", "recorder", "monitor")),
        "a word of every node",
    )
    told = "not a parameter of this node, left to the others that share it: "
    assert f"{told}'wheel_profile'" in graph.processes.log("twin")
    monitor = graph.processes.log("monitor")
    assert told in monitor
    assert all(f"'{name}'" in monitor for name in ("scene", "start_timeout", "wheel_profile"))


@pytest.mark.parametrize("section", ["/axlebox/twin", "axlebox/twin"])
def test_an_unknown_name_under_the_node_itself_is_refused(graph: Graph, section: str) -> None:
    (graph.folder / "shared.yaml").write_text(f"{section}:\n  ros__parameters:\n    speeed_factor: 1.0\n")
    started(graph, "twin", "test.ros.fake_twin", "twin")
    assert graph.exit_code("twin") == 2
    assert "unknown parameter 'speeed_factor'" in graph.processes.log("twin")


def test_a_bad_value_of_a_known_name_is_refused_wherever_it_stands(graph: Graph) -> None:
    (graph.folder / "shared.yaml").write_text("/**:\n  ros__parameters:\n    start_timeout: -1.0\n")
    started(graph, "twin", "test.ros.fake_twin", "twin")
    assert graph.exit_code("twin") == 2
    assert "start_timeout" in graph.processes.log("twin")


def test_names_are_told_apart_by_where_they_stand(tmp_path: Path) -> None:
    file = tmp_path / "nodes.yaml"
    file.write_text(
        "/**: {ros__parameters: {a: 1}}\n"
        "axlebox:\n  twin: {ros__parameters: {b: {c: 2}}}\n  load: {ros__parameters: {d: 3}}\n"
    )
    words = ["--ros-args", "-p", "e:=1", "-p", "load:f:=1", "-p", "twin:g:=1", "--params-file", str(file)]
    assert own_parameters("/axlebox/twin", words) == {"b.c", "e", "g"}
    assert own_parameters("/axlebox/load", words) == {"d", "e", "f"}
    assert own_parameters("/axlebox/twin", ["-p", "e:=1"]) == set()

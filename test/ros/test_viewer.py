"""The viewer node: draws a live twin into a file; refuses a window where there is no display."""

from __future__ import annotations

import os

import pytest

from test.ros.graph import Graph


def test_viewer_draws_a_live_twin_into_a_file(graph: Graph) -> None:
    path = graph.folder / "live.rrd"
    graph.node_process("viewer", target="file", output=str(path), exit_when_done=True)
    graph.fake_twin(speed_factor=1.0)
    graph.until(lambda: graph.node.count_subscribers("/axlebox/bodies") > 0, "the viewer's subscription")
    graph.fake_load(duration=1.0)
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("viewer") == 0
    assert path.stat().st_size > 100_000
    assert "Traceback" not in graph.processes.log("viewer")


@pytest.mark.skipif(
    bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")), reason="a display is there"
)
def test_viewer_without_a_display_says_what_else_can_be_done(graph: Graph) -> None:
    graph.node_process("viewer")
    assert graph.exit_code("viewer") == 2
    log = graph.processes.log("viewer")
    assert "no display is set" in log
    assert "-p target:=web" in log
    assert "-p target:=file" in log
    assert "--web" not in log
    assert "Traceback" not in log

"""Nodes that are forked for the tests are processes like others: own session, own exit code, own words."""

from __future__ import annotations

import os
import signal

import psutil
import pytest

from test.ros.graph import Graph
from test.ros.nursery import Nursery


def test_a_forked_node_has_a_session_exit_code_and_log_of_its_own(graph: Graph) -> None:
    graph.fake_twin("first")
    graph.fake_twin("second", load_queue="no number")
    first = graph.processes.pid("first")
    graph.until(lambda: os.getsid(first) == first, "a session of its own")
    assert first != os.getsid(0)
    assert psutil.Process(first).ppid() != os.getpid()
    assert graph.exit_code("second") == 2
    assert "load_queue" in graph.processes.log("second")
    graph.processes.signal("first", signal.SIGKILL)
    assert graph.exit_code("first") == -signal.SIGKILL
    assert "load_queue" not in graph.processes.log("first")


def test_what_a_start_would_read_needs_a_start(
    nursery: Nursery | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    if nursery is None:
        pytest.skip("nodes are forked on Linux only")
    assert nursery.can_start("beardyn_ros", {**os.environ, "ROS_DOMAIN_ID": "42"})
    assert not nursery.can_start("beardyn_ros", {**os.environ, "PYTHONPATH": "/elsewhere"})
    assert not nursery.can_start("test.ros.slow_disk", os.environ)

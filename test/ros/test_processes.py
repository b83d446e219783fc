"""What a process that is killed can do to the others: nothing, and no child outlives its parent."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from beardyn_ros.environment import (
    FASTDDS_LOCAL_PROFILE,
    FASTDDS_PROFILE,
    PROFILE_VARIABLES,
    this_machine_only,
)
from beardyn_ros.processes import CHILD
from test.ros.conftest import ROS_IS_MISSING
from test.ros.graph import Graph


def shared_memory_of(pid: int) -> set[str]:
    """Files of shared memory that a process has open and the middleware has made."""
    words = [line.split() for line in Path(f"/proc/{pid}/maps").read_text().splitlines()]
    return {each[-1] for each in words if each[-1].startswith(("/dev/shm/fastdds", "/dev/shm/fastrtps"))}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
def test_no_node_shares_memory_in_which_a_killed_one_could_hold_a_lock(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    graph.fake_twin()
    monkeypatch.setitem(graph.processes._environment, "ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    monkeypatch.setitem(graph.processes._environment, PROFILE_VARIABLES[0], str(FASTDDS_PROFILE))
    graph.node_process("recorder", output=str(graph.folder / "run.mcap"))
    graph.until(lambda: any(s.value("connected") == "true" for s in graph.statuses("recorder")), "recorder")
    assert shared_memory_of(graph.processes.pid("twin")) == set()
    assert shared_memory_of(graph.processes.pid("recorder")) == set()


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("RMW_IMPLEMENTATION", "rmw_cyclonedds_cpp"),
        ("ROS_DISTRO", "jazzy"),
        (PROFILE_VARIABLES[0], "mine.xml"),
        (PROFILE_VARIABLES[1], "mine.xml"),
    ],
)
def test_where_the_profile_cannot_serve_nodes_stay_on_this_machine_by_localhost(
    name: str, value: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for each in ("ROS_DISTRO", *PROFILE_VARIABLES):
        monkeypatch.delenv(each, raising=False)
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    assert this_machine_only()[PROFILE_VARIABLES[0]] == str(FASTDDS_LOCAL_PROFILE)
    monkeypatch.setenv(name, value)
    assert this_machine_only() == {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks the kernel of Linux")
def test_a_child_whose_parent_is_gone_when_it_begins_does_nothing(tmp_path: Path) -> None:
    done = tmp_path / "done"
    words = [sys.executable, "-I", "-S", str(CHILD), "1", "-c", f"open({str(done)!r}, 'w')"]
    assert subprocess.run(words, check=False, timeout=60).returncode == 0
    assert not done.exists()


def test_a_child_takes_sigint_though_its_parent_held_it_back(tmp_path: Path, graph: Graph) -> None:
    script = tmp_path / "waits.py"
    script.write_text("import sys, time\nprint('waits', flush=True)\ntime.sleep(60)\n")
    graph.processes.start("waits", str(script))
    graph.until(lambda: "waits" in graph.processes.log("waits"), "the script")
    graph.processes.signal("waits", signal.SIGINT)
    assert graph.exit_code("waits") != 0
    assert "KeyboardInterrupt" in graph.processes.log("waits")
    graph.dismiss("waits")


@pytest.mark.skipif(ROS_IS_MISSING, reason="rclpy is not installed (pip install .[ros])")
@pytest.mark.parametrize("name", ["recorder_node", "load_node", "twin_node"])
def test_a_node_that_computes_nothing_yet_brings_no_compiler_along(name: str) -> None:
    """Numba takes a fifth of a second and 40 MB of every process that imports it."""
    code = (
        "from beardyn_ros.environment import prepare_environment\nprepare_environment()\n"
        f"import sys, beardyn_ros.{name}\nprint('numba' in sys.modules)"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "False"

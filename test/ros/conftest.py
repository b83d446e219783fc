from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from beardyn_ros.environment import prepare_environment
from test.ros.graph import Graph
from test.ros.nursery import Nursery

HERE = Path(__file__).parent
GRAPHS = {"nursery", "graph_of_new_processes"}
ROS_IS_MISSING = importlib.util.find_spec("rclpy") is None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents and GRAPHS & set(getattr(item, "fixturenames", ())):
            item.add_marker("ros")
            if ROS_IS_MISSING:
                item.add_marker(pytest.mark.skip(reason="rclpy is not installed (pip install .[ros])"))


@pytest.fixture(scope="session")
def nursery(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Nursery | None]:
    """Where the nodes of all tests of this process begin."""
    if not sys.platform.startswith("linux"):
        yield None
        return
    prepare_environment()
    begun = Nursery(tmp_path_factory.mktemp("nursery"))
    yield begun
    begun.end()


@pytest.fixture
def graph(tmp_path: Path, nursery: Nursery | None) -> Iterator[Graph]:
    with Graph(tmp_path, nursery) as running:
        yield running


@pytest.fixture
def graph_of_new_processes(tmp_path: Path) -> Iterator[Graph]:
    """Where each node is a new Python that begins and ends as a user's does."""
    with Graph(tmp_path) as running:
        yield running


@pytest.fixture(scope="session")
def _interface_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("interfaces")


@pytest.fixture
def built_interfaces(
    request: pytest.FixtureRequest, _interface_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Package for this test and its processes, built by rosidl of the wheels; name it before `graph`."""
    from test.ros.interfaces import can_build

    if not can_build():
        pytest.skip("g++ or the headers of the ROS 2 wheels are missing")
    folder = _interface_folder / request.param
    if not folder.exists():
        command = [sys.executable, "-m", "test.ros.interfaces", request.param, str(folder)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=500)
        assert done.returncode == 0, done.stdout + done.stderr
    monkeypatch.syspath_prepend(folder / "python")
    monkeypatch.setenv("PYTHONPATH", str(folder / "python"), prepend=os.pathsep)


@pytest.fixture(scope="session")
def compiled_kernels() -> None:
    """Kernels of the shipped spall scene in the disk cache, so that a real twin starts within seconds."""
    from beardyn_core.choice import load_scene
    from beardyn_core.twin import Twin

    Twin(load_scene("cup_spall")).warm()

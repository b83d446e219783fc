from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from pathlib import Path

import pytest

from test.ros.graph import Graph

HERE = Path(__file__).parent
ROS_IS_MISSING = importlib.util.find_spec("rclpy") is None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if HERE in item.path.parents and "graph" in getattr(item, "fixturenames", ()):
            item.add_marker("ros")
            if ROS_IS_MISSING:
                item.add_marker(pytest.mark.skip(reason="rclpy is not installed (pip install .[ros])"))


@pytest.fixture
def graph(tmp_path: Path) -> Iterator[Graph]:
    with Graph(tmp_path) as running:
        yield running


@pytest.fixture(scope="session")
def compiled_kernels() -> None:
    """Kernels of the shipped spall scene in the disk cache, so that a real twin starts within seconds."""
    from beardyn_core.choice import load_scene
    from beardyn_core.twin import Twin

    Twin(load_scene("cup_spall")).warm()

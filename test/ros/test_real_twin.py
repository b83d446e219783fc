"""The shipped spall scene over DDS: the same bits at any speed, and the same as on the desk."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.topics import topic
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.ros.conftest import ROS_IS_MISSING
from test.ros.graph import Graph

SCENE = "cup_spall"
DURATION = 0.4
BLOCKS = 20
SIGNALS = ("force", "force_waveform", "vibration")

pytestmark = [
    pytest.mark.ros,
    pytest.mark.skipif(ROS_IS_MISSING, reason="rclpy is not installed (pip install .[ros])"),
    pytest.mark.usefixtures("compiled_kernels"),
]


def signals_over_dds(folder: Path, speed_factor: float) -> dict[str, list[bytes]]:
    """Signal messages of one lockstep run of the real nodes."""
    folder.mkdir()
    with Graph(folder) as graph:
        graph.listen(*SIGNALS)
        graph.node_process("twin", scene=SCENE, speed_factor=speed_factor)
        graph.until(
            lambda: all(graph.node.count_publishers(topic(name).path()) for name in SIGNALS),
            "publishers of the signals",
        )
        graph.node_process("load", scene=SCENE, duration=DURATION)
        assert graph.exit_code("twin") == 0
        graph.until(lambda: len(graph.messages["vibration"]) == BLOCKS, "all blocks")
        return {name: graph.messages[name] for name in SIGNALS}


def blocks_on_the_desk() -> list[Block]:
    """The same run without ROS."""
    scene = load_scene(SCENE)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, DURATION, scene.seed))
    return [twin.advance() for _ in range(BLOCKS)]


def test_lockstep_of_the_real_twin_is_bit_identical_at_any_speed_and_on_the_desk(tmp_path: Path) -> None:
    runs = [signals_over_dds(tmp_path / str(factor), factor) for factor in (0.5, 0.0)]
    assert runs[0] == runs[1]
    vertical = np.concatenate([cloud_to_arrays(cdr)["az"] for cdr in runs[0]["vibration"]])
    desk = np.concatenate([block.acceleration[0, :, 2] for block in blocks_on_the_desk()])
    assert np.array_equal(vertical, desk.astype(np.float32))

"""Two streams with clocks of their own: one that drifts, and what is no second clock."""

from __future__ import annotations

import threading
import time

import numpy as np
import pytest

from beardyn_core.record.clouds import encode_points, fill, points_of
from beardyn_core.record.encoding import ACCELERATION_AXES, SHAFT_JOINT, VIBRATION, joint_template
from beardyn_ros.clocks_apart import ClocksApart
from test.ros.graph import Graph


class _Streams:
    """Vibration and shaft, 50 blocks a second, the vibration by a clock of its own."""

    def __init__(self) -> None:
        self.wall = 0.0
        self.clocks = ClocksApart("vibration", "shaft", lambda: self.wall)

    def run(self, seconds: float, ahead: float = 0.0, drift: float = 0.0, pace: float = 1.0) -> str:
        for _ in range(round(50 * seconds)):
            self.wall += 0.02
            time = pace * self.wall
            self.clocks.receive("vibration", round(1e9 * ((1.0 + drift) * time + ahead)))
            self.clocks.receive("shaft", round(1e9 * (time - 0.02)))
            self.clocks.look()
        return self.clocks.sentence


@pytest.mark.parametrize("ahead", [-3.2, 3.2])
def test_two_clocks_are_reported_with_their_distance(ahead: float) -> None:
    said, side = _Streams().run(6.0, ahead), "ahead of" if ahead > 0.0 else "behind"
    assert f"vibration is stamped {abs(ahead + 0.02):.2f} s {side} shaft" in said


def test_a_clock_that_drifts_is_reported_once_it_is_half_a_second_off() -> None:
    streams = _Streams()
    assert streams.run(20.0, drift=0.01) == ""
    assert "ahead of shaft" in streams.run(60.0, drift=0.01)


@pytest.mark.parametrize("pace", [0.1, 1.0, 20.0])
def test_one_clock_is_one_at_any_pace(pace: float) -> None:
    assert _Streams().run(20.0, pace=pace) == ""


def test_a_stream_that_pauses_is_no_second_clock() -> None:
    streams = _Streams()
    streams.run(6.0)
    for _ in range(500):  # the shaft is silent for ten seconds
        streams.wall += 0.02
        streams.clocks.receive("vibration", round(1e9 * streams.wall))
        streams.clocks.look()
    assert streams.clocks.sentence == ""
    assert streams.run(6.0) == ""


@pytest.mark.ros
def test_the_monitor_warns_of_a_sensor_with_a_clock_of_its_own(graph: Graph) -> None:
    shaft, ended = joint_template(SHAFT_JOINT, "axlebox", effort=False), threading.Event()
    for name in ("vibration", "shaft"):
        graph.out.publisher(name)

    def publish() -> None:
        block = 0
        while not ended.wait(0.02):
            now = time.time_ns()
            times = now + 3_200_000_000 + 39_062 * np.arange(512)
            points = points_of(VIBRATION, 512 * block, times, int(times[0]))
            fill(points, ACCELERATION_AXES, np.random.default_rng(block).normal(size=(512, 3)))
            graph.out.publish("vibration", encode_points(points, int(times[0]), "axlebox"))
            turned = np.array([[0.4 * block]])
            row = shaft.rows(np.array([now]), position=turned, velocity=np.full((1, 1), 20.0))[0]
            graph.out.publish("shaft", row.tobytes())
            block += 1

    graph.node_process("monitor", exit_when_done=False)
    sender = threading.Thread(target=publish)
    sender.start()
    try:
        graph.until(
            lambda: any("they have two clocks" in each.message for each in graph.statuses("monitor")),
            "the word about two clocks",
        )
        said = graph.statuses("monitor")[-1]
        assert said.message.startswith("vibration is stamped 3.2")
        assert said.level == 1
    finally:
        ended.set()
        sender.join()

"""A train that publishes live load by a clock of its own, for tests and the soak."""

from __future__ import annotations

import threading
import time

import numpy as np

from beardyn_ros.live_load import SHAFT_TOPIC, WRENCH_TOPIC, encode_shaft, encode_wrench
from test.ros.graph import Graph

EPOCH_S = 1.77e9


class LiveTrain:
    """Publishes live load from a thread, 200 messages a second, stamped by a clock of its own."""

    def __init__(self, graph: Graph, shaft_ahead: float = 0.0) -> None:
        for name in (WRENCH_TOPIC, SHAFT_TOPIC):
            graph.out.publisher(name)
        self._publish = graph.out.publish
        self._shaft_ahead = shaft_ahead
        self.ahead = EPOCH_S - time.monotonic()
        self._vertical = 40e3
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> LiveTrain:
        self._thread.start()
        return self

    def __exit__(self, *_exception: object) -> None:
        self._ended.set()
        self._thread.join()

    @property
    def now(self) -> float:
        """What its clock shows, [s]."""
        return time.monotonic() + self.ahead

    def _run(self) -> None:
        while not self._ended.wait(5e-3):
            wrench, now = np.array([0.0, 0.0, self._vertical, 0.0, 0.0, 0.0]), self.now
            self._publish(WRENCH_TOPIC, encode_wrench(wrench, round(1e9 * now)))
            self._publish(SHAFT_TOPIC, encode_shaft(30.0, round(1e9 * (now + self._shaft_ahead))))

    def step(self) -> int:
        """Let the vertical load leap by 40 kN; the stamp of that, [ns]."""
        self._vertical += 40e3
        return round(1e9 * self.now)

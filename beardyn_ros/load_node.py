"""Replays an operation, or a CSV of time, speed and force, as load of the twin.

`lockstep`: stamped blocks with sample numbers on ``load/blocks``, never further ahead of
``load/consumed`` than the horizon; an empty block ends the stream. `live`: one ``load/wrench`` and one
``load/shaft`` a sample, paced by the wall clock. A new run id on ``truth`` (a reset, or another twin)
starts the replay again.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from rclpy.node import Node

from beardyn_core.errors import InputError
from beardyn_core.record.load_stream import LONGEST_NS, encode_load
from beardyn_core.record.messages import TIME, decode, decode_string, header, make, serialize
from beardyn_core.record.topics import FRAME, TWIST, WRENCH, topic
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.runtime import EXIT_LOAD_LOST, run_node
from beardyn_ros.wire import RawIntake, TopicPublishers

HistoryLoader = Callable[[str, str, float], LoadHistory]

PUMP_PERIOD_S = 0.005
LAST_WORDS_TIMEOUT_S = 5.0
ALONE_TIMEOUT_S = 3.0
SETTLED_AFTER_S = 0.3  # a recorder may be found a moment later than the twin
LOOK_PERIOD_S = 0.1
IDLE_PERIOD_S = 0.2

PARAMETERS = (
    NodeParameter(
        "scene", "cup_spall", "shipped scene by name, or path of a scene file: its operation is replayed"
    ),
    NodeParameter("csv", "", "CSV file of time, speed and force, replayed instead of the scene's operation"),
    NodeParameter(
        "duration", 0.0, "simulated time to replay, 0 for the scene's own", "s", minimum=0.0, maximum=86_399.0
    ),
    NodeParameter(
        "mode",
        "lockstep",
        "lockstep sends load/blocks; live sends load/wrench and load/shaft, stamped in time of the load",
        choices=("lockstep", "live"),
    ),
    NodeParameter("horizon", 1.0, "how far to stay ahead of the credit", "s", minimum=0.1, maximum=60.0),
    NodeParameter("block", 0.1, "load in one message", "s", minimum=0.001, maximum=LONGEST_NS * 1e-9 / 2),
    NodeParameter(
        "live_rate", 200.0, "messages per wall second in live mode", "Hz", minimum=1.0, maximum=1000.0
    ),
    NodeParameter(
        "speed_factor",
        1.0,
        "simulated seconds per wall second in live mode, 0 means 1, as in the twin",
        minimum=0.0,
        maximum=100.0,
    ),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for a twin, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
    NodeParameter("exit_when_done", True, "end the process when everything is replayed and received"),
)


class LoadNode(Node):
    """Sends a `LoadHistory`.

    Parameters
    ----------
    load_history : callable or None
        ``load_history(scene, csv, duration)``; ``None``: scenes of the config room.
    """

    def __init__(self, load_history: HistoryLoader | None = None) -> None:
        super().__init__("load", namespace="axlebox")
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS)
        if self._values.block >= self._values.horizon:
            raise InputError(
                f"node load: block {self._values.block:g} s must be shorter than "
                f"horizon {self._values.horizon:g} s"
            )
        loader = load_history or scene_history
        self._history = loader(self._values.scene, self._values.csv, self._values.duration)
        self._live = self._values.mode == "live"
        self._out = TopicPublishers(
            self, "load/blocks", *(("load/wrench", "load/shaft") if self._live else ())
        )
        self._intake = RawIntake(self)
        self._intake.add(topic("load/consumed"), self._on_consumed, keep_all=False)
        self._intake.add(topic("truth"), self._on_truth)
        self._run_id = ""
        self._restart()
        self._announced = False
        self._listeners: tuple[int, ...] = ()
        self._listeners_since = time.monotonic()
        self._heard = False
        self._looked_at = 0.0
        self._alone_since = self._twinless_since = time.monotonic()
        span = (self._history.time_ns[-1] - self._history.time_ns[0]) * 1e-9
        self.get_logger().info(f"{len(self._history)} load samples over {span:.2f} s, waiting for a twin")
        self._busy_period_s = 1.0 / self._values.live_rate if self._live else PUMP_PERIOD_S
        self._timer = self.create_timer(IDLE_PERIOD_S, self._on_timer)

    def _restart(self) -> None:
        self._next = 0
        self._ended = False
        self._credit_ns = int(self._history.time_ns[0])
        self._live_begin: float | None = None

    def _on_consumed(self, cdr: bytes) -> None:
        stamp = decode(TIME, cdr)
        self._credit_ns = stamp.sec * 1_000_000_000 + stamp.nanosec

    def _on_truth(self, cdr: bytes) -> None:
        run_id = str(json.loads(decode_string(cdr)).get("run_id", ""))
        if self._run_id and run_id != self._run_id:
            self.get_logger().info("a new run has begun, the replay starts again")
            self._restart()
        self._run_id = run_id

    def _on_timer(self) -> None:
        (self._pump_live if self._live else self._pump)()
        idle = not self._announced or (self._ended and not self._values.exit_when_done)
        period_ns = round((IDLE_PERIOD_S if idle else self._busy_period_s) * 1e9)
        if self._timer.timer_period_ns != period_ns:
            self._timer.timer_period_ns = period_ns

    def _twin_listens(self) -> bool:
        """Whether the twin gets what is sent; looked up at intervals, it costs more than a send."""
        now = time.monotonic()
        if now - self._looked_at < LOOK_PERIOD_S:
            return self._heard
        self._looked_at = now
        self._heard = self._all_connected() and (
            self._announced or now - self._listeners_since > SETTLED_AFTER_S
        )
        if self._heard and not self._announced:
            self._announced = True
            self.get_logger().info("the twin listens, replay begins")
        if self._heard or not self._announced or self._ended:
            self._alone_since = now
        elif self._values.exit_when_done and now - self._alone_since > ALONE_TIMEOUT_S:
            self.get_logger().error("the twin has gone before everything was replayed")
            self.exit_code, self.finished = EXIT_LOAD_LOST, True
        timeout = self._values.start_timeout
        if not self._announced and 0.0 < timeout < now - self._twinless_since:
            self.get_logger().error(
                f"there has been no twin in {self.get_namespace()} for start_timeout = {timeout:g} s"
            )
            self.exit_code, self.finished = EXIT_LOAD_LOST, True
        return self._heard

    def _all_connected(self) -> bool:
        """Whether the twin, and every other listener that the graph knows, is connected.

        Recorder and monitor listen to the load too; the twin is the one that gives credit.
        """
        names = ("load/wrench", "load/shaft", "load/blocks") if self._live else ("load/blocks",)
        counts = tuple(self._out.publisher(name).get_subscription_count() for name in names)
        if counts != self._listeners:
            self._listeners, self._listeners_since = counts, time.monotonic()
        givers = self.get_publishers_info_by_topic(self.resolve_topic_name("load/consumed"))
        twins = {(info.node_namespace, info.node_name) for info in givers}
        if twins:
            self._twinless_since = time.monotonic()
        for name, count in zip(names, counts, strict=True):
            known = self.get_subscriptions_info_by_topic(self.resolve_topic_name(name))
            if count < len(known) or not twins & {(info.node_namespace, info.node_name) for info in known}:
                return False
        return True

    def _pump(self) -> None:
        if not (self._twin_listens() or self._ended):
            return
        times = self._history.time_ns
        horizon_ns = round(self._values.horizon * 1e9)
        block_ns = round(self._values.block * 1e9)
        while self._next < len(times):
            first = self._next
            last = max(int(np.searchsorted(times, times[first] + block_ns)), first + 1)
            if times[last - 1] > self._credit_ns + horizon_ns:
                break
            if not self._out.publish("load/blocks", encode_load(self._history.part(first, last), first)):
                return
            self._next = last
        if self._next == len(times):
            self._end_stream()

    def _pump_live(self) -> None:
        if not (self._twin_listens() or self._ended):
            return
        if self._live_begin is None:
            self._live_begin = time.monotonic()
        pace = self._values.speed_factor or 1.0
        times = self._history.time_ns
        now_ns = times[0] + round((time.monotonic() - self._live_begin) * pace * 1e9)
        index = int(np.searchsorted(times, now_ns, side="right")) - 1
        if index >= self._next:
            stamp, sample = int(times[index]), self._history.wrench[index]
            self._out.publish("load/wrench", encode_wrench(sample, stamp))
            self._out.publish("load/shaft", encode_shaft(float(self._history.shaft_speed[index]), stamp))
            self._next = index + 1
        if index == len(times) - 1:
            self._end_stream()

    def _end_stream(self) -> None:
        if not self._ended:
            empty = self._history.part(0, 0)
            self._ended = self._out.publish("load/blocks", encode_load(empty, len(self._history)))
            self.get_logger().info("everything is replayed, the stream is ended")
        elif self._values.exit_when_done:
            # The twin still reads: leaving before it has everything would lose the tail.
            listeners = self._out.publisher("load/blocks").get_subscription_count()
            self.finished = listeners == 0 or self._out.wait_until_received("load/blocks", 0.001)

    def close(self) -> bool:
        """Leave nothing half-sent; there is no thread to end."""
        self._out.wait_until_received("load/blocks", LAST_WORDS_TIMEOUT_S if self.finished else 0.0)
        return False


def encode_wrench(wrench: np.ndarray, stamp_ns: int) -> bytes:
    """CDR of one ``load/wrench``, shape [6], [N, N m]."""
    force = make("geometry_msgs/msg/Vector3", x=wrench[0], y=wrench[1], z=wrench[2])
    torque = make("geometry_msgs/msg/Vector3", x=wrench[3], y=wrench[4], z=wrench[5])
    content = make("geometry_msgs/msg/Wrench", force=force, torque=torque)
    return serialize(make(WRENCH, header=header(stamp_ns, FRAME), wrench=content))


def encode_shaft(speed: float, stamp_ns: int) -> bytes:
    """CDR of one ``load/shaft``, [rad/s] about +y."""
    zero = make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
    turning = make("geometry_msgs/msg/Vector3", x=0.0, y=speed, z=0.0)
    content = make("geometry_msgs/msg/Twist", linear=zero, angular=turning)
    return serialize(make(TWIST, header=header(stamp_ns, FRAME), twist=content))


def scene_history(scene_name: str, csv: str, duration: float) -> LoadHistory:
    """Load of a scene's operation, or of a CSV file.

    Parameters
    ----------
    scene_name : str
    csv : str
        '' for the scene's operation.
    duration : float
        0 for the scene's own, or the whole CSV, [s].
    """
    from beardyn_core.config import load_scene
    from beardyn_core.rail.build import load_history
    from beardyn_core.rail.measured import read_measurement
    from beardyn_core.scene.operation import MeasuredOperation

    scene = load_scene(scene_name)
    operation = scene.operation
    length = duration or scene.duration
    if csv:
        path = Path(csv)
        operation = MeasuredOperation(path)
        if not duration:
            time_s = read_measurement(path).time
            length = float(time_s[-1] - time_s[0])
    return load_history(operation, scene.mounting, length, scene.seed)


def main(argv: Sequence[str], load_history: HistoryLoader | None = None) -> int:
    """Run the node until everything is replayed."""
    return run_node(lambda: LoadNode(load_history), argv)

"""Records every topic of the table into a crash-safe MCAP file, one file a run."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rclpy.node import Node

from beardyn_core.errors import InputError
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, decode_string, encode_diagnostics
from beardyn_core.record.topics import TOPICS, Topic, topic
from beardyn_ros.diagnostics import OK, RECORDER, TWIN, WARN, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.recording import Recording, free_name, parsed_truth
from beardyn_ros.runtime import EXIT_BAD_INPUT, EXIT_LOAD_LOST, run_node, wall_timer
from beardyn_ros.twin_watch import TwinWatch
from beardyn_ros.wire import RawIntake, TopicPublishers

TICK_S = 0.1
REPORT_PERIOD_S = 0.5
TAIL_TIMEOUT_S = 3.0
MONITOR_TIMEOUT_S = 20.0
OLD_RUN_TIMEOUT_S = 1.0
TWIN_TOPICS = (
    "truth",
    "force",
    "force_waveform",
    "vibration",
    "imu",
    "shaft",
    "joint_states",
    "bodies",
    "contacts",
)

PARAMETERS = (
    NodeParameter(
        "output",
        "",
        "file to write; further runs get _2, _3; empty: <scene>_<date>.mcap here",
    ),
    NodeParameter("replace", False, "replace the file when it exists, instead of refusing to start"),
    NodeParameter("exit_when_done", True, "close the file and end the process when the twin has ended"),
    NodeParameter(
        "start_timeout", 120.0, "longest wait for a twin, 0 for ever", "s", minimum=0.0, maximum=1e6
    ),
)


class RecorderNode(Node):
    """Every topic of one axlebox into files.

    Parameters
    ----------
    **of_node
        Passed on to the node: another namespace, parameters.
    """

    def __init__(self, **of_node: Any) -> None:
        super().__init__("recorder", **{"namespace": "axlebox", **of_node})
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS)
        self._check_output()
        self._recording = Recording(self._path_of, self.get_namespace(), replace=self._values.replace)
        self._out = TopicPublishers(self, "/diagnostics")
        self._intake = RawIntake(self)
        self._names: set[str] = set()
        for entry in TOPICS:
            self._record(entry)
        self._watch = TwinWatch(
            diagnostic_name(self.get_namespace(), TWIN),
            lambda: self.count_publishers(topic("truth").path(self.get_namespace())),
        )
        self._ended_at: float | None = None
        self._monitor_done = False
        self._reported_at = 0.0
        self._announced_ready = False
        wall_timer(self, TICK_S, self._tick)
        self.get_logger().info(f"recorder of {self.get_namespace()} is waiting for a twin")

    def _check_output(self) -> None:
        output = self._values.output
        if output and not Path(output).expanduser().resolve().parent.is_dir():
            raise InputError(
                f"node recorder: output '{output}': the folder does not exist; create it or choose another"
            )
        if output and Path(output).expanduser().is_dir():
            raise InputError(f"node recorder: output '{output}' is a folder; a file name is needed")
        if output and Path(output).expanduser().is_file() and not self._values.replace:
            raise InputError(
                f"node recorder: output '{output}': the file exists; give another name, or replace:=true"
            )

    def _path_of(self, scene: str, number: int) -> Path:
        if self._values.output:
            path = Path(self._values.output).expanduser()
        else:
            path = Path(f"{scene}_{time.strftime('%Y%m%d_%H%M%S')}.mcap")
        if number > 1 or not self._values.replace:
            path = free_name(path, number)
        self.get_logger().info(f"recording into {path}")
        return path

    # --- messages ----------------------------------------------------------------------------------

    def _record(self, entry: Topic) -> None:
        if entry.name not in self._names:
            self._names.add(entry.name)
            self._intake.add(entry, self._handler(entry), complete=True)

    def _handler(self, entry: Topic) -> Callable[[bytes], None]:
        def take(cdr: bytes) -> None:
            self._recording.add(entry, cdr)
            if entry.name == "/diagnostics":
                self._watch.take_statuses(decode_diagnostics(cdr)[1])
            elif entry.name == "truth":
                self._on_truth(cdr)
            elif entry.name == "monitor/result":
                statuses = decode_diagnostics(cdr)[1]
                self._monitor_done = any(status.value("final") == "true" for status in statuses)

        return take

    def _on_truth(self, cdr: bytes) -> None:
        self._ended_at, self._monitor_done = None, False
        truth = parsed_truth(decode_string(cdr))
        self._watch.begin_run(str(truth.get("run_id", "")))
        description = truth.get("description")
        names = description.get("sensor_names", []) if isinstance(description, dict) else []
        for name in names[1:]:
            self._record(topic(f"vibration/{name}"))

    # --- state -------------------------------------------------------------------------------------

    def missing(self) -> list[str]:
        """List the topics of the twin that have no publisher yet."""
        counts = self._intake.publisher_counts()
        namespace = self.get_namespace()
        return [name for name in TWIN_TOPICS if not counts.get(topic(name).path(namespace), 0)]

    def _tick(self) -> None:
        self._intake.sweep()
        self._recording.flush_and_close_old(OLD_RUN_TIMEOUT_S)
        if not self._announced_ready and not self.missing():
            self._announced_ready = True
            self.get_logger().info("connected to every topic of the twin")
        if time.monotonic() - self._reported_at > REPORT_PERIOD_S:
            self._report()
        if self._watch.mixed and not self.finished:
            self.get_logger().error(self._watch.mixed)
            self._end(self._watch.mixed)
            self.exit_code, self.finished = EXIT_BAD_INPUT, True
        elif self._watch.ended:
            self._end_when_complete()
        elif self._watch.vanished() and self._recording.current is not None:
            self._end("the twin has vanished without a last word")
        if not self._recording.paths:
            self._give_up_without_twin()

    def _give_up_without_twin(self) -> None:
        timeout = self._values.start_timeout
        if 0.0 < timeout < self._watch.absent_for():
            self.get_logger().error(
                f"there has been no twin in {self.get_namespace()} for start_timeout = {timeout:g} s, "
                "nothing is recorded"
            )
            self.exit_code, self.finished = EXIT_LOAD_LOST, True

    def _end_when_complete(self) -> None:
        if self._recording.current is None:
            return
        now = time.monotonic()
        self._ended_at = self._ended_at or now
        wanted = int(self._watch.value("waveform_samples", 0))
        complete = self._recording.current.loss.received.get("vibration", 0) >= wanted
        waiting_for_tail = not complete and now - self._ended_at < TAIL_TIMEOUT_S
        monitored = self.count_publishers(topic("monitor/result").path(self.get_namespace())) > 0
        waiting_for_monitor = (
            monitored and not self._monitor_done and now - self._ended_at < MONITOR_TIMEOUT_S
        )
        if not (waiting_for_tail or waiting_for_monitor):
            if not complete:
                loss = self._recording.current.loss
                missing = wanted - loss.received.get("vibration", 0)
                self.get_logger().warning(
                    f"{missing} of {wanted} vibration samples are not in the file, "
                    f"{loss.missed_at_start} of them from before the recorder was there"
                )
            self._end(self._watch.end_sentence)

    def _end(self, status: str) -> None:
        self._intake.sweep()
        self._report()
        current = self._recording.current
        lost = self._recording.lost_samples
        self._recording.close(status)
        if current is not None:
            text = f"{current.path}: {current.message_count} messages, {lost} samples lost"
            self.get_logger().info(f"{text}. {status}" if status else text)
        if self._values.exit_when_done:
            self.finished = True

    def _report(self) -> None:
        self._reported_at = time.monotonic()
        current = self._recording.current
        missing = self.missing()
        lost = self._recording.lost_samples
        level, sentence = OK, "recording" if current else "waiting for a run"
        if lost:
            level, sentence = WARN, f"{lost} samples have been lost on the way"
        elif current is not None and current.problem:
            level, sentence = WARN, current.problem
        values = [
            ("connected", "false" if missing else "true"),
            ("missing_topics", " ".join(missing)),
            ("file", str(current.path) if current else ""),
            ("messages", str(current.message_count if current else 0)),
            ("lost_samples", str(lost)),
            ("missed_at_start", str(current.loss.missed_at_start if current else 0)),
        ]
        if current is not None:
            values += [(f"lost: {name}", str(count)) for name, count in sorted(current.loss.lost.items())]
        status = Diagnostic(diagnostic_name(self.get_namespace(), RECORDER), level, sentence, tuple(values))
        stamp = current.last_ns.get("load/consumed", 0) if current else 0
        self._out.publish("/diagnostics", encode_diagnostics(stamp, frame_of(self.get_namespace()), [status]))

    def close(self) -> bool:
        """Finish the file; there is no thread to end."""
        if self._recording.current is not None or not self.finished:
            self._intake.sweep()
            self._recording.close("" if self.finished else "the recorder was told to stop")
        return False


def main(argv: Sequence[str]) -> int:
    """Run the node until the twin has ended."""
    return run_node(RecorderNode, argv)

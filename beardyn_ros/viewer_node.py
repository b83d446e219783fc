"""Live view in rerun: a window, a page in the browser on this machine, or an ``.rrd`` file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from rclpy.node import Node

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, decode_string, encode_diagnostics
from beardyn_core.record.plot_values import MONITOR, value_topics
from beardyn_core.record.topics import topic, vibration_topic
from beardyn_core.record.viewer import has_display
from beardyn_ros.diagnostics import OK, TWIN, WARN, TwinWatch, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.message_guard import MessageGuard
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.runtime import run_node, wall_timer
from beardyn_ros.wire import RawIntake, TopicPublishers

TICK_S = 0.1
REPORT_PERIOD_S = 0.5
LAST_WORDS_TIMEOUT_S = 0.5
# What drawing raises on numbers of the right type that make no picture.
NOT_DRAWABLE = (InputError, ValueError, TypeError, LookupError, AttributeError, ArithmeticError)
DRAWN = (
    "truth",
    "force",
    "force_waveform",
    "vibration",
    "imu",
    "shaft",
    "joint_states",
    "bodies",
    "contacts",
    "load/blocks",
    "monitor/result",
    *value_topics(MONITOR),
    "follower/estimate",
    "follower/residual",
)


class ViewerNode(Node):
    """Feeds a `LiveView` with every message."""

    def __init__(self) -> None:
        super().__init__("viewer", namespace="axlebox")
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["viewer"])
        if self._values.target == "window" and not has_display():
            raise InputError(
                "node viewer: no display is set (DISPLAY, WAYLAND_DISPLAY): use `-p target:=web` for a page "
                "in a browser, or `-p target:=file` for an .rrd file"
            )
        library("rerun", "node viewer", "view")
        from beardyn_core.record.rerun_live import LiveView
        from beardyn_core.record.rerun_view import live_stream

        self._stack = ExitStack()
        stream = self._stack.enter_context(
            live_stream(self._values.target, Path(self._values.output).expanduser(), self._values.port)
        )
        self._view = LiveView(stream.stream)
        self._out = TopicPublishers(self, "/diagnostics")
        self._intake = RawIntake(self, polled=True)
        self._guard = MessageGuard(self)
        for name in DRAWN:
            self._draw(name)
        self._further: set[str] = set()
        diagnostics = topic("/diagnostics")
        guarded = self._guard.guard_handler(diagnostics, self._on_diagnostics)
        self._intake.add_sourced(diagnostics, guarded, keep_all=False)
        self._watch = TwinWatch(
            diagnostic_name(self.get_namespace(), TWIN),
            lambda: self._guard.sources.count("truth"),
        )
        wall_timer(self, TICK_S, self._tick)
        wall_timer(self, REPORT_PERIOD_S, self._report)
        self.get_logger().info(f"drawing into {stream.where}")

    def _draw(self, name: str) -> None:
        entry = topic(name)
        self._intake.add_sourced(entry, self._guard.guard_handler(entry, self._drawer(name)))

    def _drawer(self, name: str) -> Callable[[bytes], None]:
        def draw(cdr: bytes) -> None:
            try:
                self._view.feed(name, cdr)
                if name == "truth":
                    self._know(RunDescription.from_json(decode_string(cdr)))
            except NOT_DRAWABLE as error:
                self._guard.refuse(name, f"it cannot be drawn ({error})")

        return draw

    def _know(self, run: RunDescription) -> None:
        checker = self._guard.checker
        checker.body_count, checker.roller_count = len(run.body_names), run.roller_count
        for number in range(1, len(run.sensor_names)):
            name = vibration_topic(number, run.sensor_names)
            if name not in self._further:
                self._further.add(name)
                self._draw(name)

    def _on_diagnostics(self, cdr: bytes) -> None:
        self._watch.take_statuses(decode_diagnostics(cdr)[1])

    def _sweep(self) -> None:
        self._intake.sweep()
        self._guard.sources.look()
        try:
            self._view.flush()
        except NOT_DRAWABLE as error:
            self._guard.refuse("drawing", f"what has come cannot be drawn ({error})")

    def _tick(self) -> None:
        self._sweep()
        if self._watch.ended or self._watch.vanished():
            self.finished = bool(self._values.exit_when_done)

    def _report(self) -> None:
        status = Diagnostic(
            diagnostic_name(self.get_namespace(), "viewer"),
            WARN if self._guard.total else OK,
            self._guard.sentence() or "drawing",
            self._guard.values(),
        )
        self._out.publish("/diagnostics", encode_diagnostics(0, frame_of(self.get_namespace()), [status]))

    def close(self) -> bool:
        """Draw the rest and close the stream; there is no thread to end."""
        self._sweep()
        self._report()
        self._stack.close()
        self._out.wait_until_received("/diagnostics", LAST_WORDS_TIMEOUT_S)
        return False


def main(argv: Sequence[str]) -> int:
    """Run the node until it is stopped."""
    return run_node(ViewerNode, argv)

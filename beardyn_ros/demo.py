"""The main job in one go: load, twin, recorder and monitor as processes over real DDS."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.record.messages import Diagnostic, decode_diagnostics
from beardyn_core.study.demo_console import Progress, add_arguments, say
from beardyn_ros.environment import MISSING_ROS, prepare_environment, ros_available, this_machine_only
from beardyn_ros.processes import Processes, free_domain_id, local_environment
from beardyn_ros.rig import SCENE_OWN
from beardyn_ros.runtime import EXIT_BAD_INPUT, EXIT_DONE, EXIT_INVALID_MODEL

EXIT_FAILED, EXIT_INTERRUPTED = 1, 130
SPIN_S = 0.1
SILENCE_TIMEOUT_S = 180.0
END_TIMEOUT_S = 60.0
LEAST_REPORTED_S = 0.5
LOG_LINES_SHOWN = 15


class NodeFailureError(Exception):
    """A node has ended early or has fallen silent; the text says which and why."""

    def __init__(self, text: str, exit_code: int = EXIT_FAILED) -> None:
        super().__init__(text)
        self.exit_code = exit_code


def main(argv: Sequence[str]) -> int:
    """Run the demonstration; gives the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m beardyn_ros demo",
        description="Load, twin, recorder and monitor as processes of a ROS 2 graph of their own.",
    )
    add_arguments(parser)
    args = parser.parse_args(list(argv))
    prepare_environment()
    if not ros_available():
        print(MISSING_ROS, file=sys.stderr)
        return EXIT_BAD_INPUT
    try:
        return _demo(args)
    except InputError as error:
        for sentence in error.problems:
            print(f"beardyn: {sentence}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except ValidityError as error:
        print(f"beardyn: {error}", file=sys.stderr)
        return EXIT_INVALID_MODEL
    except NodeFailureError as failure:
        print(f"beardyn: {failure}", file=sys.stderr)
        return failure.exit_code
    except KeyboardInterrupt:
        print("\nbeardyn: interrupted, every node has been ended", file=sys.stderr)
        return EXIT_INTERRUPTED


def _demo(args: argparse.Namespace) -> int:
    from beardyn_core.base.outputs import files_read
    from beardyn_core.config import read_scene
    from beardyn_core.study.demo_report import RECORDING_NAME, Pace, demo_folder, report

    wanted = {("effects",): args.effects, ("duration_s",): args.duration}
    with files_read() as inputs:  # the twin chooses what is open
        scene = read_scene(
            args.scene, {key: value for key, value in wanted.items() if value is not None}
        ).scene
    folder = demo_folder(args.output, say, inputs=inputs, force=args.force).resolve()
    logs = folder / "logs"
    logs.mkdir(exist_ok=True)
    recording = folder / RECORDING_NAME
    recording.unlink(missing_ok=True)
    domain = free_domain_id()
    say(f"{scene.name}: {scene.purpose}")
    say(f"nodes on ROS domain {domain}, this machine only, logs in {logs}")
    with Processes(local_environment(domain), logs) as processes:
        name = scene.name if args.scene == scene.name else str(Path(args.scene).resolve())
        nodes = _Nodes(processes, name, args.effects)
        with _Observer(domain) as graph:
            twin = _run_nodes(nodes, graph, scene, recording)
    pace = Pace(
        simulated=float(twin.value("simulated_time") or 0.0),
        real_time_factor=float(twin.value("real_time_factor") or 0.0),
        overall=float(twin.value("pace") or 0.0),
        late_blocks=int(twin.value("late_blocks") or 0),
    )
    if twin.value("state") != "finished" and pace.simulated < LEAST_REPORTED_S:
        raise ValidityError(twin.message)
    report(folder, pace, say, picture_of_view=not args.no_view)
    if twin.value("state") != "finished":
        raise ValidityError(twin.message)
    return EXIT_DONE


def _run_nodes(nodes: _Nodes, graph: _Observer, scene: Any, recording: Path) -> Diagnostic:
    """Start everybody, follow the run, wait for everybody's end; the twin's last words."""
    nodes.start("twin", scene=nodes.scene, effects=nodes.effects, speed_factor=1.0)
    nodes.start("recorder", output=str(recording))
    nodes.start("monitor", bearing=scene.bearing.name)
    begin = time.monotonic()
    graph.spin_until(lambda: graph.latest_status("twin") is not None, nodes, "the first words of the twin")
    announced = False

    def ready() -> bool:
        nonlocal announced
        if not announced and graph.state() == "compiling":
            announced = True
            say("compiling the twin ... (a minute the first time, kept for the next)")
        return (
            graph.state() == "waiting for load"
            and graph.is_connected("recorder")
            and graph.is_connected("monitor")
        )

    graph.spin_until(ready, nodes, "the twin, the recorder and the monitor to be ready")
    say(f"ready after {time.monotonic() - begin:.1f} s, the train starts")
    first = graph.latest_status("twin")
    if first is not None and first.value("tier_note"):
        say(f"to keep real time: {first.value('tier_note')}")
    nodes.start("load", scene=nodes.scene, duration=float(scene.duration))
    progress = Progress(scene.duration)

    def ended() -> bool:
        twin, monitor = graph.latest_status("twin"), graph.latest_status("monitor")
        if monitor is not None:
            progress.receive(monitor.value("verdict") or "waiting")
        if twin is not None and twin.value("pace"):
            progress.show(float(twin.value("simulated_time") or 0.0), float(twin.value("pace") or 0.0))
        return graph.state() in ("finished", "stopped")

    try:
        graph.spin_until(ended, nodes, "the end of the run", tolerate=("twin", "load"))
    finally:
        progress.close()
    say("the train has arrived, closing the recording ...")
    twin = graph.latest_status("twin")
    assert twin is not None
    graph.spin_until(
        lambda: all(nodes.processes.exit_code(name) is not None for name in ("twin", "recorder", "monitor")),
        nodes,
        "the nodes to end",
        tolerate=("twin", "load"),
        timeout=END_TIMEOUT_S,
    )
    return twin


class _Nodes:
    """The nodes of the demonstration as processes."""

    def __init__(self, processes: Processes, scene: str, effects: str | None) -> None:
        self.processes = processes
        self.scene = scene
        self.effects = effects or SCENE_OWN

    def start(self, node: str, **parameters: object) -> None:
        words = ["-m", "beardyn_ros", node, "--ros-args"]
        for name, value in parameters.items():
            words += ["-p", f"{name}:={value}"]
        self.processes.start(node, *words)

    def failure(self, tolerate: Sequence[str]) -> NodeFailureError | None:
        """Describe in a sentence that a node has ended with an error; ``None`` when none has."""
        for name in self.processes.failed():
            if name in tolerate:
                continue
            code = self.processes.exit_code(name) or EXIT_FAILED
            tail = "\n".join(self.processes.log(name).splitlines()[-LOG_LINES_SHOWN:])
            return NodeFailureError(
                f"the node {name} has ended with code {code}; its last words "
                f"({self.processes.log_path(name)}):\n{tail}",
                code if code > 0 else EXIT_FAILED,
            )
        return None


class _Observer:
    """Listens to the diagnostics of the graph, and to Ctrl-C.

    An exception that a signal raises in a finalizer or a callback from C is swallowed there: what was
    pressed is kept and reported at the next look.
    """

    def __init__(self, domain: int) -> None:
        self._domain = domain
        self._interrupted = False
        self._latest: dict[str, Diagnostic] = {}
        self._last_message_at = time.monotonic()

    def __enter__(self) -> _Observer:
        self._before = signal.signal(signal.SIGINT, self._interrupt)
        os.environ.update(this_machine_only())
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node

        from beardyn_core.record.topics import topic
        from beardyn_ros.wire import RawIntake

        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=self._domain)
        self._node = Node("demo", namespace="axlebox", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        RawIntake(self._node).add(topic("/diagnostics"), self._on_diagnostics)
        return self

    def __exit__(self, *_: object) -> None:
        from beardyn_ros.runtime import leave_quietly

        self._executor.shutdown()
        leave_quietly(self._node)
        self._context.try_shutdown()
        signal.signal(signal.SIGINT, self._before)

    def _interrupt(self, _number: int, _frame: FrameType | None) -> None:
        self._interrupted = True
        raise KeyboardInterrupt

    def _on_diagnostics(self, cdr: bytes) -> None:
        self._last_message_at = time.monotonic()
        for status in decode_diagnostics(cdr)[1]:
            self._latest[status.name.rpartition("/")[2]] = status

    def latest_status(self, part: str) -> Diagnostic | None:
        """Find the latest status of a part."""
        return self._latest.get(part)

    def state(self) -> str:
        """Return the state of the twin; '' before its first status."""
        twin = self.latest_status("twin")
        return (twin.value("state") or "") if twin else ""

    def is_connected(self, part: str) -> bool:
        """Check whether a listening node has found the twin."""
        status = self.latest_status(part)
        return status is not None and status.value("connected") == "true"

    def spin_until(
        self,
        condition: Callable[[], bool],
        nodes: _Nodes,
        what: str,
        tolerate: Sequence[str] = (),
        timeout: float = SILENCE_TIMEOUT_S,
    ) -> None:
        """Spin until the condition holds; a dead node or long silence is a failure."""
        self._last_message_at = time.monotonic()
        while not condition():
            self._executor.spin_once(timeout_sec=SPIN_S)
            if self._interrupted:
                raise KeyboardInterrupt
            failure = nodes.failure(tolerate)
            if failure is not None:
                raise failure
            if time.monotonic() - self._last_message_at > timeout:
                raise NodeFailureError(f"nothing arrived for {timeout:.0f} s while waiting for {what}")

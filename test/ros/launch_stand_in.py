"""Runs a launch file where `launch` and `launch_ros` are not installed: they are in no package registry.

Stands in for the few classes that the launch files use, with their documented behaviour and with real
processes: ``python -m test.ros.launch_stand_in FOLDER car.launch.py name:=value``. With ``--fake-twin`` the
twin is the fake one; with ``--dry`` parameters are written and no node runs. As with ``ros2 launch``, SIGINT
shuts everything down, and the exit code is 0 unless a handler has raised.
"""

from __future__ import annotations

import json
import runpy
import signal
import subprocess
import sys
import time
import types
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parents[2] / "launch"


class Record:
    """An action, event or handler: remembers its arguments."""

    def __init__(self, *positional: Any, **named: Any) -> None:
        self.positional = positional
        self.__dict__.update(named)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"{type(self).__name__} was given no {name}")


class DeclareLaunchArgument(Record):
    pass


class IncludeLaunchDescription(Record):
    pass


class PythonLaunchDescriptionSource(Record):
    def described(self) -> LaunchDescription:
        described = runpy.run_path(self.positional[0])["generate_launch_description"]()
        assert isinstance(described, LaunchDescription)
        return described


class OpaqueFunction(Record):
    pass


class RegisterEventHandler(Record):
    pass


class OnProcessExit(Record):
    pass


class OnShutdown(Record):
    pass


class EventHandler(Record):
    pass


class Event:
    pass


class EmitEvent(Record):
    pass


class SignalProcess(Record):
    pass


class LogInfo(Record):
    pass


class TimerAction(Record):
    cancelled = False

    def cancel(self) -> None:
        self.cancelled = True


class Shutdown(Record):
    pass


class LaunchDescription(Record):
    pass


class LaunchConfiguration(Record):
    def perform(self, context: Any) -> str:
        return str(context.launch_configurations[self.positional[0]])


class ParameterValue(Record):
    def evaluate(self, context: Any) -> object:
        text = performed(self.positional[0], context)
        return text.lower() in ("true", "1") if self.value_type is bool else self.value_type(text)


def performed(value: Any, context: Any) -> str:
    """A text as it is, or what a substitution gives."""
    return value.perform(context) if isinstance(value, LaunchConfiguration) else str(value)


class Node(Record):
    """A process of the package, its parameters in a file under the node's full name as launch_ros does."""

    def start(self, folder: Path, fake_twin: bool, dry: bool, context: Any) -> subprocess.Popen[bytes]:
        self.__dict__["namespace"] = performed(self.__dict__["namespace"], context).strip("/")
        full_name = f"/{self.namespace}/{self.name}"
        file = folder / f"{full_name.strip('/').replace('/', '.')}.yaml"
        values = {
            name: value.evaluate(context) if isinstance(value, ParameterValue) else value
            for part in self.parameters
            for name, value in part.items()
        }
        fake = self.executable in ("twin", "car_twin") and fake_twin
        if fake and self.executable == "twin":
            values = {**values, "scene": "fake"}
        file.write_text(json.dumps({full_name: {"ros__parameters": values}}))
        module = "test.ros.fake_twin" if fake else "beardyn_ros"
        words = ["--ros-args", "-r", f"__node:={self.name}", "-r", f"__ns:=/{self.namespace}"]
        words += ["--params-file", str(file)]
        if dry:
            return subprocess.Popen([sys.executable, "-c", ""])
        return subprocess.Popen([sys.executable, "-m", module, self.executable, *words])


def matches_action(node: Node) -> Callable[[Node], bool]:
    return lambda other: other is node


class Launcher:
    """Carries out the actions of a launch description until every process has ended."""

    def __init__(self, folder: Path, fake_twin: bool, dry: bool, configurations: dict[str, str]) -> None:
        self.folder = folder
        self.fake_twin = fake_twin
        self.dry = dry
        self.launch_configurations = configurations
        self.running: dict[Node, subprocess.Popen[bytes]] = {}
        self.handlers: list[Record] = []
        self.is_shutdown = False
        self.code = 0
        self.timers: list[tuple[float, TimerAction]] = []
        self.kill_at: float | None = None

    def carry_out(self, actions: Sequence[Any]) -> None:
        for action in actions:
            if isinstance(action, DeclareLaunchArgument):
                self.launch_configurations.setdefault(action.positional[0], action.default_value)
            elif isinstance(action, OpaqueFunction):
                self.carry_out(action.function(self))
            elif isinstance(action, RegisterEventHandler):
                self.handlers.append(action.positional[0])
            elif isinstance(action, IncludeLaunchDescription):
                for name, value in action.launch_arguments:
                    self.launch_configurations[name] = performed(value, self)
                self.carry_out(action.positional[0].described().positional[0])
            elif isinstance(action, Node):
                self.running[action] = action.start(self.folder, self.fake_twin, self.dry, self)
                print(f"[launch] {action.namespace}/{action.name} pid {self.running[action].pid}", flush=True)
            elif isinstance(action, LogInfo):
                print(action.msg, flush=True)
            elif isinstance(action, TimerAction):
                self.timers.append((time.monotonic() + action.period, action))
            elif isinstance(action, Shutdown):
                self.shut_down()
            elif isinstance(action, EmitEvent) and isinstance(action.event, Event):
                self.handle(action.event)
            elif isinstance(action, EmitEvent):
                for node in list(self.running):
                    if action.event.process_matcher(node):
                        self.running[node].send_signal(action.event.signal_number)
            else:
                raise TypeError(f"the stand-in knows no {type(action).__name__}")

    def handle(self, event: Event) -> None:
        for handler in self.handlers:
            if isinstance(handler, EventHandler) and handler.matcher(event):
                try:
                    self.carry_out(handler.entities)
                except RuntimeError as error:
                    print(f"[launch] {error}", flush=True)
                    self.code = 1

    def begin_shutdown(self) -> None:
        if not self.is_shutdown:
            self.is_shutdown = True
            for handler in self.handlers:
                if isinstance(handler, OnShutdown):
                    self.carry_out(handler.on_shutdown(None, self))

    def shut_down(self) -> None:
        self.begin_shutdown()
        if self.kill_at is None:
            self.kill_at = time.monotonic() + 10.0
            for child in self.running.values():
                child.send_signal(signal.SIGINT)

    def run(self) -> None:
        while self.running or self.timers:
            time.sleep(0.05)
            self.timers = [timer for timer in self.timers if not timer[1].cancelled and self.kill_at is None]
            for node, child in list(self.running.items()):
                if child.poll() is not None:
                    del self.running[node]
                    self.report_exit(node, child.returncode)
            for due in [timer for timer in self.timers if timer[0] < time.monotonic()]:
                self.timers.remove(due)
                self.carry_out(due[1].actions)
            if self.kill_at is not None and time.monotonic() > self.kill_at:
                for child in self.running.values():
                    child.kill()
        self.begin_shutdown()

    def report_exit(self, node: Node, code: int) -> None:
        event = Record(action=node, returncode=code, process_name=f"{node.namespace}/{node.name}")
        print(f"[launch] {event.process_name} exit {code}", flush=True)
        for handler in self.handlers:
            if isinstance(handler, OnProcessExit) and handler.target_action is node:
                self.carry_out(handler.on_exit(event, self))


MODULES: dict[str, dict[str, Any]] = {
    "launch": {"LaunchDescription": LaunchDescription, "LaunchContext": Any, "LaunchDescriptionEntity": Any},
    "launch.actions": {
        "DeclareLaunchArgument": DeclareLaunchArgument,
        "EmitEvent": EmitEvent,
        "IncludeLaunchDescription": IncludeLaunchDescription,
        "LogInfo": LogInfo,
        "OpaqueFunction": OpaqueFunction,
        "RegisterEventHandler": RegisterEventHandler,
        "Shutdown": Shutdown,
        "TimerAction": TimerAction,
    },
    "launch.event": {"Event": Event},
    "launch.event_handler": {"EventHandler": EventHandler},
    "launch.event_handlers": {"OnProcessExit": OnProcessExit, "OnShutdown": OnShutdown},
    "launch.events": {"matches_action": matches_action},
    "launch.events.process": {"SignalProcess": SignalProcess},
    "launch.launch_description_sources": {"PythonLaunchDescriptionSource": PythonLaunchDescriptionSource},
    "launch.substitutions": {"LaunchConfiguration": LaunchConfiguration},
    "launch_ros": {},
    "launch_ros.actions": {"Node": Node},
    "launch_ros.parameter_descriptions": {"ParameterValue": ParameterValue},
}


def main(words: Sequence[str]) -> int:
    for name, content in MODULES.items():
        module = types.ModuleType(name)
        module.__dict__.update(content)
        sys.modules[name] = module
    folder, file, *given = [word for word in words if not word.startswith("--")]
    described = runpy.run_path(str(FOLDER / file))["generate_launch_description"]()
    flags = "--fake-twin" in words, "--dry" in words
    launcher = Launcher(Path(folder), *flags, dict(word.split(":=", 1) for word in given))
    signal.signal(signal.SIGINT, lambda *_: launcher.shut_down())
    signal.signal(signal.SIGTERM, lambda *_: launcher.shut_down())
    launcher.carry_out(described.positional[0])
    launcher.run()
    return launcher.code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

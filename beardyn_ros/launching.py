"""What launch files share: switches, the nodes that a load waits for, and an end with a failure.

By itself ``ros2 launch`` ends with 0 whatever the nodes ended with.
"""

from __future__ import annotations

import signal
from collections.abc import Mapping, Sequence
from typing import Any

from launch.actions import EmitEvent, OpaqueFunction, RegisterEventHandler
from launch.event import Event
from launch.event_handler import EventHandler
from launch.event_handlers import OnProcessExit, OnShutdown

from beardyn_core.base.errors import InputError

LISTENERS = ("recorder", "monitor", "follower")  # a replay that began without them would be lost to them
_SWITCHES = {"true": True, "1": True, "false": False, "0": False}


def read_switches(given: Mapping[str, str], *names: str) -> dict[str, bool]:
    """Read arguments that are true or false, or 1 or 0, as `launch` has them.

    Parameters
    ----------
    given : mapping
        Texts of the arguments.
    *names : str
        Of those that are read.

    Raises
    ------
    InputError
        With every one that is neither.
    """
    problems = [
        f"{name} {given[name]}: allowed are true, false" for name in names if _switch(given, name) is None
    ]
    if problems:
        raise InputError(problems)
    return {name: bool(_switch(given, name)) for name in names}


def _switch(given: Mapping[str, str], name: str) -> bool | None:
    return _SWITCHES.get(given[name].strip().lower())


def listeners_of(switches: Mapping[str, bool]) -> str:
    """List the nodes that a load waits for, as its parameter ``wait_for`` has them."""
    return " ".join(name for name in LISTENERS if switches[name])


class NodeFailed(Event):
    """Nodes have failed, and the launch is about to end."""


def failure_of(nodes: Sequence[Any]) -> list[Any]:
    """Make the handlers that let a launch end with 1 when a node has ended with another code than 0.

    Nothing is stopped by them. A launch file that includes this one ends with 1, too.

    Parameters
    ----------
    nodes : sequence of launch_ros.actions.Node
    """
    failed: list[str] = []

    def note(event: Any, context: Any) -> list[Any]:
        if event.returncode in (0, -signal.SIGINT):  # asked to end before it could listen
            return []
        failed.append(f"{event.process_name} with {event.returncode}")
        return tell(event, context) if context.is_shutdown else []

    def tell(_event: Any, _context: Any) -> list[Any]:
        # an event of its own: an exception keeps the handlers that come after it from theirs
        return [EmitEvent(event=NodeFailed())] if failed else []

    def fail(_context: Any) -> None:
        raise RuntimeError(f"ended with a failure: {', '.join(failed)}")

    handlers = [OnProcessExit(target_action=node, on_exit=note) for node in nodes]
    raising = EventHandler(
        matcher=lambda event: isinstance(event, NodeFailed), entities=[OpaqueFunction(function=fail)]
    )
    return [RegisterEventHandler(each) for each in (*handlers, OnShutdown(on_shutdown=tell), raising)]

"""A launch that ends with a failure when one of its nodes has failed.

By itself ``ros2 launch`` ends with 0 whatever the nodes ended with.
"""

from __future__ import annotations

import signal
from collections.abc import Sequence
from typing import Any

from launch.actions import EmitEvent, OpaqueFunction, RegisterEventHandler
from launch.event import Event
from launch.event_handler import EventHandler
from launch.event_handlers import OnProcessExit, OnShutdown


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

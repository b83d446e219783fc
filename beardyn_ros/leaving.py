"""A node leaves so that those who stay are not stopped by it."""

from __future__ import annotations

import time
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.parameter import Parameter

# Fast DDS answers a message 5 ms after it has come, from the thread that also announces its own process; that
# thread may have to wait for a processor.
QUIET_S = 0.05
LAST_WORDS_TIMEOUT_S = 0.5


def leave_quietly(node: Any) -> None:
    """Destroy a node and its members, each step after everybody has answered the one before.

    Parameters
    ----------
    node : rclpy.node.Node
        With or without `members`, nodes of the same process.

    Notes
    -----
    A process that answers a writer while it learns that this writer is gone, and has to announce itself next,
    stops for good: it holds the list of participants and waits for the thread that wants the list (issue 6502
    of Fast DDS, open). So nothing is said any more when publishers go. Every step tells the graph what is
    left, through a writer that goes with the last node: so that is one with nothing else to say.
    ``python -m evidence.ros.leaving`` shows both.
    """
    try:
        last = _nobody(node)
    except Exception:  # the context has gone: there is nobody left to be quiet for
        node.destroy_node()
        return
    deadline = time.monotonic() + LAST_WORDS_TIMEOUT_S
    for each in (*getattr(node, "members", ()), node):
        for publisher in each.publishers:
            publisher.wait_for_all_acked(Duration(seconds=max(deadline - time.monotonic(), 0.0)))
    time.sleep(QUIET_S)
    node.destroy_node()
    time.sleep(QUIET_S)
    last.destroy_node()


def _nobody(node: Any) -> Any:
    """Make a hidden node beside one, which has nothing to say."""
    last = Node(
        f"_{node.get_name()}_leaving",  # hidden from `ros2 node list`
        namespace=node.get_namespace(),
        context=node.context,
        use_global_arguments=False,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter("start_type_description_service", value=False)],
    )
    for publisher in list(last.publishers):
        last.destroy_publisher(publisher)
    return last

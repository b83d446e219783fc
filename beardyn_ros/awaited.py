"""Nodes that a replay waits for, so that one which starts slowly misses nothing."""

from __future__ import annotations

import math
import time

from rclpy.node import Node

LONGEST_S = 30.0
SUBSCRIBED = "vibration"  # by recorder, monitor and follower


class Awaited:
    """Nodes of the namespace that are to listen before the replay begins.

    Parameters
    ----------
    node : Node
        The one that waits.
    names : str
        Names with blanks in between, empty for nobody.
    """

    def __init__(self, node: Node, names: str) -> None:
        self._node = node
        self._missing = set(names.split())
        self._until = math.inf

    def are_there(self) -> bool:
        """Check whether all of them listen or have been waited for long enough, from the first check on."""
        if not self._missing:
            return True
        self._until = min(self._until, time.monotonic() + LONGEST_S)
        space = self._node.get_namespace()
        known = self._node.get_subscriptions_info_by_topic(self._node.resolve_topic_name(SUBSCRIBED))
        self._missing -= {info.node_name for info in known if info.node_namespace == space}
        if self._missing and time.monotonic() > self._until:
            late = ", ".join(sorted(self._missing))
            self._node.get_logger().warning(
                f"the replay begins without {late}: waited {LONGEST_S:g} s for it"
            )
            self._missing.clear()
        return not self._missing

"""Topics ``typed/<name>``: messages of the table once more, as those of the package beardyn_msgs."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import Any

from rclpy.impl.implementation_singleton import rclpy_implementation

from beardyn_core.record.topics import Topic
from beardyn_ros.typed_messages import PREFIX, TypedMessage, message_types, typed_message
from beardyn_ros.wire import all_received, quality_of_service

TYPED_DEPTH = 50


class TypedTopics:
    """Publishes messages of the table as those of beardyn_msgs on ``typed/<name>``.

    Parameters
    ----------
    node : rclpy.node.Node
    types : module
        ``beardyn_msgs.msg``.
    frame : str
        Frame of the axlebox, of messages that have no header.

    Notes
    -----
    Nothing is converted while nobody subscribes. A reader that comes late gets the truth.
    """

    def __init__(self, node: Any, types: Any, frame: str) -> None:
        self._node, self._types, self._frame = node, types, frame
        self._publishers: dict[str, tuple[Any, TypedMessage, bool]] = {}

    @classmethod
    def wanted(cls, node: Any, wanted: bool, frame: str) -> TypedTopics | None:
        """Make them where they are wanted and the package is built and sourced; else ``None``."""
        types = message_types() if wanted else None
        return None if types is None else cls(node, types, frame)

    def announce(self, entry: Topic) -> None:
        """Create the publisher that goes with a topic of the table, if it has one."""
        conversion = typed_message(entry.name)
        if conversion is None:
            return
        # of the load, whose readers get everything, too: a typed reader must not hold it up
        profile = quality_of_service(replace(entry, depth=entry.depth or TYPED_DEPTH))
        kind = getattr(self._types, conversion.type_name)
        publisher = self._node.create_publisher(kind, PREFIX + entry.name, profile)
        self._publishers[entry.name] = publisher, conversion, entry.durability == "transient_local"

    def publish(self, name: str, cdr: bytes) -> None:
        """Publish a message of the table typed, if its topic has a type and anybody reads it."""
        if name not in self._publishers:
            return
        publisher, conversion, latched = self._publishers[name]
        if not latched and publisher.get_subscription_count() == 0:
            return
        try:
            message = conversion.convert(self._types, cdr, self._frame)
        except (AttributeError, KeyError, TypeError, ValueError) as error:  # a text that is none of ours
            self._node.get_logger().warning(f"{name} has no typed form: {error!r}", throttle_duration_sec=5.0)
            return
        with suppress(rclpy_implementation.RCLError):  # full: the message itself is out, its copy is lost
            publisher.publish(message)

    def wait_until_received(self, name: str, timeout: float) -> None:
        """Wait until every reliable reader has acknowledged a topic, for at most `timeout` seconds."""
        if name in self._publishers:
            all_received(self._publishers[name][0], timeout)

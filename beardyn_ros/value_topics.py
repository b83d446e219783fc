"""Results as plain numbers on ``values/<name>``, for any tool that plots."""

from __future__ import annotations

import time
from collections.abc import Mapping

from beardyn_core.record.plot_values import Bounded, ValueEncoder, value_topics
from beardyn_ros.wire import TopicPublishers


class ValueTopics:
    """Publishes the values of one source, or nothing.

    Parameters
    ----------
    out : TopicPublishers
    source : str
        ``monitor`` or ``follower``.
    frame : str
        Frame of the axlebox.
    wanted : bool
        Parameter ``values`` of the node.
    """

    def __init__(self, out: TopicPublishers, source: str, frame: str, wanted: bool) -> None:
        self._out = out
        self._names = value_topics(source) if wanted else ()
        self._encoder = ValueEncoder(source, frame)
        for name in self._names:
            out.publisher(name)

    def publish(self, time_s: float, values: Mapping[str, Bounded]) -> None:
        """Publish the values of the result of a time [s]; to be called before the result is published."""
        if self._names:
            for name, cdr in self._encoder.encode(round(time_s * 1e9), values):
                self._out.publish(name, cdr)

    def wait_until_received(self, timeout: float) -> None:
        """Wait for all readers, for at most `timeout` seconds; a recorder that has the last word ends."""
        deadline = time.monotonic() + timeout
        for name in self._names:
            self._out.wait_until_received(name, max(deadline - time.monotonic(), 0.0))

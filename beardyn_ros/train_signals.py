"""What a train has of one axlebox: vibration, shaft and temperature, for the nodes that listen to it.

Nothing else is read: no ``truth``, no ``contacts``, ``bodies`` or ``joint_states``. Of the twin it is known
whether it has ended; a real axlebox has none.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from rclpy.node import Node

from beardyn_core.base.arrays import Float, Int
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import cloud_times
from beardyn_core.record.messages import decode, decode_diagnostics, header_stamp
from beardyn_core.record.reading import run_of_messages
from beardyn_core.record.topics import TEMPERATURE, topic
from beardyn_ros.clocks_apart import ClocksApart
from beardyn_ros.diagnostics import TWIN, TwinWatch, diagnostic_name
from beardyn_ros.message_guard import MessageGuard
from beardyn_ros.wire import RawIntake

_MEASURED = ("vibration", "shaft")  # without these nothing is read
_BOX = "axlebox"  # of the temperatures, that of the box is measured


class Hearer(NamedTuple):
    """Who receives what comes in."""

    restart: Callable[[], None]  # the vibration starts again
    vibration: Callable[[Int, Float], None]  # times [ns], acceleration of shape [sample, 3], [m/s^2]
    shaft: Callable[[Int, Float], None]  # times [ns], angles [rad], after the vibration of a sweep
    temperature: Callable[[int, float], None]  # time [ns], of the box, [degrees Celsius]


class TrainSignals:
    """Subscriptions of a node to what a train has.

    Parameters
    ----------
    node : Node
    hearer : Hearer
    further : mapping
        Handlers of further topics by name, such as ``load/blocks``.
    pass_on : callable, optional
        Gets the bytes of every message of vibration that is taken.
    """

    def __init__(
        self,
        node: Node,
        hearer: Hearer,
        further: Mapping[str, Callable[[bytes], None]] | None = None,
        pass_on: Callable[[bytes], None] | None = None,
    ) -> None:
        self._node, self._hearer, self._pass_on = node, hearer, pass_on
        self._shaft: list[bytes] = []
        self._last_sample = -1
        self._came, self._nothing_waits = False, True
        self._clocks = ClocksApart(*_MEASURED)
        self._intake = RawIntake(node, polled=True)
        self.guard = MessageGuard(node)
        for name, handler in {
            "vibration": self._on_vibration,
            "shaft": self._shaft_comes,
            **(further or {}),
            "temperature": self._on_temperature,
            "/diagnostics": self._on_diagnostics,
        }.items():
            entry = topic(name)
            guarded = self.guard.guard_handler(entry, handler)
            self._intake.add_sourced(entry, guarded, keep_all=name != "/diagnostics")
        name = diagnostic_name(node.get_namespace(), TWIN)
        self.watch = TwinWatch(name, lambda: self.guard.sources.count("vibration"))

    @property
    def connected(self) -> bool:
        """Whether somebody publishes vibration and shaft."""
        counts, space = self._intake.publisher_counts(), self._node.get_namespace()
        return all(counts.get(topic(name).path(space), 0) for name in _MEASURED)

    @property
    def ended(self) -> bool:
        """Whether the twin has ended and all that it has sent is read: a busy node is behind."""
        return self.watch.ended and self._nothing_waits

    @property
    def vanished(self) -> bool:
        """Whether the twin is gone without a word, and all that it has sent is read."""
        return self.watch.vanished() and self._nothing_waits

    @property
    def clock_note(self) -> str:
        """Report two clocks of vibration and shaft, which are paired by stamp; empty where there is one."""
        return self._clocks.sentence

    def sweep(self) -> None:
        """Tell the hearer what has come since the last sweep."""
        self._came = False
        self._intake.sweep()
        self.guard.sources.look()
        self._nothing_waits = not self._came  # diagnostics of a whole train never pause
        if self._shaft:
            turning = run_of_messages({"shaft": self._shaft}, None).shaft
            self._hearer.shaft(turning.time_ns, turning.angle)
            self._shaft = []
        self._clocks.look()

    def _on_vibration(self, cdr: bytes) -> None:
        self._came = True
        points = cloud_points(cdr)
        if not len(points):
            return
        if int(points["sample"][-1]) <= self._last_sample:
            self._node.get_logger().info(f"the vibration starts again, so does the {self._node.get_name()}")
            self._shaft = []
            self._clocks.begin()
            self._hearer.restart()
        self._last_sample = int(points["sample"][-1])
        if self._pass_on is not None:
            self._pass_on(cdr)
        acceleration = np.stack([points[axis].astype(float) for axis in ("ax", "ay", "az")], axis=1)
        times = cloud_times(cdr, points)
        self._clocks.receive("vibration", int(times[-1]))
        self._hearer.vibration(times, acceleration)

    def _shaft_comes(self, cdr: bytes) -> None:
        self._came = True
        self._clocks.receive("shaft", header_stamp(cdr))
        self._shaft.append(cdr)

    def _on_temperature(self, cdr: bytes) -> None:
        message = decode(TEMPERATURE, cdr)
        if message.header.frame_id.rpartition("/")[2] == _BOX:
            self._hearer.temperature(header_stamp(cdr), float(message.temperature))

    def _on_diagnostics(self, cdr: bytes) -> None:
        self.watch.take_statuses(decode_diagnostics(cdr)[1])

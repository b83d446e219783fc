"""Topics of the twin that carry load: subscribed, decoded, handed to the feed or refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.messages import decode, decode_string, header_frame, header_stamp
from beardyn_core.record.topics import TWIST, WRENCH, topic
from beardyn_ros.live_load import SHAFT_TOPIC, WRENCH_TOPIC, LiveLoad
from beardyn_ros.load_feed import LoadFeed
from beardyn_ros.message_guard import Sources
from beardyn_ros.scenario import says_paused
from beardyn_ros.wire import RawIntake


class LoadIntake:
    """Takes load for the feed of the present session; without one it is dropped.

    Parameters
    ----------
    node : rclpy.node.Node
    frame : str
        The only frame that load may be in, besides none.
    """

    def __init__(self, node: Any, frame: str) -> None:
        self._node = node
        self._frame = frame
        self._intake = RawIntake(node)
        self._sources = Sources(node)
        self._checker = MessageChecker()
        self._feed: LoadFeed | None = None
        self._paused = False

    def serve(self, feed: LoadFeed | None, live: bool = False) -> None:
        """Hand what comes to a feed from now on; the first call subscribes."""
        self._feed = feed
        if feed is None:
            return
        if not self._intake.publisher_counts():
            self._add("load/blocks", self._on_load)
            self._add("load/truth", self._on_load_truth)
            if live:
                self._add("load/wrench", self._on_wrench)
                self._add("load/shaft", self._on_shaft)
        feed.pause(self._paused)

    def _add(self, name: str, handler: Callable[[bytes], None]) -> None:
        entry = topic(name)

        def take(cdr: bytes, source: bytes) -> None:
            if self._feed is None:
                return
            problem = self._checker.problem(entry, cdr)
            reason = "wrong fields"
            if not problem:
                reason, problem = "second publisher", self._sources.problem(entry, source)
            if not problem:
                handler(cdr)
            elif name in (WRENCH_TOPIC, SHAFT_TOPIC):
                self._report(self._feed.live.refuse(name, reason, problem))
            else:
                self._report(self._feed.gate.refuse(reason, problem, name))

        self._intake.add_sourced(entry, take)

    def count_senders(self) -> int:
        """Count the publishers of load; whoever is gone is not paused any more, its silence is a loss."""
        senders = self._intake.publisher_counts()
        known = senders.pop(self._node.resolve_topic_name("load/truth"), 0)
        if self._paused and not known:
            self._set_paused(False)
        return sum(senders.values())

    def _set_paused(self, paused: bool) -> None:
        self._paused = paused
        if self._feed is not None:
            self._feed.pause(paused)

    def _on_load(self, cdr: bytes) -> None:
        if self._feed is None:
            return
        try:
            wrong = wrong_frame(cdr, self._frame)
            load, samples = decode_load(cdr)
        except Exception as error:  # a foreign message may break the decoder in any way
            refusal: str | None = self._feed.gate.refuse(
                "wrong fields",
                "it is not a block of load samples with the fields sample, t, fx..mz, shaft_speed "
                f"({error!r})",
            )
        else:
            refusal = self._feed.gate.offer(load, samples, wrong)
        self._report(refusal)

    def _on_load_truth(self, cdr: bytes) -> None:
        self._set_paused(says_paused(decode_string(cdr)))

    def _on_wrench(self, cdr: bytes) -> None:
        def take(live: LiveLoad) -> str | None:
            content = decode(WRENCH, cdr).wrench
            force, torque = content.force, content.torque
            wrench = np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])
            return live.offer_wrench(wrench, header_stamp(cdr))

        self._take_live("load/wrench", cdr, take)

    def _on_shaft(self, cdr: bytes) -> None:
        def take(live: LiveLoad) -> str | None:
            return live.offer_speed(float(decode(TWIST, cdr).twist.angular.y), header_stamp(cdr))

        self._take_live("load/shaft", cdr, take)

    def _take_live(self, name: str, cdr: bytes, take: Callable[[LiveLoad], str | None]) -> None:
        if self._feed is None:
            return
        live = self._feed.live
        try:
            wrong = wrong_frame(cdr, self._frame)
            refusal = live.refuse(name, *wrong) if wrong else take(live)
        except Exception as error:  # as above
            refusal = live.refuse(name, "wrong fields", f"it cannot be read ({error!r})")
        self._report(refusal)

    def _report(self, sentence: str | None) -> None:
        if sentence is not None:
            self._node.get_logger().warning(sentence, throttle_duration_sec=1.0)


def wrong_frame(cdr: bytes, frame: str) -> tuple[str, str] | None:
    """Give reason and sentence when a message is of another frame; one that names no frame is taken."""
    found = header_frame(cdr)
    if found in ("", frame):
        return None
    return (
        "wrong frame",
        f"its frame is '{found}', this twin takes load in '{frame}' (parameter frame_id)",
    )

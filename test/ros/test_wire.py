"""What keeps the hot path of a node free, and what must come through all the same."""

from __future__ import annotations

import gc
import time

from rclpy.qos import DurabilityPolicy, QoSProfile

from beardyn_core.record.topics import WRENCH
from beardyn_ros.run_state import READY, SessionOptions
from beardyn_ros.session import TwinSession
from beardyn_ros.wire import message_class
from test.ros.fake_twin import fake_rig
from test.ros.graph import Graph

OPTIONS = SessionOptions("lockstep", 5.0, 5.0, 1.0, 10**10, 10**8, False, 10.0, "axlebox", "one")


def test_a_reader_with_incompatible_qos_is_noticed_within_two_seconds(graph: Graph) -> None:
    noticed: list[object] = []
    for handler in graph.out.publisher("force").event_handlers:
        handler.callback = noticed.append
    late = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    graph.node.create_subscription(message_class(WRENCH), "force", lambda _: None, late)
    graph.until(lambda: noticed, "the event", timeout=2.0)


def test_executor_does_not_look_at_qos_events_at_each_wake_up(graph: Graph) -> None:
    events = graph.out.publisher("force").event_handlers
    assert events
    begin, looks = time.monotonic(), []
    while time.monotonic() < begin + 2.0:
        looks.append(events[0].callback_group.can_execute(events[0]))
        time.sleep(0.01)
    assert 0.0 < sum(looks) / len(looks) < 0.3


def test_compiled_twin_is_left_alone_by_the_garbage_collector() -> None:
    """A full collection among all that a compiler has made holds the run for a quarter of a second."""
    session = TwinSession(fake_rig("fake", "scene"), OPTIONS, 0.0, lambda: None)
    before = gc.get_freeze_count()
    session.compile()
    try:
        deadline = time.monotonic() + 20.0
        while session.report().state != READY:
            assert time.monotonic() < deadline
            time.sleep(0.01)
        assert gc.get_freeze_count() - before > 0.9 * len(gc.get_objects())
    finally:
        session.end(5.0)
        gc.unfreeze()

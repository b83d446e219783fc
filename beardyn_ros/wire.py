"""Topics of the table on the wire: publishers of ready-made bytes, at once or spread; raw subscriptions.

Messages per second are the limit of rclpy, not bytes: one wake-up of the executor costs as much as
a hundred takes. A raw subscription therefore empties its own queue, and the queues of all its
sisters, in one sweep. Trend messages go out one after the other instead of in bursts: a reader with a
short queue gets them all.
"""

from __future__ import annotations

import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from importlib import import_module
from itertools import groupby
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.callback_groups import CallbackGroup
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.messages import DIAGNOSTICS
from beardyn_core.record.topics import Topic, topic

if TYPE_CHECKING:
    from beardyn_ros.typed_topics import TypedTopics

# Our publishers keep more than the table promises: a reader that gets no processor for a second or two
# can still ask for what it missed.
HISTORY_FACTOR = 20
PUBLISH_TRIES = 20
PUBLISH_RETRY_S = 0.005
DEEPEST_HISTORY = 4000
# Diagnostics are large and come a few times a second by the wall clock: 20 s of them.
DIAGNOSTICS_HISTORY_FACTOR = 2
RECENT_S = 5.0
LONGEST_SWEEP = 1000  # of one topic, then it is the turn of the next
MOST_SWEEPS = 50
CLOSEST = 0.8  # of the spacing between two moments that were meant; so a late one is made up for
LONGEST_SLEEP_S = 0.05
MOST_MOMENTS = 24  # behind more than that, everything goes out at once

SourcedHandler = Callable[[bytes, bytes], None]  # bytes of a message, identity of its publisher


@cache
def message_class(type_name: str) -> Any:
    """Find the Python class of ``package/msg/Type``."""
    package, kind, name = type_name.split("/")
    return getattr(import_module(f"{package}.{kind}"), name)


def quality_of_service(
    entry: Topic, keep_all: bool = False, complete: bool = False, offered: bool = False
) -> QoSProfile:
    """Choose the QoS of a topic of the table.

    Parameters
    ----------
    entry : Topic
    keep_all : bool
        Nothing is dropped in the queue of a reader that is busy.
    complete : bool
        Reliable also where the table asks for sensor data QoS: for a reader that wants every message.
    offered : bool
        For a publisher: reliable and deep, which serves readers with sensor data QoS as well. A topic that
        only its latest message matters on (`truth`) keeps its depth.
    """
    reliable = complete or offered or entry.reliability == "reliable"
    depth = entry.depth or DEEPEST_HISTORY
    if offered and entry.durability == "volatile" and entry.depth > 0:
        # what is small and frequent is kept for as long as the blocks: ten seconds and more
        factors = {CLOUD: HISTORY_FACTOR, DIAGNOSTICS: DIAGNOSTICS_HISTORY_FACTOR}
        depth = entry.depth * factors[entry.type] if entry.type in factors else DEEPEST_HISTORY
    return QoSProfile(
        depth=depth,
        # a publisher that kept all would wait for a reader that hangs, and with it everybody else
        history=HistoryPolicy.KEEP_ALL
        if keep_all or (entry.depth == 0 and not offered)
        else HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL
        if entry.durability == "transient_local"
        else DurabilityPolicy.VOLATILE,
    )


def all_received(publisher: Any, timeout: float) -> bool:
    """Wait until every reliable reader of a publisher has acknowledged, for at most `timeout` seconds."""
    if publisher.get_subscription_count() == 0:
        return True
    return bool(publisher.wait_for_all_acked(Duration(seconds=timeout)))


class TopicPublishers:
    """Publishers of CDR bytes, one per topic, made when first needed.

    Parameters
    ----------
    node : rclpy.node.Node
    names : str
        Topics of the table that are announced at once, so that readers find them.
    typed : TypedTopics, optional
        Publishes what has a type of beardyn_msgs once more.
    """

    def __init__(self, node: Any, *names: str, typed: TypedTopics | None = None) -> None:
        self._node = node
        self._typed = typed
        self._publishers: dict[str, Any] = {}
        self.sent: Counter[str] = Counter()
        self.lost_messages = 0
        self._lost_at = -RECENT_S
        for name in names:
            self.publisher(name)

    def publisher(self, name: str) -> Any:
        """Create the publisher of a topic of the table."""
        if name not in self._publishers:
            entry = topic(name)
            self._publishers[name] = self._node.create_publisher(
                message_class(entry.type), entry.name, quality_of_service(entry, offered=True)
            )
            if self._typed is not None:
                self._typed.announce(entry)
        return self._publishers[name]

    def publish(self, name: str, cdr: bytes) -> bool:
        """Publish, trying again for a moment when the middleware is full; False when given up."""
        publisher = self.publisher(name)
        for attempt in range(PUBLISH_TRIES):
            try:
                publisher.publish(cdr)
                self.sent[name] += 1
                if self._typed is not None:
                    self._typed.publish(name, cdr)
                return True
            except rclpy_implementation.RCLError:  # "cannot publish data": full
                if attempt + 1 < PUBLISH_TRIES:
                    time.sleep(PUBLISH_RETRY_S)
        self.lost_messages += 1
        self._lost_at = time.monotonic()
        return False

    @property
    def lost_recently(self) -> bool:
        """Whether a message was given up within the last seconds."""
        return time.monotonic() - self._lost_at < RECENT_S

    def wait_until_received(self, name: str, timeout: float) -> bool:
        """Wait until every reliable reader has acknowledged a topic, for at most `timeout` seconds."""
        publisher = self._publishers.get(name)
        if self._typed is not None:
            self._typed.wait_until_received(name, timeout)
        return publisher is None or all_received(publisher, timeout)

    @property
    def names(self) -> tuple[str, ...]:
        """Topics with a publisher."""
        return tuple(self._publishers)


class _Moment(NamedTuple):
    """Messages of one time: when they are due, and how close to the ones before they may come."""

    due: float
    gap: float
    messages: tuple[tuple[str, bytes], ...]


class Spreader:
    """Publishes messages at their times, from a thread of its own.

    Parameters
    ----------
    publish : callable
        ``publish(topic, cdr)``; may be called from any thread.
    """

    def __init__(self, publish: Callable[[str, bytes], object]) -> None:
        self._publish = publish
        self._condition = threading.Condition()
        self._waiting: deque[_Moment] = deque()
        self._last = 0.0
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="trends", daemon=True)
        self._thread.start()

    def spread(self, messages: Sequence[tuple[float, str, bytes]], pace: float) -> None:
        """Publish messages over the time to come, behind what still waits.

        Parameters
        ----------
        messages : sequence of (offset, topic, bytes)
            In the order of their offsets from now, in simulated time, [s].
        pace : float
            Simulated seconds per wall second; 0: everything at once.
        """
        now, wall = time.monotonic(), 1.0 / (pace or 1.0)
        groups = [(offset, tuple(group)) for offset, group in groupby(messages, lambda message: message[0])]
        gap = CLOSEST * wall * (groups[1][0] - groups[0][0]) if len(groups) > 1 else 0.0
        moments = [
            _Moment(now + wall * offset, gap, tuple((name, cdr) for _, name, cdr in group))
            for offset, group in groups
        ]
        with self._condition:
            if len(self._waiting) > MOST_MOMENTS:
                self._publish_waiting()
            self._waiting.extend(moments)
            if pace == 0.0:
                self._publish_waiting()
            self._condition.notify()

    def flush(self) -> None:
        """Publish at once what still waits."""
        with self._condition:
            self._publish_waiting()

    def drain(self, timeout: float) -> None:
        """Wait until everything is out in its time; after `timeout` seconds the rest goes at once."""
        deadline = time.monotonic() + timeout
        while self._waiting and time.monotonic() < deadline:
            time.sleep(0.001)
        self.flush()

    def end(self) -> None:
        """Publish the rest and end the thread."""
        with self._condition:
            self._publish_waiting()
            self._ended = True
            self._condition.notify()
        self._thread.join()

    def _publish_waiting(self) -> None:
        while self._waiting:
            self._publish_next()

    def _publish_next(self) -> None:
        for name, cdr in self._waiting.popleft().messages:
            self._publish(name, cdr)
        self._last = time.monotonic()

    def _run(self) -> None:
        while not self._ended:
            with self._condition:
                if not self._waiting:
                    self._condition.wait()
                    continue
                moment = self._waiting[0]
                delay = max(moment.due, self._last + moment.gap) - time.monotonic()
                if delay <= 0.0:
                    self._publish_next()
                    continue
            time.sleep(min(delay, LONGEST_SLEEP_S))


class _PolledGroup(CallbackGroup):
    """Keeps its subscriptions out of what the executor waits for."""

    def can_execute(self, entity: Any) -> bool:
        """Say that nothing is ever ready: the waitable only counts."""
        return False

    def beginning_execution(self, entity: Any) -> bool:
        """Never begin."""
        return False

    def ending_execution(self, entity: Any) -> None:
        """Do nothing: nothing has begun."""


def source_of(info: Mapping[str, Any]) -> bytes:
    """Take the identity of the publisher out of what comes with a message; empty in an older rclpy."""
    found = info.get("publisher_gid")
    return bytes(found["data"]) if found else b""


class RawIntake:
    """Subscriptions that hand over CDR bytes, all queues emptied in one sweep.

    Parameters
    ----------
    node : rclpy.node.Node
    polled : bool
        Messages do not wake the executor, which costs more than taking them: a timer of the node calls
        `sweep`.
    """

    def __init__(self, node: Any, *, polled: bool = False) -> None:
        self._node = node
        self._group = _PolledGroup() if polled else None
        self._subscriptions: list[tuple[Any, Any, SourcedHandler]] = []

    def add(
        self,
        entry: Topic,
        handler: Callable[[bytes], None],
        keep_all: bool = True,
        complete: bool = False,
    ) -> None:
        """Subscribe to a topic; `handler` gets the bytes of each message, in order."""
        self.add_sourced(entry, lambda cdr, _source: handler(cdr), keep_all, complete)

    def add_sourced(
        self, entry: Topic, handler: SourcedHandler, keep_all: bool = True, complete: bool = False
    ) -> None:
        """Subscribe to a topic; `handler` also gets the identity of the publisher, empty when not known."""
        kind = message_class(entry.type)

        def on_message(cdr: bytes, info: Mapping[str, Any]) -> None:
            handler(cdr, source_of(info))
            self.sweep()

        subscription = self._node.create_subscription(
            kind,
            entry.name,
            on_message,
            quality_of_service(entry, keep_all, complete),
            callback_group=self._group,
            raw=True,
        )
        self._subscriptions.append((subscription, kind, handler))

    def sweep(self) -> int:
        """Take what has arrived, of each topic up to `LONGEST_SWEEP`; how many messages that were."""
        total = 0
        for subscription, kind, handler in self._subscriptions:
            handle = subscription.handle
            count = 0
            try:
                with handle:
                    while count < LONGEST_SWEEP and (taken := handle.take_message(kind, True)) is not None:
                        handler(taken[0], source_of(taken[1]))
                        count += 1
            except InvalidHandle:
                continue
            finally:
                total += count
        return total

    def sweep_to_the_end(self) -> None:
        """Take everything that has arrived, however much it is; a sender without a pause is left."""
        for _ in range(MOST_SWEEPS):
            if self.sweep() < LONGEST_SWEEP:  # so no queue has kept anything back
                return

    def publisher_counts(self) -> dict[str, int]:
        """Count the publishers that each subscription is connected to, by absolute topic name."""
        return {
            subscription.topic_name: subscription.get_publisher_count()
            for subscription, _, _ in self._subscriptions
        }

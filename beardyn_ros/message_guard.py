"""The one intake of every node: refused is what its topic does not promise, or another publisher sends.

Anybody may publish on any topic. Of each topic one publisher is followed, and rather the node that the topic
is named for. A second publisher next to it is refused and counted; it is followed when the first has gone.
Every message carries the identity of its publisher, and the graph states which node that is.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from beardyn_core.record import plot_values as values
from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.messages import Diagnostic, decode_diagnostics
from beardyn_core.record.plot_values import value_topics
from beardyn_core.record.topics import Topic
from beardyn_ros.diagnostics import FOLLOWER, LOAD, MONITOR, TWIN, diagnostic_name
from beardyn_ros.wire import SourcedHandler

WARN_PERIOD_S = 5.0
LOOK_PERIOD_S, NEW_LOOK_PERIOD_S = 1.0, 0.05  # a look at the graph costs as much as a hundred messages
SILENT_AFTER_S = 2.0
SPEAKERS = (TWIN, LOAD, MONITOR, FOLLOWER)
_OF_NODES = {
    "load/blocks": LOAD,
    "load/truth": LOAD,
    "load/wrench": LOAD,
    "load/shaft": LOAD,
    "monitor/result": MONITOR,
    "follower/estimate": FOLLOWER,
    "follower/residual": FOLLOWER,
    "vibration_samples": MONITOR,
    **dict.fromkeys(value_topics(values.MONITOR), MONITOR),
    **dict.fromkeys(value_topics(values.FOLLOWER), FOLLOWER),
}
_OF_TWIN = (
    *("truth", "force", "force_waveform", "vibration", "imu", "shaft", "joint_states", "bodies", "contacts"),
    *("temperature", "load/consumed", "source_time"),
)
ANYBODY = ("/diagnostics", "/clock")


@dataclass(frozen=True)
class Publisher:
    """A publisher in the graph."""

    space: str
    node: str


class Sources:
    """Follows one publisher a topic.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose graph is looked at.
    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self._followed: dict[str, bytes] = {}
        self._own: dict[str, bool] = {}  # whether who is followed is the node that the topic is named for
        self._known: dict[str, dict[bytes, Publisher]] = {}
        self._looked_at: dict[str, float] = {}
        self._received_at: dict[str, float] = {}
        self._silent: set[str] = set()
        self._named: set[str] = set()  # topics that the node they are named for has published on

    def problem(self, entry: Topic, source: bytes) -> str:
        """Describe why a message is not taken; empty when it is, and its publisher is followed from then on.

        Parameters
        ----------
        entry : Topic
        source : bytes
            Identity of the publisher; empty where the middleware does not give it: then it is taken.
        """
        if not source or entry.name in ANYBODY:
            return ""
        return self._problem(entry.name, entry.name, _node_of(entry.name), source)

    def problem_of_statuses(self, statuses: tuple[Diagnostic, ...], source: bytes) -> str:
        """Describe why statuses are not taken: another node speaks in the name of one that is followed."""
        if not source:
            return ""
        space = self._node.get_namespace()
        names = {diagnostic_name(space, part): part for part in SPEAKERS}
        for status in statuses:
            part = names.get(status.name)
            if part is None:
                continue
            if problem := self._problem("/diagnostics", f"status {status.name}", part, source):
                return problem
            self._received_at[part] = time.monotonic()
        return ""

    def problem_of_name(self, source: bytes) -> str:
        """Describe why a publisher of diagnostics does not speak for a node of this node's full name."""
        own = Publisher(self._node.get_namespace(), self._node.get_name())
        publisher = self._publishers("/diagnostics", source).get(source)
        if not source or publisher == own:
            return ""
        return f"it speaks in the name of this node and comes from {_name(publisher)}"

    def look(self) -> None:
        """Note who is silent; to be called when everything that has come is taken."""
        now = time.monotonic()
        self._silent = {part for part, at in self._received_at.items() if now - at > SILENT_AFTER_S}

    def follows(self, name: str, source: bytes) -> bool:
        """Check whether a publisher is the one that is followed; True when nobody is."""
        return not source or self._followed.get(name, source) == source

    def is_there(self, name: str, source: bytes) -> bool:
        """Check whether a publisher is still in the graph; True when its identity is not known."""
        return not source or source in self._publishers(name, source)

    def count(self, name: str) -> int:
        """Count the publishers of a topic that are the node it is named for, from when there has been one.

        A stranger that publishes `truth` must not stand for a twin that has gone.
        """
        count = int(self._node.count_publishers(self._node.resolve_topic_name(name)))
        if count == 0:
            return 0
        publishers = self._publishers(name).values()
        own = sum(self._is_own(each, _node_of(name)) for each in publishers)
        if own:
            self._named.add(name)
        return own if name in self._named else count

    def _problem(self, name: str, key: str, part: str, source: bytes) -> str:
        followed = self._followed.get(key)
        if followed == source:
            return ""
        known = self._publishers(name, source)
        own_there = any(self._is_own(each, part) for each in known.values())
        if followed in known and self._is_own(known[followed], part):
            self._own[key] = True  # the graph learns names later than messages come
        publisher = known.get(source)
        own = publisher is not None and self._is_own(publisher, part)
        if followed is None:
            free = own or not own_there
        elif self._own[key]:
            # a node of the same name after this one, such as a twin that was started again
            free = own and (followed not in known or part in self._silent)
        else:
            free = own or followed not in known
        if free:
            self._followed[key], self._own[key] = source, own
            return ""
        return (
            f"it comes from a second publisher, {_name(publisher)}; followed is "
            f"{_name(known.get(followed)) if followed else f'the node {part}'}"
        )

    def _is_own(self, publisher: Publisher, part: str) -> bool:
        return bool(part) and publisher == Publisher(self._node.get_namespace(), part)

    def _publishers(self, name: str, source: bytes = b"") -> dict[bytes, Publisher]:
        """Look up the publishers of a topic in the graph: soon for a new one, else at intervals."""
        known, now = self._known.get(name, {}), time.monotonic()
        period = LOOK_PERIOD_S if not source or source in known else NEW_LOOK_PERIOD_S
        if now - self._looked_at.get(name, -period) >= period:
            self._looked_at[name] = now
            infos = self._node.get_publishers_info_by_topic(self._node.resolve_topic_name(name))
            known = {
                bytes(info.endpoint_gid): Publisher(info.node_namespace, info.node_name) for info in infos
            }
            self._known[name] = known
        return known


class MessageGuard:
    """Counts refused messages, warns of them, and passes the others on.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose log reports them.

    Attributes
    ----------
    checker : MessageChecker
        What the messages of the run must be.
    sources : Sources
        Whose messages are taken.
    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self.checker = MessageChecker()
        self.sources = Sources(node)
        self.counts: Counter[str] = Counter()
        self.last_sentence = ""
        self._warned_at = -WARN_PERIOD_S

    def guard_handler(self, entry: Topic, handler: Callable[[bytes], None]) -> SourcedHandler:
        """Make a handler of one topic that gets only what can be used."""
        return self.guarded_sourced(entry, lambda cdr, _source: handler(cdr))

    def guarded_sourced(self, entry: Topic, handler: SourcedHandler) -> SourcedHandler:
        """Make a handler of one topic that gets only what can be used, with its publisher."""

        def take(cdr: bytes, source: bytes) -> None:
            problem = self.problem(entry, cdr, source)
            if problem:
                self.refuse(entry.name, problem)
            else:
                handler(cdr, source)

        return take

    def problem(self, entry: Topic, cdr: bytes, source: bytes) -> str:
        """Describe why a message is not taken; empty when it is."""
        if found := self.checker.problem(entry, cdr) or self.sources.problem(entry, source):
            return found
        if entry.name == "/diagnostics":
            return self.sources.problem_of_statuses(decode_diagnostics(cdr)[1], source)
        return ""

    @property
    def total(self) -> int:
        """Messages refused so far."""
        return self.counts.total()

    def values(self) -> tuple[tuple[str, str], ...]:
        """Give the values of a diagnostic: how many in all, and by topic."""
        each = tuple((f"refused: {name}", str(count)) for name, count in sorted(self.counts.items()))
        return (("refused_messages", str(self.total)), *each)

    def sentence(self) -> str:
        """Describe what was refused; empty when nothing was."""
        return f"{self.total} message(s) refused, the last: {self.last_sentence}" if self.total else ""

    def refuse(self, name: str, problem: str) -> None:
        """Count a message that is not taken."""
        self.counts[name] += 1
        self.last_sentence = f"{name}: {problem}"
        now = time.monotonic()  # a logger that throttles looks up its caller first: as much as 20 messages
        if now - self._warned_at > WARN_PERIOD_S:
            self._warned_at = now
            self._node.get_logger().warning(f"message refused, {self.last_sentence}")


def _node_of(name: str) -> str:
    """Name the node that a topic is named for; empty when it is none."""
    if name in _OF_TWIN or name.startswith("vibration/"):
        return TWIN
    return _OF_NODES.get(name, "")


def _name(publisher: Publisher | None) -> str:
    return f"{publisher.space.rstrip('/')}/{publisher.node}" if publisher else "one that has gone"

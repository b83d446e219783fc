"""The one intake of every node: refused is what its topic does not promise, or another publisher sends."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from typing import Any

from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.messages import decode_diagnostics
from beardyn_core.record.topics import Topic
from beardyn_ros.sources import Sources
from beardyn_ros.wire import SourcedHandler

WARN_PERIOD_S = 5.0


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

    def guarded(self, entry: Topic, handler: Callable[[bytes], None]) -> SourcedHandler:
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

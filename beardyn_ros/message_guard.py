"""Messages that a node does not take, because they are not what their topic promises."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.topics import Topic

WARN_PERIOD_S = 5.0


class MessageGuard:
    """Counts malformed messages, warns of them, and passes the others on.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose log tells of them.
    """

    def __init__(self, node: Any) -> None:
        self._node = node
        self.checker = MessageChecker()
        self.counts: Counter[str] = Counter()
        self.last_sentence = ""

    def guarded(self, entry: Topic, handler: Callable[[bytes], None]) -> Callable[[bytes], None]:
        """Make a handler of one topic that gets only what can be used."""
        problem_with = self.checker.problem

        def take(cdr: bytes) -> None:
            problem = problem_with(entry, cdr)
            if problem:
                self._refuse(entry.name, problem)
            else:
                handler(cdr)

        return take

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
        return (
            f"{self.total} malformed message(s) refused, the last: {self.last_sentence}" if self.total else ""
        )

    def _refuse(self, name: str, problem: str) -> None:
        self.counts[name] += 1
        self.last_sentence = f"{name}: {problem}"
        self._node.get_logger().warning(
            f"malformed message refused, {self.last_sentence}", throttle_duration_sec=WARN_PERIOD_S
        )

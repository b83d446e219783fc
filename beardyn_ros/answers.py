"""Services that answer when the work is done, while their node goes on."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.task import Future
from std_srvs.srv import Trigger

PATIENCE_S = 10.0


class StepService:
    """Service ``step`` of one more piece of work, answered when the piece is done.

    Parameters
    ----------
    node : rclpy.node.Node
    name : str
    order : callable
        Orders a piece; a sentence when that is not possible, '' otherwise.
    done : str
        What the answer says then.
    """

    def __init__(self, node: Any, name: str, order: Callable[[], str], done: str) -> None:
        self._order = order
        self._done = done
        self._waiting: deque[tuple[float, Future[str]]] = deque()
        # a group of its own: an answer that waits must not hold up the other callbacks of the node
        node.create_service(Trigger, name, self._on_request, callback_group=ReentrantCallbackGroup())

    async def _on_request(self, _request: Any, response: Any) -> Any:
        problem = self._order()
        if not problem:
            answer: Future[str] = Future()
            self._waiting.append((time.monotonic() + PATIENCE_S, answer))
            problem = await answer or ""
        response.success, response.message = not problem, problem or self._done
        return response

    def complete(self) -> None:
        """Answer the oldest order: it is done."""
        if self._waiting:
            self._waiting.popleft()[1].set_result("")

    def fail(self, problem: str) -> None:
        """Answer every order: it will not be done."""
        while self._waiting:
            self._waiting.popleft()[1].set_result(problem)

    def fail_late(self, problem: str) -> None:
        """Answer the orders that have waited for longer than `PATIENCE_S` seconds."""
        while self._waiting and self._waiting[0][0] < time.monotonic():
            self._waiting.popleft()[1].set_result(problem)

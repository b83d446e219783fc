"""Computed blocks that are not due yet: a short load on the machine is no delay while there are some."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from beardyn_core.sensors.block import Block
from beardyn_ros.run_control import RunLeftError
from beardyn_ros.run_state import Outgoing


@dataclass(frozen=True)
class ComputedBlock:
    """A block with its messages.

    Parameters
    ----------
    outgoing : Outgoing
    block : Block
    busy_s : float
        Time from load to messages, [s].
    """

    outgoing: Outgoing
    block: Block
    busy_s: float


class BlocksAhead:
    """Hands computed blocks over in their order, from a thread of its own, while others are computed.

    Parameters
    ----------
    most : int
        Blocks that may wait when another one is begun; 0: each is handed over before the next is begun.
    condition : threading.Condition
        Guards the blocks.
    wait : callable
        ``wait(ready)`` blocks a thread until `ready`; raises `RunLeftError` when the run is left.
    hand_over : callable
        Waits until a block is due and hands it over.
    leave : callable
        Lets the other thread leave the run when that fails.

    Attributes
    ----------
    failure : Exception or None
        Why no more blocks are handed over.
    """

    def __init__(
        self,
        most: int,
        condition: threading.Condition,
        wait: Callable[[Callable[[], bool]], object],
        hand_over: Callable[[ComputedBlock], None],
        leave: Callable[[], None],
    ) -> None:
        self.most = most
        self._condition = condition
        self._wait = wait
        self._hand_over = hand_over
        self._leave = leave
        self._blocks: deque[ComputedBlock] = deque()
        self.failure: Exception | None = None
        self._thread = threading.Thread(target=self._thread_main, name="blocks ahead", daemon=True)
        self._thread.start()

    @property
    def is_waiting(self) -> bool:
        """Whether any block has not been handed over."""
        return bool(self._blocks)

    def append(self, computed: ComputedBlock) -> None:
        """Take a block that is handed over when it is due."""
        with self._condition:
            self._blocks.append(computed)
            self._condition.notify_all()

    def wait_for_room(self) -> None:
        """Wait until another block may be begun."""
        self._wait(lambda: len(self._blocks) <= self.most)

    def drain(self) -> None:
        """Wait until every block has been handed over."""
        self._wait(lambda: not self._blocks)

    def join(self) -> None:
        """Wait for the end of the thread, which leaves with the run."""
        self._thread.join()

    def _thread_main(self) -> None:
        try:
            while True:
                self._wait(lambda: bool(self._blocks))
                self._hand_over(self._blocks[0])
                with self._condition:
                    self._blocks.popleft()
                    self._condition.notify_all()
        except RunLeftError:
            pass
        except Exception as error:
            self.failure = error
            self._leave()

"""What is asked of a run while it goes: active, paused, steps, a reset, the end; waiting that sees it."""

from __future__ import annotations

import threading
from collections.abc import Callable


class RunLeftError(Exception):
    """The run is left because of a reset or the end of the process."""


class RunControl:
    """Orders from the executor's thread, obeyed by the threads of a run.

    Parameters
    ----------
    condition : threading.Condition
        Guards the orders and all that is waited for.
    """

    def __init__(self, condition: threading.Condition) -> None:
        self._condition = condition
        self.active = False
        self.paused = False
        self.is_reset = False
        self.is_ending = False
        self._steps = 0
        self._is_left = False

    def activate(self, active: bool) -> None:
        """Run, or hold still without losing anything."""
        with self._condition:
            self.active = active
            self._condition.notify_all()

    def pause(self, paused: bool) -> None:
        """Hold before the next block, or go on."""
        with self._condition:
            self.paused = paused
            self._steps = 0
            self._condition.notify_all()

    def step(self) -> None:
        """Let one block through while paused."""
        with self._condition:
            self._steps += 1
            self._condition.notify_all()

    def reset(self) -> None:
        """Leave the run for the next one."""
        with self._condition:
            self.is_reset = True
            self._condition.notify_all()

    def end(self) -> None:
        """Leave the run, and all that waits."""
        with self._condition:
            self.is_ending = True
            self._condition.notify_all()

    def leave(self) -> None:
        """Leave the run, until `begin`."""
        with self._condition:
            self._is_left = True
            self._condition.notify_all()

    def begin(self) -> None:
        """Wait for things again: both threads have left."""
        with self._condition:
            self._is_left = False

    @property
    def is_held(self) -> bool:
        """Whether no block may go on; under the condition or as a first look."""
        return not self.active or (self.paused and not self._steps)

    def take_turn(self) -> bool:
        """Take the turn of a block that may go on; whether a step has ordered it."""
        with self._condition:
            ordered = self._steps > 0
            self._steps -= ordered
        return ordered

    def wait(self, ready: Callable[[], bool], timeout: float = 0.0) -> bool:
        """Wait until `ready`; False after `timeout` seconds (0: for ever).

        Raises
        ------
        RunLeftError
            The run is left.
        """

        def left() -> bool:
            return self.is_ending or self.is_reset or self._is_left

        with self._condition:
            self._condition.wait_for(lambda: left() or ready(), timeout or None)
            if left():
                raise RunLeftError
            return ready()

    def wait_for_reset(self) -> bool:
        """Wait behind a run for the next one; False at the end of the process."""
        with self._condition:
            self._condition.wait_for(lambda: self.is_ending or self.is_reset)
            return self.is_reset and not self.is_ending

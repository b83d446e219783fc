"""What the other nodes need to know about the twin: is it there, has it ended, how."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from beardyn_core.record.messages import Diagnostic
from beardyn_ros.run_state import END_STATES, FINISHED, LEFT

VANISHED_AFTER_S = 3.0
SILENT_AFTER_S = 2.0
MOST_OTHERS = 16  # runs whose status is kept until their truth comes


class TwinWatch:
    """Follows the diagnostics of one twin and the presence of its publishers.

    Parameters
    ----------
    name : str
        Full name of the twin's status, as `diagnostics.diagnostic_name` makes it: ``axlebox/twin``.
    publisher_count : callable
        How many publishers one of the twin's topics has.
    """

    def __init__(self, name: str, publisher_count: Callable[[], int]) -> None:
        self.name = name
        self._publisher_count = publisher_count
        self._run_id = ""
        self._told = False
        self._heard_at = -math.inf
        self.speaks = False
        self._seen = False
        self._absent_since: float | None = time.monotonic()
        self.last: Diagnostic | None = None
        self._others: dict[str, Diagnostic] = {}  # last statuses of other runs by run id

    def begin_run(self, run_id: str) -> None:
        """Follow the run that a ``truth`` has told; what was said about others is forgotten.

        Topics are not ordered among each other: what the twin said about this run may have come before.
        """
        if self.last is None or self.last.value("run_id") != run_id:
            self.last = self._others.get(run_id)
        self._others.clear()
        self._run_id, self._told = run_id, bool(run_id)

    def take_statuses(self, statuses: tuple[Diagnostic, ...]) -> None:
        """Take the statuses of one diagnostics message; those of other twins and other runs are left."""
        for status in statuses:
            if status.name != self.name:
                continue
            run_id = status.value("run_id") or ""
            if not self._told and run_id:
                self._run_id = run_id
            if run_id == self._run_id:
                self.last, self._heard_at, self.speaks = status, time.monotonic(), True
            else:
                self._others[run_id] = status
                while len(self._others) > MOST_OTHERS:
                    del self._others[next(iter(self._others))]

    def look(self) -> None:
        """Note whether the twin speaks of its run; to be called when everything that has come is taken."""
        self.speaks = time.monotonic() - self._heard_at < SILENT_AFTER_S

    def value(self, key: str, default: Any = None) -> Any:
        """Look up a value of the twin's last status."""
        found = self.last.value(key) if self.last else None
        return default if found is None else found

    @property
    def ended(self) -> bool:
        """Whether the twin has said that its run is over, and no reset begins another."""
        left = self.last is not None and self.last.message.startswith(LEFT)
        return self.value("state") in END_STATES and not left

    @property
    def end_sentence(self) -> str:
        """Empty when the run ended as asked."""
        return "" if self.value("state") == FINISHED or self.last is None else self.last.message

    def absent_for(self) -> float:
        """Compute for how long the twin has been seen to be away, or the watch has waited for it, [s]."""
        if self._publisher_count() > 0:
            self._seen, self._absent_since = True, None
            return 0.0
        if self._absent_since is None:
            self._absent_since = time.monotonic()
        return time.monotonic() - self._absent_since

    def vanished(self) -> bool:
        """Check whether the twin was there and is gone without a word."""
        return self.absent_for() > VANISHED_AFTER_S and self._seen

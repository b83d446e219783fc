"""What nodes know of each other by ``/diagnostics``: names of statuses, the twin's run, twins of one name."""

from __future__ import annotations

import math
import time
import uuid
from collections.abc import Callable
from typing import Any

from beardyn_core.record.messages import Diagnostic, decode_diagnostics
from beardyn_ros.run_state import END_STATES, FINISHED, LEFT

OK, WARN, ERROR = 0, 1, 2
TWIN = "twin"
LOAD = "load"
RECORDER = "recorder"
MONITOR = "monitor"
FOLLOWER = "follower"
LAG = "lag"
VANISHED_AFTER_S = 3.0
SILENT_AFTER_S = 2.0
NAMESAKE_SILENT_AFTER_S = 1.0
MOST_OTHERS = 16  # runs whose status is kept until their truth comes
LONGEST_TIME = 20  # digits of a time in nanoseconds


def diagnostic_name(namespace: str, part: str) -> str:
    """Make the name of a status, unique among several axleboxes: ``axlebox/twin``."""
    return f"{namespace.strip('/')}/{part}" if namespace.strip("/") else part


def run_instance(run_id: str) -> str:
    """Return the part of a run id that its twin keeps through resets."""
    return run_id.rpartition("-")[0]


class TwinWatch:
    """Follows the diagnostics of one twin and the presence of its publishers.

    Parameters
    ----------
    name : str
        Full name of the twin's status, as `diagnostic_name` makes it: ``axlebox/twin``.
    publisher_count : callable
        How many publishers one of the twin's topics has.
    """

    def __init__(self, name: str, publisher_count: Callable[[], int]) -> None:
        self.name = name
        self._publisher_count = publisher_count
        self._run_id = ""
        self._told = False
        self._received_at = -math.inf
        self.speaks = False
        self._seen = False
        self._absent_since: float | None = time.monotonic()
        self.last: Diagnostic | None = None
        self._others: dict[str, Diagnostic] = {}  # last statuses of other runs by run id

    def begin_run(self, run_id: str) -> None:
        """Follow the run that a ``truth`` has announced; what was said about others is forgotten.

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
                self.last, self._received_at, self.speaks = status, time.monotonic(), True
            else:
                self._others[run_id] = status
                while len(self._others) > MOST_OTHERS:
                    del self._others[next(iter(self._others))]

    def look(self) -> None:
        """Note whether the twin speaks of its run; to be called when everything that has come is taken."""
        self.speaks = time.monotonic() - self._received_at < SILENT_AFTER_S

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


class Namesakes:
    """Finds other live twins under the same full name by their diagnostics.

    Parameters
    ----------
    name : str
        Of the status, as `diagnostic_name` makes it.
    """

    def __init__(self, name: str) -> None:
        self.instance = uuid.uuid4().hex[:8]
        self.since_ns = time.time_ns()
        self._name = name
        self._mark = name.encode() + b"\0"
        self._own = self.instance.encode() + b"\0"
        self._older_at = self._younger_at = -NAMESAKE_SILENT_AFTER_S

    def is_named_in(self, cdr: bytes) -> bool:
        """Check whether a diagnostics message has the status of another twin of this name.

        A sentence in the status of another part may name the twin too, even at its end.
        """
        if self._mark not in cdr or self._own in cdr:
            return False
        statuses = decode_diagnostics(cdr)[1]
        return any(each.name == self._name and each.value("instance") != self.instance for each in statuses)

    def receive(self, cdr: bytes) -> None:
        """Take one diagnostics message of a node of this name."""
        if not self.is_named_in(cdr):
            return
        for status in decode_diagnostics(cdr)[1]:
            instance = status.value("instance")
            if status.name != self._name or instance in (None, self.instance):
                continue
            since = status.value("since") or "0"
            if not since.isdecimal() or len(since) > LONGEST_TIME:
                continue
            other = (int(since), instance)
            if other < (self.since_ns, self.instance):
                self._older_at = time.monotonic()
            else:
                self._younger_at = time.monotonic()

    @property
    def older(self) -> bool:
        """Whether a twin that was here before has spoken within the last second."""
        return time.monotonic() - self._older_at < NAMESAKE_SILENT_AFTER_S

    @property
    def younger(self) -> bool:
        """Whether a twin that came later has spoken within the last second."""
        return time.monotonic() - self._younger_at < NAMESAKE_SILENT_AFTER_S

"""Who is who among several axleboxes: frame of a load, runs of a twin, two twins under one name."""

from __future__ import annotations

import struct
import time
import uuid

from beardyn_core.record.messages import decode_diagnostics

SILENT_AFTER_S = 1.0
LONGEST_TIME = 20  # digits of a time in nanoseconds
_LENGTH = struct.Struct("<I")
_FRAME_AT = 12  # behind the encapsulation and the stamp


def header_frame(cdr: bytes) -> str:
    """Read the frame of a message that begins with a header, without decoding it."""
    (length,) = _LENGTH.unpack_from(cdr, _FRAME_AT)
    begin = _FRAME_AT + _LENGTH.size
    return cdr[begin : begin + max(length - 1, 0)].decode("utf-8", errors="replace")


def wrong_frame(cdr: bytes, frame: str) -> tuple[str, str] | None:
    """Give reason and sentence when a message is of another frame; one that names no frame is taken."""
    found = header_frame(cdr)
    if found in ("", frame):
        return None
    return (
        "wrong frame",
        f"its frame is '{found}', this twin takes load in '{frame}' (parameter frame_id)",
    )


def run_instance(run_id: str) -> str:
    """Return the part of a run id that its twin keeps through resets."""
    return run_id.rpartition("-")[0]


class Namesakes:
    """Finds other live twins under the same full name by their diagnostics.

    Parameters
    ----------
    name : str
        Of the status, as `diagnostics.diagnostic_name` makes it.
    """

    def __init__(self, name: str) -> None:
        self.instance = uuid.uuid4().hex[:8]
        self.since_ns = time.time_ns()
        self._name = name
        self._mark = name.encode() + b"\0"
        self._own = self.instance.encode() + b"\0"
        self._older_at = self._younger_at = -SILENT_AFTER_S

    def is_named_in(self, cdr: bytes) -> bool:
        """Check whether a diagnostics message has the status of another twin of this name.

        A sentence in the status of another part may name the twin too, even at its end.
        """
        if self._mark not in cdr or self._own in cdr:
            return False
        statuses = decode_diagnostics(cdr)[1]
        return any(each.name == self._name and each.value("instance") != self.instance for each in statuses)

    def hear(self, cdr: bytes) -> None:
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
        return time.monotonic() - self._older_at < SILENT_AFTER_S

    @property
    def younger(self) -> bool:
        """Whether a twin that came later has spoken within the last second."""
        return time.monotonic() - self._younger_at < SILENT_AFTER_S

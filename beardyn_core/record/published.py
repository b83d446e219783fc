"""What a twin says it has published, compared with what has been recorded of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from math import isfinite
from typing import Annotated as A

from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.topics import NAMESPACE, relative_name

PREFIX = "messages "
LONGEST_COUNT = 15  # digits
# Others speak there too: which run a message belongs to is not known.
_NOT_COUNTED = ("/diagnostics", "/clock", "source_time")
BLOCKS = ("force_waveform", "vibration", "bodies", "contacts")
_BLOCK_NS, _TEMPERATURE_NS = 20_000_000, 200_000_000
_TREND_NS = {"force": 2_500_000, "imu": 2_500_000, "shaft": 2_500_000, "joint_states": 5_000_000}


@dataclass(frozen=True)
class MissingMessages:
    """Messages of one topic that were published and are not recorded."""

    topic: A[str, "its name in the topic table"]
    published: int
    recorded: int

    @property
    def count(self) -> int:
        """How many are missing."""
        return self.published - self.recorded


def published_values(counts: Mapping[str, int]) -> tuple[tuple[str, str], ...]:
    """Write how many messages of each topic were published as values of a diagnostic."""
    return tuple((f"{PREFIX}{name}", str(count)) for name, count in sorted(counts.items()))


def published_counts(status: Diagnostic, namespace: str = NAMESPACE) -> dict[str, int]:
    """Read how many messages of each topic a twin has published, by name in the table.

    Parameters
    ----------
    status : Diagnostic
        Last word of a twin; an earlier one has no counts.
    namespace : str
        Of its topics.
    """
    return {
        relative_name(key.removeprefix(PREFIX), namespace): int(value)
        for key, value in status.values
        if key.startswith(PREFIX) and value.isdecimal() and len(value) <= LONGEST_COUNT
    }


def last_published(statuses: Iterable[Diagnostic], namespace: str = NAMESPACE) -> dict[str, int] | None:
    """Find the last word of the twin of a namespace and what it says it has published.

    Parameters
    ----------
    statuses : iterable of Diagnostic
        In the order of time.
    namespace : str

    Returns
    -------
    dict of str to int, or None
        ``None``: the twin has had no last word, as after a crash, so nobody knows.
    """
    name = f"{namespace.strip('/')}/twin".lstrip("/")
    found = None
    for status in statuses:
        if status.name == name:
            found = published_counts(status, namespace) or found
    return found


_GOES_ON = (None, "running", "paused", "waiting for load")  # states of a twin that has not ended


def kept_pace(statuses: Iterable[Diagnostic], namespace: str = NAMESPACE) -> tuple[float | None, int | None]:
    """Find what the twin of a namespace says of its pace when it has ended: the pace, and its late blocks.

    Both are ``None`` where no pace was asked for, or where the twin has had no last word: while it runs its
    pace is that of the last second.
    """
    name = f"{namespace.strip('/')}/twin".lstrip("/")
    last = None
    for status in statuses:
        if status.name == name and status.value("pace") is not None:
            last = status
    if last is None or last.value("state") in _GOES_ON or not _read_number(last.value("speed_factor")):
        return None, None
    late = last.value("late_blocks") or ""
    counted = late.isdecimal() and len(late) <= LONGEST_COUNT
    return _read_number(last.value("pace")), int(late) if counted else None


def _read_number(text: str | None) -> float | None:
    """Read a finite number; ``None`` for what is none, as a foreign diagnostic may have it."""
    with suppress(ValueError):
        number = float(text or "")
        return number if isfinite(number) else None
    return None


def published_before(first_ns: Mapping[str, int], parts: int = 1) -> dict[str, int]:
    """Count the messages of a run that a recorder which joined late could not receive.

    A recorder that has the first block of any topic was there from the start: then nothing was before it,
    and what lacks was lost.

    Parameters
    ----------
    first_ns : mapping of str to int
        First stamp of each topic in the recording, by name in the table, [ns].
    parts : int
        Parts whose temperature is published.

    Returns
    -------
    dict of str to int
        Empty when the recorder was there from the start.
    """
    found = {}
    for name, stamp in first_ns.items():
        if name in _TREND_NS:
            found[name] = round(stamp / _TREND_NS[name])
        elif name in BLOCKS or name.startswith("vibration/"):
            found[name] = round(stamp / _BLOCK_NS)
    if not found or min(found.values()) <= 0:
        return {}
    if "temperature" in first_ns:
        found["temperature"] = parts * max(round((first_ns["temperature"] - _BLOCK_NS) / _TEMPERATURE_NS), 0)
    return found


def missing_messages(
    published: Mapping[str, int], recorded: Mapping[str, int], before: Mapping[str, int] | None = None
) -> list[MissingMessages]:
    """List the topics of which fewer messages are recorded than were published.

    Parameters
    ----------
    published, recorded : mapping of str to int
        Messages by name in the topic table.
    before : mapping of str to int, optional
        Published before the recording began, see `published_before`.
    """
    early = before or {}
    wanted = {name: count - early.get(name, 0) for name, count in published.items()}
    return [
        MissingMessages(name, count, recorded.get(name, 0))
        for name, count in sorted(wanted.items())
        if recorded.get(name, 0) < count and name not in _NOT_COUNTED
    ]


def missing_sentence(missing: Iterable[MissingMessages]) -> str:
    """Describe what is missing, by topic; empty when nothing is."""
    parts = [f"{each.topic} {each.count} of {each.published}" for each in missing]
    return f"published messages that are not in the file: {', '.join(parts)}" if parts else ""

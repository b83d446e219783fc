"""What a twin says it has published, beside what has been recorded of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.topics import NAMESPACE, relative_name

PREFIX = "messages "
# Others speak there too: which run a message belongs to is not to be told.
_NOT_COUNTED = ("/diagnostics", "/clock")


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
        if key.startswith(PREFIX) and value.isdecimal()
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


def missing_messages(published: Mapping[str, int], recorded: Mapping[str, int]) -> list[MissingMessages]:
    """List the topics of which fewer messages are recorded than were published.

    Parameters
    ----------
    published, recorded : mapping of str to int
        Messages by name in the topic table.
    """
    return [
        MissingMessages(name, count, recorded.get(name, 0))
        for name, count in sorted(published.items())
        if recorded.get(name, 0) < count and name not in _NOT_COUNTED
    ]


def missing_sentence(missing: Iterable[MissingMessages]) -> str:
    """Describe what is missing, by topic; empty when nothing is."""
    parts = [f"{each.topic} {each.count} of {each.published}" for each in missing]
    return f"published messages that are not in the file: {', '.join(parts)}" if parts else ""

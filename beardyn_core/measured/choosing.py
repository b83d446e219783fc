"""A file while its channels are chosen: a channel by name, and the sentences about all that is found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Source

_SHOWN = 12


@dataclass
class Choosing:
    """What has been found so far: what must be asked for, how the file was understood, what differs."""

    path: Path
    source: Source
    reading: Reading
    problems: list[str] = field(default_factory=list)
    told: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def complain(self, sentence: str) -> None:
        """Add a sentence about the file to what must be asked for."""
        self.problems.append(f"{self.path}: {sentence}")


def list_names(names: Sequence[str]) -> str:
    """List names of channels, the first of many."""
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"{', '.join(names[:_SHOWN])}{more}" if names else "none"


def find_channel(work: Choosing, option: str, pattern: str) -> Channel | None:
    """Find the channel of a name, of a pattern, or by its number from 1."""
    channels = work.source.channels
    exact = [each for each in channels if each.name == pattern]
    fitting = exact or [each for each in channels if fnmatchcase(each.name, pattern)]
    if not fitting and pattern.isdecimal() and 0 < int(pattern) <= len(channels):
        fitting = [channels[int(pattern) - 1]]
    if len(fitting) == 1:
        return fitting[0]
    names = list_names([each.name for each in (fitting or channels)])
    if fitting:
        work.complain(f"{option} {pattern!r} fits several channels, {names}; it must be one")
    else:
        work.complain(f"{option} {pattern!r} is no channel of the file; it has {names}")
    return None

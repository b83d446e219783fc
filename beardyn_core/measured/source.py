"""What a file has: its channels, their samples block by block, and what it says about itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated as A
from typing import Any, Protocol

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.claimed_rate import Claim
from beardyn_core.measured.claimed_start import Start

BLOCK = 65_536
"""Samples that are in memory at a time of a format that is read in blocks."""


@dataclass(frozen=True)
class Channel:
    """One signal of a file."""

    name: str
    table: A[str, "channels of one table are sampled together"] = ""
    count: A[int | None, "samples; None: known at the end of the file"] = None
    unit: A[str, "as the file has it; empty when it has none"] = ""
    claims: A[tuple[Claim, ...], "on its sampling rate, the nearest first"] = ()
    start: A[Start | None, "of its first sample, where the file has it next to the samples"] = None
    is_time: A[bool, "the format itself marks this as the time, in seconds"] = False
    axis: A[str, "``x``, ``y`` or ``z`` where the format itself states it"] = ""


class Source(Protocol):
    """An open file."""

    channels: tuple[Channel, ...]
    numbers: Mapping[str, float]
    """Single numbers next to the channels, by name."""
    facts: Mapping[str, str]
    """What else the file states about itself."""
    notes: tuple[str, ...]
    """How the file was understood, in sentences."""
    warnings: tuple[str, ...]
    """What of it may be wrong, in sentences without the file."""
    problems: list[str]
    """Mistakes found in the samples so far."""
    origins: dict[str, int]
    """Zero of time stamps that are given from their first one on, by channel, [ns]; known after reading."""
    flagged: dict[str, int]
    """Samples that the file itself marks as invalid, by channel; they are given as NaN."""
    log_delays: Mapping[str, int]
    """Of messages that have stamps of their own, by table: from the stamp of the first to the log, [ns]."""
    longest_delay: int
    """By which these may differ where all stamps are of one clock, [ns]."""

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""


@dataclass
class Held:
    """A file of which all channels are in memory, or arrays that are read slice by slice."""

    channels: tuple[Channel, ...]
    columns: A[Mapping[str, Any], "by name of the channel: something with len and slices"]
    numbers: Mapping[str, float] = field(default_factory=dict)
    facts: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    problems: list[str] = field(default_factory=list)
    origins: dict[str, int] = field(default_factory=dict)
    flagged: dict[str, int] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    log_delays: Mapping[str, int] = field(default_factory=dict)
    longest_delay: int = 0

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        count = min(len(self.columns[name]) for name in names)
        for begin in range(0, count, BLOCK):
            part = slice(begin, min(begin + BLOCK, count))
            yield np.stack([np.asarray(self.columns[name][part], np.float64) for name in names], axis=1)


def unreadable_file(path: Path, kind: str, error: Exception) -> InputError:
    """Say that a file cannot be read as what it is."""
    reason = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
    return InputError(f"{path}: cannot be read as {kind} ({reason}); it is cut off or damaged")


def in_text(value: Any) -> str | None:
    """Write a word or number that a file says about itself in one line; None for what is none."""
    if isinstance(value, bytes):
        value = value.decode(errors="replace")
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.reshape(-1)[0]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bytes):
        value = value.decode(errors="replace")
    if isinstance(value, str | int | float) or hasattr(value, "isoformat"):
        return " ".join(str(value).split())[:500]
    return None

"""What a file has: its channels, their samples block by block, and what it says about itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated as A
from typing import Any, Protocol

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.errors import InputError

BLOCK = 65_536
"""Samples that are in memory at a time of a format that is read in blocks."""
UNKNOWN = float("nan")


@dataclass(frozen=True)
class Channel:
    """One signal of a file."""

    name: str
    table: A[str, "channels of one table are sampled together"] = ""
    count: A[int | None, "samples; None: known at the end of the file"] = None
    unit: A[str, "as the file has it; empty when it says none"] = ""
    rate: A[float, "that the file claims, NaN when it says none, [Hz]"] = UNKNOWN
    is_time: A[bool, "the format itself says that this is the time, in seconds"] = False
    axis: A[str, "``x``, ``y`` or ``z`` where the format itself says so"] = ""


class Source(Protocol):
    """An open file."""

    channels: tuple[Channel, ...]
    numbers: Mapping[str, float]
    """Single numbers beside the channels, by name."""
    facts: Mapping[str, str]
    """What else the file says about itself."""
    notes: tuple[str, ...]
    """How the file was understood, in sentences."""
    problems: list[str]
    """Mistakes found in the samples so far."""

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

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        count = min(len(self.columns[name]) for name in names)
        for begin in range(0, count, BLOCK):
            part = slice(begin, min(begin + BLOCK, count))
            yield np.stack([np.asarray(self.columns[name][part], np.float64) for name in names], axis=1)


def broken(path: Path, kind: str, error: Exception) -> InputError:
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

"""Channels of arrays with one or two axes, and the single numbers and words beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.measured.source import UNKNOWN, Channel
from beardyn_core.measured.units import usual

RATE_NAMES = (
    *("fs", "sr", "f_s", "samplerate", "sample_rate", "samplingrate", "sampling_rate", "samplefrequency"),
    *("sampling_frequency", "samplingfrequency", "sample_frequency", "rate_hz", "fs_hz", "fsamp", "fsample"),
)
_NOTHING: Mapping[str, Any] = {}
STEP_NAMES = ("dt", "ts", "time_step", "wf_increment", "increment", "sample_interval")


@dataclass(frozen=True)
class Column:
    """One column of an array that is sliced along its longer axis."""

    array: A[Any, "with ``shape`` and slices; of one or two axes"]
    across: A[int | None, "which of the shorter axis; None: the array has one axis"] = None
    lying: A[bool, "whether time runs along the second axis"] = False

    def __len__(self) -> int:
        return int(self.array.shape[1 if self.lying else 0])

    def __getitem__(self, part: slice) -> Float:
        return self.of(np.asarray(self.array[self.place(part)]))

    def place(self, part: slice) -> Any:
        """Give the index of a stretch of time in the array, all its columns."""
        return (slice(None), part) if self.lying else part

    def of(self, stretch: Any) -> Float:
        """Take this column out of such a stretch."""
        if self.across is None:
            return np.asarray(stretch, np.float64)
        return np.asarray(stretch[self.across] if self.lying else stretch[:, self.across], np.float64)


def stretches(columns: Mapping[str, Any], names: Sequence[str], count: int, block: int) -> Iterator[Float]:
    """Give columns stretch by stretch, shape [sample, column]; an array is read once for all its columns."""
    for begin in range(0, count, block):
        part = slice(begin, min(begin + block, count))
        read: dict[int, Any] = {}
        found = []
        for name in names:
            column = columns[name]
            if isinstance(column, Column):
                key = id(column.array)
                if key not in read:
                    read[key] = np.asarray(column.array[column.place(part)])
                found.append(column.of(read[key]))
            else:
                found.append(np.asarray(column[part], np.float64))
        yield np.stack(found, axis=1)


def columns_in(name: str, array: Any) -> dict[str, Column]:
    """List the columns of an array of real numbers by name: itself, or ``name[0]``, ``name[1]``, ...

    Time runs along the longer axis. Empty for what is no such array.
    """
    shape, kind = tuple(array.shape), np.dtype(array.dtype).kind
    if kind not in "fiu" or len(shape) not in (1, 2) or 0 in shape or int(np.prod(shape)) < 2:
        return {}
    if len(shape) == 1:
        return {name: Column(array)}
    lying = shape[1] > shape[0]
    across = min(shape)
    if across == 1:
        return {name: Column(array, 0, lying)}
    return {f"{name}[{k}]": Column(array, k, lying) for k in range(across)}


def claimed_rate(numbers: Mapping[str, float]) -> float:
    """Find the sampling rate among the numbers of a file by its usual names; NaN without, [Hz]."""
    last = {
        name.lower().replace("/", ".").rpartition(".")[2].replace(" ", "_"): value
        for name, value in numbers.items()
    }
    found = [last[name] for name in RATE_NAMES if name in last]
    found += [1.0 / last[name] for name in STEP_NAMES if last.get(name, 0.0) > 0.0]
    return float(found[0]) if found and found[0] > 0.0 else UNKNOWN


def channels_of(
    columns: Mapping[str, Column],
    rate: float,
    rates: Mapping[str, float] = _NOTHING,
    units: Mapping[str, str] = _NOTHING,
    groups: Mapping[str, str] = _NOTHING,
) -> tuple[Channel, ...]:
    """List the channels of columns: those of a group and of the same length are sampled together.

    Parameters
    ----------
    rates, units, groups : mapping
        What the file says of a column.
    rate : float
        What it says of all, [Hz].
    """
    return tuple(
        Channel(
            name,
            table=f"{groups.get(name, '')}, {len(column)} samples".removeprefix(", "),
            count=len(column),
            unit=usual(units.get(name, "")),
            rate=rates.get(name, rate),
        )
        for name, column in columns.items()
    )

"""Channels of arrays with one or two axes, and the single numbers and words next to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.measured.claimed_rate import claims_by_path, claims_on
from beardyn_core.measured.claimed_start import Start, start_in
from beardyn_core.measured.source import Channel
from beardyn_core.measured.time_column import is_time_name
from beardyn_core.measured.units import usual

_NOTHING: Mapping[str, Any] = {}


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


def channels_of(
    columns: Mapping[str, Column],
    said: Mapping[str, Any],
    paths: Mapping[str, str] = _NOTHING,
    units: Mapping[str, str] = _NOTHING,
) -> tuple[Channel, ...]:
    """List the channels of columns: those of one length, rate, start and time are sampled together.

    Parameters
    ----------
    said : mapping
        Numbers and words of the file by path, ``vib.fs``.
    paths, units : mapping
        Path of the array of a column, by default its name without the number; unit that the file says.
    """
    claims = claims_by_path(said)
    places = {name: tuple(paths.get(name, name.partition("[")[0]).split(".")) for name in columns}
    timed = {(place[:-1], len(columns[name])) for name, place in places.items() if is_time_name(place[-1])}
    starts = _starts_in(said)
    found = []
    for name, column in columns.items():
        place = places[name]
        own = claims_on(place, claims, places.values())
        start = next((starts[place[:k]] for k in range(len(place), -1, -1) if place[:k] in starts), None)
        table = f"{len(column)} samples"
        if (place[:-1], len(column)) in timed:  # whatever else is claimed, its time is that of the samples
            table = ", ".join((*place[:-1], table))
        else:
            near = sorted({claim.rates for claim in own if claim.distance == own[0].distance})
            if near:
                table += f" at {' or '.join(f'{rate:.9g} Hz' for rates in near for rate in rates)}"
            if start is not None:
                table += f" from {start.ns * 1e-9:.9g} s"
        found.append(Channel(name, table, len(column), usual(units.get(name, "")), own, start))
    return tuple(found)


def _starts_in(said: Mapping[str, Any]) -> dict[tuple[str, ...], Start]:
    """Find when structs and groups begin, by their place."""
    places: dict[str, dict[str, Any]] = {}
    for path, value in said.items():
        above, _, name = path.rpartition(".")
        places.setdefault(above, {})[name] = value
    found = {tuple(above.split(".")) if above else (): start_in(names) for above, names in places.items()}
    return {place: start for place, start in found.items() if start is not None}

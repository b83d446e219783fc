"""HDF5 and MATLAB 7.3, read in blocks with h5py."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library
from beardyn_core.measured import source
from beardyn_core.measured.arrays_inside import Column, channels_of, columns_in, stretches
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Held, in_text, unreadable_file

_UNITS = ("unit", "units", "Unit", "Units", "UNIT")


class _File(Held):
    """Columns by the path of their dataset; the file is open only while blocks are read."""

    path: Path
    h5py: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        with self.h5py.File(self.path, "r") as file:
            try:
                arrays = {place: file[place] for place, _ in (self.columns[name] for name in names)}
                columns = {
                    name: Column(arrays[place], column.across, column.lying)
                    for name, (place, column) in ((name, self.columns[name]) for name in names)
                }
                count = min(map(len, columns.values()))
                yield from stretches(columns, names, count, source.BLOCK)
            except (OSError, RuntimeError, ValueError) as error:
                raise unreadable_file(self.path, "HDF5", error) from error


def open_file(path: Path, _reading: Reading) -> Held:
    """List the datasets of a file, with ``.`` between the groups; attributes give units and rate."""
    h5py = library("h5py", f"{path}: reading HDF5 and MATLAB 7.3", "measured")
    numbers: dict[str, float] = {}
    facts: dict[str, str] = {}
    columns: dict[str, Column] = {}
    places: dict[str, str] = {}
    units: dict[str, str] = {}
    paths: dict[str, str] = {}

    def take(place: str, item: Any) -> None:
        name = place.replace("/", ".")
        said = dict(item.attrs)
        _note(said, f"{name}." if name else "", numbers, facts)
        if not isinstance(item, h5py.Dataset) or "#refs#" in place:
            return
        if said.get("MATLAB_class") == b"char":
            facts[name] = "".join(map(chr, np.asarray(item).reshape(-1).tolist()))[:500]
        elif item.shape is not None and int(np.prod(item.shape)) == 1 and item.dtype.kind in "fiu":
            numbers[name] = float(np.asarray(item).reshape(-1)[0])
            if unit := next((in_text(said[key]) for key in _UNITS if key in said), None):
                facts[f"{name}_unit"] = unit
        elif item.shape is not None and (found := columns_in(name, item)):
            for each, column in found.items():
                columns[each] = Column(None, column.across, column.lying)
                lengths[each], places[each] = len(column), place
                paths[each] = name
                units[each] = next((in_text(said[key]) or "" for key in _UNITS if key in said), "")

    lengths: dict[str, int] = {}
    try:
        with h5py.File(path, "r") as file:
            take("", file)
            file.visititems(take)
            known = {name: Column(_Length(lengths[name])) for name in columns}
            channels = channels_of(known, {**facts, **numbers}, paths, units)
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        raise unreadable_file(path, "HDF5", error) from error
    found = _File(channels, {name: (places[name], columns[name]) for name in columns}, numbers, facts)
    found.path, found.h5py = path, h5py
    return found


class _Length:
    """Stands for an array of which only the length is known."""

    def __init__(self, count: int) -> None:
        self.shape = (count,)


def _numbers(attributes: dict[str, Any]) -> dict[str, float]:
    found = {}
    for key, value in attributes.items():
        if isinstance(value, np.ndarray) and value.size == 1:
            value = value.reshape(-1)[0]
        if isinstance(value, int | float | np.integer | np.floating):
            found[key] = float(value)
    return found


def _note(attributes: dict[str, Any], above: str, numbers: dict[str, float], facts: dict[str, str]) -> None:
    single = _numbers(attributes)
    numbers |= {f"{above}{key}": value for key, value in single.items()}
    for key, value in attributes.items():
        if key not in single and not key.startswith(("MATLAB_", "H5PATH")) and (text := in_text(value)):
            facts[f"{above}{key}"] = text

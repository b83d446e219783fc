"""Signals of a set in Zarr: an array a signal, the runs along its first axis, a file for each task."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.optional import library
from beardyn_core.population.batch import Array, Made

SIGNALS = "signals.zarr"
RUN = "run"


class SignalStore:
    """Arrays of all runs, written a batch at a time.

    Parameters
    ----------
    folder : Path
        Of the set.
    count : int
        Runs of the whole set.
    together : int
        Runs in one file.
    """

    def __init__(self, folder: Path, count: int, together: int) -> None:
        zarr = zarr_library()
        self._zarr = zarr
        self._group = zarr.open_group(str(folder / SIGNALS), mode="a", zarr_format=3)
        self._count, self._together = count, together
        for name in self._group.array_keys():
            array = self._group[name]
            if array.metadata.dimension_names[0] == RUN and array.shape[0] < count:
                array.resize((count, *array.shape[1:]))

    def write(self, runs: Sequence[Made]) -> list[str]:
        """Write the signals of a task; gives what is wrong with each that does not fit, by number of run."""
        if any(made.shapes for made in runs):
            self._make(runs)
        problems = []
        for name in self._signal_names():
            array = self._group[name]
            first, last = runs[0].run, runs[-1].run + 1
            block = np.full((last - first, *array.shape[1:]), np.nan, array.dtype)
            if last - first != len(runs):  # others of the file are there already
                block[:] = array[first:last]
            for made in runs:
                values = made.arrays.get(name)
                if values is None:
                    continue
                count = min(len(values), block.shape[1])
                if values.shape[1:] != block.shape[2:]:
                    problems.append(f"{name} of run {made.run} is of shape {values.shape[1:]}")
                    continue
                block[made.run - first, :count] = values[:count]
            array[first:last] = block
        return problems

    def _signal_names(self) -> list[str]:
        return [
            name for name in self._group.array_keys() if self._group[name].metadata.dimension_names[0] == RUN
        ]

    def _make(self, runs: Sequence[Made]) -> None:
        """Make the arrays of the first runs that come back."""
        one = next(made for made in runs if made.shapes)
        if all(name in self._group for name in one.shapes):
            return
        sizes = {signal: len(time) for signal, time in one.times.items()}
        for signal, time in one.times.items():
            self._coordinate(f"time_{signal}", f"time_{signal}", np.asarray(time * 1e-9, np.float64), "s")
        values = {name: next(m.arrays[name] for m in runs if name in m.arrays) for name in one.shapes}
        for name, about in one.shapes.items():
            self._array(name, about, values[name].shape, sizes[about.signal])

    def _array(self, name: str, about: Array, shape: tuple[int, ...], samples: int) -> None:
        codecs = self._zarr.codecs
        one = (1, samples, *shape[1:])
        array = self._group.create_array(
            name,
            shape=(self._count, *one[1:]),
            chunks=one,
            shards=(self._together, *one[1:]),
            dtype=about.values.dtype,
            fill_value=np.nan,
            compressors=[codecs.BloscCodec(cname="zstd", clevel=3, shuffle="bitshuffle")],
            dimension_names=[RUN, f"time_{about.signal}", *about.dims],
        )
        array.attrs["units"] = about.unit

    def _coordinate(self, name: str, dim: str, values: NDArray[Any], unit: str) -> None:
        array = self._group.create_array(name, data=values, dimension_names=[dim])
        array.attrs["units"] = unit


def forget(folder: Path) -> None:
    """Remove the signals of a set."""
    shutil.rmtree(folder / SIGNALS, ignore_errors=True)


def zarr_library() -> Any:
    """Import Zarr, which nothing but this room needs.

    Raises
    ------
    InputError
        It is not installed.
    """
    library("zarr", "a set of runs", "sweep")  # says what to install
    import zarr

    return zarr

"""A set as one file for other programs: HDF5, NumPy or Parquet, written a piece at a time."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole, file_problems
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.signal_store import RUN

KINDS = (".h5", ".npz", ".parquet")
_AT_ONCE = 32  # runs in memory


def export_set(
    runs: LabelledSet, path: Path | str, signals: Sequence[str] = (), force: bool = False
) -> list[Path]:
    """Write signals and labels of all runs of a set to one file.

    HDF5 and NPZ have an array a signal and a label, runs along the first axis; Parquet has a row a run, each
    signal a list of its samples, axis by axis.

    Parameters
    ----------
    path : Path
        Its ending is the format, one of `KINDS`.
    signals : sequence of str
        All by default.
    force : bool
        Replace the file if it exists.

    Raises
    ------
    InputError
        The file cannot be written, or there is no such signal.
    """
    path = Path(path)
    names = tuple(signals) or runs.signal_names
    problems = file_problems("", path, inputs=(runs.folder,), force=force)
    problems += [
        f"signal {name!r} is not one of the set; allowed are {', '.join(runs.signal_names)}"
        for name in names
        if name not in runs.signal_names
    ]
    if path.suffix not in KINDS:
        problems.append(
            f"{path}: a set is written as {', '.join(KINDS)}; its ending is {path.suffix or 'none'}"
        )
    if problems:
        raise InputError(problems)
    with as_a_whole(path, replace=force) as fresh:
        {".h5": _hdf5, ".npz": _npz, ".parquet": _parquet}[path.suffix](runs, fresh, names)
    return [path]


def _pieces(runs: LabelledSet) -> Iterator[slice]:
    """Give runs that are read together, of those that the table has."""
    numbers = runs.table[RUN].to_numpy()
    for first in range(0, len(numbers), _AT_ONCE):
        part = numbers[first : first + _AT_ONCE]
        yield slice(int(part[0]), int(part[-1]) + 1)


def _read(runs: LabelledSet, name: str, piece: slice) -> NDArray[Any]:
    """Read the runs of a piece that the table has."""
    numbers = runs.table[RUN].to_numpy()
    inside = numbers[(numbers >= piece.start) & (numbers < piece.stop)]
    return np.asarray(runs.arrays[name][piece][inside - piece.start])


def _about(runs: LabelledSet) -> dict[str, str]:
    return {
        key: json.dumps(runs.about.get(key)) for key in ("sweep", "licence", "code", "versions", "identity")
    }


def _hdf5(runs: LabelledSet, path: Path, names: Sequence[str]) -> None:
    h5py = library("h5py", "a set in HDF5", "sweep")
    with h5py.File(path, "w") as file:
        file.attrs.update(_about(runs))
        for name in names:
            shape = (len(runs), *runs.arrays[name].shape[1:])
            chunks = (1, *shape[1:])
            data = file.create_dataset(
                name, shape, runs.arrays[name].dtype, chunks=chunks, compression="gzip", compression_opts=1
            )
            data.attrs["units"] = runs.arrays[name].attrs.get("units", "")
            at = 0
            for piece in _pieces(runs):
                values = _read(runs, name, piece)
                data[at : at + len(values)] = values
                at += len(values)
        labels = file.create_group("labels")
        for name, column in runs.table.items():
            values = column.to_numpy()
            text = values.dtype.kind not in "biuf"
            kept = np.array(["" if each is None else str(each) for each in values], "S") if text else values
            labels.create_dataset(str(name), data=kept).attrs["units"] = runs.units.get(str(name), "")


def _npz(runs: LabelledSet, path: Path, names: Sequence[str]) -> None:
    arrays: dict[str, Any] = {
        name: np.concatenate([_read(runs, name, piece) for piece in _pieces(runs)]) for name in names
    }
    for name, column in runs.table.items():
        values = column.to_numpy()
        text = values.dtype.kind not in "biuf"
        arrays[f"label_{name}"] = (
            np.array(["" if each is None else str(each) for each in values]) if text else values
        )
    with path.open("wb") as file:
        np.savez_compressed(file, **arrays)


def _parquet(runs: LabelledSet, path: Path, names: Sequence[str]) -> None:
    arrow, parquet = (
        library("pyarrow", "a set of runs", "sweep"),
        library("pyarrow.parquet", "a set of runs", "sweep"),
    )
    whole = arrow.Table.from_pandas(runs.table, preserve_index=False)
    writer: Any = None
    at = 0
    for piece in _pieces(runs):
        columns: dict[str, Any] = {}
        count = 0
        for name in names:
            values = _read(runs, name, piece)
            count = len(values)
            # axis by axis: the samples of one signal stand one after the other
            flat = np.moveaxis(values, 1, -1).reshape(count, -1)
            kind = arrow.list_(arrow.from_numpy_dtype(flat.dtype), flat.shape[1])
            columns[name] = arrow.FixedSizeListArray.from_arrays(arrow.array(flat.reshape(-1)), type=kind)
        part = whole.slice(at, count)
        for name, column in columns.items():
            unit = runs.arrays[name].attrs.get("units", "")
            shape = json.dumps(list(runs.arrays[name].shape[:0:-1]))
            field = arrow.field(name, column.type, metadata={"unit": unit, "shape": shape})
            part = part.append_column(field, column)
        at += count
        if writer is None:
            schema = part.schema.with_metadata({"beardyn": json.dumps(_about(runs))})
            writer = parquet.ParquetWriter(path, schema, compression="zstd")
        writer.write_table(part.replace_schema_metadata(schema.metadata))
    if writer is not None:
        writer.close()

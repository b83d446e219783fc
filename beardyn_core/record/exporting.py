"""Signals of a run to files of other programs: Parquet, CSV, NPZ, HDF5, WAV."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Sequence
from io import SEEK_END, BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole, file_problems, write_whole
from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.record import tables

if TYPE_CHECKING:
    from beardyn_core.record.run import Run

# Formats of one table a file get a file for each signal; the others hold all signals.
_TABLES = ("parquet", "csv", "wav")
KINDS = ("parquet", "csv", "npz", "h5", "wav")
_LONGEST_RUN_S = 1e7  # times beyond count from an epoch: 12 digits would leave 10 ms of them
_BESIDE = ("csv", "wav")  # they cannot carry the truth: it goes to a JSON file next to them


def export(
    run: Run, path: Path | str, *, kind: str | None = None, signals: Iterable[str] = (), force: bool = False
) -> list[Path]:
    """Write signals of a run to a file.

    Parameters
    ----------
    path : Path
        With several signals in Parquet, CSV or WAV, which hold one table, each goes to
        ``<name>_<signal>.<ending>``.
    kind : str, optional
        One of `KINDS`; by default the ending of the path.
    signals : str or iterable of str
        One signal or several, of `tables.signal_names`; by default the vibration of every accelerometer for
        Parquet, CSV and WAV, all for NPZ and HDF5.
    force : bool
        Replace files that exist.

    Returns
    -------
    list of Path
        The files written. CSV and WAV have the truth in ``<path>.json`` next to them; the others carry it.

    Raises
    ------
    InputError
        The format or a signal is not known, a file exists, a library is missing, or the disk refused; all
        mistakes at once and nothing written but in the last case.
    """
    path = Path(path)
    kind = kind or path.suffix.lower().removeprefix(".").replace("hdf5", "h5")
    names = tuple(dict.fromkeys([signals] if isinstance(signals, str) else signals)) or _usual(run, kind)
    problems = [
        f"signal {name!r} is not one of the run; allowed are {', '.join(tables.signal_names(run))}"
        for name in names
        if name not in tables.signal_names(run)
    ]
    if kind not in KINDS:
        endings = ", ".join(f".{each}" for each in KINDS)
        problems.append(f"{path}: the format is not known by its ending; allowed are {endings}")
    elif kind == "wav":
        problems += [
            f"signal {name!r} cannot be a WAV file, only vibration can; choose .parquet, .csv, .npz or .h5"
            for name in names
            if name in tables.signal_names(run) and not name.startswith(tables.VIBRATION)
        ]
    if problems:
        raise InputError(problems)
    targets = dict.fromkeys(names, path)
    if kind in _TABLES and len(names) > 1:
        targets = {name: path.with_name(f"{path.stem}_{name}{path.suffix}") for name in names}
    beside = [path.with_name(f"{path.name}.json")] if kind in _BESIDE else []
    files = [*dict.fromkeys(targets.values()), *beside]
    inputs = [] if run.path is None else [run.path]
    if problems := [each for file in files for each in file_problems("", file, inputs=inputs, force=force)]:
        raise InputError(problems)
    try:
        if kind in _TABLES:
            write = {"parquet": _write_parquet, "csv": _write_csv, "wav": _write_wav}[kind]
            for name, target in targets.items():
                with as_a_whole(target, replace=force) as fresh:
                    write(run, fresh, name)
        else:
            with as_a_whole(path, replace=force) as fresh:
                {"npz": _write_npz, "h5": _write_hdf5}[kind](run, fresh, names)
        for target in beside:
            write_whole(target, json.dumps(run.truth, indent=1) + "\n", replace=force)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror or error})") from error
    return files


def _usual(run: Run, kind: str) -> tuple[str, ...]:
    known = tables.signal_names(run)
    names = (
        known if kind not in _TABLES else tuple(name for name in known if name.startswith(tables.VIBRATION))
    )
    return tuple(name for name in names if len(tables.signal_of(run, name))) or (tables.VIBRATION,)


def _write_parquet(run: Run, path: Path, name: str) -> None:
    pyarrow = library("pyarrow", "Parquet", "data")
    parquet = library("pyarrow.parquet", "Parquet", "data")
    columns, units = _measured_columns(run, name), tables.units_of(run, name)
    schema = pyarrow.schema(
        pyarrow.field(
            key, pyarrow.array(values[:0]).type, metadata={"unit": units[key]} if key in units else None
        )
        for key, values in columns.items()
    )
    table = pyarrow.table(columns, schema=schema)
    labels = {key: str(value) for key, value in tables.labels_of(run).items() if key != "truth"}
    found = {"beardyn": json.dumps({"signal": name, "truth": run.truth}), **labels}
    parquet.write_table(table.replace_schema_metadata(found), path)


def _write_csv(run: Run, path: Path, name: str) -> None:
    columns, units = _measured_columns(run, name), tables.units_of(run, name)
    since_epoch = len(columns["time"]) > 0 and abs(columns["time"][-1]) > _LONGEST_RUN_S
    digits = {"time": 16} if since_epoch else {}
    formats = [
        "%s" if values.dtype.kind in "US" else f"%.{digits.get(key, 12)}g" for key, values in columns.items()
    ]
    rows = np.empty(len(columns["time"]), [(key, values.dtype) for key, values in columns.items()])
    for key, values in columns.items():
        rows[key] = values
    heading = ",".join(f"{key} [{units[key]}]" if key in units else key for key in columns)
    np.savetxt(path, rows, fmt=formats, delimiter=",", header=heading, comments="", encoding="utf-8")


def _measured_columns(run: Run, name: str) -> dict[str, Any]:
    """Give the columns of a signal without the axes that were not measured, NaN from end to end."""
    columns = tables.columns_of(run, name)
    if not name.startswith(tables.VIBRATION):
        return columns
    absent = [key for key, values in columns.items() if len(values) and np.isnan(values).all()]
    return (
        columns if len(absent) == len(columns) - 1 else {k: v for k, v in columns.items() if k not in absent}
    )


def _write_npz(run: Run, path: Path, names: Sequence[str]) -> None:
    arrays: dict[str, Any] = {"truth": json.dumps(run.truth)}
    for name in names:
        arrays[f"{name}.time"] = tables.signal_of(run, name).time
        for part, array in tables.parts_of(run, name).items():
            arrays[f"{name}.{part}"] = array.values
            arrays[f"{name}.{part}.unit"] = array.unit
    with path.open("wb") as file:  # NumPy would add an ending of its own
        np.savez_compressed(file, **arrays)


def _write_hdf5(run: Run, path: Path, names: Sequence[str]) -> None:
    h5py = library("h5py", "HDF5", "data")
    memory = BytesIO()  # a disk that is full in between would leave HDF5 with handles it cannot close
    with h5py.File(memory, "w") as file:
        for key, value in tables.labels_of(run).items():
            file.attrs[key] = value
        for name in names:
            signal: Any = tables.signal_of(run, name)
            group = file.create_group(name)
            group.create_dataset("time", data=signal.time).attrs["unit"] = "s"
            group.attrs["rate_Hz"] = signal.rate
            for part, array in tables.parts_of(run, name).items():
                stored = group.create_dataset(part, data=array.values, compression="gzip", shuffle=True)
                stored.attrs["unit"] = array.unit
                stored.attrs["axes"] = ",".join(("time", *array.dims))
    path.write_bytes(memory.getbuffer())


def _write_wav(run: Run, path: Path, name: str) -> None:
    """Write the axes that were measured as channels of 32-bit floats in m/s^2, not scaled.

    The head of a WAV file has no names, no units and whole hertz only: these stand in its comment.
    """
    from scipy.io import wavfile

    signal: Any = tables.signal_of(run, name)
    if not len(signal):
        raise InputError(f"{run.label}: has no {name}")
    missing = int((np.diff(signal.sample) != 1).sum())
    if missing:
        raise InputError(
            f"{run.label}: {name} has {missing} gaps, which WAV cannot hold; choose another format"
        )
    wavfile.write(path, round(signal.rate), measured_axes(signal.values).astype(np.float32))
    units = tables.units_of(run, name)
    columns = [f"{key} [{units[key]}]" for key in _measured_columns(run, name) if key != "time"]
    _add_comment(path, json.dumps({"columns": columns, "rate_Hz": signal.rate}))


def _add_comment(path: Path, text: str) -> None:
    """Append the comment of a WAV file: a list of one text of the kind ``ICMT``."""
    comment = text.encode("ascii") + b"\0"
    comment += b"\0" * (len(comment) % 2)
    chunk = b"INFOICMT" + struct.pack("<I", len(comment)) + comment
    with path.open("r+b") as file:
        size = file.seek(0, SEEK_END)
        file.write(b"LIST" + struct.pack("<I", len(chunk)) + chunk)
        file.seek(4)
        file.write(struct.pack("<I", size + len(chunk)))

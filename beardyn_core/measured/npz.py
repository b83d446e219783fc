"""NumPy archives (``.npz``) and arrays (``.npy``), read in blocks also where they are packed."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.arrays_inside import Column, channels_of, columns_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import BLOCK, Held, in_text, unreadable_file

_DAMAGE = (OSError, ValueError, EOFError, zipfile.BadZipFile, KeyError, zlib.error)


class _Head:
    """Shape and type of an array in the archive."""

    def __init__(self, shape: tuple[int, ...], turned: bool, dtype: np.dtype[Any]) -> None:
        self.shape, self.turned, self.dtype = shape, turned, dtype


class _Archive(Held):
    path: Path

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        heads = {name: self.columns[name].array for name in names}
        members = dict.fromkeys(_member(name) for name in names)
        try:
            with _Members(self.path) as archive:
                arrays = {member: _rows(archive, member) for member in members}
                while parts := {
                    m: part for m, rows in arrays.items() if (part := next(rows, None)) is not None
                }:
                    if len(parts) < len(members):
                        return
                    yield np.stack(
                        [
                            parts[_member(name)][:, self.columns[name].across or 0].astype(np.float64)
                            for name in heads
                        ],
                        axis=1,
                    )
        except _DAMAGE as error:
            raise unreadable_file(self.path, "NumPy", error) from error


class _Members:
    """Arrays of a file by name, one of its own in ``.npy``."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._zip = zipfile.ZipFile(path) if zipfile.is_zipfile(path) else None
        self.names = (
            [path.stem]
            if self._zip is None
            else [name.removesuffix(".npy") for name in self._zip.namelist() if name.endswith(".npy")]
        )

    def open(self, name: str) -> IO[bytes]:
        if self._zip is None:
            return self._path.open("rb")
        return self._zip.open(f"{name}.npy")

    def __enter__(self) -> _Members:
        return self

    def __exit__(self, *_: object) -> None:
        if self._zip is not None:
            self._zip.close()


def open_file(path: Path, _reading: Reading) -> Held:
    """List the arrays of a file; single numbers and words are what it says about itself."""
    numbers: dict[str, float] = {}
    facts: dict[str, str] = {}
    columns: dict[str, Column] = {}
    try:
        with path.open("rb") as file:
            packed = file.read(2) == b"PK"
        if packed and not zipfile.is_zipfile(path):
            raise zipfile.BadZipFile("the list of its arrays, at its end, is missing")
        with _Members(path) as archive:
            if not archive.names:
                raise InputError(
                    f"{path}: is a ZIP file without NumPy arrays; of a spreadsheet save the sheet as CSV"
                )
            for name in archive.names:
                with archive.open(name) as file:
                    head = _head(file)
                    if int(np.prod(head.shape)) == 1:
                        _note(name, _values(file, head, 1), numbers, facts)
                        continue
                columns |= columns_in(name, head)
    except _DAMAGE as error:
        raise unreadable_file(path, "NumPy", error) from error
    units = {name: facts.get(f"{_member(name)}.unit", "") for name in columns}
    channels = channels_of(columns, {**facts, **numbers}, units=units)
    found = _Archive(channels, columns, numbers, facts)
    found.path = path
    return found


def _member(channel: str) -> str:
    name, bracket, number = channel.rpartition("[")
    return name if bracket and number.rstrip("]").isdigit() else channel


def _head(file: IO[bytes]) -> _Head:
    version = npy.read_magic(file)
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    head = _Head(*read(file))
    if head.dtype.hasobject:
        raise ValueError("it holds Python objects, which are not read")
    return head


def _rows(archive: _Members, name: str) -> Iterator[np.ndarray[Any, Any]]:
    """Give an array in parts along its longer axis, shape [sample, column]."""
    with archive.open(name) as file:
        head = _head(file)
        shape = head.shape if len(head.shape) == 2 else (*head.shape, 1)
        count, across = max(shape), min(shape)
        lying = shape[1] > shape[0]
        if across > 1 and lying != head.turned:  # column behind column: no part of it is a stretch of time
            whole = _values(file, head, count * across).reshape(shape, order="F" if head.turned else "C")
            whole = whole.T if lying else whole
            yield from (whole[begin : begin + BLOCK] for begin in range(0, count, BLOCK))
            return
        for begin in range(0, count, BLOCK):
            length = min(BLOCK, count - begin)
            yield _values(file, head, length * across).reshape(length, across)


def _values(file: IO[bytes], head: _Head, count: int) -> np.ndarray[Any, Any]:
    wanted = count * head.dtype.itemsize
    data = file.read(wanted)
    if len(data) < wanted:
        raise EOFError("an array ends before its last number")
    return np.frombuffer(data, head.dtype)


def _note(name: str, values: Any, numbers: dict[str, float], facts: dict[str, str]) -> None:
    if values.dtype.kind in "fiub":
        numbers[name] = float(values[0])
    elif (text := in_text(values[0])) is not None:
        facts[name] = text

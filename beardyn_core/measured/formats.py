"""Which format a file is of: by its first bytes, not by its name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import size_of_file
from beardyn_core.base.outputs import note_read
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Source


@dataclass(frozen=True)
class Format:
    """One format: its name, the module that opens a file of it, what it is known by, how it is read."""

    name: str
    module: str
    known: Callable[[bytes], bool]
    in_blocks: bool


def _starts(*magic: bytes) -> Callable[[bytes], bool]:
    return lambda head: head.startswith(magic)


def _is_universal(head: bytes) -> bool:
    lines = head.lstrip(b"\r\n").splitlines()
    return len(lines) > 1 and lines[0].strip() == b"-1" and lines[1][:6].strip().isdigit()


FORMATS = (
    Format("MATLAB 7.3", "hdf5", lambda head: head.startswith(b"MATLAB 7.3") and b"\x89HDF" in head, True),
    Format("MATLAB", "matlab", _starts(b"MATLAB"), False),
    Format(
        "HDF5", "hdf5", lambda head: b"\x89HDF\r\n\x1a\n" in (head[:8], head[512:520], head[1024:1032]), True
    ),
    Format(
        "WAV", "wav", lambda head: head[:4] in (b"RIFF", b"RIFX", b"RF64") and head[8:12] == b"WAVE", True
    ),
    Format("FLAC", "wav", _starts(b"fLaC"), True),
    Format("NumPy", "npz", _starts(b"PK\x03\x04", b"PK\x05\x06", b"\x93NUMPY"), True),
    Format("TDMS", "tdms", _starts(b"TDSm"), True),
    Format("MDF", "mdf", _starts(b"MDF     ", b"UnFinMF "), True),
    Format("Parquet", "parquet", _starts(b"PAR1"), True),
    Format("MCAP", "other_mcap", _starts(b"\x89MCAP0\r\n"), True),
    Format("Universal", "universal", _is_universal, False),
)
TEXT = Format(
    "text", "csv_text", lambda head: b"\0" not in head or head[:2] in (b"\xff\xfe", b"\xfe\xff"), True
)
_HEAD = 2048


def format_of(path: Path) -> Format:
    """Find the format of a file.

    Raises
    ------
    InputError
        There is no such file, it is empty, or of no known format.
    """
    try:
        if path.is_dir():
            raise InputError(f"{path}: is a folder; give the files in it")
        size_of_file(path)
        with path.open("rb") as file:
            head = file.read(_HEAD)
    except OSError as error:
        raise InputError(
            f"{path}: cannot be read ({error.strerror or error}); give the path of a file"
        ) from error
    if not head:
        raise InputError(f"{path}: the file is empty")
    for each in (*FORMATS, TEXT):
        if each.known(head):
            return each
    names = ", ".join(dict.fromkeys(("CSV", *(each.name for each in FORMATS))))
    raise InputError(f"{path}: is of no known format; known are {names}")


def open_measured(path: Path, reading: Reading) -> tuple[Source, Format]:
    """Open a file with the module of its format.

    Raises
    ------
    InputError
        See `format_of`; or its library is missing, or it is cut off or damaged.
    """
    found = format_of(path)
    note_read(path)
    module = import_module(f"beardyn_core.measured.{found.module}")
    source: Source = module.open_file(path, reading)
    if not source.channels:
        raise InputError([*source.problems, f"{path}: has no channel with numbers that change"])
    return source, found

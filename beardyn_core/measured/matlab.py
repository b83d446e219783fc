"""MATLAB up to version 7, read with SciPy and held in memory; 7.3 is HDF5."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.measured.arrays_inside import Column, channels_of, columns_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Held, in_text, unreadable_file


def open_file(path: Path, _reading: Reading) -> Held:
    """Read all arrays of a file; those inside of a struct are called ``struct.field``."""
    from scipy.io import loadmat

    try:
        content = loadmat(path, squeeze_me=False, struct_as_record=True)
    except Exception as error:  # the reader breaks in any way on bytes that are not what they should be
        raise unreadable_file(path, "MATLAB", error) from error
    numbers: dict[str, float] = {}
    facts: dict[str, str] = {}
    columns: dict[str, Column] = {}
    for name, value in _flat(content):
        if isinstance(value, np.ndarray) and value.size == 1 and value.dtype.kind in "fiub":
            numbers[name] = float(value.reshape(-1)[0])
        elif isinstance(value, np.ndarray) and (found := columns_in(name, value)):
            columns |= found
        elif (text := in_text(value)) is not None:
            facts[name.strip("_")] = text
    channels = channels_of(columns, {**facts, **numbers})
    return Held(channels, columns, numbers, facts)


def _flat(content: dict[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in content.items():
        if name in ("__version__", "__globals__"):
            continue
        if isinstance(value, np.ndarray) and value.dtype.names:
            for number, one in enumerate(value.reshape(-1)):
                place = f"{above}{name}" if value.size == 1 else f"{above}{name}({number + 1})"
                yield from _flat({key: one[key] for key in value.dtype.names}, f"{place}.")
        else:
            yield f"{above}{name}", value

"""Results of studies in files: what is there is not made again, so that a study that was cut off goes on."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.outputs import as_a_whole, write_whole

Arrays = dict[str, NDArray[Any]]


def read_json(path: Path) -> Any:
    """Read what `write_json` wrote."""
    return json.loads(path.read_text(encoding="utf-8"))


def write_json(path: Path, found: Any) -> None:
    """Write results, whole or not at all; the folder is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, json.dumps(found, indent=1) + "\n")


def kept_json(path: Path, make: Callable[[], Any]) -> Any:
    """Read results from a file; where there is none they are made and written."""
    if not path.is_file():
        write_json(path, make())
    return read_json(path)


def kept_arrays(path: Path | None, make: Callable[[], Arrays]) -> Arrays:
    """Read arrays by name from an NPZ file; where there is none they are made, and written if it is named."""
    if path is not None and path.is_file():
        with np.load(path) as found:
            return {name: found[name] for name in found.files}
    arrays = make()
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        with as_a_whole(path) as fresh, fresh.open("wb") as stream:
            np.savez(stream, **arrays)  # type: ignore[arg-type]
    return arrays


class KeptResults:
    """Results of many cases in one file, by key; each is written as it comes.

    No `experiments.Store`: that takes a result for today's only if a digest of the code says so, and the
    records here are measured ones, whose hours of analysis a page may keep through edits that do not touch
    the monitor. Who wants them anew deletes the file. Cases are a few hundred, one process makes them in
    turn, and the file stays readable as a whole.

    Parameters
    ----------
    path : Path or None
        JSON; without it nothing is kept.

    Raises
    ------
    ValueError
        The file is of something else.
    """

    def __init__(self, path: Path | None) -> None:
        found = read_json(path) if path is not None and path.is_file() else {}
        if not isinstance(found, dict):
            raise ValueError(f"{path}: has no results by key; name another file, or delete it")
        self._path, self._found = path, found

    def get(self, key: str, make: Callable[[], Any]) -> Any:
        """Give the result of a case; the first time it is made."""
        if key not in self._found:
            self._found[key] = make()
            if self._path is not None:
                write_json(self._path, self._found)
        return self._found[key]

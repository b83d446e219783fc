"""The table of a set in Parquet: a row a run, every column with its unit and what it means."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from beardyn_core.base.optional import library
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.base.units import UNITS
from beardyn_core.scene.sweep import Split

RUNS, FEATURES = "runs.parquet", "features.parquet"
# units of labels that no key of a file has
_ENDINGS = ("per_rev", "rad", "K", "N", *UNITS)
_WORDS = {
    "run": "number of the run: its place along the first axis of the signals",
    "status": "complete, or failed",
    "reason": "how a failed run ended, in a sentence",
    "bearing_id": "name of the bearing by drawing and scatter; no bearing is in two parts",
    "bearing_kind": "tapered, cylindrical or spherical",
    "split": "part of the set: train, validation or test",
    "condition": "parts with a fault, healthy without",
}
# 1 over the golden ratio: its multiples fill the unit interval evenly, whatever their number
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


def unit_in(name: str) -> str:
    """Find the unit that the name of a column says: at its end, or before what follows it.

    Examples
    --------
    >>> unit_in("load_fz_N_mean"), unit_in("defects[0].width_mm"), unit_in("condition")
    ('N', 'mm', '')
    """
    words = name.rpartition(".")[2].split("_")
    for end in range(len(words), 1, -1):
        for start in range(1, end):
            ending = "_".join(words[start:end])
            if ending in _ENDINGS:
                return ending
    return ""


def splits_of(bearings: Sequence[str], split: Split, seed: int) -> list[str]:
    """Give each run its part, by its bearing; more bearings change no part of those before.

    Parameters
    ----------
    bearings : sequence of str
        Name of the bearing of each run, in the order of the runs.
    """
    known: dict[str, str] = {}
    offset = (seed * _GOLDEN * 0.37) % 1.0
    for name in bearings:
        if name not in known:
            place, reached = (offset + (len(known) + 1) * _GOLDEN) % 1.0, 0.0
            part = ""
            for each, share in split.shares.items():
                reached += share
                if share > 0.0 and (place < reached or not part):
                    part = each
                    if place < reached:
                        break
            known[name] = part
    return [known[name] for name in bearings]


def write_table(
    path: Path, rows: Sequence[Mapping[str, Any]], units: Mapping[str, str], about: Mapping[str, Any]
) -> None:
    """Write rows as a Parquet file, whole or not at all.

    Parameters
    ----------
    units : mapping
        Of columns whose names do not say them.
    about : mapping
        Facts of the set, in the metadata of the file.
    """
    arrow, parquet = (
        library("pyarrow", "a set of runs", "sweep"),
        library("pyarrow.parquet", "a set of runs", "sweep"),
    )
    names = list(dict.fromkeys(name for row in rows for name in row))
    fields, columns = [], []
    for name in names:
        column = arrow.array(_alike([row.get(name) for row in rows]))
        if arrow.types.is_null(column.type):
            column = column.cast(arrow.string())
        unit = units.get(name, unit_in(name))
        facts = {"unit": unit, "words": _WORDS.get(name, "")}
        fields.append(arrow.field(name, column.type, metadata={k: v for k, v in facts.items() if v}))
        columns.append(column)
    schema = arrow.schema(fields, metadata={"beardyn": json.dumps(about, sort_keys=True, default=str)})
    with as_a_whole(path) as fresh:
        parquet.write_table(arrow.table(columns, schema=schema), fresh, compression="zstd")


def _alike(values: list[Any]) -> list[Any]:
    """Make the values of a column of one type: numbers, truths or texts."""
    given = [value for value in values if value is not None]
    if all(isinstance(value, bool) for value in given):
        return values
    if all(isinstance(value, int) and not isinstance(value, bool) for value in given):
        return values
    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in given):
        return [None if value is None else float(value) for value in values]
    return [
        value if value is None or isinstance(value, str) else json.dumps(value, default=str)
        for value in values
    ]


def units_of(path: Path) -> dict[str, str]:
    """Read the units of the columns of a table; '' without."""
    schema = library("pyarrow.parquet", "a set of runs", "sweep").read_schema(path)
    return {field.name: ((field.metadata or {}).get(b"unit", b"")).decode() for field in schema}

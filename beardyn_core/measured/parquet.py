"""Parquet, read in blocks with pyarrow."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library
from beardyn_core.measured.claimed_rate import claims_by_path, claims_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import BLOCK, Channel, Held, unreadable_file
from beardyn_core.measured.units import split_unit, usual

_READ_BYTES = 1 << 20


class _Parquet(Held):
    path: Path
    parquet: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        first = self.origins
        first.clear()
        try:
            # by default whole groups of rows are read ahead
            with self.parquet.ParquetFile(self.path, pre_buffer=False, buffer_size=_READ_BYTES) as file:
                for batch in file.iter_batches(BLOCK, columns=[self.columns[name] for name in names]):
                    yield np.stack(
                        [_numbers(batch, self.columns[name], name, first) for name in names], axis=1
                    )
        except Exception as error:  # the reader has errors of its own for every kind of damage
            raise unreadable_file(self.path, "Parquet", error) from error


def _numbers(batch: Any, key: str, name: str, first: dict[str, int]) -> Float:
    """Give a column as float64; moments become seconds from the first, exact to a nanosecond."""
    column = batch.column(batch.schema.get_field_index(key))
    if str(column.type).startswith("timestamp"):
        moments = column.to_numpy(zero_copy_only=False).astype("datetime64[ns]").astype(np.int64)
        return np.asarray((moments - first.setdefault(name, int(moments[0]))) * 1e-9, np.float64)
    return np.asarray(column.to_numpy(zero_copy_only=False), np.float64)


def open_file(path: Path, _reading: Reading) -> Held:
    """List the columns of numbers of a file; its metadata may give the rate."""
    parquet = library("pyarrow.parquet", f"{path}: reading Parquet", "measured")
    try:
        with parquet.ParquetFile(path) as file:
            count, schema = int(file.metadata.num_rows), file.schema_arrow
    except Exception as error:
        raise unreadable_file(path, "Parquet", error) from error
    said = {
        key.decode(errors="replace"): value.decode(errors="replace")
        for key, value in (schema.metadata or {}).items()
    }
    numbers = {key: float(value) for key, value in said.items() if _is_number(value)}
    facts = {
        key: value[:500]
        for key, value in said.items()
        if key not in numbers and not key.startswith(("ARROW", "pandas"))
    }
    whole = [replace(claim, place=(), distance=1) for claim in claims_by_path({**facts, **numbers})]
    channels, columns = [], {}
    for each in schema:
        kind = str(each.type)
        if not kind.startswith(("float", "double", "halffloat", "int", "uint", "timestamp")):
            continue
        name, unit = split_unit(each.name)
        own = {key.decode().lower(): value.decode() for key, value in (each.metadata or {}).items()}
        unit = unit or own.get("unit", own.get("units", ""))
        moment = kind.startswith("timestamp")
        claims = (*claims_in(own, (each.name,), f"{name}: "), *whole)
        channels.append(Channel(name, "", count, "s" if moment else usual(unit), claims, is_time=moment))
        columns[name] = each.name
    found = _Parquet(tuple(channels), columns, numbers, facts)
    found.path, found.parquet = path, parquet
    return found


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True

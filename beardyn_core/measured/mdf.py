"""MDF 3 and 4, read in blocks with asammdf."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library
from beardyn_core.measured.claimed_start import Start
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import BLOCK, Channel, Held, in_text, unreadable_file
from beardyn_core.measured.units import usual

_TIME = "time"


class _Mdf(Held):
    path: Path
    asammdf: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        try:
            with _open_mdf(self.path, self.asammdf) as file:
                group = self.columns[names[0]][0]
                count = file.groups[group].channel_group.cycles_nr
                self.flagged = dict.fromkeys(names, 0)
                for begin in range(0, count, BLOCK):
                    part = {"record_offset": begin, "record_count": min(BLOCK, count - begin)}
                    found = [_samples(file, group, self.columns[name][1], part) for name in names]
                    for name, values in zip(names, found, strict=True):
                        self.flagged[name] += int(np.isnan(values).sum())
                    yield np.stack(found, axis=1)
        except Exception as error:  # the reader breaks in any way on bytes that are not what they should be
            raise unreadable_file(self.path, "MDF", error) from error


@contextmanager
def _open_mdf(path: Path, asammdf: Any) -> Iterator[Any]:
    with path.open("rb") as raw:
        try:
            file = asammdf.MDF(raw)
        except Exception as error:
            _let_go(error.__traceback__)
            raise
        with file:
            yield file


def _let_go(trace: TracebackType | None) -> None:
    """Keep a file that could not be opened from complaining again when it is deleted."""
    while trace is not None:
        opener = trace.tb_frame.f_locals.get("self")
        if opener is not None and hasattr(opener, "_closed"):
            opener._closed = True
        trace = trace.tb_next


def _samples(file: Any, group: int, index: int | None, part: dict[str, int]) -> Float:
    """Give the samples of a channel, NaN where the file marks one as invalid."""
    if index is None:
        return np.asarray(file.get_master(group, **part), np.float64)
    values, invalid = file.get(
        group=group, index=index, samples_only=True, ignore_invalidation_bits=True, **part
    )
    found = np.array(values, np.float64)
    if invalid is not None and len(invalid) == len(found):
        found[np.asarray(invalid, bool)] = np.nan
    return found


def open_file(path: Path, _reading: Reading) -> Held:
    """List the channels of a file; ``name (group 2)`` where two groups have one of the same name."""
    asammdf = library("asammdf", f"{path}: reading MDF", "measured")
    channels: list[Channel] = []
    places: dict[str, tuple[int, int | None]] = {}
    facts: dict[str, str] = {}
    origins: dict[str, int] = {}
    origin = Start(0, False)
    try:
        with _open_mdf(path, asammdf) as file:
            if (start := in_text(file.header.start_time)) is not None:
                facts["start"] = start
                origin = Start(round(file.header.start_time.timestamp() * 1e9), True)
            masters = file.masters_db
            names = Counter(
                channel.name
                for group, each in enumerate(file.groups)
                for index, channel in enumerate(each.channels)
                if masters.get(group) != index
            )
            for group, each in enumerate(file.groups):
                count = int(each.channel_group.cycles_nr)
                table = f"group {group}, {count} samples"
                if count < 1:
                    continue
                if group in masters:
                    channels.append(Channel(f"{_TIME} (group {group})", table, count, "s", is_time=True))
                    places[channels[-1].name] = (group, None)
                    origins[channels[-1].name] = origin.ns
                for index, channel in enumerate(each.channels):
                    if masters.get(group) == index:
                        continue
                    first = file.get(
                        group=group, index=index, samples_only=True, record_offset=0, record_count=1
                    )[0]
                    if first.dtype.kind not in "fiu" or first.ndim != 1:
                        continue
                    name = channel.name if names[channel.name] == 1 else f"{channel.name} (group {group})"
                    channels.append(Channel(name, table, count, usual(str(channel.unit or ""))))
                    places[name] = (group, index)
    except Exception as error:
        raise unreadable_file(path, "MDF", error) from error
    found = _Mdf(tuple(channels), places, {}, facts, origins=origins)
    found.path, found.asammdf = path, asammdf
    return found

"""TDMS of LabVIEW, read in blocks with nptdms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from beardyn_core.arrays import Float
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import UNKNOWN, Channel, Held, broken, in_text
from beardyn_core.measured.units import usual
from beardyn_core.optional import library

_UNITS = ("unit_string", "NI_UnitDescription", "Unit", "unit")


class _Tdms(Held):
    path: Path
    nptdms: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        try:
            with self.nptdms.TdmsFile.open(self.path) as file:
                columns = {}
                for name in names:
                    group, channel = self.columns[name]
                    columns[name] = file[group][channel]
                yield from Held(self.channels, columns).blocks(names)
        except Exception as error:  # the reader breaks in any way on bytes that are not what they should be
            raise broken(self.path, "TDMS", error) from error


def open_file(path: Path, _reading: Reading) -> Held:
    """List the channels of a file, ``group/channel`` where two groups have one of the same name."""
    nptdms = library("nptdms", f"{path}: reading TDMS", "measured")
    facts: dict[str, str] = {}
    numbers: dict[str, float] = {}
    channels, places, starts = [], {}, set()
    try:
        with nptdms.TdmsFile.open(path) as file:
            every = [channel for group in file.groups() for channel in group.channels()]
            names = Counter(channel.name for channel in every)
            for key, value in file.properties.items():
                _note(str(key), value, numbers, facts)
            for channel in every:
                name = channel.name if names[channel.name] == 1 else f"{channel.group_name}/{channel.name}"
                if channel.dtype is None or channel.dtype.kind not in "fiu" or not len(channel):
                    continue
                said = channel.properties
                step = said.get("wf_increment") or 0.0
                rate = 1.0 / step if step > 0.0 else UNKNOWN
                unit = next((str(said[key]) for key in _UNITS if said.get(key)), "")
                table = f"{channel.group_name}, {len(channel)} samples at {rate:g} Hz"
                channels.append(Channel(name, table, len(channel), usual(unit), rate))
                places[name] = (channel.group_name, channel.name)
                if said.get("wf_start_time") is not None:
                    starts.add(str(said["wf_start_time"]))
    except Exception as error:
        raise broken(path, "TDMS", error) from error
    if len(starts) == 1:
        facts["start"] = starts.pop()
    found = _Tdms(tuple(channels), places, numbers, facts)
    found.path, found.nptdms = path, nptdms
    return found


def _note(key: str, value: Any, numbers: dict[str, float], facts: dict[str, str]) -> None:
    if isinstance(value, int | float) and not isinstance(value, bool):
        numbers[key] = float(value)
    elif (text := in_text(value)) is not None:
        facts[key] = text

"""TDMS of LabVIEW, read in blocks with nptdms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library
from beardyn_core.measured.claimed_rate import claims_in, claims_on
from beardyn_core.measured.claimed_start import start_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Held, in_text, unreadable_file
from beardyn_core.measured.units import usual

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
            raise unreadable_file(self.path, "TDMS", error) from error


def open_file(path: Path, _reading: Reading) -> Held:
    """List the channels of a file, ``group/channel`` where two groups have one of the same name."""
    nptdms = library("nptdms", f"{path}: reading TDMS", "measured")
    facts: dict[str, str] = {}
    numbers: dict[str, float] = {}
    channels, places = [], {}
    dates: set[str] = set()
    try:
        with nptdms.TdmsFile.open(path) as file:
            every = [channel for group in file.groups() for channel in group.channels()]
            names = Counter(channel.name for channel in every)
            for key, value in file.properties.items():
                _note(str(key), value, numbers, facts)
            claims = claims_in(dict(file.properties))
            for group in file.groups():
                claims += claims_in(dict(group.properties), (group.name,), f"{group.name}: ")
            for channel in every:
                claims += claims_in(
                    dict(channel.properties), (channel.group_name, channel.name), f"{channel.name}: "
                )
            paths = [(channel.group_name, channel.name) for channel in every]
            for channel in every:
                name = channel.name if names[channel.name] == 1 else f"{channel.group_name}/{channel.name}"
                if channel.dtype is None or channel.dtype.kind not in "fiu" or not len(channel):
                    continue
                said = dict(channel.properties)
                start = start_in(said) or start_in(dict(file[channel.group_name].properties))
                own = claims_on((channel.group_name, channel.name), claims, paths)
                rate = next((rate for claim in own for rate in claim.rates), float("nan"))
                unit = next((str(said[key]) for key in _UNITS if said.get(key)), "")
                table = f"{channel.group_name}, {len(channel)} samples at {rate:g} Hz"
                if start is not None and start.ns:
                    table += f" from {start.ns * 1e-9:.9g} s"
                channels.append(Channel(name, table, len(channel), usual(unit), own, start))
                places[name] = (channel.group_name, channel.name)
                if said.get("wf_start_time") is not None:
                    dates.add(str(said["wf_start_time"]))
    except Exception as error:
        raise unreadable_file(path, "TDMS", error) from error
    if len(dates) == 1:
        facts["start"] = dates.pop()
    found = _Tdms(tuple(channels), places, numbers, facts)
    found.path, found.nptdms = path, nptdms
    return found


def _note(key: str, value: Any, numbers: dict[str, float], facts: dict[str, str]) -> None:
    if isinstance(value, int | float) and not isinstance(value, bool):
        numbers[key] = float(value)
    elif (text := in_text(value)) is not None:
        facts[key] = text

"""WAV (also RF64 and FLAC), read in blocks with soundfile: whole numbers are shares of full scale."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.optional import library
from beardyn_core.measured.claimed_rate import claims_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import BLOCK, Channel, Held, unreadable_file
from beardyn_core.measured.units import split_unit, usual

_USUAL_STEP = 25.0  # [Hz], of which rates that were not rounded are multiples: 11025, 25600, 44100
_ROUNDED = 0.5  # [Hz], by which the head may be off
_FLOATS = ("FLOAT", "DOUBLE")


class _Sound(Held):
    path: Path
    soundfile: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        wanted = [self.columns[name] for name in names]
        try:
            with self.soundfile.SoundFile(self.path) as file:
                for block in file.blocks(BLOCK, dtype="float64", always_2d=True):
                    yield np.asarray(block[:, wanted], np.float64)
        except self.soundfile.LibsndfileError as error:
            raise unreadable_file(self.path, "WAV", error) from error


def open_file(path: Path, _reading: Reading) -> Held:
    """List the channels of a file, ``channel_1``, ``channel_2``, ...; its rate stands in its head."""
    soundfile = library("soundfile", f"{path}: reading WAV", "measured")
    try:
        with soundfile.SoundFile(path) as file:
            count, rate, names = file.frames, float(file.samplerate), file.channels
            subtype, facts = file.subtype, file.copy_metadata()
    except soundfile.LibsndfileError as error:
        raise unreadable_file(path, "WAV", error) from error
    columns, exact = _comment(str(facts.get("comment", "")), names, rate)
    claims = tuple(claims_in({"sample rate": exact or rate}))
    whole = subtype not in _FLOATS  # another program has scaled them, whatever the comment states
    named = [split_unit(column) for column in columns]
    if len({name for name, _ in named}) < names:
        named = [(f"channel_{k + 1}", "") for k in range(names)]
    channels = tuple(Channel(name, "", count, "" if whole else usual(unit), claims) for name, unit in named)
    notes = [f"numbers are shares of full scale, 1 is the largest ({subtype})"] if whole else []
    found = _Sound(
        channels, {}, {}, {str(key): str(value) for key, value in facts.items()},
        notes=tuple(notes),
        warnings=() if exact or rate % _USUAL_STEP == 0.0 else (
            f"the head of a WAV file has whole hertz only, and {rate:.0f} Hz may be rounded by half of one "
            f"({50.0 / rate:.2g} %); give --rate-hz if the rate is known",
        ),
    )  # fmt: skip
    found.path, found.soundfile = path, soundfile
    found.columns = {channel.name: k for k, channel in enumerate(channels)}
    missing = _missing_bytes(path)
    if missing:
        found.problems.append(f"{path}: is cut off: {missing} bytes of its samples are missing")
    return found


def _comment(text: str, count: int, rate: float) -> tuple[list[str], float]:
    """Take names with units and the exact rate from the comment of an exported file; nothing of any other."""
    try:
        said = json.loads(text)
    except (ValueError, RecursionError):
        return [], 0.0
    if not isinstance(said, dict):
        return [], 0.0
    columns, exact = said.get("columns"), said.get("rate_Hz")
    if not (isinstance(columns, list) and len(columns) == count):
        columns = []
    if isinstance(exact, bool) or not isinstance(exact, int | float) or not abs(exact - rate) <= _ROUNDED:
        exact = 0.0
    return [str(column) for column in columns], float(exact)


def _missing_bytes(path: Path) -> int:
    """Count the bytes that the data chunk of a RIFF file promises and the file does not have."""
    size = path.stat().st_size
    with path.open("rb") as file:
        if file.read(4) not in (b"RIFF",):
            return 0
        file.seek(12)
        while len(head := file.read(8)) == 8:
            name, length = struct.unpack("<4sI", head)
            if name == b"data":
                return 0 if length in (0, 0xFFFFFFFF) else max(0, file.tell() + length - size)
            file.seek(length + length % 2, 1)
    return 0

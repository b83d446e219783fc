"""WAV (also RF64 and FLAC), read in blocks with soundfile: whole numbers are shares of full scale."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.measured.claimed_rate import claims_in
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import BLOCK, Channel, Held, broken
from beardyn_core.optional import library

_USUAL_STEP = 25.0  # [Hz], of which rates that were not rounded are multiples: 11025, 25600, 44100
_FLOATS = ("FLOAT", "DOUBLE")


class _Sound(Held):
    path: Path
    soundfile: Any

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one table from the beginning, shape [sample, channel]."""
        wanted = [int(name.rpartition("_")[2]) - 1 for name in names]
        try:
            with self.soundfile.SoundFile(self.path) as file:
                for block in file.blocks(BLOCK, dtype="float64", always_2d=True):
                    yield np.asarray(block[:, wanted], np.float64)
        except self.soundfile.LibsndfileError as error:
            raise broken(self.path, "WAV", error) from error


def open_file(path: Path, _reading: Reading) -> Held:
    """List the channels of a file, ``channel_1``, ``channel_2``, ...; its rate stands in its head."""
    soundfile = library("soundfile", f"{path}: reading WAV", "measured")
    try:
        with soundfile.SoundFile(path) as file:
            count, rate, names = file.frames, float(file.samplerate), file.channels
            subtype, facts = file.subtype, file.copy_metadata()
    except soundfile.LibsndfileError as error:
        raise broken(path, "WAV", error) from error
    claims = tuple(claims_in({"sample rate": rate}))
    channels = tuple(Channel(f"channel_{k + 1}", "", count, "", claims) for k in range(names))
    whole = subtype not in _FLOATS
    notes = [f"numbers are shares of full scale, 1 is the largest ({subtype})"] if whole else []
    found = _Sound(
        channels, {}, {}, {str(key): str(value) for key, value in facts.items()},
        notes=tuple(notes),
        warnings=() if rate % _USUAL_STEP == 0.0 else (
            f"the head of a WAV file has whole hertz only, and {rate:.0f} Hz may be rounded by half of one "
            f"({50.0 / rate:.2g} %); give --rate-hz if the rate is known",
        ),
    )  # fmt: skip
    found.path, found.soundfile = path, soundfile
    missing = _missing_bytes(path)
    if missing:
        found.problems.append(f"{path}: is cut off: {missing} bytes of its samples are missing")
    return found


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

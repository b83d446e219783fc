"""A measured transfer path, sensor over rigid box, from a CSV or a Universal file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import note_read
from beardyn_core.base.packed import pack_file, unpack_file
from beardyn_core.rail.table import Column, Layout, read_table

_PAIRS = (("real", "imaginary"), ("magnitude_dB", "phase_deg"))
LAYOUT = Layout(
    what="a transfer path over the frequency",
    columns=(
        Column("frequency_Hz", "Hz"),
        *(Column(name, name.partition("_")[2], needed=False) for pair in _PAIRS for name in pair),
    ),
    ascending="frequency_Hz",
)
_UNIVERSAL = (".uff", ".unv")
_FUNCTION = 58
_RESPONSE = 4  # function type of a frequency response


@dataclass(frozen=True)
class TransferPath:
    """Ratio of the acceleration at a sensor to that of the rigid box at its place."""

    frequency: A[Float, "shape [frequency], increasing, [Hz]"]
    ratio: A[NDArray[np.complex128], "shape [frequency], [-]"]


def read_transfer_path(path: Path) -> TransferPath:
    """Read a measured path; columns and data sets are those of `beardyn_core.scene.sensor.MeasuredPath`.

    Raises
    ------
    InputError
        With what is wrong with the file.
    """
    path = Path(path)
    if path.suffix.lower() in _UNIVERSAL:
        note_read(path)
        return _check_ratio(path, *_universal(path))
    table = read_table(path, LAYOUT)
    whole = [pair for pair in _PAIRS if all(name in table for name in pair)]
    if len(whole) != 1 or len(table) != 3:
        raise InputError(
            f"{path}: has the columns {', '.join(table)}; next to frequency_Hz give real and imaginary, or "
            "magnitude_dB and phase_deg"
        )
    one, two = (table[name] for name in whole[0])
    ratio = one + 1j * two if whole[0] == _PAIRS[0] else 10.0 ** (one / 20.0) * np.exp(1j * np.deg2rad(two))
    return _check_ratio(path, table["frequency_Hz"], np.asarray(ratio, dtype=np.complex128))


def path_read(content: str | None, path: Path) -> TransferPath:
    """Read a measured path from what a recording has of it, or else from its file."""
    if not content:
        return read_transfer_path(path)
    try:
        rows = [line.split(",") for line in unpack_file(content, path).splitlines()]
        frequency, real, imaginary = np.array(rows, dtype=np.float64).T
    except ValueError as error:
        raise InputError(f"{path}: content is no measured path ({error})") from error
    return _check_ratio(path, frequency, real + 1j * imaginary)


def content_of(measured: TransferPath, path: Path) -> str:
    """Pack what was read of a file so that `path_read` gives the same: frequency, real, imaginary."""
    rows = zip(measured.frequency.tolist(), measured.ratio.tolist(), strict=True)
    return pack_file("\n".join(f"{hertz!r},{ratio.real!r},{ratio.imag!r}" for hertz, ratio in rows), path)


def _check_ratio(path: Path, frequency: Float, ratio: NDArray[np.complex128]) -> TransferPath:
    problems = []
    if frequency[0] < 0.0:
        problems.append(f"{path}: frequency_Hz begins at {frequency[0]:g}; it must not be negative")
    if frequency[-1] < 1000.0:
        problems.append(
            f"{path}: frequency_Hz ends at {frequency[-1]:g}; a path must reach at least 1000 Hz, where "
            "boxes begin to ring"
        )
    if not np.isfinite(ratio).all():
        problems.append(f"{path}: the ratio has values that are not finite")
    if problems:
        raise InputError(problems)
    return TransferPath(np.asarray(frequency, dtype=np.float64), np.asarray(ratio, dtype=np.complex128))


def _universal(path: Path) -> tuple[Float, NDArray[np.complex128]]:
    try:
        import pyuff
    except ImportError:
        raise InputError(
            f"{path}: a Universal file needs pyuff; install with `pip install beardyn[structure]`, or give "
            "CSV"
        ) from None
    try:
        if not path.is_file():
            raise OSError("no such file")
        found = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # of a broken file pyuff raises whatever Python does
        raise InputError(f"{path}: cannot be read as a Universal file: {error}") from error
    sets: list[dict[str, Any]] = found if isinstance(found, list) else [found]
    responses = [each for each in sets if each["type"] == _FUNCTION and each.get("func_type") == _RESPONSE]
    if len(responses) != 1:
        raise InputError(
            f"{path}: has {len(responses)} frequency responses (data set 58, function type 4); give exactly "
            "one"
        )
    frequency = np.asarray(responses[0]["x"], dtype=np.float64)
    if len(frequency) < 2 or not (np.diff(frequency) > 0.0).all():
        raise InputError(f"{path}: the frequencies of the response must increase, and be at least two")
    return frequency, np.asarray(responses[0]["data"], dtype=np.complex128)

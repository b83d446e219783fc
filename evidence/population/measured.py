"""Public records of spalled bearings on test rigs, and the features of each.

The files are not ours to give: docs/measured.md says where they are from. CWRU Bearing Data Center: drive
end, 12 kHz; MFPT Society: bearing fault data sets. Both have small bearings on a motor or a rig, with damage
of 0.2 to 0.7 mm by a spark, or worn: far from an axlebox, which is the point.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

import beardyn_core as bd
from beardyn_core.population.features import NAMES, features_of

_CWRU = {"B": "roller", "IR": "cone", "OR": "cup"}
_MFPT = {"InnerRace": "cone", "OuterRace": "cup", "baseline": "healthy"}


@dataclass(frozen=True)
class Record:
    """One file."""

    path: Path
    condition: A[str, "in the words of an axlebox: cup for outer ring, cone for inner ring"]
    plate: A[str, "data of the bearing"]
    options: A[dict[str, Any], "how it is read"]


def records(folder: Path) -> Iterator[Record]:
    """Find the records of both collections below a folder."""
    for path in sorted(folder.rglob("*.mat")):
        rigs = re.search(r"12k_Drive_End[^/]*/(B|IR|OR)/", path.as_posix())
        if rigs or path.parent.name == "Normal":
            rate = 48_000 if path.parent.name == "Normal" else 12_000
            condition = _CWRU[rigs[1]] if rigs else "healthy"
            options = {"channels": {"z": "*DE_time"}, "unit": "g", "rate_Hz": rate, "speed_channel": "*RPM"}
            yield Record(path, condition, "6205", options)
        kind = next((word for word in _MFPT if word.lower() in path.name.lower()), None)
        if kind:
            options = {"channels": {"z": "bearing.gs"}, "speed_channel": "bearing.rate", "speed_unit": "Hz"}
            yield Record(path, _MFPT[kind], "NICE", options)


def collection_of(record: Record) -> str:
    """Name the collection of a record."""
    return "CWRU" if record.plate == "6205" else "MFPT"


def features_of_records(found: list[Record]) -> tuple[dict[str, NDArray[np.float64]], NDArray[Any]]:
    """Work out the features of records, an array each, and their conditions; unreadable ones are left out."""
    rows, conditions = [], []
    for record in found:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                run = bd.read_measured(record.path, bearing=record.plate, **record.options)
            except bd.InputError as error:
                print(f"{record.path}: left out: {error}")
                continue
        plate = bd.name_plate(record.plate)
        rows.append(features_of(run, plate.frequencies, plate.roller_count))
        conditions.append(record.condition)
    return {name: np.array([row[name] for row in rows]) for name in NAMES}, np.array(conditions)

"""The records: which bearing is faulty and where, how fast the shaft turns, and how they are read.

The data are public and not part of the repository. A folder is searched for them at any depth; what is not
there is left out, and the page says so.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_plate
from evidence.measured.grades import GRADES

G = 9.80665  # [m/s^2]
DRIVE, FAN = "drive end", "fan end"
PLATES = {DRIVE: "6205", FAN: "6203"}
SENSORS = {DRIVE: "DE", FAN: "FE"}
NOMINAL_RPM = (1797.0, 1772.0, 1750.0, 1730.0)  # at 0 to 3 horsepower, of files that do not say it
SETS = ("CWRU 12 kHz, drive end", "CWRU 12 kHz, fan end", "CWRU 48 kHz, drive end", "CWRU healthy", "MFPT")
CWRU_12_DRIVE, CWRU_12_FAN, CWRU_48_DRIVE, CWRU_SOUND, MFPT = SETS
HIT = "HIT-SM"  # two rigs of the Harbin Institute of Technology, 6205, 51.2 kHz, one axis
_HIT_PARTS = {"IR": "cone", "OR": "cup", "No": ""}

# part, diameter in thousandths of an inch, place of a fault of the cup on the clock, numbers at 0 to 3 hp
_TABLE: dict[str, tuple[tuple[str, int, int, tuple[int, ...]], ...]] = {
    CWRU_12_DRIVE: (
        ("cone", 7, 0, (105, 106, 107, 108)),
        ("cone", 14, 0, (169, 170, 171, 172)),
        ("cone", 21, 0, (209, 210, 211, 212)),
        ("cone", 28, 0, (3001, 3002, 3003, 3004)),
        ("roller", 7, 0, (118, 119, 120, 121)),
        ("roller", 14, 0, (185, 186, 187, 188)),
        ("roller", 21, 0, (222, 223, 224, 225)),
        ("roller", 28, 0, (3005, 3006, 3007, 3008)),
        ("cup", 7, 6, (130, 131, 132, 133)),
        ("cup", 7, 3, (144, 145, 146, 147)),
        ("cup", 7, 12, (156, 158, 159, 160)),
        ("cup", 14, 6, (197, 198, 199, 200)),
        ("cup", 21, 6, (234, 235, 236, 237)),
        ("cup", 21, 3, (246, 247, 248, 249)),
        ("cup", 21, 12, (258, 259, 260, 261)),
    ),
    CWRU_12_FAN: (
        ("cone", 7, 0, (278, 279, 280, 281)),
        ("cone", 14, 0, (274, 275, 276, 277)),
        ("cone", 21, 0, (270, 271, 272, 273)),
        ("roller", 7, 0, (282, 283, 284, 285)),
        ("roller", 14, 0, (286, 287, 288, 289)),
        ("roller", 21, 0, (290, 291, 292, 293)),
        ("cup", 7, 6, (294, 295, 296, 297)),
        ("cup", 7, 3, (298, 299, 300, 301)),
        ("cup", 7, 12, (302, 305, 306, 307)),
        ("cup", 14, 3, (310, 309, 311, 312)),
        ("cup", 14, 6, (313,)),
        ("cup", 21, 6, (315,)),
        ("cup", 21, 3, (0, 316, 317, 318)),
    ),
    CWRU_48_DRIVE: (
        ("cone", 7, 0, (109, 110, 111, 112)),
        ("cone", 14, 0, (174, 175, 176, 177)),
        ("cone", 21, 0, (213, 214, 215, 217)),
        ("roller", 7, 0, (122, 123, 124, 125)),
        ("roller", 14, 0, (189, 190, 191, 192)),
        ("roller", 21, 0, (226, 227, 228, 229)),
        ("cup", 7, 6, (135, 136, 137, 138)),
        ("cup", 7, 3, (148, 149, 150, 151)),
        ("cup", 7, 12, (161, 162, 163, 164)),
        ("cup", 14, 6, (201, 202, 203, 204)),
        ("cup", 21, 6, (238, 239, 240, 241)),
        ("cup", 21, 3, (250, 251, 252, 253)),
        ("cup", 21, 12, (262, 263, 264, 265)),
    ),
    CWRU_SOUND: (("", 0, 0, (97, 98, 99, 100)),),
}


@dataclass(frozen=True)
class Record:
    """One file of measured vibration, and what is known of it."""

    group: A[str, "one of `SETS`, or `HIT`"]
    name: A[str, "number of the record, or name of the file"]
    path: Path
    part: A[str, "faulty part, '' when sound"]
    diameter: A[int, "of the fault, 0 when unknown, [thousandths of an inch]"] = 0
    clock: A[int, "place of a fault of the cup, 6 is the load zone, 0 when not told, [hours]"] = 0
    load: A[int, "of the motor, [hp]"] = 0
    grade: A[str, "of Smith and Randall for the faulty end, '' when not known"] = ""

    @property
    def judging(self) -> bool:
        """Whether the record was kept back to judge by: all but every second one of 12 kHz, drive end."""
        return not (self.group == CWRU_12_DRIVE and int(self.name) % 2 == 1)


@dataclass(frozen=True)
class Listening:
    """A bearing beside its accelerometer in a record."""

    record: Record
    end: A[str, "which bearing of the machine, '' when there is one"]
    plate: NamePlate
    part: A[str, "its faulty part, '' when it is sound"]
    rate: A[float, "[Hz]"]
    shaft_frequency: A[float, "[Hz]"]
    acceleration: A[Float, "shape [sample], [m/s^2]"]


@cache
def cwru_known() -> dict[int, tuple[str, str, int, int, int]]:
    """List set, part, diameter, place and load of the records of CWRU by their numbers."""
    return {
        number: (group, part, diameter, clock, load)
        for group, rows in _TABLE.items()
        for part, diameter, clock, numbers in rows
        for load, number in enumerate(numbers)
        if number
    }


def records(cwru: Path | None = None, mfpt: Path | None = None, hit_sm: Path | None = None) -> list[Record]:
    """Find the records below the folders, in the order of the tables."""
    found = []
    if cwru is not None:
        paths = {int(hit[0]): path for path in cwru.rglob("*.mat") if (hit := re.match(r"\d+", path.name))}
        for number, (group, part, diameter, clock, load) in cwru_known().items():
            if number in paths:
                grade = GRADES.get(number, "")
                path = paths[number]
                found.append(Record(group, str(number), path, part, diameter, clock, load, grade))
    if mfpt is not None:
        for path in sorted(mfpt.rglob("*.mat")):
            parts = {"baseline": "", "InnerRaceFault": "cone", "OuterRaceFault": "cup"}
            for word, part in parts.items():
                if path.name.startswith(word):
                    found.append(Record(MFPT, path.stem, path, part))
    for path in sorted(hit_sm.rglob("*.mat")) if hit_sm is not None else ():
        named = re.search(r"(IR|OR|Normal)\d*_(600|900|1200)$", path.stem)
        if named:
            found.append(Record(HIT, f"{path.parent.name}/{path.stem}", path, _HIT_PARTS[named[1][:2]]))
    return found


def listenings(record: Record) -> Iterator[Listening]:
    """Read a record: each bearing with its own accelerometer, the faulty one first."""
    from scipy.io import loadmat

    content: dict[str, Any] = loadmat(record.path, squeeze_me=True)
    if record.group == MFPT:
        bearing = content["bearing"]
        signal = np.asarray(bearing["gs"].item(), float).ravel() * G
        rate, turns = float(bearing["sr"].item()), float(bearing["rate"].item())
        yield Listening(record, "", load_plate("NICE"), record.part, rate, turns, signal)
        return
    if record.group == HIT:
        signal = next(np.ravel(value) for key, value in content.items() if not key.startswith("__"))
        rpm = float(record.name.rpartition("_")[2])
        yield Listening(
            record, "", load_plate(PLATES[DRIVE]), record.part, 51.2e3, rpm / 60.0, G * signal.astype(float)
        )
        return
    rate = 12e3 if record.group in (CWRU_12_DRIVE, CWRU_12_FAN) else 48e3
    rpm = next((float(content[key]) for key in content if key.endswith("RPM")), NOMINAL_RPM[record.load])
    faulty = FAN if record.group == CWRU_12_FAN else DRIVE
    for end in (faulty, DRIVE if faulty == FAN else FAN):
        key = next((key for key in content if key.endswith(f"{SENSORS[end]}_time")), None)
        if key is not None:
            signal = np.asarray(content[key], float).ravel() * G
            part = record.part if end == faulty else ""
            yield Listening(record, end, load_plate(PLATES[end]), part, rate, rpm / 60.0, signal)

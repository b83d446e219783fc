"""The store of a fleet: one SQLite file, one writer, a transaction for each recording.

SQLite is in Python itself, keeps one file, and in its WAL mode a process that is killed loses nothing that
was committed. Levels and evidence are blobs of a few kilobytes, which belong to one recording each and are
read by it: a second file format next to it would have to be kept in step with it.
"""

from __future__ import annotations

import errno
import json
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from math import isfinite, nan
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import plain
from beardyn_core.fleet.analysis import Analysis, Evidence, analysis_numbers, read_evidence
from beardyn_core.fleet.consistency import Known
from beardyn_core.fleet.identity import Axlebox, FleetRecording

try:
    import fcntl
except ImportError:  # a system without file locks
    fcntl = None  # type: ignore[assignment]

SCHEMA_VERSION = 1
"""Raised when tables change; a store of another version is refused."""
APPLICATION = 0x62647966  # "bdyf", in the head of the file
EXCHANGED, ACKNOWLEDGED = "exchanged", "acknowledged"
_BUSY_S = 10.0
_TABLES = """
create table recording (
    id integer primary key, sha256 text not null, source_box text not null, file text not null,
    vehicle text not null, axle text not null, side text not null, train text not null,
    time real not null, mileage real, bearing text not null, sensor text not null, exchanged integer not null,
    verdict text not null, reason text not null, bearing_name text not null, confidence real,
    stage text not null, stage_reason text not null, width real, width_low real, width_high real,
    width_from text not null, shaft_frequency real, temperature real, duration real,
    levels blob not null, detail text not null, evidence blob not null, unique (sha256, source_box)
) strict;
create index recording_by_axlebox on recording (vehicle, axle, side, time);
create table entry (
    id integer primary key, kind text not null, vehicle text not null, axle text not null, side text not null,
    time real not null, mileage real, made_by text not null, note text not null, health text not null,
    raised real
) strict;
"""
_COLUMNS = (
    *("sha256", "source_box", "file", "vehicle", "axle", "side", "train", "time", "mileage", "bearing"),
    *("sensor", "exchanged", "verdict", "reason", "bearing_name", "confidence", "stage", "stage_reason"),
    *("width", "width_low", "width_high", "width_from", "shaft_frequency", "temperature", "duration"),
    *("levels", "detail", "evidence"),
)
_NUMBERS = (
    *(
        "mileage",
        "confidence",
        "width",
        "width_low",
        "width_high",
        "shaft_frequency",
        "temperature",
        "duration",
    ),
)
# of a list: estimates are most of the detail, and nothing that is listed needs them
_LISTED = ", ".join(
    (
        "id",
        *(
            f"json_remove({name}, '$.estimate') as {name}" if name == "detail" else name
            for name in _COLUMNS[:-1]
        ),
    )
)


@dataclass(frozen=True)
class Stored:
    """A recording as the store lists it, without evidence and without what an estimator says."""

    number: A[int, "in the store"]
    axlebox: Axlebox
    train: str
    time: A[float, "[s]"]
    mileage: A[float, "NaN unknown, [m]"]
    bearing: A[str, "as stated"]
    file: str
    exchanged: A[bool, "whether the bearing is another one from this recording on"]
    analysis: Analysis


@dataclass(frozen=True)
class Entry:
    """What a person has entered about an axlebox."""

    kind: A[str, "`EXCHANGED` or `ACKNOWLEDGED`"]
    axlebox: Axlebox
    time: A[float, "[s]"]
    mileage: A[float, "NaN where not stated, [m]"]
    made_by: str
    note: str
    health: A[str, "health that was acknowledged"] = ""
    raised: A[float, "when that health began; NaN of an exchange, [s]"] = nan


class FleetStore:
    """An open store; `open_store` opens one."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path = path
        self._connection = connection

    def add(self, recording: FleetRecording, analysis: Analysis) -> None:
        """Add a recording in one transaction."""
        box = recording.axlebox
        values: dict[str, Any] = {
            "sha256": recording.sha256,
            "source_box": recording.source_box,
            "file": str(recording.path),
            **box._asdict(),
            "train": recording.train,
            "time": recording.time,
            "mileage": recording.mileage,
            "bearing": recording.bearing,
            "sensor": recording.sensor,
            "exchanged": int(recording.exchanged),
            "levels": analysis.levels.astype(np.float32).tobytes(),
            "detail": json.dumps(plain(analysis_numbers(analysis)), allow_nan=False),
            **{
                name: getattr(analysis, name)
                for name in _COLUMNS
                if hasattr(analysis, name) and name != "levels"
            },
        }
        row = [_sql(values[name]) for name in _COLUMNS]
        marks = ", ".join("?" for _ in _COLUMNS)
        with self._connection:
            self._connection.execute(f"insert into recording ({', '.join(_COLUMNS)}) values ({marks})", row)

    def enter(self, entry: Entry) -> None:
        """Add what a person has entered."""
        box = entry.axlebox
        row = [entry.kind, *box, entry.time, entry.mileage, entry.made_by, entry.note]
        row += [entry.health, entry.raised]
        with self._connection:
            self._connection.execute(
                "insert into entry (kind, vehicle, axle, side, time, mileage, made_by, note, health, raised) "
                "values (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                [_sql(each) for each in row],
            )

    def recordings(self) -> list[Stored]:
        """List all recordings in the order of time, without evidence and without what estimators say."""
        rows = self._connection.execute(f"select {_LISTED} from recording order by time, id")
        names = [each[0] for each in rows.description]
        return [_stored(dict(zip(names, row, strict=True))) for row in rows]

    def known(self) -> list[Known]:
        """List what contradictions are looked for in."""
        return [
            Known(Axlebox(*row[:3]), row[3], _known(row[4]), row[5], (row[6], row[7]), row[8], bool(row[9]))
            for row in self._connection.execute(
                "select vehicle, axle, side, time, mileage, bearing, sha256, source_box, file, exchanged "
                "from recording"
            )
        ]

    def entries(self) -> list[Entry]:
        """List what people have entered, in that order."""
        return [
            Entry(row[0], Axlebox(*row[1:4]), row[4], _known(row[5]), row[6], row[7], row[8], _known(row[9]))
            for row in self._connection.execute(
                "select kind, vehicle, axle, side, time, mileage, made_by, note, health, raised "
                "from entry order by id"
            )
        ]

    def evidence(self, number: int) -> Evidence | None:
        """Read spectrum and waveform of a recording; ``None`` where it has none."""
        row = self._connection.execute("select evidence from recording where id = ?", [number]).fetchone()
        return read_evidence(row[0]) if row else None

    def count(self) -> int:
        """Count the recordings."""
        return int(self._connection.execute("select count(*) from recording").fetchone()[0])


@contextmanager
def open_store(path: Path, *, write: bool = False, make: bool = False) -> Iterator[FleetStore]:
    """Open a store.

    Parameters
    ----------
    write : bool
        Whether it is written; then nobody else may.
    make : bool
        Whether it is made when it is missing.

    Raises
    ------
    InputError
        There is none, it is of another version or no store, or another process writes it.
    """
    path = Path(path)
    if path.is_dir():
        raise InputError(f"--store {path}: is a folder; give the name of a file")
    if not path.exists() and not make:
        raise InputError(f"--store {path}: does not exist; `beardyn fleet add` makes it")
    if not path.exists() and not path.parent.is_dir():
        raise InputError(f"--store {path}: the folder {path.parent} does not exist; create it first")
    with _only_writer(path) if write else _nobody():
        try:
            with closing(_connect(path, write)) as connection:
                _check(path, connection, fresh=make and write)
                yield FleetStore(path, connection)
        except sqlite3.DatabaseError as error:
            raise InputError(f"--store {path}: {error}; {_advice(error)}") from error


def _connect(path: Path, write: bool) -> sqlite3.Connection:
    if write:
        return sqlite3.connect(path, timeout=_BUSY_S)
    return sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", timeout=_BUSY_S, uri=True)


def _check(path: Path, connection: sqlite3.Connection, *, fresh: bool) -> None:
    """Refuse what is no store of this version; make the tables of a fresh one."""
    kind = connection.execute("pragma application_id").fetchone()[0]
    version = connection.execute("pragma user_version").fetchone()[0]
    tables = connection.execute("select count(*) from sqlite_master").fetchone()[0]
    if fresh and not tables:
        connection.execute("pragma journal_mode = wal")
        # the tables and the version in one transaction: a kill between leaves an empty file, which is fresh
        connection.executescript(
            f"begin; {_TABLES} pragma application_id = {APPLICATION}; "
            f"pragma user_version = {SCHEMA_VERSION}; commit;"
        )
    elif kind != APPLICATION:
        raise InputError(f"--store {path}: is no store of a fleet; give another name")
    elif version != SCHEMA_VERSION:
        raise InputError(
            f"--store {path}: is of version {version}, and this beardyn reads version {SCHEMA_VERSION}; use "
            "the beardyn that made it, or add the recordings to a new store"
        )
    connection.execute("pragma synchronous = full")


def _advice(error: sqlite3.DatabaseError) -> str:
    if "not a database" in str(error) or "malformed" in str(error):
        return "it is no store of a fleet, or damaged: give another name"
    if "full" in str(error):
        return "free space; what was committed is kept"
    return "what was committed is kept"


@contextmanager
def _nobody() -> Iterator[None]:
    yield


@contextmanager
def _only_writer(path: Path) -> Iterator[None]:
    """Hold the lock of the writer; the system releases it however the process ends."""
    if fcntl is None:
        yield
        return
    # a file of its own: closing another handle of the database would drop the locks of SQLite
    lock = path.with_name(f"{path.name}.lock")
    handle = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno not in (errno.EWOULDBLOCK, errno.EACCES):
                raise
            raise InputError(
                f"--store {path}: another process is writing it; wait for its end (reading goes on meanwhile)"
            ) from None
        yield
    finally:
        os.close(handle)


def _stored(row: dict[str, Any]) -> Stored:
    numbers = {name: nan if row[name] is None else row[name] for name in _NUMBERS}
    detail = json.loads(row["detail"])
    axes = tuple(detail["axes"])
    levels = np.frombuffer(row["levels"], np.float32).astype(np.float64)
    analysis = Analysis(
        row["verdict"], row["reason"], row["bearing_name"], numbers["confidence"],
        detail["agreeing"], detail["analyses"], row["stage"], row["stage_reason"], numbers["width"],
        numbers["width_low"], numbers["width_high"], row["width_from"], tuple(detail["also_fits"]),
        numbers["shaft_frequency"], numbers["temperature"], axes,
        levels.reshape(len(axes), -1) if levels.size else levels.reshape(0, 0),
        numbers["duration"], {}, tuple(detail["assumed"]),
    )  # fmt: skip
    return Stored(
        row["id"], Axlebox(row["vehicle"], row["axle"], row["side"]), row["train"], row["time"],
        numbers["mileage"], row["bearing"], row["file"], bool(row["exchanged"]), analysis,
    )  # fmt: skip


def _known(value: float | None) -> float:
    return nan if value is None else value


def _sql(value: Any) -> Any:
    """Write what SQLite takes: it has no NaN."""
    if isinstance(value, float | np.floating):
        return float(value) if isfinite(value) else None
    return value

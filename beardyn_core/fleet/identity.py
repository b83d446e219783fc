"""Which axlebox a recording is of, and when and at what mileage it was made."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated as A
from typing import Any, NamedTuple

SIDES = {"left": "left", "l": "left", "right": "right", "r": "right"}
_FORMS = ("%Y%m%d", "%Y%m%d_%H%M", "%Y%m%d_%H%M%S", "%Y%m%dT%H%M%S", "%Y-%m-%d_%H-%M", "%Y-%m-%d_%H-%M-%S")


class Axlebox(NamedTuple):
    """One axlebox of a fleet."""

    vehicle: str
    axle: str
    side: str  # ``left`` or ``right``

    @property
    def name(self) -> str:
        """Its name in sentences and tables."""
        return f"{self.vehicle} axle {self.axle} {self.side}"


@dataclass(frozen=True)
class FleetRecording:
    """A recording of one axlebox that is to be analysed."""

    path: Path
    axlebox: Axlebox
    train: A[str, "whose axleboxes are compared on the same ride"]
    time: A[float, "of its begin, after 1970-01-01 UTC, [s]"]
    mileage: A[float, "of the axlebox, NaN where unknown, [m]"]
    bearing: A[str, "as in `beardyn monitor --bearing`; empty: the scene of the recording names it"] = ""
    sensor: A[str, "accelerometer in the file; empty: the first"] = ""
    source_box: A[str, "axlebox in a recording of several; empty: the only one"] = ""
    exchanged: A[bool, "whether the bearing is another one from this recording on"] = False
    temperature: A[float, "of the axlebox, NaN where unknown, [K]"] = float("nan")
    reading: A[dict[str, Any], "how the file is read, see `beardyn_core.measured.options`"] = field(
        default_factory=dict
    )
    sha256: A[str, "of the file; empty until it is known"] = ""

    @property
    def key(self) -> tuple[str, str]:
        """What no other recording of a store shares: content, and the axlebox in it."""
        return self.sha256, self.source_box


def read_time(text: str) -> float:
    """Read a date with or without a time of day, [s] after 1970-01-01 UTC; without a zone it is UTC.

    Raises
    ------
    ValueError
        It is none.
    """
    text = text.strip()
    for form in _FORMS:
        try:
            return datetime.strptime(text, form).replace(tzinfo=UTC).timestamp()
        except ValueError:
            continue
    found = datetime.fromisoformat(text)
    return (found if found.tzinfo else found.replace(tzinfo=UTC)).timestamp()


def write_time(seconds: float) -> str:
    """Write a time to the minute, UTC."""
    return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d %H:%M}"


def write_date(seconds: float) -> str:
    """Write the date of a time, UTC."""
    return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d}"

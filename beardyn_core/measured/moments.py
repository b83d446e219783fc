"""Dates with times of measuring programs: ``2026-01-31 12:00:00.5+01:00``, ``31.01.2026 12:00:00,5``."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from beardyn_core.base.arrays import Int

_CLOCK = r"(?P<clock>\d\d?:\d\d(?::\d\d(?:[.,]\d+)?)?)"
_ZONE = r"\s?(?P<zone>Z|UTC|[+-]\d\d(?::?\d\d)?)?"
_MOMENT = re.compile(
    rf"(?:(?P<year>\d{{4}})[-/.](?P<month>\d\d?)[-/.](?P<day>\d\d?)|"
    rf"(?P<day_first>\d\d?)\.(?P<then_month>\d\d?)\.(?P<then_year>\d{{4}}))(?:T|,?\s+){_CLOCK}{_ZONE}"
)
_PLAIN = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d(?::\d\d(?:[.,]\d+)?)?Z?")


def is_moment(text: str) -> bool:
    """Tell whether a text is a date with a time."""
    return _MOMENT.fullmatch(text.strip()) is not None


def moments_in_ns(texts: Sequence[str]) -> Int:
    """Convert dates with times to nanoseconds since 1970, those with a zone to UTC.

    Raises
    ------
    ValueError
        One is no such date.
    """
    if not all(map(_PLAIN.fullmatch, texts)):
        texts = [_plain(text) for text in texts]
    written = [text.replace(" ", "T").replace(",", ".").rstrip("Z") for text in texts]
    zones = [_zone(text) for text in written]
    found = np.array([text[:-6] if zone else text for text, zone in zip(written, zones, strict=True)],
                     "datetime64[ns]").astype(np.int64)  # fmt: skip
    return found - np.array(zones, np.int64) * 60_000_000_000 if any(zones) else found


def _plain(text: str) -> str:
    """Write a moment as NumPy reads it, its zone as ``+01:00``."""
    found = _MOMENT.fullmatch(text.strip())
    if found is None:
        raise ValueError(text)
    year = found["year"] or found["then_year"]
    month, day = int(found["month"] or found["then_month"]), int(found["day"] or found["day_first"])
    clock = found["clock"] if found["clock"].index(":") == 2 else f"0{found['clock']}"
    zone = found["zone"] or ""
    if zone in ("Z", "UTC"):
        zone = ""
    elif zone:
        digits = zone[1:].replace(":", "").ljust(4, "0")
        zone = f"{zone[0]}{digits[:2]}:{digits[2:]}"
    return f"{year}-{month:02d}-{day:02d}T{clock}{zone}"


def _zone(text: str) -> int:
    """Give the minutes that the zone at the end of a text is ahead of UTC."""
    if len(text) < 22 or text[-6] not in "+-" or text[-3] != ":":
        return 0
    sign = -1 if text[-6] == "-" else 1
    return sign * (60 * int(text[-5:-3]) + int(text[-2:]))

"""Units of acceleration, speed, time and sampling as people write them."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from beardyn_core.base.units import STANDARD_GRAVITY

ACCELERATION = {
    "m/s2": 1.0,
    "g": STANDARD_GRAVITY,
    "mg": 1e-3 * STANDARD_GRAVITY,
    "ug": 1e-6 * STANDARD_GRAVITY,
    "dm/s2": 0.1,
    "cm/s2": 1e-2,
    "mm/s2": 1e-3,
    "um/s2": 1e-6,
    "in/s2": 0.0254,
    "ft/s2": 0.3048,
}
"""Metres per second squared in each unit."""
TIME = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0, "d": 86400.0}
"""Seconds in each unit."""
SAMPLING = {"mHz": 1e-3, "Hz": 1.0, "kHz": 1e3, "MHz": 1e6, "GHz": 1e9}
"""Hertz in each unit of a sampling rate."""
ROTATION = {"rpm": 2.0 * math.pi / 60.0, "Hz": 2.0 * math.pi, "rad/s": 1.0}
"""Radians per second in each unit."""
TRAVEL = {"km/h": 1.0 / 3.6, "m/s": 1.0}
"""Metres per second in each unit of a vehicle's speed."""

_SAME = {
    "gn": "g",
    "g0": "g",
    "gs": "g",
    "g's": "g",
    "grav": "g",
    "gravity": "g",
    "milli-g": "mg",
    "milli_g": "mg",
    "millig": "mg",
    "micro-g": "ug",
    "micro_g": "ug",
    "microg": "ug",
    "gal": "cm/s2",
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "sekunden": "s",
    "msec": "ms",
    "millisecond": "ms",
    "milliseconds": "ms",
    "usec": "us",
    "microsecond": "us",
    "microseconds": "us",
    "nsec": "ns",
    "nanosecond": "ns",
    "nanoseconds": "ns",
    "minute": "min",
    "minutes": "min",
    "hour": "h",
    "hours": "h",
    "day": "d",
    "days": "d",
    "1/min": "rpm",
    "u/min": "rpm",
    "r/min": "rpm",
    "min-1": "rpm",
    "rev/min": "rpm",
    "hz": "Hz",
    "1/s": "Hz",
    "rps": "Hz",
    "rev/s": "Hz",
    "s-1": "Hz",
    "rad_s": "rad/s",
    "rad_per_s": "rad/s",
    "rad/sec": "rad/s",
    "kmh": "km/h",
    "kph": "km/h",
    "km_h": "km/h",
    "mps": "m/s",
    "m_s": "m/s",
}
_LENGTH = {"inch": "in", "inches": "in", "foot": "ft", "feet": "ft", "metre": "m", "meter": "m"}
# ``m/s2``, ``m/s/s``, ``ms-2``, ``m*s-2``, ``m_s2``, ``m_per_s2``, ``mps2``, ``m/sec2``, ``m/(s2)``
_PER_SECOND_TWICE = re.compile(
    r"(?P<length>[a-z]+?)"
    r"(?:(?:/|_per_|per|_|p)\(?(?:s|sec|second)(?:2|/(?:s|sec|second))\)?|[*._]?(?:s|sec)-2)"
)
_BRACKETS = re.compile(r"^(.*?)\s*[\[({]\s*([^\])}]*?)\s*[\])}]\s*$")
_BOUNDARY = " _.-/,;:"
_SENSITIVITY = re.compile(r"[\d.,]*(?:v|mv|uv|pc|a|ma|counts?|lsb|digits?)")  # of a sensor: ``mV/g``
_PREFIXES = {"k": 1e3, "M": 1e6, "G": 1e9}
_SAMPLES = re.compile(r"(?:hz|hertz|cps|s/s|sa/s|s/sec|sps|samples?(?:/|per)(?:s|sec|second)|1/s|s-1)")


def usual(text: str) -> str:
    """Write a unit as the tables here have it: ``m/s^2``, ``m/s²`` and ``m s-2`` are ``m/s2``."""
    plain = _plain(text)
    known = (*ACCELERATION, *TIME, *ROTATION, *TRAVEL)
    if plain in known:
        return plain
    folded = plain.lower()
    if folded in known:
        return folded
    if folded in _SAME:
        return _SAME[folded]
    if found := _PER_SECOND_TWICE.fullmatch(folded):
        length = _LENGTH.get(found["length"], found["length"])
        if f"{length}/s2" in ACCELERATION:
            return f"{length}/s2"
    return plain


def _plain(text: str) -> str:
    plain = text.strip()
    for sign, letter in (("²", "2"), ("⁻", "-"), ("−", "-"), ("¹", "1"), ("µ", "u"), ("μ", "u"), ("·", "*")):
        plain = plain.replace(sign, letter)
    return plain.replace("**", "").replace("^", "").replace(" ", "").replace("\u00a0", "")


def sampling_factor(unit: str) -> float:
    """Give the hertz in one unit of a sampling rate, ``kHz``, ``kS/s``, ``samples/s``; NaN when not known."""
    plain = _plain(unit)
    if plain in SAMPLING:
        return SAMPLING[plain]
    if plain in ("k", "K"):
        return 1e3
    if _SAMPLES.fullmatch(plain.lower()):
        return 1.0
    words = {"kilo": "k", "mega": "M", "giga": "G"}
    prefix, rest = plain[:1], plain[1:]
    for word, letter in words.items():
        if plain.lower().startswith(word):
            prefix, rest = letter, plain[len(word) :].lstrip("-")
    prefix = {"K": "k", "g": "G"}.get(prefix, prefix)
    return _PREFIXES[prefix] if prefix in _PREFIXES and _SAMPLES.fullmatch(rest.lower()) else math.nan


def split_unit(name: str) -> tuple[str, str]:
    """Split a heading from the unit in brackets behind it: ``ax [m/s²]``, ``ax (g)``; '' without."""
    found = _BRACKETS.match(name.strip())
    return (found[1], found[2]) if found and found[1] else (name.strip(), "")


def unit_in(name: str, known: Mapping[str, float]) -> str:
    """Find a known unit as the last whole word of a name; '' without.

    ``time_ms``, ``speed_rpm``, ``az/mm/s2``, ``X097RPM``. The longest word counts: ``mm/s2`` is no ``m/s2``.
    """
    for place in range(1, len(name)):
        before, rest = name[place - 1], name[place:]
        if before in _BOUNDARY:
            stem = name[: place - 1].strip()
            if usual(rest) in known and not (before == "/" and _is_a_unit_itself(stem)):
                return usual(rest)
        elif len(rest) > 2 and rest.isalpha() and usual(rest) in known and (
            before.isdigit() or (before.islower() and rest[0].isupper())
        ):  # fmt: skip
            return usual(rest)
    return ""


def _is_a_unit_itself(stem: str) -> bool:
    """Tell whether what stands before a slash is a part of the unit: ``mV/g``, ``acc/dm/s2``."""
    last = stem.replace("[", " ").replace("(", " ").split()[-1:] or [""]
    return "/" in last[0] or _SENSITIVITY.fullmatch(last[0].lower()) is not None

"""Units of acceleration, speed and time as people write them."""

from __future__ import annotations

import math
import re

STANDARD_GRAVITY = 9.80665
ACCELERATION = {
    "m/s2": 1.0,
    "g": STANDARD_GRAVITY,
    "mg": 1e-3 * STANDARD_GRAVITY,
    "mm/s2": 1e-3,
    "cm/s2": 1e-2,
    "um/s2": 1e-6,
    "in/s2": 0.0254,
    "ft/s2": 0.3048,
}
"""Metres per second squared in each unit."""
TIME = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0}
"""Seconds in each unit."""
ROTATION = {"rpm": 2.0 * math.pi / 60.0, "Hz": 2.0 * math.pi, "rad/s": 1.0}
"""Radians per second in each unit."""
TRAVEL = {"km/h": 1.0 / 3.6, "m/s": 1.0}
"""Metres per second in each unit of a vehicle's speed."""

_SAME = {
    "gn": "g",
    "gs": "g",
    "g's": "g",
    "grav": "g",
    "milli-g": "mg",
    "ms-2": "m/s2",
    "m*s-2": "m/s2",
    "m.s-2": "m/s2",
    "m/s/s": "m/s2",
    "m/sec2": "m/s2",
    "mps2": "m/s2",
    "m_s2": "m/s2",
    "m_per_s2": "m/s2",
    "mm_s2": "mm/s2",
    "mms-2": "mm/s2",
    "gal": "cm/s2",
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "msec": "ms",
    "usec": "us",
    "nsec": "ns",
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
    "rad/sec": "rad/s",
    "kmh": "km/h",
    "kph": "km/h",
    "km_h": "km/h",
    "mps": "m/s",
    "m_s": "m/s",
}
_BRACKETS = re.compile(r"^(.*?)\s*[\[({]\s*([^\])}]*?)\s*[\])}]\s*$")


def usual(text: str) -> str:
    """Write a unit as the tables here have it: ``m/s^2``, ``m/s²`` and ``m s-2`` are ``m/s2``."""
    plain = (
        text.strip().replace("²", "2").replace("⁻", "-").replace("µ", "u").replace("μ", "u").replace("·", "*")
    )
    plain = plain.replace("**", "").replace("^", "").replace(" ", "")
    known = (*ACCELERATION, *TIME, *ROTATION, *TRAVEL)
    if plain in known:
        return plain
    folded = plain.lower()
    return folded if folded in known else _SAME.get(folded, plain)


def split_unit(name: str) -> tuple[str, str]:
    """Split a heading from the unit in brackets behind it: ``ax [m/s²]``, ``ax (g)``; '' without."""
    found = _BRACKETS.match(name.strip())
    return (found[1], found[2]) if found and found[1] else (name.strip(), "")


def unit_in(name: str, known: dict[str, float]) -> str:
    """Find a known unit at the end of a name: ``time_ms``, ``speed_rpm``, ``X097RPM``; '' without."""
    words = re.split(r"[_ .\-]", name)
    for count in (3, 2, 1):
        if len(words) > count and usual("_".join(words[-count:])) in known:
            return usual("_".join(words[-count:]))
    for unit in known:
        if len(unit) > 2 and name.lower().endswith(unit.lower()):
            return unit
    return ""

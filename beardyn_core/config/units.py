"""Units at the edge: the last words of a key name its unit; and how to come to SI."""

from __future__ import annotations

import math

# Small units are divided by, so that a decimal number stays the nearest one to its decimal SI value.
MM = 1e3
MRAD = 1e3
UM = 1e6
US = 1e6
MM2_PER_S = 1e6

DEG = math.pi / 180.0
KN = 1e3
KMH = 1.0 / 3.6
RPM = 2.0 * math.pi / 60.0
MEGA = 1e6
GIGA = 1e9
ZERO_CELSIUS = 273.15

# Ending of a key -> the unit in words. `per` divides, `_` multiplies; longer endings stand first.
_WORDS = {
    "m_per_s2_per_sqrt_Hz": "metres per second squared per square root of hertz",
    "N_m_s_per_rad": "newton metre seconds per radian",
    "kN_m_per_rad": "kilonewton metres per radian",
    "kg_per_m3": "kilograms per cubic metre",
    "mm2_per_s": "square millimetres per second (centistokes)",
    "W_per_m2_K": "watts per square metre and kelvin",
    "um_per_m_K": "micrometres per metre and kelvin",
    "W_per_m_K": "watts per metre and kelvin",
    "W_per_K": "watts per kelvin",
    "kN_s_per_m": "kilonewton seconds per metre",
    "N_s_per_m": "newton seconds per metre",
    "kN_per_mm": "kilonewtons per millimetre",
    "MN_per_m": "meganewtons per metre",
    "kg_per_m": "kilograms per metre",
    "rad_per_s": "radians per second",
    "m_per_s2": "metres per second squared",
    "m_per_s": "metres per second",
    "per_GPa": "1 per gigapascal",
    "per_K": "1 per kelvin",
    "MN_m2": "meganewton square metres",
    "kg_m2": "kilogram square metres",
    "kN_m": "kilonewton metres",
    "N_m": "newton metres",
    "mrad": "milliradians",
    "kmh": "kilometres per hour",
    "rpm": "revolutions per minute",
    "deg": "degrees",
    "kHz": "kilohertz",
    "GPa": "gigapascals",
    "MPa": "megapascals",
    "MN": "meganewtons",
    "kN": "kilonewtons",
    "kg": "kilograms",
    "um": "micrometres",
    "us": "microseconds",
    "m2": "square metres",
    "Hz": "hertz",
    "mm": "millimetres",
    "C": "degrees Celsius",
    "s": "seconds",
    "t": "tonnes",
    "m": "metres",
}
# Endings that people write for a unit and that no key uses.
_FOREIGN = (
    *(
        "cm",
        "inch",
        "in",
        "ft",
        "nm",
        "K",
        "F",
        "rad",
        "rad_s",
        "mph",
        "m_s",
        "ms",
        "ns",
        "min",
        "h",
    ),
    *("N", "lbf", "Nm", "kNm", "N_per_m", "kN_per_m", "g", "lb", "Pa", "kPa", "bar"),
)
_ENDINGS = tuple(sorted((*_WORDS, *_FOREIGN), key=len, reverse=True))


def unit_of(key: str) -> str | None:
    """Unit in words that a key is given in; ``None`` when its name says none."""
    return next((words for ending, words in _WORDS.items() if key.endswith(f"_{ending}")), None)


def stem_of(key: str) -> str:
    """Key without its unit, foreign units included: ``width_cm`` -> ``width``."""
    return next((key.removesuffix(f"_{ending}") for ending in _ENDINGS if key.endswith(f"_{ending}")), key)

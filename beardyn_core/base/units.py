"""Units at the edge: endings of keys, their words, and the way to SI and back."""

from __future__ import annotations

import math
from typing import NamedTuple

ZERO_CELSIUS = 273.15  # [K]


class Unit(NamedTuple):
    """A unit at the edge and how a number in it comes to SI: ``value * times / over + plus``."""

    words: str
    times: float = 1.0
    over: float = 1.0  # small units are divided by: a decimal number stays the nearest one to its SI value
    plus: float = 0.0

    def to_si(self, value: float) -> float:
        """Convert a number to SI."""
        if self.over != 1.0:
            return value / self.over
        if self.plus != 0.0:
            return value + self.plus
        return value * self.times if self.times != 1.0 else value

    def to_edge(self, value: float, added: float = 0.0) -> float:
        """Convert a number from SI: the shortest decimal of which `to_si` makes it, else the nearest one.

        Parameters
        ----------
        value : float
            SI.
        added : float, optional
            What is added to the number, in SI, before it is the value.
        """
        if not math.isfinite(value) or (self[1:] == (1.0, 1.0, 0.0) and added == 0.0):
            return value
        about = (value - added) * self.over / self.times - self.plus
        for digits in range(1, 18):
            if self.to_si(found := float(f"{about:.{digits}g}")) + added == value:
                return found
        near = (about, math.nextafter(about, math.inf), math.nextafter(about, -math.inf))
        return min(near, key=lambda found: abs(self.to_si(found) + added - value))


STANDARD_GRAVITY = 9.80665  # [m/s^2]

# Ending of a key -> its unit; longer endings stand before the shorter ones that they end in.
UNITS = {
    "m_per_s2_per_sqrt_Hz": Unit("metres per second squared per square root of hertz"),
    "mV_per_m_per_s2": Unit("millivolts per metre per second squared", over=1e3),
    "N_m_s_per_rad": Unit("newton metre seconds per radian"),
    "kN_m_per_rad": Unit("kilonewton metres per radian", times=1e3),
    "kg_per_m3": Unit("kilograms per cubic metre"),
    "mm2_per_s": Unit("square millimetres per second (centistokes)", over=1e6),
    "W_per_m2_K": Unit("watts per square metre and kelvin"),
    "um_per_m_K": Unit("micrometres per metre and kelvin", over=1e6),
    "W_per_m_K": Unit("watts per metre and kelvin"),
    "W_per_K": Unit("watts per kelvin"),
    "kN_s_per_m": Unit("kilonewton seconds per metre", times=1e3),
    "N_s_per_m": Unit("newton seconds per metre"),
    "kN_per_mm": Unit("kilonewtons per millimetre", times=1e6),
    "MN_per_m": Unit("meganewtons per metre", times=1e6),
    "kg_per_m": Unit("kilograms per metre"),
    "rad_per_s": Unit("radians per second"),
    "m_per_s2": Unit("metres per second squared"),
    "m_per_s": Unit("metres per second"),
    "per_GPa": Unit("1 per gigapascal", over=1e9),
    "per_K": Unit("1 per kelvin"),
    "MN_m2": Unit("meganewton square metres", times=1e6),
    "kg_m2": Unit("kilogram square metres"),
    "kN_m": Unit("kilonewton metres", times=1e3),
    "N_m": Unit("newton metres"),
    "mrad": Unit("milliradians", over=1e3),
    "N_s": Unit("newton seconds"),
    "mV": Unit("millivolts", over=1e3),
    "kmh": Unit("kilometres per hour", times=1.0 / 3.6),
    "rpm": Unit("revolutions per minute", times=2.0 * math.pi / 60.0),
    "deg": Unit("degrees", times=math.pi / 180.0),
    "kHz": Unit("kilohertz", times=1e3),
    "GPa": Unit("gigapascals", times=1e9),
    "MPa": Unit("megapascals", times=1e6),
    "MN": Unit("meganewtons", times=1e6),
    "kN": Unit("kilonewtons", times=1e3),
    "kg": Unit("kilograms"),
    "um": Unit("micrometres", over=1e6),
    "us": Unit("microseconds", over=1e6),
    "bar": Unit("bar", times=1e5),
    "m2": Unit("square metres"),
    "Hz": Unit("hertz"),
    "mm": Unit("millimetres", over=1e3),
    "C": Unit("degrees Celsius", plus=ZERO_CELSIUS),
    "s": Unit("seconds"),
    "t": Unit("tonnes", times=1e3),
    "m": Unit("metres"),
}
# Endings that people write for a unit and that no key uses.
_FOREIGN = (
    *("cm", "inch", "in", "ft", "nm", "K", "F", "rad", "rad_s", "mph", "m_s", "ms", "ns", "min", "h"),
    *("N", "lbf", "Nm", "kNm", "N_per_m", "kN_per_m", "g", "lb", "Pa", "kPa"),
)
_ENDINGS = tuple(sorted((*UNITS, *_FOREIGN), key=len, reverse=True))


def unit_of(key: str) -> str | None:
    """Find the unit, in words, that a key is given in; ``None`` when its name says none."""
    return next((unit.words for ending, unit in UNITS.items() if key.endswith(f"_{ending}")), None)


def stem_of(key: str) -> str:
    """Take the unit off a key, foreign units included: ``width_cm`` -> ``width``."""
    return next((key.removesuffix(f"_{ending}") for ending in _ENDINGS if key.endswith(f"_{ending}")), key)

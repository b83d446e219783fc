"""Numbers of options: in the units of scene files, or in the unit that is written behind them."""

from __future__ import annotations

import math
import re

from beardyn_core.base.errors import InputError

# dimension -> unit -> factor and divisor to SI, as a division by 1000 keeps the number nearest to the decimal
# one; the first is the unit of a number without one
_UNITS = {
    "force": {"kN": (1e3, 1.0), "N": (1.0, 1.0), "MN": (1e6, 1.0)},
    "length": {"mm": (1.0, 1e3), "um": (1.0, 1e6), "µm": (1.0, 1e6), "m": (1.0, 1.0)},
    "rotation": {"rpm": (2.0 * math.pi / 60.0, 1.0), "Hz": (2.0 * math.pi, 1.0), "rad/s": (1.0, 1.0)},
}
_NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_WRITTEN = re.compile(rf"([-+]?{_NUMBER})\s*([A-Za-zµ/]*)")
NEGATIVE_QUANTITY = re.compile(rf"-{_NUMBER}\s*[A-Za-zµ/]*$")
"""What argparse has to take for a negative number instead of an option."""

MOST_FORCE_KN = 2000.0
LEAST_LENGTH_MM = 1e-3


def read_quantity(option: str, text: str, dimension: str) -> float:
    """Read a number of an option, in SI: ``80``, ``80kN`` and ``80000N`` are the same force.

    The dimension is ``force`` (kN without a unit), ``length`` (mm) or ``rotation`` (rpm).

    Raises
    ------
    InputError
        When it is not a number, its unit is another, or it was probably meant in SI.
    """
    units = _UNITS[dimension]
    usual = next(iter(units))
    match = _WRITTEN.fullmatch(text.strip())
    if match is None or (match[2] and match[2] not in units):
        raise InputError(
            f"{option} is {text!r}; allowed is a number in {usual}, or one with its unit: {', '.join(units)}"
        )
    number, unit = float(match[1]), match[2]
    if not unit and dimension == "force" and abs(number) > MOST_FORCE_KN:
        raise InputError(
            f"{option} is {number:g} kN, more than an axlebox bearing carries ({MOST_FORCE_KN:g} kN); were "
            f"newtons meant? Then write {number / 1e3:g}, or {text.strip()}N"
        )
    if not unit and dimension == "length" and 0.0 < abs(number) < LEAST_LENGTH_MM:
        raise InputError(
            f"{option} is {number:g} mm, less than a micrometre; were metres meant? Then write "
            f"{number * 1e3:g}, or {text.strip()}m"
        )
    factor, divisor = units[unit or usual]
    return number * factor / divisor

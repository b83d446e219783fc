"""What would explain a comb: this bearing at another speed, or another bearing at this one."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Annotated as A
from typing import NamedTuple

from beardyn_core.monitor.chain.fault_lines import Pattern, fault_patterns

PART_NAMES = {"cup": "outer ring (cup)", "cone": "inner ring (cone)", "roller": "rolling elements"}
_SLIP = 0.01  # within which an order is that of a part, [-]
_RPM = 60.0  # of a hertz
_COMMON = ("6203", "6205", "NICE")  # with the whole catalogue some part has any order, and nothing is said


class Explanation(NamedTuple):
    """A part of a bearing that has the order of a comb."""

    part: A[str, "``cup``, ``cone`` or ``roller``"]
    speed: A[float, "of the shaft at which it has, [Hz]"]
    bearing: A[str, "a shipped one; '' for the bearing that is monitored"] = ""

    def sentence(self, stated: float) -> str:
        """Write it next to the stated speed, [Hz]."""
        part = f"the {PART_NAMES[self.part]}"
        if self.bearing:
            return f"{part} of {self.bearing} at this speed"
        change = 100.0 * (self.speed / stated - 1.0)
        return f"{part} of this bearing at {_RPM * self.speed:.5g} rpm ({change:+.1f} %)"


def explanations(
    order: float, patterns: Sequence[Pattern], speed: float, doubt: float, likely: str = ""
) -> tuple[Explanation, ...]:
    """List what would explain a comb: the bearing at other speeds, then shipped bearings, the nearest first.

    Parameters
    ----------
    order : float
        Of the comb at the stated speed, [-].
    patterns : sequence of Pattern
        Of the bearing that is monitored.
    speed : float
        Stated, of the shaft, [Hz].
    doubt : float
        Largest error of the stated speed, [-].
    likely : str
        Part whose sidebands the comb has; it comes first.
    """
    own = [Explanation(each.fault, speed * order / each.order) for each in patterns]
    near = [each for each in own if abs(speed / each.speed - 1.0) <= doubt + _SLIP]
    orders = [each.order for each in patterns]
    others = [
        (abs(pattern.order / order - 1.0), Explanation(pattern.fault, speed, name))
        for name, shipped in _shipped_patterns()
        if [each.order for each in shipped] != orders
        for pattern in shipped
    ]
    fitting = sorted(each for each in others if each[0] <= _SLIP)
    return (
        *sorted(near, key=lambda each: (each.part != likely, abs(each.speed - speed))),
        *(each for _, each in fitting),
    )


@cache
def _shipped_patterns() -> tuple[tuple[str, tuple[Pattern, ...]], ...]:
    from beardyn_core.config import load_plate, shipped_names
    from beardyn_core.config.catalogue import catalogue

    there = {entry.name for entry in catalogue()}  # a folder of configuration of one's own may have none
    names = (*(each for each in _COMMON if each in there), *shipped_names("bearings"))
    return tuple((name, fault_patterns(load_plate(name).frequencies)) for name in names)

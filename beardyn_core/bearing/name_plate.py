"""Data of any rolling bearing: all that its fault frequencies need, inner dimensions or maker's factors."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from math import isnan, nan
from typing import TYPE_CHECKING
from typing import Annotated as A

from beardyn_core.base.edge import INTERNAL, At, refuse

if TYPE_CHECKING:
    from beardyn_core.bearing.factors import Derived, Factors
    from beardyn_core.bearing.kinematics import FaultFrequencies
    from beardyn_core.bearing.roller_bearing import RollerBearing

_INNER = ("roller_count", "roller_diameter_mm", "pitch_diameter_mm")
_BARRELS = "spherical"


@dataclass(frozen=True, kw_only=True)
class NamePlate:
    """Rolling elements of one row of a ball or roller bearing, its outer ring at rest.

    Of a bearing with several rows they are those of one row. Inner dimensions (number, both diameters,
    contact angle), maker's factors, or both; what is not known is NaN, a number of rolling elements 0.
    `kind` is that of a whole bearing, as in `roller_bearing.KINDS`; data alone do not state it, and then it
    is empty.
    """

    name: A[str, At(longest=80), "of the bearing"] = "bearing data"
    description: A[str, "what it is, in a few words"] = ""
    roller_count: A[int, At(ge=3, le=200, absent=True), "balls or rollers of one row"] = 0
    roller_diameter: A[float, At("mm", gt=0.0, absent=True), "of a ball, or of a roller at mid-length"] = nan
    pitch_diameter: A[float, At("mm", gt=0.0, absent=True), "through the centres of the rolling elements"] = (
        nan
    )
    contact_angle: A[
        float,
        At("deg", ge=0.0, lt=90.0, absent=True),
        "contact angle of a ball bearing, angle between roller axis and bearing axis of a roller bearing; "
        "default 0 with the diameters, else not known",
    ] = nan
    bpfo: A[
        float,
        At(absent=True),
        "maker's factor of the outer ring: passes of rolling elements in a turn of the shaft",
    ] = nan
    bpfi: A[float, At(absent=True), "the same of the inner ring"] = nan
    bsf: A[
        float,
        At(absent=True),
        "maker's factor of a rolling element: its turns about itself in a turn of the shaft; some makers "
        "list twice that",
    ] = nan
    ftf: A[float, At(absent=True), "maker's factor of the cage: its turns in a turn of the shaft"] = nan
    kind: A[str, INTERNAL] = ""
    sources: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if isnan(self.contact_angle) and not isnan(self.roller_diameter):
            object.__setattr__(self, "contact_angle", 0.0)
        refuse(self, "bearing data")
        if not self.roller_count:
            object.__setattr__(self, "roller_count", self._derived.roller_count)

    def rules(self) -> Iterator[str]:
        """Check that the rolling elements fit on their circle, and factors each other."""
        from beardyn_core.bearing.factors import contradictions

        known = self._factors
        if not known.given():
            values = (self.roller_count or nan, self.roller_diameter, self.pitch_diameter)
            if absent := [key for key, value in zip(_INNER, values, strict=True) if isnan(value)]:
                yield from (f"{key} is missing" for key in absent)
                return
        elif isnan(self.roller_diameter) != isnan(self.pitch_diameter):
            given, other = _INNER[1:] if isnan(self.pitch_diameter) else _INNER[:0:-1]
            yield f"{given} is given without {other}; give both or none"
        if not isnan(self.roller_diameter + self.pitch_diameter):
            yield from self._misfits()
        wrong = list(contradictions(known))
        yield from wrong
        if not wrong and known.given() and isnan(self.frequencies.bpfo) and isnan(self.frequencies.bpfi):
            yield (
                f"neither bpfo nor bpfi follows from {' and '.join(known.given())}; give one of them, or "
                "roller_count with ftf to three digits"
            )

    def _misfits(self) -> Iterator[str]:
        if self.pitch_diameter <= self.roller_diameter:
            yield (
                f"pitch_diameter_mm is {1e3 * self.pitch_diameter:g}; it must be above roller_diameter_mm, "
                f"{1e3 * self.roller_diameter:g}"
            )
            return
        room = math.pi / math.asin(self.roller_diameter / self.pitch_diameter)
        if self.roller_count > room * (1.0 + 1e-9):
            yield (
                f"roller_count is {self.roller_count}; {math.floor(room)} rolling elements of "
                f"{1e3 * self.roller_diameter:g} mm fit on a circle of {1e3 * self.pitch_diameter:g} mm"
            )

    @classmethod
    def of(cls, bearing: RollerBearing) -> NamePlate:
        """Take from a whole bearing what its fault frequencies need."""
        return cls(
            name=bearing.name,
            description=bearing.description,
            roller_count=bearing.roller_count,
            roller_diameter=bearing.roller_diameter,
            pitch_diameter=bearing.pitch_diameter,
            contact_angle=bearing.contact_angle,
            kind=bearing.kind,
        )

    @property
    def has_barrels(self) -> bool:
        """Whether the rollers are known to be barrels."""
        return self.kind == _BARRELS

    @property
    def has_dimensions(self) -> bool:
        """Whether number and diameters of the rolling elements are known."""
        return bool(self.roller_count) and not isnan(self.roller_diameter + self.pitch_diameter)

    @property
    def frequencies(self) -> FaultFrequencies:
        """Fault frequencies of one row per shaft revolution; NaN what is not known and does not follow."""
        from beardyn_core.bearing.kinematics import frequencies  # not for who declares an option

        if self.has_dimensions and not self._factors.given():
            return frequencies(
                self.roller_count, self.pitch_diameter, self.roller_diameter, self.contact_angle
            )
        return self._derived.frequencies

    @property
    def cannot_tell(self) -> dict[str, str]:
        """Parts (``cup``, ``cone``, ``roller``) whose order is not known, and why it does not follow."""
        from beardyn_core.bearing.factors import PARTS

        missing = self._derived.missing
        return {
            part: "; ".join(f"{name}: {missing[name]}" for name in names if name in missing)
            for part, names in PARTS.items()
            if any(name in missing for name in names)
        }

    @property
    def _factors(self) -> Factors:
        from beardyn_core.bearing.factors import Factors

        return Factors(
            self.bpfo,
            self.bpfi,
            self.bsf,
            self.ftf,
            self.roller_count,
            self.roller_diameter / self.pitch_diameter,
            self.contact_angle,
        )

    @property
    def _derived(self) -> Derived:
        from beardyn_core.bearing.factors import derive

        return derive(self._factors)

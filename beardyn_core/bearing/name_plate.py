"""Data of any rolling bearing, as on its name plate: all that its fault frequencies need."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING
from typing import Annotated as A

from beardyn_core.base.edge import At, refuse

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.kinematics import FaultFrequencies


@dataclass(frozen=True, kw_only=True)
class NamePlate:
    """Rolling elements of one row of a ball or roller bearing, its outer ring at rest.

    Of a bearing with several rows they are those of one row.
    """

    name: A[str, At(longest=80), "of the bearing"] = "bearing data"
    description: A[str, "what it is, in a few words"] = ""
    roller_count: A[int, At(ge=3, le=200), "balls or rollers of one row"]
    roller_diameter: A[float, At("mm", gt=0.0), "of a ball, or of a roller at mid-length"]
    pitch_diameter: A[float, At("mm", gt=0.0), "through the centres of the rolling elements"]
    contact_angle: A[
        float,
        At("deg", ge=0.0, lt=90.0),
        "contact angle of a ball bearing, angle between roller axis and bearing axis of a roller bearing",
    ] = 0.0
    sources: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        refuse(self, "bearing data")

    def rules(self) -> Iterator[str]:
        """Check that the rolling elements fit on their circle."""
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
    def of(cls, bearing: Bearing) -> NamePlate:
        """Take from a whole bearing what its fault frequencies need."""
        return cls(
            name=bearing.name,
            description=bearing.description,
            roller_count=bearing.roller_count,
            roller_diameter=bearing.roller_diameter,
            pitch_diameter=bearing.pitch_diameter,
            contact_angle=bearing.contact_angle,
        )

    @property
    def frequencies(self) -> FaultFrequencies:
        """Fault frequencies of one row per shaft revolution."""
        from beardyn_core.bearing.kinematics import frequencies  # not for who declares an option

        return frequencies(self.roller_count, self.pitch_diameter, self.roller_diameter, self.contact_angle)

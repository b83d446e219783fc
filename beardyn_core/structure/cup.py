"""The cup that the modes of a box are made with: only a bearing with the same one goes into the box."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Annotated as A

from beardyn_core.bearing.roller_bearing import RollerBearing

_SAME = 1e-4  # [m]; tables have five digits


@dataclass(frozen=True)
class Cup:
    """What of a bearing decides how the box around its cup bends, and where its rollers press."""

    bearing: A[str, "name of the bearing"]
    outer_diameter: A[float, "[m]"]
    width: A[float, "[m]"]
    raceway_diameter: A[float, "mean one of a row, [m]"]
    row_spacing: A[float, "between the middles of the rows, [m]"]

    @classmethod
    def of(cls, bearing: RollerBearing) -> Cup:
        """Take the cup of a bearing."""
        return cls(
            bearing.name,
            bearing.outer_diameter,
            bearing.width,
            2.0 * bearing.cup_radius,
            bearing.row_spacing,
        )

    def differences(self, bearing: RollerBearing) -> Iterator[str]:
        """Find where the cup of a bearing is not this one, in millimetres; names may differ."""
        other = Cup.of(bearing)
        for dimension in DIMENSIONS:
            mine, its = getattr(self, dimension), getattr(other, dimension)
            if abs(mine - its) > _SAME:
                yield f"{dimension} {1e3 * mine:.6g} mm, that of {other.bearing} {1e3 * its:.6g} mm"


DIMENSIONS = tuple(field.name for field in fields(Cup) if field.name != "bearing")

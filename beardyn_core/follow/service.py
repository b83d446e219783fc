"""What a forecast must know of the service of a bearing."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Annotated as A

from beardyn_core.base.edge import At, refuse


@dataclass(frozen=True)
class Service:
    """What a forecast must know: how far the bearing has run, and what it may not come to."""

    mileage: A[float, At(ge=0.0, le=1e11), "of the bearing so far, [m]"] = 0.0
    wheel_diameter: A[float, At("mm", gt=0.0, ge=300.0, le=1500.0), "running diameter"] = 0.92
    widest: A[
        float | None,
        At("mm", gt=0.0, le=200.0),
        "width of a spall at which the bearing is taken out; default 20 mm, or the distance of two rollers "
        "where that is less",
    ] = None

    def __post_init__(self) -> None:
        refuse(self, "service")

    @property
    def revolutions(self) -> float:
        """Revolutions of the shaft so far."""
        return self.mileage / (pi * self.wheel_diameter)

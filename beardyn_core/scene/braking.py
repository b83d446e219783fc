"""Brake and drive of an axle: forces when the vehicle slows down or speeds up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, refuse

BRAKES = ("disc", "block", "clasp")


@dataclass(frozen=True)
class Braking:
    """Brake of an axle; how much it must brake follows from the speed profile."""

    brake: A[str, At(one_of=BRAKES), "on the axle, one block a wheel, or two blocks whose forces cancel"] = (
        "disc"
    )
    share: A[float, At(ge=0.0, le=10.0), "over what would brake this axle's own part of the vehicle"] = 1.0
    friction: A[float, At(ge=0.05, le=0.6), "of block on wheel"] = 0.25
    disc_radius: A[float, At("mm", gt=0.0, ge=100.0, le=600.0), "at which the pads act"] = 0.25
    ahead: A[bool, "whether caliper or block are ahead of the axle, at +x"] = True

    def __post_init__(self) -> None:
        refuse(self, "braking")


@dataclass(frozen=True)
class Starting:
    """Drive of an axle."""

    share: A[
        float,
        At(ge=0.0, le=20.0),
        "over what would speed up this axle's own part: 2 where half of the axles drive",
    ] = 1.0

    def __post_init__(self) -> None:
        refuse(self, "starting")

"""A box in proportion to the bearing that it carries: one description for every size of bearing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.edge import At, Vector, refuse
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.structure.box import Box, Seat


@dataclass(frozen=True)
class FittedBox:
    """An axlebox like another one, with sizes in proportion to the bearing that it carries."""

    name: A[str, At(longest=80), "of the box"]
    like: A[str, At(longest=200), "shipped box or path of its file, in figures"]
    bearing: A[str, At(longest=200), "shipped bearing or path of its file, whose cup the bore holds"]
    description: A[str, At(usual=""), "what it is; that of the other box when left out"] = ""

    def __post_init__(self) -> None:
        refuse(self, f"box {self.name!r}")


def fit_box(box: Box, own: RollerBearing, carried: RollerBearing) -> Box:
    """Scale a box to another bearing: along x and z with the outer diameter, along y with the width.

    Parameters
    ----------
    own : RollerBearing
        That the box has been drawn for.
    carried : RollerBearing
        That it is to carry; `Box.bearing` stays as it is.
    """
    across = carried.outer_diameter / own.outer_diameter
    along = carried.width / own.width
    scale = np.array([across, along, across])

    def vector(value: Vector) -> Vector:
        x, y, z = map(float, scale * value)
        return x, y, z

    def seats(every: tuple[Seat, ...]) -> tuple[Seat, ...]:
        return tuple(
            replace(seat, position=vector(seat.position), radius=across * seat.radius) for seat in every
        )

    return replace(
        box,
        outer_diameter=across * box.outer_diameter,
        length=along * box.length,
        blocks=tuple(
            replace(block, centre=vector(block.centre), size=vector(block.size)) for block in box.blocks
        ),
        discs=tuple(
            replace(disc, thickness=along * disc.thickness, hole_diameter=across * disc.hole_diameter)
            for disc in box.discs
        ),
        sensors=seats(box.sensors),
        suspension=seats(box.suspension),
    )

"""The axleboxes of a wheelset, a bogie, a car or a train: their names, and where their wheels run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.edge import At, Problem

SIDES = ("left", "right")
AXLES_OF_A_CAR = 4


@dataclass(frozen=True)
class Box:
    """One axlebox of several."""

    name: A[str, "``axle_<number>_<side>``: its namespace in a recording"]
    axle: A[int, "1 leads"]
    side: A[str, "``left`` or ``right``, looking forwards"]


@dataclass(frozen=True)
class Axleboxes:
    """All axleboxes of a wheelset, a bogie, a car or a train, computed at once; left out: one.

    Axle 1 leads; a box is called axle_<number>_<left or right>. All run over the same track one after the
    other; left and right wheels have a rail each. Each has a bearing of its own lot (`scatter`) and a sensor
    of its own noise.
    """

    axles: A[
        int,
        At(ge=1, le=400, required=True),
        "two axleboxes each: 1 is a wheelset, 2 a bogie, 4 a car, each further car has 4 more",
    ] = 1
    axle_distance: A[float, At("m", ge=0.0, le=5.0), "between the axles of a bogie"] = 2.5
    bogie_distance: A[float, At("m", ge=0.0, le=30.0), "between the centres of the bogies of a car"] = 17.5
    car_distance: A[float, At("m", ge=0.0, le=60.0), "between the middles of neighbouring cars"] = 25.0
    faulty: A[
        tuple[str, ...],
        "boxes that have the defects and missing rollers of the scene and, on their wheels, the "
        "wheel_defects; the others are healthy",
    ] = ("axle_1_left",)
    pictures: A[
        bool, "record bodies and contacts of every box, which ``view`` draws: about half of the file"
    ] = True

    @property
    def boxes(self) -> tuple[Box, ...]:
        """All of them, from the first axle to the last, left before right."""
        axles = range(1, self.axles + 1)
        return tuple(Box(f"axle_{axle}_{side}", axle, side) for axle in axles for side in SIDES)

    def behind(self, box: Box) -> float:
        """Compute how far the wheel of a box runs behind the first, [m]."""
        car, within = divmod(box.axle - 1, AXLES_OF_A_CAR)
        bogie, wheel = divmod(within, 2)
        return car * self.car_distance + bogie * self.bogie_distance + wheel * self.axle_distance

    def rules(self) -> Iterator[Problem]:
        """Find names in `faulty` that no box has, or that come twice."""
        names = [box.name for box in self.boxes]
        for index, name in enumerate(self.faulty):
            if name not in names:
                yield Problem(f"faulty[{index}] is {name!r}; the boxes are {names[0]} to {names[-1]}")
            elif name in self.faulty[:index]:
                yield Problem(f"faulty[{index}] is {name!r}, given twice; name each box once")

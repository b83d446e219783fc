"""A run from stop to stop as a speed profile."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, refuse
from beardyn_core.scene.speed import Profile


@dataclass(frozen=True)
class Stop:
    """One stop of a timetable."""

    distance: A[float, At("m", gt=0.0, ge=1.0, le=1e6), "from the stop before"]
    wait: A[float, At("s", gt=0.0, ge=0.5, le=3600.0), "standing time there"] = 20.0
    top_speed: A[float, At("kmh", gt=0.0, ge=1.8, le=400.0, required=True), "on the way to it"] = 100.0 / 3.6


@dataclass(frozen=True)
class Timetable:
    """Stops after each other; the run begins standing."""

    stops: A[tuple[Stop, ...], At(size=(1, None)), "one after the other"]
    acceleration: A[float, At("m_per_s2", gt=0.0, ge=0.01, le=3.0), "from each stop"] = 0.5
    deceleration: A[float, At("m_per_s2", gt=0.0, ge=0.01, le=3.0), "to each stop"] = 0.6
    wait: A[float, At("s", gt=0.0, ge=0.5, le=3600.0), "before the first departure"] = 1.0

    def __post_init__(self) -> None:
        refuse(self, "timetable")

    def speed_profile(self) -> Profile:
        """Compute points of time and speed: speed up, hold the top speed where there is room, brake.

        Returns
        -------
        tuple of (time, speed) pairs, [s], [m/s]
        """
        time = self.wait
        points = [(0.0, 0.0), (time, 0.0)]
        for stop in self.stops:
            # way of speeding up and braking by each unit of speed squared
            way = 0.5 / self.acceleration + 0.5 / self.deceleration
            top = min(stop.top_speed, math.sqrt(stop.distance / way))
            time += top / self.acceleration
            points.append((time, top))
            held = (stop.distance - way * top**2) / top
            if held > 1e-6:
                time += held
                points.append((time, top))
            time += top / self.deceleration
            points.append((time, 0.0))
            time += stop.wait
            points.append((time, 0.0))
        return tuple(points)

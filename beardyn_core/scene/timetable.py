"""A run from stop to stop as a speed profile."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import outside, refuse
from beardyn_core.scene.speed import Profile


@dataclass(frozen=True)
class Stop:
    """One stop of a timetable.

    Parameters
    ----------
    distance : float
        From the stop before, [m].
    wait : float
        Standing time there, [s].
    top_speed : float
        On the way to it, [m/s].
    """

    distance: float
    wait: float
    top_speed: float


@dataclass(frozen=True)
class Timetable:
    """Stops after each other; the run begins standing.

    Parameters
    ----------
    stops : tuple of Stop
    acceleration, deceleration : float
        [m/s^2].
    wait : float
        Standing time before the first departure, [s].
    """

    stops: tuple[Stop, ...]
    acceleration: float = 0.5
    deceleration: float = 0.6
    wait: float = 1.0

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "timetable"
        if not self.stops:
            yield f"{owner}: stops is empty; give at least one"
        yield from outside(owner, "acceleration", self.acceleration, 0.01, 3.0, "m/s^2")
        yield from outside(owner, "deceleration", self.deceleration, 0.01, 3.0, "m/s^2")
        yield from outside(owner, "wait", self.wait, 0.5, 3600.0, "s")
        for index, stop in enumerate(self.stops):
            name = f"{owner}, stop {index}"
            yield from outside(name, "distance", stop.distance, 1.0, 1e6, "m")
            yield from outside(name, "wait", stop.wait, 0.5, 3600.0, "s")
            yield from outside(name, "top_speed", stop.top_speed, 0.5, 400 / 3.6, "m/s")

    def speed_profile(self) -> Profile:
        """Points of time and speed: speed up, hold the top speed where the way is long enough, brake.

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

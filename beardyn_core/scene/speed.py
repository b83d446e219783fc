"""Speed profiles: points of time and speed, linear in between and held outside; runs from stop to stop."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.edge import At, refuse


class SpeedPoint(NamedTuple):
    """Speed of the vehicle at one time."""

    time: A[float, At("s", ge=0.0), "from the start of the run"]
    speed: A[float, At("kmh", ge=-400.0, le=400.0), "negative when it runs backwards"]


Profile = tuple[tuple[float, float], ...]
POINTS = At(entry=SpeedPoint)


def not_ascending(key: str, times: list[float]) -> Iterator[str]:
    """Report times of a list that do not increase."""
    for index, (one, two) in enumerate(pairwise(times), start=1):
        if not two > one:
            yield f"{key}[{index}].time_s is {two:g}; it must be greater than the {one:g} before it"


def speed_at(profile: Profile, time: Float) -> Float:
    """Find the speed [m/s] of a profile at times [s]."""
    points = np.asarray(profile, dtype=np.float64)
    return np.interp(time, points[:, 0], points[:, 1])


def distance_at(profile: Profile, time: Float) -> Float:
    """Find the distance [m] travelled from time 0 to times [s], exact for the piecewise linear speed."""
    time = np.asarray(time, dtype=np.float64)
    inner = [moment for moment, _ in profile if moment > 0.0]
    knots = np.array([0.0, *inner])
    speeds = speed_at(profile, knots)
    at_knot = np.concatenate(([0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(knots))))
    last = np.searchsorted(knots, time, side="right") - 1
    # mean of the speed at both ends of the last stretch, times its duration
    return at_knot[last] + 0.5 * (speeds[last] + speed_at(profile, time)) * (time - knots[last])


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
        """Compute points of time and speed: speed up, hold the top speed where there is room, brake."""
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

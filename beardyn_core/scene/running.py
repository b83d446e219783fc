"""What a run meets besides straight track at constant speed: speed profiles, curves, brake and drive."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At, refuse


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


HANDS = ("left", "right")
BRAKES = ("disc", "block", "clasp")


@dataclass(frozen=True)
class Curve:
    """A circular arc between two clothoids, on which curvature and cant grow linearly."""

    radius: A[float, At("m", gt=0.0, ge=50.0, le=1e5), "of the arc"]
    cant: A[float, At("mm", ge=-50.0, le=250.0), "the outer rail above the inner one"] = 0.0
    begin: A[
        float, At("m", ge=0.0, le=1e6), "where the first transition begins, from the start of the run"
    ] = 0.0
    length: A[float, At("m", gt=0.0, ge=2.0, le=1e5, required=True), "with both transitions"] = 100.0
    transition: A[float, At("m", gt=0.0, ge=1.0, le=1e4, required=True), "length of each"] = 30.0
    hand: A[
        str, At(one_of=HANDS), "where it turns; a left axlebox is on the inner rail of a left-hand curve"
    ] = "left"

    def __post_init__(self) -> None:
        refuse(self, "curve")

    def rules(self) -> Iterator[str]:
        """Find transitions that the curve cannot hold."""
        if 2.0 * self.transition > self.length:
            yield (
                f"transition_m is {self.transition:g}; it must be at most half of length_m, "
                f"{0.5 * self.length:g}"
            )

    @property
    def end(self) -> float:
        """Where the second transition ends, [m]."""
        return self.begin + self.length


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

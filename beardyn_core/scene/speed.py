"""Speed profiles: points of time and speed, linear in between, held before and after."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.edge import At

Float = NDArray[np.float64]


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
    """Find the speed of the vehicle.

    Parameters
    ----------
    profile : tuple of (time, speed) pairs, [s], [m/s]
    time : float64 array, [s]

    Returns
    -------
    float64 array, [m/s]
    """
    points = np.asarray(profile, dtype=np.float64)
    return np.interp(time, points[:, 0], points[:, 1])


def distance_at(profile: Profile, time: Float) -> Float:
    """Find the distance travelled since time 0, exact for the piecewise linear speed.

    Parameters
    ----------
    profile : tuple of (time, speed) pairs, [s], [m/s]
    time : float64 array, not negative, [s]

    Returns
    -------
    float64 array, [m]
    """
    time = np.asarray(time, dtype=np.float64)
    inner = [moment for moment, _ in profile if moment > 0.0]
    knots = np.array([0.0, *inner])
    speeds = speed_at(profile, knots)
    at_knot = np.concatenate(([0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(knots))))
    last = np.searchsorted(knots, time, side="right") - 1
    # mean of the speed at both ends of the last stretch, times its duration
    return at_knot[last] + 0.5 * (speeds[last] + speed_at(profile, time)) * (time - knots[last])

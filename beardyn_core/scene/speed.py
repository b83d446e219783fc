"""Speed profiles: points of time and speed, linear in between, held before and after."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Profile = tuple[tuple[float, float], ...]
Float = NDArray[np.float64]


def speed_at(profile: Profile, time: Float) -> Float:
    """Vehicle speed.

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
    """Distance travelled since time 0, exact for the piecewise linear speed.

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

"""Sensors on the axlebox."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Accelerometer:
    """A three-axis accelerometer screwed to the axlebox.

    Parameters
    ----------
    name : str
    position : tuple of 3 floats
        From the bearing centre, world axes, [m].
    noise_density : float
        White noise, one-sided, [m/s^2/sqrt(Hz)].
    range : float
        Clipping level of each axis, [m/s^2].
    """

    name: str = "axlebox_top"
    position: tuple[float, float, float] = (0.0, 0.0, 0.17)
    noise_density: float = 0.02
    range: float = 5000.0

"""Height that defects of wheel and rail add to the irregularity, over the distance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.excitation import (
    Corrugation,
    DippedJoint,
    RailDefect,
    WheelDefect,
    WheelFlat,
    WheelPolygon,
)

Float = NDArray[np.float64]


def wheel_height(defects: tuple[WheelDefect, ...], wheel_radius: float, position: Float) -> Float:
    """What the wheel's own shape lifts its centre, rolling without slip.

    Flats that overlap do not add: a spot is as deep as the deepest.

    Parameters
    ----------
    defects : tuple of WheelDefect
    wheel_radius : float
        [m].
    position : float64 array
        Distance rolled since the start of the run, [m].

    Returns
    -------
    float64 array
        Upwards, at the wheel centre on a rigid rail, [m].

    Notes
    -----
    The contact is a point: waves and flats shorter than some 20 mm are in truth smoothed by the
    contact patch, about 12 mm long.
    """
    flats = np.zeros_like(position)
    waves = np.zeros_like(position)
    for defect in defects:
        if isinstance(defect, WheelFlat):
            flats = np.minimum(flats, _flat(defect, wheel_radius, position))
        else:
            waves += _polygon(defect, wheel_radius, position)
    return flats + waves


def rail_height(defects: tuple[RailDefect, ...], position: Float) -> Float:
    """Height of the rail from its own defects.

    Parameters
    ----------
    defects : tuple of RailDefect
    position : float64 array
        Along the track from the start of the run, [m].

    Returns
    -------
    float64 array
        Upwards, [m].
    """
    height = np.zeros_like(position)
    for defect in defects:
        height += _dip(defect, position) if isinstance(defect, DippedJoint) else _waves(defect, position)
    return height


def _flat(flat: WheelFlat, wheel_radius: float, position: Float) -> Float:
    # the point at the azimuth a comes down to the rail after the angle pi - a
    middle = (np.pi - flat.azimuth) * wheel_radius
    apart = _apart(position - middle, 2.0 * np.pi * wheel_radius)
    depth = flat.depth_on(wheel_radius)
    if flat.shape == "fresh":
        return -depth * _cusp(apart, flat.length)
    within = np.minimum(apart / flat.length, 0.5)
    return -0.5 * depth * (1.0 + np.cos(2.0 * np.pi * within))


def _polygon(polygon: WheelPolygon, wheel_radius: float, position: Float) -> Float:
    azimuth_on_rail = np.pi - position / wheel_radius
    return polygon.amplitude * np.cos(polygon.order * (azimuth_on_rail - polygon.azimuth))


def _dip(joint: DippedJoint, position: Float) -> Float:
    apart = position - joint.position
    if joint.spacing is None:
        return -joint.depth * _cusp(np.abs(apart), joint.length)
    # the rail before the first joint is sound
    met = apart > -0.5 * joint.spacing
    return np.where(met, -joint.depth * _cusp(_apart(apart, joint.spacing), joint.length), 0.0)


def _waves(corrugation: Corrugation, position: Float) -> Float:
    inside = np.minimum(position - corrugation.begin, corrugation.end - position)
    share = np.clip(inside / (2.0 * corrugation.wavelength), 0.0, 1.0)
    envelope = 0.5 - 0.5 * np.cos(np.pi * share)
    phase = 2.0 * np.pi * (position - corrugation.begin) / corrugation.wavelength
    return corrugation.amplitude * envelope * np.sin(phase)


def _apart(distance: Float, period: float) -> Float:
    """Distance to the nearest of places that come back with the period, not negative."""
    return np.abs(distance - period * np.round(distance / period))


def _cusp(apart: Float, length: float) -> Float:
    """Two parabolas that fall from 0 at both ends to -1, and meet there in a kink; here upwards."""
    return np.maximum(1.0 - 2.0 * apart / length, 0.0) ** 2

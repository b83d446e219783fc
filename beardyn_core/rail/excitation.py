"""Height that defects of wheel and rail add to the irregularity, over the distance."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.rail.patch import wave_gain
from beardyn_core.scene import excitation

_STREAM = 0x7768656C  # keeps the wheel's random numbers apart from those of rail and sensors


def wheel_height(
    defects: tuple[excitation.WheelDefect, ...], wheel_radius: float, position: Float, patch: float = 0.0
) -> Float:
    """Compute how far the wheel's own shape lifts its centre on a rigid rail, rolling without slip, [m].

    Flats that overlap do not add: a spot is as deep as the deepest. `position` is the distance rolled since
    the start of the run, `patch` the length of the contact over which waves are smoothed, 0 a point, [m].

    Notes
    -----
    A flat meets the rail in a point; one shorter than some 20 mm is in truth smoothed by the contact
    patch, about 12 mm long, as waves are here.
    """
    flats = np.zeros_like(position)
    waves = np.zeros_like(position)
    for defect in defects:
        if isinstance(defect, excitation.WheelFlat):
            flats = np.minimum(flats, _flat(defect, wheel_radius, position))
        else:
            for polygon in waves_of(defect):
                gain = wave_gain(polygon.order / wheel_radius, patch)
                waves += gain * _polygon(polygon, wheel_radius, position)
    return flats + waves


def waves_of(
    defect: excitation.WheelPolygon | excitation.WheelOutOfRound,
) -> tuple[excitation.WheelPolygon, ...]:
    """Split the shape of a wheel into single waves."""
    if isinstance(defect, excitation.WheelPolygon):
        return (defect,)
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence([_STREAM, defect.seed])))
    azimuths = random.uniform(0.0, 2.0 * np.pi, len(defect.amplitudes))
    return tuple(
        excitation.WheelPolygon(order, amplitude, float(azimuth))
        for order, (amplitude, azimuth) in enumerate(zip(defect.amplitudes, azimuths, strict=True), start=1)
    )


def rail_height(defects: tuple[excitation.RailDefect, ...], position: Float, patch: float = 0.0) -> Float:
    """Compute the height of the rail from its own defects, upwards, [m].

    `position` is the place along the track from the start of the run, `patch` the length of the contact over
    which corrugation is smoothed, 0 a point, [m].
    """
    height = np.zeros_like(position)
    for defect in defects:
        if isinstance(defect, excitation.DippedJoint):
            height += _dip(defect, position)
        elif isinstance(defect, excitation.DippedWeld):
            height += _weld(defect, position)
        elif isinstance(defect, excitation.Crossing):
            height += _crossing(defect, position)
        else:
            height += wave_gain(2.0 * np.pi / defect.wavelength, patch) * _waves(defect, position)
    return height


def _flat(flat: excitation.WheelFlat, wheel_radius: float, position: Float) -> Float:
    # the point at the azimuth a comes down to the rail after the angle pi - a
    middle = (np.pi - flat.azimuth) * wheel_radius
    apart = _apart(position - middle, 2.0 * np.pi * wheel_radius)
    depth = flat.depth_on(wheel_radius)
    if flat.shape == "fresh":
        return -depth * _cusp(apart, flat.length)
    within = np.minimum(apart / flat.length, 0.5)
    return -0.5 * depth * (1.0 + np.cos(2.0 * np.pi * within))


def _polygon(polygon: excitation.WheelPolygon, wheel_radius: float, position: Float) -> Float:
    azimuth_on_rail = np.pi - position / wheel_radius
    return polygon.amplitude * np.cos(polygon.order * (azimuth_on_rail - polygon.azimuth))


def _dip(joint: excitation.DippedJoint, position: Float) -> Float:
    apart = _from_nearest(position - joint.position, joint.spacing)
    return -joint.depth * _cusp(apart, joint.length)


def _weld(weld: excitation.DippedWeld, position: Float) -> Float:
    apart = _from_nearest(position - weld.position, weld.spacing)
    return -weld.depth * _hollow(apart, weld.length) - weld.short_depth * _hollow(apart, weld.short_length)


def _crossing(crossing: excitation.Crossing, position: Float) -> Float:
    behind = position - crossing.position
    share = np.where(behind < 0.0, -behind / crossing.wing_length, behind / crossing.nose_length)
    return -crossing.depth * np.maximum(1.0 - share, 0.0)


def _waves(corrugation: excitation.Corrugation, position: Float) -> Float:
    inside = np.minimum(position - corrugation.begin, corrugation.end - position)
    share = np.clip(inside / (2.0 * corrugation.wavelength), 0.0, 1.0)
    envelope = 0.5 - 0.5 * np.cos(np.pi * share)
    phase = 2.0 * np.pi * (position - corrugation.begin) / corrugation.wavelength
    return corrugation.amplitude * envelope * np.sin(phase)


def _apart(distance: Float, period: float) -> Float:
    """Compute the distance to the nearest of periodic places, not negative."""
    return np.abs(distance - period * np.round(distance / period))


def _from_nearest(distance: Float, spacing: float | None) -> Float:
    """Compute the distance to the nearest of periodic places from 0 on; there is none before 0."""
    if spacing is None:
        return np.abs(distance)
    return np.where(distance > -0.5 * spacing, _apart(distance, spacing), np.inf)


def _hollow(apart: Float, length: float) -> Float:
    """Evaluate one wave of a cosine, 1 in the middle and 0 at both ends; here upwards."""
    return 0.5 + 0.5 * np.cos(2.0 * np.pi * np.minimum(apart / length, 0.5))


def _cusp(apart: Float, length: float) -> Float:
    """Evaluate two parabolas that fall from 0 at both ends to -1, and meet there in a kink; here upwards."""
    return np.maximum(1.0 - 2.0 * apart / length, 0.0) ** 2

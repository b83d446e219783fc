"""Forces on the journal that do not come from its own bearing: drive, other bearing, knocks."""

from __future__ import annotations

from math import pi

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.background import Background, Knocks, OtherBearing

_STREAM = 0x62616367  # keeps these random numbers apart from those of rail and sensors
_DRIVE, _OTHER, _KNOCKS = range(3)


def background_force(
    background: Background, bearing: RollerBearing, time: Float, speed: Float, seed: int
) -> Float:
    """Compute the vertical force on the journal, upwards, shape [sample], [N].

    Lines follow the shaft angle, and their phases are random; a line above 0.4 of the rate is left out. They
    are as strong at every speed: a source for how they grow with it was not found.

    Parameters
    ----------
    bearing : RollerBearing
        Type of the other bearing.
    time, speed : float64 arrays, shape [sample]
        Evenly spaced from 0, [s]; of the shaft, [rad/s].
    """
    step = float(time[1] - time[0])
    angle = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step)])
    force = np.zeros_like(time)
    if background.drive is not None:
        force += _lines(background.drive.orders, angle, speed, step, _random(seed, _DRIVE))
    if background.other_bearing is not None:
        force += _other_bearing(background.other_bearing, bearing, angle, speed, step, _random(seed, _OTHER))
    if background.knocks is not None:
        force += _knocks(background.knocks, time, _random(seed, _KNOCKS))
    return background.amplitude_factor * force


def _random(seed: int, source: int) -> np.random.Generator:
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([_STREAM, seed, source])))


def _lines(
    orders: tuple[tuple[float, float], ...],
    angle: Float,
    speed: Float,
    step: float,
    random: np.random.Generator,
) -> Float:
    force = np.zeros_like(angle)
    turning = np.minimum(np.abs(speed) / (2.0 * pi), 1.0)  # nothing meshes at rest
    for order, amplitude in orders:
        phase = random.uniform(0.0, 2.0 * pi)
        received = order * np.abs(speed) * step < 0.8 * pi
        force += np.where(received, turning * amplitude * np.cos(order * angle + phase), 0.0)
    return force


def _other_bearing(
    other: OtherBearing,
    bearing: RollerBearing,
    angle: Float,
    speed: Float,
    step: float,
    random: np.random.Generator,
) -> Float:
    rates, rollers = fault_frequencies(bearing), bearing.roller_count
    cage = rates.ftf * (1.0 - other.slip)  # turns in a turn of the shaft
    passing = tuple((rollers * cage * k, each) for k, each in enumerate(other.passing_force, start=1))
    force = _lines(passing, angle, speed, step, random)
    if other.fault is None:
        return force
    # strokes and turns of the fault through the load zone, in a turn of the shaft
    strokes, turns = {
        "cup": (rollers * cage, 0.0),
        "cone": (rollers * (1.0 - cage), 1.0),
        "roller": (2.0 * rates.bsf * (1.0 - other.slip), cage),
    }[other.fault]
    phase = strokes * angle / (2.0 * pi) + random.uniform()
    before = np.flatnonzero(np.diff(np.floor(phase)) != 0.0)
    share = (np.maximum(np.floor(phase[before]), np.floor(phase[before + 1])) - phase[before]) / (
        phase[before + 1] - phase[before]
    )
    loaded = np.maximum(np.cos(turns * angle[before]), 0.0)
    return force + _strokes(len(angle), step, (before + share) * step, other.impulse * loaded, other.pulse)


def _knocks(knocks: Knocks, time: Float, random: np.random.Generator) -> Float:
    at: list[float] = []
    size: list[float] = []
    now = random.exponential(1.0 / knocks.rate)
    # one after the other, so that a longer run begins with the same knocks
    while now < time[-1]:
        at.append(now)
        size.append(random.choice((-1.0, 1.0)) * knocks.impulse * np.exp(random.normal(0.0, knocks.spread)))
        now += random.exponential(1.0 / knocks.rate)
    return _strokes(len(time), float(time[1] - time[0]), np.array(at), np.array(size), knocks.pulse)


def _strokes(count: int, step: float, at: Float, impulse: Float, pulse: float) -> Float:
    """Add half sines of a length [s] that begin at times [s] and have given impulses [N s].

    Each sample has the mean force of its step, so that an impulse is kept whole wherever it falls.
    """
    force = np.zeros(count)
    longest = int(pulse / step) + 3
    for begin, size in zip(at, impulse, strict=True):
        first = int(begin / step)
        edges = (np.arange(first, min(first + longest, count) + 1) - 0.5) * step - begin
        given = 0.5 - 0.5 * np.cos(pi * np.clip(edges / pulse, 0.0, 1.0))
        force[first : first + len(edges) - 1] += size * np.diff(given) / step
    return force

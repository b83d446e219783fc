"""Levels of vibration in twelfths of an octave, of recordings and of twins alike."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import band_levels
from beardyn_core.follow.inference import stretches_of
from beardyn_core.record.run import Run
from beardyn_core.scene.sensor import PASSBAND

SHARE = 12  # bands to an octave
LOWEST = 100.0  # [Hz], below which the track says more than the axlebox
_SAME_SPEED = 0.03  # stretches that are put together
MOST_RIDES = 2  # speeds that a twin runs at
_MODEL = (1.0, 4.0)  # [dB], by which tiers differ up to 5 kHz, and above: docs/estimate.md
_MODEL_TO = 5000.0  # [Hz]
_SMOOTH = 7  # bands whose scatter is put together, as few seeds tell it badly


class Reception(NamedTuple):
    """What is measured at once; see `beardyn_core.follow.inference.Receiver`."""

    axes: tuple[str, ...]
    rate: float  # [Hz]
    stretch: float  # [s]

    @property
    def middles(self) -> tuple[float, ...]:
        """Middles of the bands, to what the anti-alias filter leaves as it is, [Hz]."""
        count = int(np.floor(SHARE * np.log2(PASSBAND * self.rate / LOWEST)))
        return tuple(LOWEST * 2.0 ** ((k + 0.5) / SHARE) for k in range(count))

    @property
    def widths(self) -> Float:
        """Widths of the bands, shape [band], [Hz]."""
        half = 2.0 ** (0.5 / SHARE)
        return np.array(self.middles) * (half - 1.0 / half)

    @property
    def model(self) -> Float:
        """By which a right twin may be off, shape [band], [dB]."""
        return np.asarray(np.where(np.array(self.middles) <= _MODEL_TO, *_MODEL), np.float64)


@dataclass(frozen=True, eq=False)
class Ride:
    """Stretches of recordings at one speed."""

    shaft_frequency: A[float, "middle of the stretches, [Hz]"]
    levels: A[Float, "shape [stretch, axis, band], [dB re 1 m/s^2]"]

    @property
    def middle(self) -> Float:
        """Middle level of the stretches, shape [axis, band], [dB re 1 m/s^2]."""
        return np.asarray(np.median(self.levels, axis=0), np.float64)


class StretchLevels(NamedTuple):
    """One stretch."""

    shaft_frequency: float  # [Hz]
    levels: Float  # shape [axis, band], [dB re 1 m/s^2]


def received_in(run: Run, reception: Reception, sensor: str = "") -> list[StretchLevels]:
    """Measure the levels of every stretch of a run."""
    return [
        StretchLevels(stretch.shaft_frequency, levels_of(stretch.acceleration, reception))
        for stretch in stretches_of(run, reception, sensor)
    ]


def levels_of(acceleration: Float, reception: Reception) -> Float:
    """Measure the levels of a signal, shape [sample, axis], [m/s^2]; see `StretchLevels`."""
    signal = acceleration - acceleration.mean(axis=0)
    bands = (band_levels(each, reception.rate, reception.middles, SHARE) for each in signal.T)
    return np.array([list(each.values()) for each in bands])


def rides_of(received: list[StretchLevels]) -> tuple[Ride, ...]:
    """Put stretches of one speed together; the speeds with most of them are taken."""
    rest, rides = sorted(received, key=lambda each: each.shaft_frequency), list[Ride]()
    while rest and len(rides) < MOST_RIDES:
        groups = [
            [each for each in rest if abs(each.shaft_frequency / one.shaft_frequency - 1.0) < _SAME_SPEED]
            for one in rest
        ]
        best = max(groups, key=len)
        frequency = float(np.median([each.shaft_frequency for each in best]))
        rides.append(Ride(frequency, np.stack([each.levels for each in best])))
        rest = [each for each in rest if all(each is not other for other in best)]
    return tuple(rides)


def tolerance_of(rides: tuple[Ride, ...], twins: Float, reception: Reception) -> Float:
    """Put together what stretches, tracks, bearings of a lot and tiers differ by.

    Parameters
    ----------
    rides : tuple of Ride
        StretchLevels.
    twins : float64 array, shape [seed, ride, axis, band]
        Levels of twins on other tracks, with other bearings of the lot, [dB].

    Returns
    -------
    float64 array, shape [ride, axis, band]
        Standard deviation of a difference between the two, [dB].
    """
    found = []
    for ride, twin in zip(rides, np.moveaxis(twins, 1, 0), strict=True):
        count = len(ride.levels)
        own = ride.levels.var(axis=0, ddof=1) / count if count > 1 else 0.0
        variance = twin.var(axis=0, ddof=1) * (1.0 + 1.0 / len(twin)) + own
        even = uniform_filter1d(variance, _SMOOTH, axis=-1, mode="nearest")
        found.append(np.sqrt(even + reception.model**2))
    return np.stack(found)

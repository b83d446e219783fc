"""The smallest spall that a monitor would have found in a record: spalls of the twin, added to the record."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil, inf, isfinite, nan
from typing import Annotated as A

import numpy as np
from scipy.signal import butter, resample_poly, sosfiltfilt

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import FAULTS, REFERENCE, Algorithm, MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.run import blocks
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.scene import Scene

WIDTHS = (1e-3, 2e-3, 3e-3, 4e-3, 6e-3, 8e-3, 12e-3, 16e-3, 21e-3)
_FINER = 4  # times the rate of the twin, at which its signal is read over the angle of the shaft
_FILTER_ORDER, _PASSED = 8, 0.4  # of the anti-alias filter of the record; share of its rate
_SETTLED = 4.0  # revolutions that the twin's runs begin before the record


@dataclass(frozen=True)
class SmallestSpall:
    """Spalls of one part, added to a record: which of them the monitor names."""

    part: A[str, "``cup``, ``cone`` or ``roller``"]
    named: A[float, "least width from which on all that were tried are named, NaN: the widest is not, [m]"]
    missed: A[float, "largest width that is missed; 0: none that was tried is, [m]"]
    widest: A[float, "largest width that was tried, [m]"]

    @property
    def sentence(self) -> str:
        """Say it in a sentence."""
        part = PART_NAMES[self.part]
        if not isfinite(self.named):
            return f"{part}: a spall of {1e3 * self.widest:g} mm, the widest tried, would have been missed"
        less = f", one of {1e3 * self.missed:g} mm would have been missed" if self.missed else ""
        return f"{part}: a spall of {1e3 * self.named:g} mm or more would have been named{less}"


@dataclass(frozen=True)
class SmallestSpalls:
    """The smallest spall of each part that a record would have shown."""

    spalls: tuple[SmallestSpall, ...]
    twin: A[str, "scene, bearing, speed, load and kind of spall"]

    @property
    def sentence(self) -> str:
        """Say it in a sentence."""
        return f"{'; '.join(each.sentence for each in self.spalls)} (twin: {self.twin})"


class LastStretch:
    """An algorithm that keeps the stretch it was given last, and judges nothing.

    Attributes
    ----------
    stretch : Stretch or None
        ``None`` before the first.
    """

    def __init__(self) -> None:
        self.stretch: Stretch | None = None

    def __call__(
        self, stretch: Stretch, _orders: FaultFrequencies, _roller_count: int, _settings: MonitorSettings
    ) -> MonitorResult:
        """Keep a stretch."""
        self.stretch = stretch
        return MonitorResult("waiting", "kept", stretch.end_ns)


def smallest_spalls_in(
    stretch: Stretch,
    axes: tuple[int, ...],
    orders: FaultFrequencies,
    roller_count: int,
    scene: Scene,
    sensor: str = "",
    settings: MonitorSettings | None = None,
    algorithm: Algorithm = REFERENCE,
) -> Iterator[SmallestSpall]:
    """Add spalls of the twin to a stretch without a fault, and find the smallest that is named, part by part.

    Parameters
    ----------
    stretch : Stretch
        Of the record, such as the last one of a run.
    axes : tuple of int
        Which of x, y, z the columns of its acceleration are: 0, 1, 2.
    scene : Scene
        The twin, at the speed and load of the record, with the effects that a spall needs; its own defects
        are left out.
    sensor : str
        Accelerometer of the twin; by default the first.

    Notes
    -----
    What a spall adds to the vibration is the difference of two runs of the twin that differ by the spall
    alone. It is added over the angle of the shaft. Spalls are tried from the widest on until one is missed;
    a narrower one may be named all the same, for two events a mode's period apart strike less. Faint faults
    count as missed: two runs of the twin differ by more than the spall, and what is added looks surer than
    the same spall in a run of its own (3 mm here, 5 mm there in `service_high_speed`). Box, sensor
    and load are the twin's: where those of the record are others, so is the smallest spall.
    """
    settings = replace(settings or MonitorSettings(), faint_margin=inf)
    turns = stretch.revolutions + 2.0 * _SETTLED
    scene = replace(scene, duration=ceil(50.0 * turns / stretch.shaft_frequency) / 50.0)
    _, healthy = _vibration(scene, (), sensor)
    rate = next(each.rate for each in scene.sensors if each.name == sensor or not sensor)
    for part in FAULTS:
        named, missed = nan, 0.0
        for width in reversed(WIDTHS):
            angle, faulty = _vibration(scene, (_spall(part, width, scene),), sensor)
            spall = _in_band((faulty - healthy)[:, list(axes)], rate, stretch.rate)
            added = _over_angle(spall, angle, stretch.shaft_angle)
            received = replace(stretch, acceleration=stretch.acceleration + added)
            if algorithm(received, orders, roller_count, settings).verdict != part:
                missed = width
                break
            named = width
        yield SmallestSpall(part, named, missed, WIDTHS[-1])


def _spall(part: str, width: float, scene: Scene) -> FieldSpall:
    """Make a spall that begins in the middle of the load zone, at the top."""
    return FieldSpall(on=part, row=0, azimuth=0.0, width=width, length=scene.bearing.effective_length)


def _vibration(scene: Scene, defects: tuple[FieldSpall, ...], sensor: str) -> tuple[Float, Float]:
    """Run the twin: shaft angle, shape [sample], and acceleration of a sensor, shape [sample, axis]."""
    names = [each.name for each in scene.sensors]
    index = names.index(sensor) if sensor else 0
    times, values, trend_times, angles = [], [], [], []
    for block in blocks(replace(scene, defects=defects)):
        times.append(block.vibration[index].time_ns)
        values.append(block.vibration[index].acceleration)
        trend_times.append(block.trend_time_ns)
        angles.append(block.shaft_angle)
    angle = np.unwrap(np.concatenate(angles))
    turned = np.interp(np.concatenate(times), np.concatenate(trend_times), angle)
    return turned, np.concatenate(values).astype(np.float64)


def _in_band(added: Float, rate: float, wanted: float) -> Float:
    """Leave out what a record of a lower rate cannot hold, shape [sample, axis]."""
    if wanted >= rate:
        return added
    low = butter(_FILTER_ORDER, _PASSED * wanted, fs=rate, output="sos")
    return np.asarray(sosfiltfilt(low, added, axis=0), np.float64)


def _over_angle(added: Float, angle: Float, wanted: Float) -> Float:
    """Read what a spall adds where the shaft of the record has turned as far, shape [sample, axis]."""
    fine = resample_poly(added, _FINER, 1, axis=0)
    place = np.interp(np.arange(len(fine)) / _FINER, np.arange(len(angle)), np.abs(angle - angle[0]))
    turned = np.abs(wanted - wanted[0]) + 2.0 * np.pi * _SETTLED
    return np.stack([np.interp(turned, place, each) for each in fine.T], axis=1)

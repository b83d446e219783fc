"""What an estimator makes of a run: its stretches, its estimates, and what speaks against them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from typing import Protocol

import numpy as np
from scipy.signal import resample_poly

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.descriptors import AXES, describe
from beardyn_core.follow.estimator import Estimates, Estimator
from beardyn_core.follow.mounting_search import mountings_of
from beardyn_core.monitor.chain import Stretch
from beardyn_core.record.run import Run

FEWEST_TURNS = 10.0  # of the shaft in a stretch
LONGEST_STEP = 1.5  # sampling periods from one sample to the next; beyond, some are lost
_ALIKE = 0.01  # sizes of a bearing that an estimator fits
_SAME_RATE = 1e-3
_LEAST_LENGTH = 0.95  # of a stretch


class Receiver(Protocol):
    """What is read at once: an estimator is one."""

    @property
    def axes(self) -> tuple[str, ...]:
        """Axes of the accelerometer."""

    @property
    def rate(self) -> float:
        """Sampling rate, [Hz]."""

    @property
    def stretch(self) -> float:
        """Length, [s]."""


def doubt_of(estimator: Estimator, bearing: RollerBearing | NamePlate) -> str:
    """Say why an estimator is not for a bearing; empty when it is."""
    plate = estimator.plate
    if alike(plate, bearing):
        return ""
    return (
        f"the estimator is for {plate.name}, {sizes_text(plate)}; the run is of {bearing.name}, "
        f"{sizes_text(bearing)}"
    )


def alike(one: RollerBearing | NamePlate, other: RollerBearing | NamePlate) -> bool:
    """Tell whether two bearings are of the same sizes and, where both are known, of the same kind."""
    sizes = ("roller_count", "pitch_diameter", "roller_diameter")
    if one.kind and other.kind and one.kind != other.kind:
        return False
    if not all(isinstance(each, RollerBearing) or each.has_dimensions for each in (one, other)):
        return False
    return all(abs(getattr(one, name) / getattr(other, name) - 1.0) < _ALIKE for name in sizes)


def sizes_text(bearing: RollerBearing | NamePlate) -> str:
    """Write the kind and the sizes by which bearings are distinguished."""
    if isinstance(bearing, NamePlate) and not bearing.has_dimensions:
        return "maker's factors without diameters"
    pitch, roller = 1e3 * bearing.pitch_diameter, 1e3 * bearing.roller_diameter
    kind = f"{bearing.kind} " if bearing.kind else ""
    return f"{bearing.roller_count} {kind}rollers of {roller:.1f} mm on {pitch:.0f} mm"


def estimates_of(
    run: Run, estimator: Estimator, bearing: RollerBearing | NamePlate, sensor: str = ""
) -> Estimates:
    """Estimate from the vibration and the shaft of a run, and nothing else.

    Raises
    ------
    InputError
        The estimator is for another bearing, an axis is not measured, or the run is too short or too slow.
    """
    if doubt := doubt_of(estimator, bearing):
        raise InputError(f"{run.label}: {doubt}; train one with `beardyn train`")
    stretches = list(stretches_of(run, estimator, sensor))
    if not stretches:
        raise InputError(
            f"{run.label}: has no {estimator.stretch:.2f} s of whole vibration in which the shaft turns "
            f"{FEWEST_TURNS:g} times one way; the estimator needs that much at once"
        )
    rows = [describe(each, estimator.orders, estimator.plate, estimator.axes) for each in stretches]
    found = estimator.estimates(np.stack(rows))
    return replace(found, mountings=mountings_of(stretches, estimator)) if found.strangeness > 1.0 else found


def stretches_of(run: Run, estimator: Receiver, sensor: str = "") -> Iterator[Stretch]:
    """Cut a run into stretches of the length and sampling rate that an estimator reads.

    Where samples are lost, or are NaN, a new stretch begins.
    """
    if sensor and sensor not in run.sensors:
        raise InputError(f"{run.label}: has no sensor {sensor!r}; it has {', '.join(run.sensors)}")
    signal = run.sensors[sensor] if sensor else run.vibration
    if not len(signal) or not len(run.shaft):
        raise InputError(f"{run.label}: has no vibration with a shaft angle to estimate from")
    inside = (signal.time_ns >= run.shaft.time_ns[0]) & (signal.time_ns <= run.shaft.time_ns[-1])
    received = np.asarray(signal.values, np.float64)[inside][:, [AXES.index(axis) for axis in estimator.axes]]
    if doubt := name_unmeasured_axes(received, estimator):
        raise InputError(f"{run.label}: {doubt}")
    if signal.rate < (1.0 - _SAME_RATE) * estimator.rate:
        raise InputError(
            f"{run.label}: is sampled at {signal.rate:.0f} Hz, the estimator needs {estimator.rate:.0f} Hz; "
            "what lies between is not in the signal"
        )
    complete = np.isfinite(received).all(axis=1)
    time_ns, received = signal.time_ns[inside][complete], received[complete]
    angle = np.interp(time_ns, run.shaft.time_ns, np.unwrap(run.shaft.angle))
    lost = np.flatnonzero(np.diff(time_ns) > LONGEST_STEP * 1e9 / signal.rate) + 1
    for begin, end in pairwise([0, *lost.tolist(), len(time_ns)]):
        if end - begin >= _LEAST_LENGTH * estimator.stretch * signal.rate:
            piece = _resample(received[begin:end], angle[begin:end], signal.rate, estimator.rate)
            yield from _cut(*piece, int(time_ns[begin]), estimator)


def _cut(received: Float, angle: Float, begin_ns: int, estimator: Receiver) -> Iterator[Stretch]:
    """Cut what nothing is lost of into stretches."""
    length = round(estimator.stretch * estimator.rate) + 1
    for k in range(max(1, len(received) // length)):
        part = slice(k * length, (k + 1) * length)
        long_enough = len(angle[part]) >= _LEAST_LENGTH * length
        if long_enough and (forward := turned_forward(received[part], angle[part])) is not None:
            end_ns = begin_ns + round(1e9 * (part.start + len(angle[part]) - 1) / estimator.rate)
            yield Stretch(estimator.rate, *forward, np.nan, end_ns)


def measured_axes(run: Run, sensor: str = "") -> tuple[str, ...]:
    """List the axes of an accelerometer of a run that are measured; all where it has no samples."""
    signal = run.sensors.get(sensor, run.vibration)
    return finite_axes(signal.values) if len(signal) else AXES


def finite_axes(acceleration: Float) -> tuple[str, ...]:
    """List the axes of acceleration, shape [sample, 3], that have a number."""
    return tuple(axis for k, axis in enumerate(AXES) if not np.isnan(acceleration[:, k]).all())


def name_unmeasured_axes(received: Float, estimator: Receiver) -> str:
    """Say which axis of a signal, shape [sample, axis], is not measured; empty when all are."""
    for axis, values in zip(estimator.axes, received.T, strict=True):
        if len(values) and np.isnan(values).all():
            return (
                f"axis {axis} is not measured; the estimator needs {', '.join(estimator.axes)}: "
                "train one with --axes"
            )
    return ""


def turned_forward(received: Float, angle: Float) -> tuple[Float, Float] | None:
    """Give vibration and angle of a stretch as if the shaft turned forwards.

    One that turns backwards is turned round in time, so that its angle increases as well.

    Parameters
    ----------
    received : float64 array, shape [sample, axis]
        [m/s^2].
    angle : float64 array, shape [sample]
        [rad].

    Returns
    -------
    tuple of arrays or None
        Vibration and increasing angle; none where the shaft stands, turns round or is too slow.
    """
    turned = np.diff(angle)
    if abs(angle[-1] - angle[0]) < FEWEST_TURNS * 2.0 * np.pi:
        return None
    if (turned >= 0.0).all():
        return received, angle
    return (received[::-1].copy(), angle[::-1].copy()) if (turned <= 0.0).all() else None


def _resample(received: Float, angle: Float, rate: float, wanted: float) -> tuple[Float, Float]:
    """Bring vibration, shape [sample, axis], and angle to the sampling rate of the estimator."""
    if abs(rate / wanted - 1.0) < _SAME_RATE:
        return received, angle
    ratio = Fraction(wanted / rate).limit_denominator(1000)
    fewer = resample_poly(received, ratio.numerator, ratio.denominator, axis=0)
    time = np.arange(len(fewer)) * (rate / wanted)
    return fewer, np.interp(time, np.arange(len(angle)), angle)

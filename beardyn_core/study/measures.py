"""Numbers of a stretch of a run, by which the ladder compares runs: its signals joined, and measured."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.monitor.features import envelope, order_spectrum, resample_by_angle
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.scene.excitation import WheelPolygon
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import PASSBAND
from beardyn_core.sensors.block import CONTACT_KINDS, Block

_CUP_BODY, _CONE_BODY, _FIRST_ROLLER = 0, 1, 4  # order of `Twin.body_names`
_CUP_CONTACT = CONTACT_KINDS.index("cup")
_FORCE = slice(3, 6)  # of `CONTACT_FIELDS`


@dataclass(frozen=True)
class Signals:
    """Channels of a stretch of a run."""

    trend_time: A[Float, "shape [trend], of the channels at 400 Hz, [s]"]
    force: A[Float, "shape [trend, 3], of the rollers on the cup, [N]"]
    torque: A[Float, "shape [trend], of the bearing on the shaft, [N m]"]
    shaft_angle: A[Float, "shape [trend], [rad]"]
    cage_speed: A[Float, "shape [trend, row], [rad/s]"]
    snapshot_time: A[Float, "shape [snapshot], of the channels at 200 Hz, [s]"]
    deflection: A[Float, "shape [snapshot, 3], of the cone against the cup, [m]"]
    roller_azimuth: A[Float, "shape [snapshot, row, roller], from +z towards +x, [rad]"]
    roller_load: A[Float, "shape [snapshot, row, roller], between cup and roller, [N]"]
    wave_time: A[Float, "shape [sample], of the acceleration, [s]"]
    acceleration: A[Float, "shape [sample, 3], read by the first accelerometer, [m/s^2]"]

    def between(self, start: float, end: float) -> Signals:
        """Cut out the samples from a time to before another one, [s]."""
        trend, snapshot, wave = (
            slice(*np.searchsorted(times, (start - 1e-9, end - 1e-9)))
            for times in (self.trend_time, self.snapshot_time, self.wave_time)
        )
        cuts = 5 * [trend] + 4 * [snapshot] + 2 * [wave]  # in the order of the fields
        return Signals(*(values[cut] for values, cut in zip(vars(self).values(), cuts, strict=True)))


class SignalCollector:
    """Collects the channels of every block that the measures of a run need."""

    def __init__(self) -> None:
        self._parts: list[tuple[NDArray[Any], ...]] = []

    def add(self, block: Block) -> None:
        """Keep the channels of a block."""
        rows, rollers = block.roller_angle.shape[1:]
        pose = block.body_pose
        places = pose[:, _FIRST_ROLLER:, :3] - pose[:, _CUP_BODY, None, :3]
        azimuth = np.arctan2(places[..., 0], places[..., 2]).reshape(-1, rows, rollers)
        self._parts.append(
            (
                block.trend_time_ns * 1e-9,
                block.force[:, :3],
                block.shaft_torque,
                block.shaft_angle,
                block.cage_speed,
                block.snapshot_time_ns * 1e-9,
                pose[:, _CONE_BODY, :3] - pose[:, _CUP_BODY, :3],
                azimuth,
                np.linalg.norm(block.contacts[..., _CUP_CONTACT, _FORCE], axis=-1),
                block.waveform_time_ns * 1e-9,
                block.acceleration[0] if len(block.acceleration) else np.zeros((0, 3)),
            )
        )

    def signals(self) -> Signals:
        """Join all blocks in one piece."""
        return Signals(*(np.concatenate(parts) for parts in zip(*self._parts, strict=True)))


# IEC 61260-1, base ten, and its nominal frequencies, [Hz]
NOMINAL_BANDS = (
    *(31.5, 40, 50, 63, 80, 100, 125, 160, 200, 250, 315, 400, 500),
    *(630, 800, 1000, 1250, 1600, 2000, 2500, 3150, 4000, 5000, 6300, 8000, 10_000),
)
BAND_CENTRES = 1000.0 * 10.0 ** (0.1 * np.arange(-15, 11))
REFERENCE_ACCELERATION = 1.0e-6  # ISO 1683, [m/s^2]
HIGH_QUANTILE = 0.99
# bins of the load distribution that carry this share of the largest one are the load zone
LOAD_ZONE_SHARE = 0.05
_MONITOR = MonitorSettings()
_TINY = 1e-300


@dataclass(frozen=True)
class FaultLine:
    """The line of a scene's fault in the envelope order spectrum."""

    name: A[str, "such as ``BPFO``"]
    order: A[float, "per shaft revolution, [-]"]


def fault_line_of(scene: Scene) -> FaultLine | None:
    """Return the line of the first defect of the bearing, else of the wheel; ``None`` for a healthy scene."""
    if not scene.defects:
        wheel = scene.operation.wheel_defects if isinstance(scene.operation, QuarterVehicleOperation) else ()
        order = wheel[0].order if wheel and isinstance(wheel[0], WheelPolygon) else 1
        return FaultLine("wheel", float(order)) if wheel else None
    frequencies = fault_frequencies(scene.bearing)
    defect = scene.defects[0]
    if defect.kind in ("diameter", "worn_pocket"):
        return FaultLine("FTF", frequencies.ftf)
    return {
        "cup": FaultLine("BPFO", frequencies.bpfo),
        "cone": FaultLine("BPFI", frequencies.bpfi),
        "roller": FaultLine("2 BSF", 2.0 * frequencies.bsf),
    }[defect.on]


def third_octave_levels(acceleration: Float, rate: float = WAVEFORM_RATE) -> Float:
    """Compute the level of the acceleration in each third-octave band, all axes together.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    rate : float
        [Hz].

    Returns
    -------
    float64 array, shape [band]
        Bands of `NOMINAL_BANDS`; the last one ends where the anti-alias filter begins (0.4 of the rate),
        re 1 µm/s^2, [dB].

    Notes
    -----
    Periodogram under a Hann window; a line between two bands is shared by them.
    """
    count = len(acceleration)
    if count < 2:
        return np.full(len(BAND_CENTRES), np.nan)
    window = np.hanning(count + 1)[:-1]
    # a constant times the window must not leak into the first bands: remove the weighted mean
    centred = acceleration - window @ acceleration / window.sum()
    spectrum = np.abs(np.fft.rfft(centred * window[:, None], axis=0)) ** 2
    power = 2.0 / (count * np.sum(window**2)) * spectrum.sum(axis=1)
    # a bin's power is spread evenly over its width, so that narrow bands need not hold whole bins
    edges = (np.arange(len(power) + 1) - 0.5) * rate / count
    below = np.concatenate([[0.0], np.cumsum(power)])
    half = 10.0**0.05
    top = np.minimum(BAND_CENTRES * half, PASSBAND * rate)
    within = np.interp(top, edges, below) - np.interp(BAND_CENTRES / half, edges, below)
    return 10.0 * np.log10(np.maximum(within, _TINY) / REFERENCE_ACCELERATION**2)


def load_distribution(azimuth: Float, load: Float) -> Float:
    """Average the roller load over azimuth, in bins of one roller pitch around 2 pi k / Z.

    Parameters
    ----------
    azimuth, load : float64 array, shape [snapshot, row, roller]
        [rad], [N].

    Returns
    -------
    float64 array, shape [row, bin]
        NaN where no roller was seen, [N].
    """
    rows, rollers = azimuth.shape[1:]
    place = np.floor(azimuth * (rollers / (2.0 * np.pi)) + 0.5).astype(np.int64) % rollers
    found = np.full((rows, rollers), np.nan)
    for row in range(rows):
        index = place[:, row].ravel()
        seen = np.bincount(index, minlength=rollers)
        total = np.bincount(index, weights=load[:, row].ravel(), minlength=rollers)
        np.divide(total, seen, out=found[row], where=seen > 0)
    return found


def line_level(signals: Signals, order: float) -> float:
    """Measure a line of the envelope order spectrum, re 1 µm/s^2, [dB].

    The order is where the line is without slip, per shaft revolution; it is sought within the monitor's
    tolerance.
    """
    times, angle = signals.wave_time, np.abs(signals.shaft_angle)
    within = (times >= signals.trend_time[0]) & (times <= signals.trend_time[-1])
    turned = np.interp(times[within], signals.trend_time, angle)
    if len(turned) < 2 or np.any(np.diff(turned) <= 0.0):
        return float("nan")
    per_revolution = _MONITOR.samples_per_revolution
    envelope_signal = envelope(signals.acceleration[within], WAVEFORM_RATE, _MONITOR.band)
    even = resample_by_angle(envelope_signal, turned, per_revolution)
    if len(even) < per_revolution:
        return float("nan")
    spectrum = order_spectrum(even, per_revolution, 2.0 * order, _MONITOR.background_width)
    reach = max(_MONITOR.tolerance * order, spectrum.resolution)
    near = np.abs(spectrum.order - order) <= reach
    return 20.0 * float(np.log10(max(spectrum.amplitude[near].max(), _TINY) / REFERENCE_ACCELERATION))


@dataclass(frozen=True)
class Measure:
    """One number, or one family of numbers, of a run."""

    quantity: A[str, "what it belongs to: a column of the ladder"]
    parts: A[tuple[str, ...], "names of its components; a single one when they are folded"]
    take: A[Callable[[Signals, FaultLine | None], Float], "components from the signals and the fault line"]
    scale: A[
        Callable[[Float], Float] | None, "of an error, from the reference's parts; ``None``: levels in dB"
    ]
    weighed: A[
        Callable[[Float], NDArray[np.bool_]] | None,
        "which components count, from the reference's; with it the error is their root mean square",
    ] = None


def _length(reference: Float) -> Float:
    return np.array([np.linalg.norm(reference)])


def _largest(reference: Float) -> Float:
    return np.nanmax(np.abs(reference), keepdims=True)


def _load_zone(reference: Float) -> NDArray[np.bool_]:
    return np.asarray(reference >= LOAD_ZONE_SHARE * np.nanmax(reference))


def _high(values: Float) -> Float:
    return np.quantile(values, HIGH_QUANTILE, keepdims=True)


def _largest_load(signals: Signals) -> Float:
    return signals.roller_load.max(axis=(1, 2))


def _line(signals: Signals, line: FaultLine | None) -> Float:
    return np.array([np.nan if line is None else line_level(signals, line.order)])


def _distribution(signals: Signals, _line: FaultLine | None) -> Float:
    return load_distribution(signals.roller_azimuth, signals.roller_load).ravel()


_AXES = ("mean x", "mean y", "mean z")
_BANDS = tuple(f"{band:g} Hz" for band in NOMINAL_BANDS)
MEASURES = (
    Measure("force", _AXES, lambda s, _: s.force.mean(axis=0), _length),
    Measure("force", ("99 %",), lambda s, _: _high(np.linalg.norm(s.force, axis=1)), _length),
    Measure("deflection", _AXES, lambda s, _: s.deflection.mean(axis=0), _length),
    Measure("deflection", ("99 %",), lambda s, _: _high(np.linalg.norm(s.deflection, axis=1)), _length),
    Measure("roller_load", ("largest, mean",), lambda s, _: _largest_load(s).mean(keepdims=True), _length),
    Measure("roller_load", ("largest, 99 %",), lambda s, _: _high(_largest_load(s)), _length),
    Measure("roller_load", ("rms over the load zone",), _distribution, _largest, _load_zone),
    Measure("torque", ("mean",), lambda s, _: s.torque.mean(keepdims=True), _length),
    Measure("vibration", _BANDS, lambda s, _: third_octave_levels(s.acceleration), None),
    Measure("cage_speed", ("row 0", "row 1"), lambda s, _: s.cage_speed.mean(axis=0), np.abs),
    Measure("fault_line", ("envelope",), _line, None),
)
QUANTITIES = tuple(dict.fromkeys(measure.quantity for measure in MEASURES))
UNITS = {measure.quantity: "dB" if measure.scale is None else "%" for measure in MEASURES}


@dataclass(frozen=True)
class Outcome:
    """Numbers of one run."""

    whole: A[tuple[Float, ...], "one of `MEASURES` each, over all windows together"]
    windows: A[tuple[tuple[Float, ...], ...], "such tuples, over each window"]


def compute_measures(signals: Signals, line: FaultLine | None) -> tuple[Float, ...]:
    """Compute the components of all `MEASURES` of a stretch."""
    return tuple(measure.take(signals, line) for measure in MEASURES)


def outcome(signals: Signals, edges: tuple[float, ...], line: FaultLine | None) -> Outcome:
    """Measure a run over windows that end at these times, [s]."""
    whole = signals.between(edges[0], edges[-1])
    windows = tuple(compute_measures(whole.between(start, end), line) for start, end in pairwise(edges))
    return Outcome(compute_measures(whole, line), windows)

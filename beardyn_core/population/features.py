"""Features of a run that a learner without deep layers takes: what the monitor works out, and band levels.

All of them can be had of a measured axlebox too: one accelerometer, the shaft, data of the bearing.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite, nan

import numpy as np
from scipy.fft import rfft

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.chain.fault_lines import comb_score
from beardyn_core.monitor.chain.kurtogram import by_kurtogram
from beardyn_core.monitor.chain.tracking import by_angle
from beardyn_core.monitor.streaming import Monitor, MonitorInput
from beardyn_core.record.run import Run

PARTS = FAULTS
# one analysis, of the last revolutions; runs are short, and a learner sees what few revolutions are worth
_ONCE = MonitorSettings(interval=1e9, least_revolutions=6.0)
_BANDS = (250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0)  # middles of octaves, [Hz]
_RESULT = ("score", "strongest_level", "rms", "kurtosis", "crest", "shaft_frequency")
_IN_BAND = {
    **{f"band_score_{part}": "dB" for part in PARTS},
    "band_strongest_level": "dB",
    "band_strongest_order": "",
    "band_kurtosis": "",
    "band_middle": "Hz",
    "band_width": "Hz",
}
UNITS = {
    **{f"score_{part}": "dB" for part in PARTS},
    "score": "dB",
    "threshold_margin": "dB",
    "lead": "dB",
    "strongest_level": "dB",
    "strongest_order": "",
    **_IN_BAND,
    "rms": "m/s^2",
    "kurtosis": "",
    "crest": "",
    "shaft_frequency": "Hz",
    **{f"octave_{middle:g}": "dB" for middle in _BANDS},
    "level": "dB",
}
"""Unit of each feature, in the order of the table."""
NAMES = tuple(UNITS)
# Levels against 1 m/s^2 and the place of the band depend on where the sensor sits and what machine it is: a
# learner that uses them learns the machine. What is left compares a signal with itself.
TRANSFERABLE = (
    *("score_cup", "score_cone", "score_roller", "score", "threshold_margin", "lead"),
    *("strongest_level", "strongest_order", "kurtosis", "crest"),
    *("band_score_cup", "band_score_cone", "band_score_roller"),
    *("band_strongest_level", "band_strongest_order", "band_kurtosis"),
)
VERDICT = "monitor_verdict"
"""Column of the table with the verdict of the shipped monitor on each run; no feature of a learner."""


def features_of(run: Run, orders: FaultFrequencies, roller_count: int, sensor: str = "") -> dict[str, float]:
    """Work out the features of a run; NaN where there is not enough of it.

    Parameters
    ----------
    run : Run
        Simulated, recorded or measured.
    orders : FaultFrequencies
        What the bearing data give, per shaft revolution.
    roller_count : int
        Rolling elements of one row.
    sensor : str
        Accelerometer; by default the first.
    """
    found, _ = judge_run(run, orders, roller_count, sensor)
    return found


def judge_run(
    run: Run, orders: FaultFrequencies, roller_count: int, sensor: str = ""
) -> tuple[dict[str, float], str]:
    """Work out the features of a run, and the verdict of the shipped monitor; see `features_of`."""
    signal = run.sensors[sensor] if sensor else run.vibration
    return _judge(run.monitor_inputs(sensor), signal.values, signal.rate, orders, roller_count)


def features_from(
    inputs: Iterable[MonitorInput], values: Float, rate: float, orders: FaultFrequencies, roller_count: int
) -> dict[str, float]:
    """Work out the features of signals that stand in arrays.

    Parameters
    ----------
    inputs : iterable of MonitorInput
        What a monitor reads of the run.
    values : array, shape [sample, axis]
        The acceleration, NaN on axes that were not measured, [m/s^2].
    rate : float
        Of the acceleration, [Hz].

    Notes
    -----
    The monitor whitens the signal and takes the logarithm of its envelope: no loud machine misleads it, and
    each strike counts once. What that costs is the loudness of strikes in the band where they ring. So
    the lines are looked for there as well, as measured: in the squared envelope of the band with the
    largest spectral kurtosis.
    """
    found, _ = _judge(inputs, values, rate, orders, roller_count)
    return found


def _judge(
    inputs: Iterable[MonitorInput], values: Float, rate: float, orders: FaultFrequencies, roller_count: int
) -> tuple[dict[str, float], str]:
    """Work out features and verdict of signals; see `features_from`."""
    in_band = dict.fromkeys(_IN_BAND, nan)

    def both(
        stretch: Stretch, orders: FaultFrequencies, count: int, settings: MonitorSettings
    ) -> MonitorResult:
        result = REFERENCE(stretch, orders, count, settings)
        if isfinite(result.threshold):
            in_band.update(_received_in_band(stretch, orders, count, settings))
        return result

    monitor = Monitor(orders, roller_count, settings=_ONCE, algorithm=both)
    for part in inputs:
        monitor.take(part)
    known = values[:, np.isfinite(values).all(axis=0)]
    result = monitor.result()
    found = {**_of_result(result), **in_band, **_levels(np.asarray(known, np.float64), rate)}
    return {name: found[name] for name in NAMES}, result.verdict


def _of_result(result: MonitorResult) -> dict[str, float]:
    known = isfinite(result.threshold)
    scores: Sequence[float] = result.scores if known else (nan,) * len(PARTS)
    ordered = sorted(scores)
    return {
        **{f"score_{part}": float(score) for part, score in zip(PARTS, scores, strict=True)},
        "threshold_margin": result.score - result.threshold if known else nan,
        "lead": ordered[-1] - ordered[-2],
        "strongest_order": result.strongest_order,
        **{name: float(getattr(result, name)) if known else nan for name in _RESULT},
    }


def _received_in_band(
    stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
) -> dict[str, float]:
    """Look for the lines of faults in the band of the largest spectral kurtosis."""
    band = by_kurtogram(stretch, settings)
    tracked = by_angle(stretch.squared_envelope((band.low, band.high)), stretch, settings)
    found = comb_score(tracked, orders, roller_count, stretch.shaft_frequency, settings)
    return {
        **{f"band_score_{part}": each.score for part, each in zip(PARTS, found.candidates, strict=True)},
        "band_strongest_level": found.strongest_level,
        "band_strongest_order": found.strongest_order,
        "band_kurtosis": band.kurtosis,
        "band_middle": 0.5 * (band.low + band.high),
        "band_width": band.high - band.low,
    }


def _levels(values: Float, rate: float) -> dict[str, float]:
    """Measure octaves against the whole, and the whole against 1 m/s^2, [dB]."""
    found = dict.fromkeys((*(f"octave_{middle:g}" for middle in _BANDS), "level"), nan)
    if len(values) < 2 or not values.size:
        return found
    power = (np.abs(rfft(values - values.mean(axis=0), axis=0)) ** 2).sum(axis=1) / len(values) ** 2 * 2.0
    frequency = np.arange(len(power)) * rate / len(values)
    whole = float(power[frequency > _BANDS[0] / 2**0.5].sum())
    if not whole > 0.0:
        return found
    for middle in _BANDS:
        inside = (frequency >= middle / 2**0.5) & (frequency < middle * 2**0.5)
        if middle * 2**0.5 <= 0.5 * rate:
            share = max(float(power[inside].sum()) / whole, 1e-12)
            found[f"octave_{middle:g}"] = 10.0 * np.log10(share)
    found["level"] = 10.0 * np.log10(whole)
    return {name: float(value) for name, value in found.items()}

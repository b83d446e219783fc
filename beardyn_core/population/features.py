"""Features of a run that a learner without deep layers takes: what the monitor works out, and band levels.

All of them can be had of a measured axlebox too: one accelerometer, the shaft, a name plate.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, nan

import numpy as np
from scipy.fft import rfft

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.observe.chain import FAULTS, MonitorResult, MonitorSettings
from beardyn_core.observe.monitoring import Monitor
from beardyn_core.record.run import Run

PARTS = FAULTS
_ONCE = MonitorSettings(interval=1e9)  # one analysis, of the last revolutions
_BANDS = (250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0)  # middles of octaves, [Hz]
_RESULT = ("score", "strongest_level", "rms", "kurtosis", "crest", "shaft_frequency")
UNITS = {
    **{f"score_{part}": "dB" for part in PARTS},
    "score": "dB",
    "threshold_margin": "dB",
    "lead": "dB",
    "strongest_level": "dB",
    "strongest_order": "",
    "band_middle": "Hz",
    "band_width": "Hz",
    "rms": "m/s^2",
    "kurtosis": "",
    "crest": "",
    "shaft_frequency": "Hz",
    **{f"octave_{middle:g}": "dB" for middle in _BANDS},
    "level": "dB",
}
"""Unit of each feature, in the order of the table."""
NAMES = tuple(UNITS)


def features_of(run: Run, orders: FaultFrequencies, roller_count: int, sensor: str = "") -> dict[str, float]:
    """Work out the features of a run; NaN where there is not enough of it.

    Parameters
    ----------
    run : Run
        Simulated, recorded or measured.
    orders : FaultFrequencies
        What the name plate gives, per shaft revolution.
    roller_count : int
        Rolling elements of one row.
    sensor : str
        Accelerometer; by default the first.
    """
    monitor = Monitor(orders, roller_count, settings=_ONCE)
    for part in run.monitor_inputs(sensor):
        monitor.take(part)
    result = monitor.result()
    signal = run.sensors[sensor] if sensor else run.vibration
    values = signal.values[:, np.isfinite(signal.values).all(axis=0)]
    found = {**_of_result(result), **_levels(np.asarray(values, np.float64), signal.rate)}
    return {name: found[name] for name in NAMES}


def _of_result(result: MonitorResult) -> dict[str, float]:
    known = isfinite(result.threshold)
    scores: Sequence[float] = result.scores if known else (nan,) * len(PARTS)
    ordered = sorted(scores)
    low, high = result.band
    return {
        **{f"score_{part}": float(score) for part, score in zip(PARTS, scores, strict=True)},
        "threshold_margin": result.score - result.threshold if known else nan,
        "lead": ordered[-1] - ordered[-2],
        "strongest_order": result.strongest_order,
        "band_middle": 0.5 * (low + high),
        "band_width": high - low,
        **{name: float(getattr(result, name)) if known else nan for name in _RESULT},
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

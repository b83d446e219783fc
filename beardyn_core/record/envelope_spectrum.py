"""Envelope order spectrum of a whole recording, for the picture next to the bearing."""

from __future__ import annotations

import numpy as np

from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.monitor.features import OrderSpectrum, envelope, order_spectrum, resample_by_angle
from beardyn_core.record.arrays import Signal, Turning

LEAST_REVOLUTIONS = 4.0


def envelope_order_spectrum(vibration: Signal, shaft: Turning, highest_order: float) -> OrderSpectrum | None:
    """Compute the spectrum of the band-passed envelope over all axes, resampled over the shaft angle.

    Band and angular grid are those of the monitor.

    Parameters
    ----------
    vibration : Signal
        Acceleration, shape [sample, 3], [m/s^2].
    shaft : Turning
        Tachometer.
    highest_order : float
        Where the result ends, [-].

    Returns
    -------
    OrderSpectrum or None
        ``None`` when the shaft makes fewer than four revolutions, or nothing is sampled in the band.
    """
    settings = MonitorSettings()
    if len(vibration) < 1024 or len(shaft) < 2:
        return None
    # Samples outside the tachometer's span have no angle.
    known = (vibration.time_ns >= shaft.time_ns[0]) & (vibration.time_ns <= shaft.time_ns[-1])
    time, signal = vibration.time[known], vibration.values[known]
    if len(time) < 1024:
        return None
    angle = np.interp(time, shaft.time, shaft.angle)
    angle = angle if angle[-1] > angle[0] else -angle
    if (angle[-1] - angle[0]) / (2.0 * np.pi) < LEAST_REVOLUTIONS or np.any(np.diff(angle) <= 0.0):
        return None
    rate = (len(time) - 1) / (time[-1] - time[0])
    if 0.5 * rate <= settings.band[0]:
        return None
    tracked = resample_by_angle(envelope(signal, rate, settings.band), angle, settings.samples_per_revolution)
    return order_spectrum(tracked, settings.samples_per_revolution, highest_order, settings.background_width)

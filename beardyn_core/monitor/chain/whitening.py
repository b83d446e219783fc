"""Whitening: every frequency gets the same weight, so that no loud tone or resonance drowns the rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.fft import irfft, rfft

from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import Band


def by_cepstrum(stretch: Stretch, settings: MonitorSettings) -> Stretch:
    """Divide the spectrum of each axis by its magnitude: cepstrum pre-whitening.

    Only the phase is left, as when the real cepstrum is set to zero. Tones of wheel, drive and mains weigh as
    little as any line of noise then, however loud they are, and what comes in bursts stays a burst. Of
    several axes each counts as much as the others.

    References
    ----------
    Borghesani, Pennacchi, Randall, Sawalhi, Ricci (2013), Application of cepstrum pre-whitening for the
    diagnosis of bearing faults under variable speed conditions, Mech. Syst. Signal Process. 36, section 2.
    """
    count = len(stretch.acceleration)
    weighted = (stretch.acceleration - stretch.acceleration.mean(axis=0)) * stretch.ramp[:, None]
    spectrum = rfft(weighted, axis=0)
    magnitude = np.abs(spectrum)
    spectrum /= np.where(magnitude > 0.0, magnitude, 1.0)
    white = np.asarray(irfft(spectrum, count, axis=0), np.float64) * np.sqrt(count)
    return replace(stretch, acceleration=white)


def not_whitened(stretch: Stretch, settings: MonitorSettings) -> Stretch:
    """Leave the stretch as it is."""
    return stretch


def whole_band(stretch: Stretch, settings: MonitorSettings) -> Band:
    """Listen to all that the signal holds: from what is left to the track up to where filters cut off."""
    low, high = settings.whole_band
    return Band(low, min(high, settings.usable_share * stretch.rate))

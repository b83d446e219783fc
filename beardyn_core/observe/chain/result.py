"""Result of a monitoring algorithm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from beardyn_core.observe.chain.fault_lines import Line
from beardyn_core.observe.features import OrderSpectrum

VERDICTS = ("waiting", "healthy", "cup", "cone", "roller", "hot_box")


@dataclass(frozen=True)
class MonitorResult:
    """Result of the monitor at one time; an algorithm sets the fields that it computes.

    Parameters
    ----------
    verdict : str
        ``waiting`` (not enough signal yet), ``healthy``, ``cup``, ``cone``, ``roller`` or ``hot_box``.
    reason : str
        The verdict in a sentence.
    end_ns : int
        Simulated time of the last sample analysed, [ns].
    fault_order, fault_frequency : float
        Found, NaN without a fault, per shaft revolution and [Hz].
    expected_order, expected_frequency : float
        Of that fault from geometry, [-], [Hz].
    score : float
        Of the strongest candidate, [dB].
    threshold : float
        Score from which it is called, [dB].
    scores : tuple of 3 floats
        For cup, cone and roller, [dB].
    lines : tuple of Line
        Lines of the strongest candidate that stand out one by one.
    strongest_order, strongest_level : float
        Strongest line above the cage's own, [-], [dB].
    band : tuple of 2 floats
        Of the envelope, [Hz].
    rms, kurtosis, crest : float
        Levels in the usual band, [m/s^2], [-], [-].
    rms_rise : float
        Over earlier stretches at a like speed, NaN without, [dB].
    shaft_frequency : float
        Mean, [Hz].
    revolutions : float
        Shaft revolutions analysed, [-].
    load : float
        Mean vertical load, [N].
    temperature : float
        Of the axlebox, NaN when unknown, [K].
    temperature_state : str
        ``unknown``, ``normal``, ``warm`` or ``hot``.
    spectrum : OrderSpectrum or None
        Of the envelope.
    """

    verdict: str
    reason: str
    end_ns: int
    fault_order: float = np.nan
    fault_frequency: float = np.nan
    expected_order: float = np.nan
    expected_frequency: float = np.nan
    score: float = 0.0
    threshold: float = np.nan
    scores: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lines: tuple[Line, ...] = ()
    strongest_order: float = np.nan
    strongest_level: float = np.nan
    band: tuple[float, float] = (np.nan, np.nan)
    rms: float = np.nan
    kurtosis: float = np.nan
    crest: float = np.nan
    rms_rise: float = np.nan
    shaft_frequency: float = np.nan
    revolutions: float = 0.0
    load: float = np.nan
    temperature: float = np.nan
    temperature_state: str = "unknown"
    spectrum: OrderSpectrum | None = None

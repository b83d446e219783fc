"""What repeats with the passages of a fault: harmonics of the envelope, and the echo of entry and exit."""

from __future__ import annotations

from math import log10, nan

import numpy as np

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.passage_order import band_envelope
from beardyn_core.monitor.severity import events_of, spacing_of

BANDS = {"low": (500.0, 2500.0), "high": (2500.0, 11000.0)}  # of the envelope, [Hz]
HARMONICS = tuple(range(1, 25))  # of the passages
WAYS = tuple(float(way) for way in np.geomspace(0.6e-3, 14e-3, 24))  # from entry to exit, [m]
NAMES = (
    *(f"harmonic_{band}_{k}" for band in BANDS for k in HARMONICS),
    *(f"echo_{1e3 * way:.2f}" for way in WAYS),
)
_LEAST_LEVEL = 1e-12  # of a harmonic, relative: below it is silence


def of_passages(stretch: Stretch, part: str, order: float, plate: NamePlate) -> dict[str, float]:
    """Work out what repeats with the passages of a fault.

    Parameters
    ----------
    stretch : Stretch
        In which the shaft turns one way.
    part : str
        ``cup`` or ``cone``.
    order : float
        Passages per revolution of the shaft, as found.
    plate : NamePlate

    Returns
    -------
    dict
        By `NAMES`: each harmonic over all of them together, [dB]; how far each way stands out of the
        cepstrum of the passages, as a logarithm, NaN where nothing is to be worked out.

    Notes
    -----
    A roller strikes when it enters a spall and when it leaves it. Of two bursts in each passage the harmonics
    of the envelope rise and fall with their number by the share of the passage that lies between, at any
    level, in any box.
    """
    passed = stretch.shaft_angle * order / (2.0 * np.pi)
    turned = np.exp(-2j * np.pi * passed)
    found = {}
    for band, (low, high) in BANDS.items():
        envelope = band_envelope(stretch.acceleration, stretch.rate, low, high)
        line = (envelope - envelope.mean()) * np.hanning(len(envelope)) + 0j
        lines = np.array([abs((line := line * turned).mean()) for _ in HARMONICS])
        whole = float(np.sqrt(np.sum(lines**2)))
        for k, height in zip(HARMONICS, lines, strict=True):
            share = float(height) / whole if whole > 0.0 else 0.0
            found[f"harmonic_{band}_{k}"] = 20.0 * log10(max(share, _LEAST_LEVEL))
    events = events_of(stretch.acceleration, stretch.rate, passed, spacing_of(part, plate))
    heights = np.full(len(WAYS), nan)
    if events is not None and len(events.way) and float(np.median(events.height)) > 0.0:
        heights = np.interp(WAYS, events.way, events.height / float(np.median(events.height)))
    logarithm = np.log(np.maximum(heights, _LEAST_LEVEL))
    found |= {f"echo_{1e3 * way:.2f}": float(each) for way, each in zip(WAYS, logarithm, strict=True)}
    return found

"""The mean envelope over one passage of a fault, and its correlations: the shape of entry and exit."""

from __future__ import annotations

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.passage_order import band_envelope
from beardyn_core.monitor.severity import spacing_of

BANDS = {"low": (500.0, 2500.0), "high": (2500.0, 11000.0), "top": (6000.0, 11500.0)}  # [Hz]
LAGS = tuple(float(lag) for lag in np.arange(0.5e-3, 20e-3, 0.5e-3))  # from entry to exit, [m]
PLACES = tuple(float(place) for place in np.arange(-19e-3, 19.5e-3, 1e-3))  # around the loudest place, [m]
CROSSED = ("low", "high")  # bands that are correlated with each other: the entry is low, the exit is high
KINDS = ("envelope", "logarithm")
_STEPS = 256  # of a passage
_SMOOTHED = 8  # steps over which the loudest place is looked for
_FLOOR = 1e-9  # [m/s^2]
_FEWEST = 8  # passages
NAMES = (
    *(f"repeat_{band}_{kind}_{1e3 * lag:.1f}" for band in BANDS for kind in KINDS for lag in LAGS),
    *(f"near_{band}_{1e3 * lag:.1f}" for band in BANDS for lag in LAGS),
    *(f"profile_{band}_{kind}_{1e3 * place:.0f}" for band in BANDS for kind in KINDS for place in PLACES),
    *(f"crossed_{1e3 * place:.0f}" for place in PLACES),
)


def profile_of(stretch: Stretch, part: str, order: float, plate: NamePlate) -> dict[str, float]:
    """Work out the mean envelope over a passage in three bands, and its correlations.

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
        By `NAMES`, NaN of fewer than 8 passages. ``repeat``: correlation of the mean passage with itself;
        ``near``: correlation of the logarithm of the whole stretch with itself, which no drift of the order
        blurs; ``profile``: mean passage around the loudest place of the high band, over its largest value;
        ``crossed``: correlation of the low and the high band.

    Notes
    -----
    All are of the way on the raceway, so that they say the same at any speed. The mean passage goes round:
    a spall of nearly the distance of two rollers repeats as a narrow one does. The profile and the crossed
    correlation know before from after, as the roller enters softly and leaves hard.
    """
    spacing = spacing_of(part, plate)
    passed = stretch.shaft_angle * order / (2.0 * np.pi)
    first = np.ceil(passed[0])
    passages = int(passed[-1] - first)
    if passages < _FEWEST:
        return dict.fromkeys(NAMES, float("nan"))
    grid = first + np.arange(passages * _STEPS) / _STEPS
    way = np.arange(_STEPS) / _STEPS * spacing
    found, means = {}, {}
    for band, limits in BANDS.items():
        envelope = np.interp(grid, passed, band_envelope(stretch.acceleration, stretch.rate, *limits))
        logarithm = np.log(np.maximum(envelope, _FLOOR))
        for kind, values in zip(KINDS, (envelope, logarithm), strict=True):
            mean = values.reshape(passages, _STEPS).mean(axis=0)
            means[band, kind] = mean - mean.mean()
            circle = _correlate_passages(means[band, kind], means[band, kind])
            for lag, value in zip(LAGS, np.interp(LAGS, way, circle, period=spacing), strict=True):
                found[f"repeat_{band}_{kind}_{1e3 * lag:.1f}"] = float(value)
        near = _near(logarithm)
        for lag, value in zip(LAGS, np.interp(LAGS, way, near), strict=True):
            found[f"near_{band}_{1e3 * lag:.1f}"] = float(value)
    loud = np.convolve(np.tile(means["high", "envelope"], 2), np.ones(_SMOOTHED) / _SMOOTHED, "same")
    loudest = way[(int(np.argmax(loud[_STEPS // 2 : 3 * _STEPS // 2])) + _STEPS // 2) % _STEPS]
    for (band, kind), mean in means.items():
        largest = max(float(np.abs(mean).max()), _FLOOR)
        around = np.interp(np.array(PLACES) + loudest, way, mean / largest, period=spacing)
        for place, value in zip(PLACES, around, strict=True):
            found[f"profile_{band}_{kind}_{1e3 * place:.0f}"] = float(value)
    one, other = (means[band, "envelope"] for band in CROSSED)
    for place, value in zip(
        PLACES, np.interp(PLACES, way, _correlate_passages(one, other), period=spacing), strict=True
    ):
        found[f"crossed_{1e3 * place:.0f}"] = float(value)
    return {name: found[name] for name in NAMES}


def _correlate_passages(one: Float, other: Float) -> Float:
    """Correlate two mean passages around the circle, 1 for the same shape in the same place."""
    size = max(float(np.linalg.norm(one) * np.linalg.norm(other)), _FLOOR**2)
    return np.asarray(irfft(np.conj(rfft(one)) * rfft(other), len(one)), np.float64) / size


def _near(values: Float) -> Float:
    """Correlate a whole stretch with itself over lags up to a passage, shape [step]."""
    centred = values - values.mean()
    padded = next_fast_len(2 * len(centred), real=True)
    found = irfft(np.abs(rfft(centred, padded)) ** 2, padded)[:_STEPS]
    return np.asarray(found, np.float64) / max(float(found[0]), _FLOOR**2)

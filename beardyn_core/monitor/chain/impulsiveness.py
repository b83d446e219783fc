"""How much of the power in the signal as measured comes in strikes: what lines beyond the loudest make."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain.fault_lines import Candidate, FaultLines
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import Band
from beardyn_core.monitor.chain.tracking import by_angle
from beardyn_core.monitor.chain.wheel import quiet_samples
from beardyn_core.monitor.features import OrderSpectrum, local_background, order_spectrum

_NOISE = 1.5  # what the highest place within a resolution is over the median of noise


def with_strikes(found: FaultLines, stretch: Stretch, band: Band, settings: MonitorSettings) -> FaultLines:
    """Measure how much each candidate strikes, in the whole band as measured and in each octave of it.

    Notes
    -----
    A strike is short against the time to the next, so that its power has many harmonics of like amplitude.
    What comes and goes slowly, as the load of rollers that enter the load zone, and the noise of rough
    surfaces with it, has one harmonic, and next to nothing is left without it.

    A loud tone or track fills the whole band, but not every octave.

    Orders of parts are near simple ratios: three times BPFI is four times BPFO in many bearings. Lines that
    belong to a part with more evidence do not count for the others.
    """
    found = _measured_in(found, stretch, (band.low, band.high), settings)
    sure = any(each.score >= each.threshold for each in (*found.candidates, *found.elsewhere, *found.turned))
    octaves = settings.strike_bands if sure or found.combs else ()
    for low, high in octaves:
        high = min(high, settings.usable_share * stretch.rate)
        if high - low >= settings.orders_in_band * stretch.shaft_frequency:
            found = _sharper(found, _measured_in(found, stretch, (low, high), settings))
    return found


def _sharper(found: FaultLines, here: FaultLines) -> FaultLines:
    """Keep for each candidate the octave where it strikes most."""
    strikes = iter([each.strikes for each in here.every])
    return found.with_each(lambda each: replace(each, sharpest=max(each.sharpest, next(strikes))))


def _measured_in(
    found: FaultLines, stretch: Stretch, band: tuple[float, float], settings: MonitorSettings
) -> FaultLines:
    """Measure the strikes of the candidates in a band [Hz], where the wheel does not strike."""
    power = stretch.squared_envelope(band)
    mean = float(np.mean(np.where(quiet_samples(stretch, settings), power, 0.0)[stretch.inner]))
    if not mean > 0.0:
        return found
    highest = max(each.places(settings.strike_harmonics).max() for each in found.every) + 1.0
    tracked = by_angle(power, stretch, settings)
    spectrum = order_spectrum(tracked, settings.samples_per_revolution, highest, settings.background_width)
    noise = local_background(spectrum.amplitude, settings.background_width / spectrum.order[1])
    surest = max(found.candidates, key=lambda candidate: candidate.evidence)

    def with_strikes_of(each: Candidate) -> Candidate:
        surer = surest if each in found.candidates and each is not surest else None
        return replace(each, strikes=_strikes(each, surer, spectrum, noise, settings) / mean)

    measured = found.with_each(with_strikes_of)
    return replace(measured, deepest=float(spectrum.amplitude.max()) / mean)


def _strikes(
    candidate: Candidate,
    surer: Candidate | None,
    spectrum: OrderSpectrum,
    noise: Float,
    settings: MonitorSettings,
) -> float:
    """Compute what the harmonics but the loudest make, with their sidebands, in the unit of the spectrum."""
    step = spectrum.order[1]
    reach = max(1, round(spectrum.resolution / step))
    places = candidate.places(settings.strike_harmonics)
    index = np.minimum(np.rint(places / step).astype(int), len(noise) - 1)
    around = np.clip(index[:, None] + np.arange(-reach, reach + 1), 0, len(noise) - 1)
    power = spectrum.amplitude[around].max(axis=1) ** 2 - (_NOISE * noise[index]) ** 2
    if surer is not None:
        power[surer.explains(places, spectrum.resolution)] = 0.0
    harmonics = np.maximum(power, 0.0)
    if not candidate.pattern.cage:
        harmonics = harmonics.reshape(settings.strike_harmonics, -1).sum(axis=1)
    return float(np.sqrt(harmonics.sum() - harmonics.max()))

"""How loud a fault is: what comes and goes on its lines, in the signal as it was measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.observe.chain.fault_lines import FaultLines
from beardyn_core.observe.chain.inputs import MonitorSettings, Stretch
from beardyn_core.observe.chain.kurtogram import Band
from beardyn_core.observe.chain.wheel import quiet_samples
from beardyn_core.observe.features import order_spectrum


def with_loudness(
    found: FaultLines, tracked: Float, stretch: Stretch, band: Band, settings: MonitorSettings
) -> FaultLines:
    """Measure the candidates in the squared envelope of a band that was not whitened, tracked `by_angle`.

    The burst of a candidate is the fourth root of the mean square of its lines but the strongest. Beside it
    stands the mean power in the band where the wheel does not strike.
    """
    power = stretch.squared_envelope((band.low, band.high))
    spectrum = order_spectrum(
        tracked, settings.samples_per_revolution, float(found.spectrum.order[-1]), settings.background_width
    )
    beside = np.where(quiet_samples(stretch, settings), power, 0.0)[stretch.inner]

    def burst(places: Float) -> float:
        index = np.minimum(np.rint(places / spectrum.order[1]).astype(int), len(spectrum.order) - 1)
        return float(np.mean(np.sort(spectrum.amplitude[index] ** 2)[:-1]) ** 0.25)

    candidates = tuple(
        replace(each, burst=burst(each.places(settings.harmonics))) for each in found.candidates
    )
    mean = float(np.mean(beside))
    deepest = float(spectrum.amplitude.max()) / mean if mean > 0.0 else 0.0
    return replace(found, candidates=candidates, power=mean, deepest=deepest)

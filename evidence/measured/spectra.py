"""Other spectra than the chain's, on the part for choosing: ``python -m evidence.measured.spectra``.

What each finds in the first analyses of the records of Y1 and Y2, 12 kHz, drive end, and of the healthy
bearings beside. Thresholds of sums of exponentials do not hold for spectra that are averages over carriers,
so all are judged alike, without one: a part is called when its lines stand out of the same pattern laid at
orders where no fault is, by more than `OUT` standard deviations and further than any of these.

Coherence is the spectrum over time of the power of each carrier, over its mean, summed over the carriers
(after the improved envelope spectrum; Antoni, Xin, Hamzaoui 2017, Mech. Syst. Signal Process. 92). With
bands, the four neighbouring carriers are taken in which a part stands out most (the idea of the IESFOgram;
Mauricio and others 2020, Mech. Syst. Signal Process. 144). The autogram's band is that of the largest
kurtosis of the autocorrelation of the squared envelope (Moshrefzadeh, Fasana 2018, Mech. Syst. Signal
Process. 105). Blind deconvolution (`evidence.measured.cycbd`) is aimed at each part in turn; then also at
orders where no fault is, so that each pattern of the comparison has the filter that favours it.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.chain.fault_lines import FAULTS, Pattern, fault_patterns
from beardyn_core.monitor.chain.tracking import by_angle, logarithm_by_angle
from beardyn_core.monitor.chain.whitening import by_cepstrum, whole_band
from beardyn_core.monitor.features import local_background, order_spectrum
from evidence.measured.cases import CWRU_12_DRIVE, Listening, listenings, records
from evidence.measured.cycbd import deconvolved
from evidence.measured.run import verdicts_of

OUT = 6.0  # standard deviations
GRADES = ("Y1", "Y2")
SECONDS, INTERVAL = 5.2, 2.0  # of a record, and between its analyses
FRAME, HOP, TOGETHER, STRIDE = 64, 8, 4, 3  # samples of a carrier's frame; carriers of a band
BESIDE = np.concatenate([np.linspace(0.78, 0.95, 12), np.linspace(1.05, 1.22, 12)])  # of a fault's order
AIMED_BESIDE = BESIDE[1::3]  # at which blind deconvolution is aimed as well
HIGHEST, WIDTH = 1.22, 3.0


class Spectrum(NamedTuple):
    """Power over its local median, for orders that are evenly spaced."""

    power: Float
    step: float
    resolution: float


class Standing(NamedTuple):
    """How far each part stands out, and the furthest of the patterns where no fault is."""

    parts: Float
    null: float

    @property
    def lead(self) -> float:
        """How much further the best part is."""
        return float(self.parts.max()) - self.null

    @property
    def called(self) -> str:
        """The part, '' without one."""
        found = self.parts.max() > max(self.null, OUT)
        return FAULTS[int(self.parts.argmax())] if found else ""


def over_median(amplitude: Float, step: float, resolution: float) -> Spectrum:
    """Compare power with its local median, and leave out the whole orders."""
    background = np.maximum(local_background(amplitude, WIDTH / step), 1e-300)
    order = step * np.arange(len(amplitude))
    beside = np.abs(order - np.round(order)) > 2.0 * resolution
    return Spectrum(np.where(beside, (amplitude / background) ** 2, 0.0), step, resolution)


def standing(spectrum: Spectrum, orders: FaultFrequencies, settings: MonitorSettings) -> Standing:
    """Lay the pattern of each part at its order and at those beside, each within the tolerance."""
    parts, nulls = [], []
    for pattern in fault_patterns(orders):
        null = np.array([laid(pattern, spectrum, share * pattern.order, settings) for share in BESIDE])
        parts.append((laid(pattern, spectrum, pattern.order, settings) - null.mean()) / null.std())
        nulls.append((null.max() - null.mean()) / null.std())
    return Standing(np.array(parts), max(nulls))


def laid(pattern: Pattern, spectrum: Spectrum, order: float, settings: MonitorSettings) -> float:
    """Add the lines of a pattern but the strongest at the best place near an order."""
    lines = np.array(pattern.lines(settings.harmonics))
    half = settings.tolerance * order
    trial = np.arange(order - half, order + half, 0.25 * spectrum.resolution / settings.harmonics)
    index = np.rint((trial[:, None] * lines[:, 0] + pattern.sideband * lines[:, 1]) / spectrum.step)
    power = spectrum.power[np.minimum(index.astype(int), len(spectrum.power) - 1)]
    return float((power.sum(axis=1) - power.max(axis=1)).max())


def aimed(
    stretch: Stretch, orders: FaultFrequencies, settings: MonitorSettings
) -> Iterator[tuple[str, Standing]]:
    """Compute how far the parts stand out behind blind deconvolution, aimed at them, and beside them too."""
    band = whole_band(stretch, settings)
    highest = settings.harmonics * HIGHEST * max(orders.bpfi, 2.0 * orders.bsf) + 6.0

    def behind(order: float) -> Spectrum:
        filtered = replace(stretch, acceleration=deconvolved(stretch, order, settings))
        tracked = by_angle(filtered.squared_envelope((band.low, band.high)), stretch, settings)
        return tracked_spectrum(tracked, highest, settings)

    patterns = fault_patterns(orders)
    spectra = [behind(pattern.order) for pattern in patterns]
    each = [standing(spectrum, orders, settings) for spectrum in spectra]
    own = np.array([one.parts[index] for index, one in enumerate(each)])
    yield "CYCBD, aimed at each part", Standing(own, max(one.null for one in each))
    parts, nulls = [], []
    for pattern, spectrum in zip(patterns, spectra, strict=True):
        places = AIMED_BESIDE * pattern.order
        null = np.array([laid(pattern, behind(place), place, settings) for place in places])
        parts.append((laid(pattern, spectrum, pattern.order, settings) - null.mean()) / null.std())
        nulls.append((null.max() - null.mean()) / null.std())
    yield "CYCBD, aimed beside as well", Standing(np.array(parts), max(nulls))


def tracked_spectrum(tracked: Float, highest: float, settings: MonitorSettings) -> Spectrum:
    """Compute the spectrum of power over equal steps of the shaft angle."""
    found = order_spectrum(tracked, settings.samples_per_revolution, highest, WIDTH)
    return over_median(found.amplitude, found.order[1], found.resolution)


def carriers(stretch: Stretch, highest: float, settings: MonitorSettings) -> list[Spectrum]:
    """Compute the spectrum of the power of each carrier in the first axis, at a constant speed."""
    signal, low = stretch.acceleration[:, 0], settings.whole_band[0]
    frames = np.lib.stride_tricks.sliding_window_view(signal, FRAME)[::HOP] * np.hanning(FRAME)
    power = np.abs(np.fft.rfft(frames, axis=1)) ** 2
    power = power[:, max(1, int(low / stretch.rate * FRAME)) : int(settings.usable_share * FRAME)]
    power = power / power.mean(axis=0) - 1.0
    padded = 1 << int(np.ceil(np.log2(4 * len(power))))
    amplitude = np.abs(np.fft.rfft(power * np.hanning(len(power))[:, None], padded, axis=0))
    step = stretch.rate / HOP / padded / stretch.shaft_frequency
    kept = amplitude[: int(highest / step)]
    return [over_median(each, step, 1.0 / stretch.revolutions) for each in kept.T]


def together(spectra: Sequence[Spectrum]) -> Spectrum:
    """Average the spectra of carriers."""
    return spectra[0]._replace(power=np.mean([each.power for each in spectra], axis=0))


def autogram_band(stretch: Stretch, settings: MonitorSettings) -> tuple[float, float]:
    """Choose among halves, quarters and eighths that with the largest kurtosis of the autocorrelation."""
    top, half = settings.usable_share * stretch.rate, 0.5 * stretch.rate
    found = []
    for count in (2, 4, 8):
        for part in range(count):
            low, high = part * half / count, min((part + 1) * half / count, top)
            if low >= settings.whole_band[0] and high > low + 0.5 * half / count:
                power = stretch.squared_envelope((low, high))[stretch.inner]
                spectrum = np.abs(np.fft.rfft(power - power.mean(), 2 * len(power))) ** 2
                first = int(stretch.rate / stretch.shaft_frequency / 30.0)
                like = np.fft.irfft(spectrum)[first : len(power) // 2]
                like = like - like.min()
                found.append((np.mean(like**4) / np.mean(like**2) ** 2, (low, high)))
    return max(found)[1]


def standings(
    stretch: Stretch, orders: FaultFrequencies, settings: MonitorSettings
) -> Iterator[tuple[str, Standing]]:
    """Compute how far the parts stand out in every spectrum."""
    white = by_cepstrum(stretch, settings)
    band = whole_band(stretch, settings)
    highest = settings.harmonics * HIGHEST * max(orders.bpfi, 2.0 * orders.bsf) + 6.0

    def of(tracked: Float) -> Standing:
        return standing(tracked_spectrum(tracked, highest, settings), orders, settings)

    power = white.squared_envelope((band.low, band.high))
    yield "log envelope, whitened (the chain's)", of(logarithm_by_angle(power, stretch, settings))
    yield (
        "squared envelope, autogram's band",
        of(by_angle(stretch.squared_envelope(autogram_band(stretch, settings)), stretch, settings)),
    )
    for name, received in (("coherence", stretch), ("coherence, whitened", white)):
        every = carriers(received, highest, settings)
        yield name, standing(together(every), orders, settings)
        starts = range(0, len(every) - TOGETHER + 1, STRIDE)
        bands = [standing(together(every[k : k + TOGETHER]), orders, settings) for k in starts]
        yield f"{name}, band by fault lines", max(bands, key=lambda each: each.lead)
    yield from aimed(stretch, orders, settings)


def received_by_all(listening: Listening) -> list[dict[str, Standing]]:
    """Analyse the beginning of a record in every spectrum."""
    found: list[dict[str, Standing]] = []

    def listen(
        stretch: Stretch, orders: FaultFrequencies, roller_count: int, settings: MonitorSettings
    ) -> MonitorResult:
        found.append(dict(standings(stretch, orders, settings)))
        return MonitorResult("healthy", "", stretch.end_ns)

    begin = replace(listening, acceleration=listening.acceleration[: int(SECONDS * listening.rate)])
    verdicts_of(begin, listen, MonitorSettings(interval=INTERVAL))
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Hear the records and print right, wrong and missed analyses of each spectrum."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--cwru", type=Path, required=True, metavar="FOLDER", help="with its .mat files")
    folder = parser.parse_args(arguments).cwru
    counts: dict[str, Counter[str]] = {}
    for record in records(folder):
        if record.group == CWRU_12_DRIVE and record.grade in GRADES:
            print(record.name, file=sys.stderr)
            for listening in listenings(record):
                for analysis in received_by_all(listening):
                    for name, each in analysis.items():
                        outcome = _outcome(listening.part, each.called)
                        counts.setdefault(name, Counter())[outcome] += 1
    print("| spectrum | right | wrong | missed | beside, alarms | beside |\n|---|--:|--:|--:|--:|--:|")
    for name, count in counts.items():
        beside = count["alarm"] + count["quiet"]
        cells = (count["right"], count["wrong"], count["missed"], count["alarm"], beside)
        print(f"| {name} | {' | '.join(map(str, cells))} |")
    return 0


def _outcome(part: str, called: str) -> str:
    """Name what was said of a bearing whose part is faulty, '' when it is sound."""
    if not part:
        return "alarm" if called else "quiet"
    return "right" if called == part else "wrong" if called else "missed"


if __name__ == "__main__":
    raise SystemExit(main())

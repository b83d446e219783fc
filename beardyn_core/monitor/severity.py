"""Severity: how wide a spall is that was found, from the two events of a roller that enters and leaves it."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, nan, pi
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.passage_order import band_envelope, find_passage_order

NOT_MEASURABLE, INCIPIENT, DEVELOPED, SEVERE = "not measurable", "incipient", "developed", "severe"
# a roller gives up and takes up its load this far inside of the edges (docs/evidence/impact.md), [m]
ENTRY_AND_EXIT = 1.1e-3
_LEAST_ROLLER = 15e-3  # of a roller for which that was found, [m]
_DEVELOPED_FROM = 4e-3  # [m]
_SEVERE_SHARE = 0.5  # of the distance of two rollers
_WIDEST = 40e-3  # spall that may be there, twice the width at which a bearing is taken out, [m]
# half of the 95 % interval: of the relation and the sampling, and of the way
_DOUBT, _RELATIVE_DOUBT = 0.4e-3, 0.04
_LOWEST, _HIGHEST_SHARE = 1500.0, 0.45  # of the band, [Hz] and of the sampling rate
_LEAST_PASSAGES = 40
_PROFILE = 256  # steps of a passage
_BEFORE, _WITH = 0.35, 0.8  # of a passage: how long before its loudest place, how long in all
_BESIDE, _WITHOUT = 0.5, 0.35  # the same of the part that has no event
_SPECTRUM, _CEPSTRUM = 4096, 8192
# of the part without an event, over that of the passage: how uneven its spectrum is; else it is noise alone
_LEAST_STRUCTURE = 0.5
_SHORTEST_WAY = 0.6e-3  # [m]
_SHORTEST_S = 0.32e-3  # between two events; what modes of a box leave beats faster
_SEARCHED = 0.45  # of a passage
_LONGEST_SHARE = 0.3  # of a passage: a longer way needs more than there is between two passages
_STANDS_OUT = 4.0  # times the median of the cepstrum
_CLEAR = 1.25  # times the next peak that is no multiple
_MULTIPLE = 0.12  # within which a peak is twice another, relative
_AROUND = 6  # steps of the profile around an event in which its power is looked for
_RINGS = 2.0  # times the power before the loudest event that the one behind it has, else it is its ringing
_SMOOTHED = 5  # steps of the profile that are averaged


@dataclass(frozen=True)
class Severity:
    """How much a fault matters."""

    grade: A[str, "``incipient``, ``developed``, ``severe``, or ``not measurable``"]
    width: A[float, "of the spall in rolling direction, NaN where not measurable, [m]"]
    low: A[float, "lower end of its 95 % interval, also where only the least width is known, [m]"]
    high: A[float, "upper end, NaN where only the least width is known, [m]"]
    reason: A[str, "the same in a sentence"]


class Events(NamedTuple):
    """Cepstrum of the passages over a fault."""

    way: Float  # shape [line], [m]
    height: Float  # shape [line]
    shortest: float  # that the modes of a box are not taken for, [m]
    longest: float  # [m]
    profile: Float = np.empty(0)  # shape [step], mean squared envelope over a passage, from its loudest place


def severity_near(
    acceleration: Float, rate: float, shaft_angle: Float, fault: str, found_order: float, plate: NamePlate
) -> Severity:
    """Measure a spall as `severity_of` does, from an order that is known to about 1 %.

    Parameters
    ----------
    found_order : float
        Passages of the fault per revolution of the shaft, of an analysis or of the bearing data, [-].
    """
    order = found_order
    if fault in ("cup", "cone"):
        order = find_passage_order(acceleration, rate, shaft_angle, found_order)
    return severity_of(acceleration, rate, shaft_angle, fault, order, plate)


def severity_of(
    acceleration: Float, rate: float, shaft_angle: Float, fault: str, order: float, plate: NamePlate
) -> Severity:
    """Measure a spall of the cup or the cone.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        Of a stretch in which the shaft turns steadily, [m/s^2].
    rate : float
        [Hz].
    shaft_angle : float64 array, shape [sample]
        Increasing, [rad].
    fault : str
        ``cup`` or ``cone``; of a roller nothing is measured.
    order : float
        Passages of the fault per revolution of the shaft, as found, [-].
    plate : NamePlate

    Notes
    -----
    Entry and exit strike the same structure twice, so the logarithm of the mean spectrum of a passage has a
    ripple of one over the time between; in its cepstrum that is a peak at this time. What the structure
    itself has of peaks is in the part of the passage without an event, too, and is taken away; so the noise
    of rolling must show the structure there, else nothing is measured: a mode would be taken for a second
    event. The time over that of a passage is the way over the distance of two rollers on the raceway, at
    any speed.

    The width is the way and 1.1 mm: a roller gives up its load 0.6 mm behind the leading edge and takes it up
    as much before the trailing one, over spalls from 3 mm on (docs/evidence/impact.md). Smaller ones make one
    event. The loudest event is the exit, so that of a spall narrower than half of the distance of two rollers
    the other event lies before it. The event that follows the loudest one is either the exit of a spall whose
    entry is louder, or the entry of the next roller into a wide spall: then the least width alone is stated.

    A spall wider than the distance of two rollers strikes as one that is narrower by this distance. Where
    the wider one would be 40 mm wide or less, as on the cone of an axlebox, the least width alone is stated.

    A spall from 4 mm on is *developed*, one wider than half of the distance of two rollers *severe*. Both
    limits are assumed: which size a vehicle may run with is its keeper's decision.

    References
    ----------
    Sawalhi, Randall (2011), Vibration response of spalled rolling element bearings, Mech. Syst. Signal
    Process. 25: the two events, pre-whitening and the cepstrum of them.
    """
    if fault not in ("cup", "cone"):
        return unmeasured(f"the width of a spall is measured on cup and cone, not on {fault}")
    if not plate.has_dimensions:
        return unmeasured(
            "the bearing data are maker's factors; give roller_count, roller_diameter_mm and "
            "pitch_diameter_mm, from which the distance of two rollers follows"
        )
    if plate.roller_diameter < _LEAST_ROLLER:
        return unmeasured(
            "the two strikes of a spall give its width with rolling elements of "
            f"{1e3 * _LEAST_ROLLER:g} mm or more; these have {1e3 * plate.roller_diameter:.3g} mm"
        )
    if plate.has_barrels:
        return unmeasured("the two strikes of a spall give its width in line contacts, not with barrels")
    spacing = spacing_of(fault, plate)
    events = events_of(acceleration, rate, shaft_angle * order / (2.0 * pi), spacing)
    if events is None:
        return unmeasured(f"fewer than {_LEAST_PASSAGES} passages of the fault")
    way = _clear_peak(events)
    if not isfinite(way):
        return unmeasured(
            "no second event stands out: a small spall, one that is worn round, one wider than "
            f"{1e3 * (events.longest + ENTRY_AND_EXIT):.0f} mm, or a noisy sensor"
        )
    width, doubt = way + ENTRY_AND_EXIT, _DOUBT + _RELATIVE_DOUBT * way
    if _follows(events, way / spacing):
        least, wide = width - doubt, spacing - way + ENTRY_AND_EXIT
        return Severity(
            NOT_MEASURABLE, nan, least, nan,
            f"{NOT_MEASURABLE}: at least {1e3 * least:.1f} mm wide; the second event follows the loudest "
            f"one, so that the spall is {1e3 * width:.1f} or {1e3 * wide:.1f} mm wide",
        )  # fmt: skip
    if width - doubt + spacing <= _WIDEST:
        least = width - doubt
        return Severity(
            NOT_MEASURABLE, nan, least, nan,
            f"{NOT_MEASURABLE}: at least {1e3 * least:.1f} mm wide; a spall of {1e3 * width:.1f} mm and one "
            f"wider by the distance of two rollers, {1e3 * spacing:.1f} mm, strike alike",
        )  # fmt: skip
    _, severe = grade_limits(fault, plate)
    grade = INCIPIENT if width < _DEVELOPED_FROM else DEVELOPED if width < severe else SEVERE
    low, high = width - doubt, width + doubt
    return Severity(
        grade, width, low, high,
        f"{grade}: {1e3 * width:.1f} mm wide ({1e3 * low:.1f} to {1e3 * high:.1f}), entry and exit are "
        f"{1e3 * way:.1f} mm apart; developed from {1e3 * _DEVELOPED_FROM:g} mm, severe from "
        f"{1e3 * severe:.0f} mm",
    )  # fmt: skip


def narrow_width(
    acceleration: Float, rate: float, shaft_angle: Float, fault: str, order: float, plate: NamePlate
) -> float:
    """Measure a spall as if it were narrower than half of the distance of two rollers, NaN without, [m].

    Parameters are those of `severity_of`; a wide spall can give the same width.
    """
    if plate.roller_diameter < _LEAST_ROLLER:
        return nan
    spacing = spacing_of(fault, plate)
    events = events_of(acceleration, rate, shaft_angle * order / (2.0 * pi), spacing)
    way = nan if events is None else _clear_peak(events)
    if events is None or not isfinite(way) or _follows(events, way / spacing):
        return nan
    return way + ENTRY_AND_EXIT


def unmeasured(reason: str) -> Severity:
    """State why the size of a spall cannot be given."""
    return Severity(NOT_MEASURABLE, nan, nan, nan, f"{NOT_MEASURABLE}: {reason}")


def grade_limits(fault: str, plate: NamePlate) -> tuple[float, float]:
    """Give the widths from which a spall of cup or cone is developed, and severe, [m]; both are assumed."""
    return _DEVELOPED_FROM, _SEVERE_SHARE * spacing_of(fault, plate)


def spacing_of(fault: str, plate: NamePlate) -> float:
    """Compute the distance of two rollers on the raceway of cup or cone, [m]."""
    sign = 1.0 if fault == "cup" else -1.0
    across = sign * plate.roller_diameter * float(np.cos(plate.contact_angle))
    return pi * (plate.pitch_diameter + across) / plate.roller_count


def events_of(acceleration: Float, rate: float, passed: Float, spacing: float) -> Events | None:
    """Compute the cepstrum of passages, less that of their parts without an event.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    rate : float
        [Hz].
    passed : float64 array, shape [sample]
        Passages so far; their whole part counts them.
    spacing : float
        Distance of two rollers on the raceway, [m].

    Returns
    -------
    Events or None
        Without lines where noise alone fills the passages; none of fewer than 40 passages.
    """
    count = len(acceleration)
    lines, frequency = np.fft.rfft(acceleration, axis=0), np.fft.rfftfreq(count, 1.0 / rate)
    high = _HIGHEST_SHARE * rate
    inside = (frequency > _LOWEST) & (frequency < high)
    received = np.fft.irfft(lines * inside[:, None], count, axis=0)
    first, last = int(passed[0]) + 1, int(passed[-1]) - 1
    if last - first < _LEAST_PASSAGES:
        return None
    place = (passed % 1.0 * _PROFILE).astype(int)
    power = np.bincount(place, weights=np.sum(received**2, axis=1), minlength=_PROFILE)
    loudest = float(power.argmax()) / _PROFILE
    period = float(np.median(np.diff(np.interp(np.arange(first, last), passed, np.arange(count)))))

    def mean_logarithm(begin: float, share: float) -> Float:
        starts = np.interp(np.arange(first, last) + loudest + begin, passed, np.arange(count)).astype(int)
        length = int(share * period)
        ramp = np.sin(0.5 * pi * np.arange(max(2, length // 8)) / max(2, length // 8)) ** 2
        window = np.ones(length)
        window[: len(ramp)], window[-len(ramp) :] = ramp, ramp[::-1]
        parts = [received[s : s + length] * window[:, None] for s in starts if s >= 0 and s + length <= count]
        spectra = (np.abs(np.fft.rfft(part, _SPECTRUM, axis=0)) ** 2 for part in parts)
        return np.asarray(np.mean([np.log(each + 1e-12) for each in spectra], axis=0))

    struck, quiet = mean_logarithm(-_BEFORE, _WITH), mean_logarithm(_BESIDE, _WITHOUT)
    ripple = struck - quiet
    frequency = np.fft.rfftfreq(_SPECTRUM, 1.0 / rate)
    inside = (frequency > 1.5 * _LOWEST) & (frequency < high)
    kept, at = ripple[inside], frequency[inside] / rate
    if np.std(quiet[inside]) < _LEAST_STRUCTURE * np.std(struck[inside]):
        return Events(np.empty(0), np.empty(0), 0.0, _LONGEST_SHARE * spacing)
    trend = np.vander(at, 5)
    kept = kept - trend @ np.linalg.lstsq(trend, kept, rcond=None)[0]
    cepstrum = np.abs(np.fft.fft(kept * np.hanning(len(kept))[:, None], _CEPSTRUM, axis=0)).sum(axis=1)
    way = np.arange(_CEPSTRUM) * _SPECTRUM / _CEPSTRUM / period * spacing
    wanted = (way > _SHORTEST_WAY) & (way < _SEARCHED * spacing)
    return Events(
        way[wanted], cepstrum[wanted], _SHORTEST_S * rate / period * spacing, _LONGEST_SHARE * spacing,
        _profile_of(band_envelope(acceleration, rate, _LOWEST, high), place),
    )  # fmt: skip


def _follows(events: Events, share: float) -> bool:
    """Tell whether the second event, this share of a passage away, comes after the loudest one."""
    step = round(share * _PROFILE)
    near = np.arange(-_AROUND, _AROUND + 1)
    near = near[np.abs(near) < step]  # not the loudest event itself
    before, after = (float(events.profile[(side * step + near) % _PROFILE].max()) for side in (-1, 1))
    return after > _RINGS * before  # the loudest event rings on behind it


def _profile_of(envelope: Float, place: NDArray[np.int64]) -> Float:
    """Average the squared envelope over passages, smooth it, and begin at its loudest step."""
    count = np.maximum(np.bincount(place, minlength=_PROFILE), 1)
    mean = np.bincount(place, weights=envelope**2, minlength=_PROFILE) / count
    around = np.concatenate([mean[-_SMOOTHED:], mean, mean[:_SMOOTHED]])
    smooth = np.convolve(around, np.ones(_SMOOTHED) / _SMOOTHED, "same")[_SMOOTHED:-_SMOOTHED]
    return np.roll(smooth, -int(smooth.argmax()))


def _clear_peak(events: Events) -> float:
    """Find the peak that is clear of the others, NaN without one, [m]."""
    height = events.height
    if len(height) < 3:
        return nan
    top = np.flatnonzero((height[1:-1] > height[:-2]) & (height[1:-1] >= height[2:])) + 1
    if not len(top):
        return nan
    best = int(top[height[top].argmax()])
    way = float(events.way[best])
    others = [
        float(height[k]) for k in top if k != best and abs(events.way[k] / (2.0 * way) - 1.0) > _MULTIPLE
    ]
    clear = height[best] > _STANDS_OUT * np.median(height) and height[best] > _CLEAR * max(
        others, default=0.0
    )
    return way if clear and events.shortest <= way <= events.longest else nan

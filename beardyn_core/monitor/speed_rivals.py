"""Whether the lines that gave a speed fit another speed of the range as well.

A row of lines at c, 2 c, 3 c has no name: c can be an order of the shaft, or strikes on a ring at another
speed. Only the lines next to that row can tell which.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.speed_lines import (
    Comb,
    LineSpectrum,
    Signal,
    SpeedSettings,
    combs_of,
    line_spectrum,
    odds_at,
    weigh,
)

NEIGHBOURHOOD = 0.035  # of a speed, relative: what is closer widens its interval, the rest are other speeds
_SAMPLES_PER_LINE = 8.0  # of the highest order
_LEAST_ROW = 4.0  # logarithm of the odds of a row of lines that is there
_HIGHEST_ROW = 6  # order of the shaft that is taken for the first of a row
_ROUND = 0.01  # relative, within which a row is at an order of the shaft
_MAINS = (50.0, 60.0)  # [Hz]
_LOBE = 1.5  # half width of a line, of the resolution
_SLIPS = 41


class Shaft(NamedTuple):
    """A speed that was found: how the shaft turned, and where it was sought."""

    turned: Callable[[Float], Float]  # revolutions at times [s]
    middles: Float  # of the windows, [s]
    revolutions: float  # of one window
    frequency: float  # [Hz]
    lowest: float  # frequency in question, [Hz]
    highest: float


class Rival(NamedTuple):
    """Another speed that explains the vibration about as well."""

    ratio: float  # to the speed found
    lead: float  # of the speed found, logarithm of the odds in one window
    why: str  # the lines that fit both, and what they are at each


class Alternatives(NamedTuple):
    """What else the lines show next to the speed that was found."""

    rival: Rival | None  # the one that the speed found leads least
    reach: float  # of its neighbours that explain about as much, relative
    spread: float  # of all speeds that explain about as much, relative


class _Row(NamedTuple):
    """Lines at the multiples of one order."""

    order: float
    name: str
    slip: float  # relative


def find_alternatives(
    searched: Sequence[Signal],
    shaft: Shaft,
    orders: Sequence[FaultFrequencies],
    names: Sequence[str],
    settings: SpeedSettings,
) -> Alternatives:
    """Weigh every other speed of the range, and do so again without each row of lines that fits both.

    Notes
    -----
    The odds are means over the windows and not sums: a line that belongs to neither speed is there in all of
    them. A row of lines that is one thing at the speed found and another at another speed counts for
    neither, and lines of the mains count for no speed. What is left must lead every other speed by
    `least_lead`. Flanks of strong lines, which are wide enough to reach the next order, are no lines.
    """
    low, high = shaft.lowest / shaft.frequency, shaft.highest / shaft.frequency
    first, last = min(low, 1.0 - NEIGHBOURHOOD), max(high, 1.0 + NEIGHBOURHOOD)
    step = 0.25 / (settings.orders * shaft.revolutions * last)
    ratios = np.exp(np.arange(np.log(first), np.log(last) + step, step))
    spectra = [_mean_spectrum(signal, shaft, settings.orders * last, settings) for signal in searched]
    combs = [*combs_of(orders, float(settings.orders), settings.orders, settings), *_cages(orders, settings)]

    def odds(of: Sequence[LineSpectrum]) -> Float:
        return np.sum([weigh(each, combs, ratios, settings) for each in of], axis=0)

    near = np.abs(ratios - 1.0) <= NEIGHBOURHOOD
    far = ~near & (ratios >= low) & (ratios <= high)
    known = _known_rows(orders, names, settings)
    rows = list(_rows_of(spectra, known, settings))
    all_lines = odds(spectra)
    found = all_lines[near].max() - all_lines
    close = near & (found < settings.least_lead)
    others = far & (found < settings.least_lead)
    rivals = []
    if far.any():
        ratio, lead = _closest(ratios, found, far)
        rivals.append(Rival(ratio, lead, _name_shared_lines(ratio, rows, known, shaft)))
        for frequency in _MAINS:
            left = odds([_without(each, frequency / shaft.frequency) for each in spectra])
            ratio, lead = _closest(ratios, left[near].max() - left, far)
            rivals.append(Rival(ratio, lead, f"lines of the mains at {frequency:g} Hz belong to no speed"))
    for row in rows:
        meanings = [(each, _fits(ratios, row, each)) for each in known if each.name != row.name]
        if not any((fit & (near | far)).any() for _, fit in meanings):
            continue
        left = odds([_without(each, row.order) for each in spectra])
        lead = left[near].max() - left
        for meaning, fit in meanings:
            close |= near & fit & (lead < settings.least_lead)
            if (fit & far).any():
                ratio, least = _closest(ratios, lead, fit & far)
                rivals.append(Rival(ratio, least, _both(row, meaning, ratio, shaft)))
    rivals = [each for each in rivals if each.lead < settings.least_lead]
    # one that names the lines of both says more
    rivals.sort(key=lambda each: ("lines at" not in each.why, each.lead))
    reach = float(np.abs(ratios[close] - 1.0).max())
    spread = max([reach, *np.abs(ratios[others] - 1.0), *(abs(each.ratio - 1.0) for each in rivals)])
    return Alternatives(rivals[0] if rivals else None, reach, float(spread))


def _closest(ratios: Float, lead: Float, among: np.ndarray) -> tuple[float, float]:
    """Find the ratio that is led least: itself and the lead."""
    place = np.flatnonzero(among)[lead[among].argmin()]
    return float(ratios[place]), float(lead[place])


def _cages(orders: Sequence[FaultFrequencies], settings: SpeedSettings) -> list[Comb]:
    """List the lines of the cage about those of the cup: of strikes that differ from roller to roller."""
    found = []
    for each in orders:
        several = np.add.outer(
            each.bpfo * np.arange(1.0, 7.0), each.ftf * np.array([-2.0, -1.0, 1.0, 2.0])
        ).reshape(-1)
        found.append(Comb(several[several <= settings.orders], settings.probable))
    return found


def _known_rows(
    orders: Sequence[FaultFrequencies], names: Sequence[str], settings: SpeedSettings
) -> list[_Row]:
    """List what a row of lines can be."""
    found = [_Row(float(k), f"order {k} of the shaft", _ROUND) for k in range(1, settings.orders + 1)]
    slip = 2.0 * settings.slip
    for number, each in enumerate(orders):
        name = f" of {names[number]}" if number < len(names) else ""
        found.append(_Row(each.bpfo, f"the outer ring{name} (BPFO)", slip))
        found.append(_Row(each.bpfi, f"the inner ring{name} (BPFI)", slip))
        found.append(_Row(2.0 * each.bsf, f"the rolling elements{name} (2 BSF)", slip))
    return found


def _rows_of(spectra: Sequence[LineSpectrum], known: list[_Row], settings: SpeedSettings) -> Iterator[_Row]:
    """Give the rows that have lines at the speed found, with the order that they slipped to."""
    for row in known:
        whole = row.slip == _ROUND
        if whole and row.order > _HIGHEST_ROW:
            continue
        slips = np.array([1.0]) if whole else np.exp(np.linspace(-row.slip, row.slip, _SLIPS))
        count = max(1, int(settings.orders / row.order))
        comb = Comb(row.order * np.arange(1.0, count + 1.0), settings.probable)
        odds = np.sum([odds_at(each, comb, slips).sum(axis=0) for each in spectra], axis=0)
        if odds.max() >= _LEAST_ROW:
            yield row._replace(order=row.order * float(slips[odds.argmax()]))


def _fits(ratios: Float, row: _Row, meaning: _Row) -> np.ndarray:
    """Find the ratios of the speed at which a row of lines has another meaning."""
    return np.asarray(np.abs(np.log(ratios * meaning.order / row.order)) <= meaning.slip)


def _both(row: _Row, meaning: _Row, ratio: float, shaft: Shaft) -> str:
    return (
        f"the lines at {row.order * shaft.frequency:.3g} Hz are {row.name} at {60.0 * shaft.frequency:.4g} "
        f"rpm, or {meaning.name} at {60.0 * ratio * shaft.frequency:.4g} rpm"
    )


def _name_shared_lines(ratio: float, rows: list[_Row], known: list[_Row], shaft: Shaft) -> str:
    """Say what lines both speeds explain, '' when they have none in common."""
    for row in rows:
        for meaning in known:
            if _fits(np.array([ratio]), row, meaning)[0]:
                return _both(row, meaning, ratio, shaft)
    return ""


def _without(spectrum: LineSpectrum, order: float) -> LineSpectrum:
    """Take a row of lines out of a spectrum."""
    place = np.arange(len(next(iter(spectrum.odds.values())))) * spectrum.step
    number = np.rint(place / order)
    row = (number >= 1.0) & (np.abs(place - number * order) <= _LOBE * spectrum.resolution)
    odds = {share: np.where(row, 0.0, each) for share, each in spectrum.odds.items()}
    return spectrum._replace(odds=odds)


def _mean_spectrum(signal: Signal, shaft: Shaft, highest: float, settings: SpeedSettings) -> LineSpectrum:
    """Average the odds of every order over windows of equal angle."""
    time = np.arange(len(signal.values)) / signal.rate
    angle = shaft.turned(time)
    per_turn = _SAMPLES_PER_LINE * highest
    count = int(shaft.revolutions * per_turn)
    even = (np.arange(count) - 0.5 * count) / per_turn
    spectra = []
    for middle in shaft.turned(shaft.middles):
        at = np.interp(middle + even, angle, time)
        values = np.stack([np.interp(at, time, axis) for axis in signal.values.T], axis=1)
        shares = {settings.probable, settings.probable_of_bearing}
        spectra.append(line_spectrum(values, per_turn, shares, flanks=False))
    odds = {share: np.mean([each.odds[share] for each in spectra], axis=0) for share in spectra[0].odds}
    return spectra[0]._replace(odds=odds)

"""Trend with memory: levels of records against the bearing's own baseline, and an alarm that stays.

It needs neither speed nor bearing, and records of a tenth of a second do: the answer is that a box has become
louder than it was, not which part of the bearing it is.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from itertools import pairwise
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError

LEARNING, STEADY, ALARM = "learning", "steady", "alarm"
_SIGMA_OF_MAD = 1.4826  # of a normal distribution
_HIGHEST_SHARE = 0.47  # of the sampling rate, up to which a band reaches
_FAINTEST = 1e-12  # [m^2/s^4]


@dataclass(frozen=True)
class TrendSettings:
    """Settings of `Trend`: round numbers; docs/evidence/run_to_failure.md has what they come to."""

    edges: A[tuple[float, ...], "between the bands whose levels are watched, [Hz]"] = (
        100.0, 1000.0, 2500.0, 5000.0, 8000.0, 12_000.0,
    )  # fmt: skip
    baseline: A[int, "records of the first baseline, and of every later one"] = 50
    smooth: A[int, "records whose median is compared with the baseline: single knocks count nothing"] = 5
    rise: A[float, "over the baseline from which a level is too high, [dB]"] = 6.0
    scatter: A[float, "and in standard deviations of the baseline, [-]"] = 2.0
    least_deviation: A[float, "of a level, however steady the baseline was, [dB]"] = 0.7
    agreeing: A[int, "levels that must be too high together, of bands and axes"] = 2
    release: A[int, "records without, one after the other, after which an alarm ends"] = 60


@dataclass(frozen=True)
class TrendPoint:
    """State of the trend after one record."""

    time: A[float, "of the end of the record, [s]"]
    state: A[str, "``learning``, ``steady`` or ``alarm``"]
    rise: A[float, "largest of the levels over its baseline, NaN while learning, [dB]"]
    level: A[str, "which one that is, such as ``z 2500 to 5000 Hz``"]
    since: A[float, "end of the record at which the alarm began, NaN without, [s]"]


def record_levels(acceleration: Float, rate: float, settings: TrendSettings | None = None) -> Float:
    """Compute the levels of a record in the bands, shape [axis, band], [dB re 1 m/s^2]; NaN beyond the rate.

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].
    rate : float
        [Hz].
    """
    edges = (settings or TrendSettings()).edges
    signal = acceleration - acceleration.mean(axis=0)
    window = np.hanning(len(signal))[:, None]
    power = np.abs(np.fft.rfft(signal * window, axis=0)) ** 2 * (2.0 / len(signal) / float(np.sum(window**2)))
    frequency = np.fft.rfftfreq(len(signal), 1.0 / rate)
    places = np.searchsorted(frequency, edges)
    found = np.full((signal.shape[1], len(edges) - 1), np.nan)
    for band, (first, last) in enumerate(pairwise(places)):
        if edges[band + 1] <= _HIGHEST_SHARE * rate and last > first:
            found[:, band] = 10.0 * np.log10(np.maximum(power[first:last].sum(axis=0), _FAINTEST))
    return found


@dataclass
class Trend:
    """Watches levels over successive records.

    Notes
    -----
    The baseline is the median of the first records, and of any later as many whose median is lower: a
    bearing that runs in becomes quieter, and one that wears does not. A level is too high when the median of
    the last few records lies over it by so many decibels and standard deviations, as the absolute deviation
    of the baseline shows. Several levels must be too high together; the alarm then stays until none has been
    for long.

    References
    ----------
    ISO 20816-1 (2016), section 6: a change against the machine's own reference counts, whatever its level.
    """

    axes: A[tuple[str, ...], "names of the axes"] = ("x", "y", "z")
    settings: TrendSettings = field(default_factory=TrendSettings)
    records: A[int, "records so far"] = 0
    since: A[float, "end of the record at which the alarm began, NaN without, [s]"] = np.nan
    quiet: A[int, "records without cause for it since"] = 0
    _last: list[Float] = field(default_factory=list)
    _base: Float | None = None
    _deviation: Float | None = None

    def take(self, levels: Float, time: float) -> TrendPoint:
        """Add the levels of a record [dB], shape [axis, band], that ends at a time [s]."""
        settings = self.settings
        self.records += 1
        self._last.append(np.asarray(levels, float).reshape(-1))
        del self._last[: -settings.baseline]
        if len(self._last) == settings.baseline:
            self._learn()
        if self._base is None or self._deviation is None:
            return TrendPoint(time, LEARNING, np.nan, "", np.nan)
        rise = np.median(self._last[-settings.smooth :], axis=0) - self._base
        high = rise > np.maximum(settings.rise, settings.scatter * self._deviation)
        if np.count_nonzero(high) >= min(settings.agreeing, int(np.isfinite(rise).sum())):
            self.since = time if np.isnan(self.since) else self.since
            self.quiet = 0
        elif not np.isnan(self.since):
            self.quiet += 1
            if self.quiet > settings.release:
                self.since, self.quiet = np.nan, 0
        worst = int(np.nanargmax(rise)) if np.isfinite(rise).any() else 0
        state = STEADY if np.isnan(self.since) else ALARM
        return TrendPoint(time, state, float(rise[worst]), self._name(worst), self.since)

    def _learn(self) -> None:
        """Take the last records as baseline of the levels in which they are the quietest so far."""
        last = np.array(self._last)
        middle = np.median(last, axis=0)
        spread = _SIGMA_OF_MAD * np.median(np.abs(last - middle), axis=0)
        spread = np.maximum(spread, self.settings.least_deviation)
        if self._base is None or self._deviation is None:
            self._base, self._deviation = middle, spread
        else:
            lower = middle < self._base
            self._base = np.where(lower, middle, self._base)
            self._deviation = np.where(lower, spread, self._deviation)

    def _name(self, place: int) -> str:
        axis, band = divmod(place, len(self.settings.edges) - 1)
        low, high = self.settings.edges[band : band + 2]
        return f"{self.axes[axis]} {low:g} to {high:g} Hz"

    def memory(self) -> dict[str, Any]:
        """Write all that must be kept until the next record, for JSON."""
        return {
            "settings": asdict(self.settings),
            "axes": list(self.axes),
            "records": self.records,
            "since": None if np.isnan(self.since) else self.since,
            "quiet": self.quiet,
            "last": [_write_levels(each) for each in self._last],
            "base": None if self._base is None else _write_levels(self._base),
            "deviation": None if self._deviation is None else _write_levels(self._deviation),
        }

    @classmethod
    def of_memory(cls, memory: dict[str, Any]) -> Trend:
        """Go on from what `memory` has written.

        Raises
        ------
        InputError
            It is of something else.
        """
        try:
            settings = {**memory["settings"], "edges": tuple(memory["settings"]["edges"])}
            base, deviation = memory["base"], memory["deviation"]
            return cls(
                tuple(memory["axes"]), TrendSettings(**settings), memory["records"],
                np.nan if memory["since"] is None else memory["since"], memory["quiet"],
                [_read(each) for each in memory["last"]],
                None if base is None else _read(base), None if deviation is None else _read(deviation),
            )  # fmt: skip
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(f"is no memory of a trend: {error!r}") from None


def _write_levels(levels: Float) -> list[float | None]:
    return [None if np.isnan(each) else round(float(each), 6) for each in levels]


def _read(levels: list[float | None]) -> Float:
    return np.array([np.nan if each is None else each for each in levels])

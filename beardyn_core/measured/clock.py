"""Sampling rate of time stamps, and where they go back, jump, or change their rate."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float

_ALIKE = 0.01  # by which steps may differ and still be even; of a rate, by which two are one
_LEAST_SAMPLES = 1000  # of which the mean step is compared
_SHOWN = 3
_JITTERING = 0.05  # share of uneven steps from which they are no single mistakes
_FIRST, _HEAD = 200, 2000  # stamps by which the usual step, and their rounding, are known


class Clock:
    """Takes the time stamps of one table, block by block.

    Stamps that are rounded more coarsely than their step, or that jitter, are even on the mean.

    Parameters
    ----------
    seconds : float
        In their unit.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self.count = 0
        self.first = self.last = float("nan")
        self._step = float("nan")
        self.coarse = 0.0
        self._backward: list[int] = []
        self._doubled: list[int] = []
        self._jumps: list[tuple[int, float]] = []
        self._change: tuple[int, float] | None = None
        self._waiting: list[Float] = []  # the first stamps, until they are enough to know the usual step

    def take(self, stamps: Float) -> None:
        """Add the next stamps; those that are not finite are somebody else's complaint."""
        if self.count:
            self._take(stamps)
            return
        self._waiting.append(stamps)
        if sum(map(len, self._waiting)) > _HEAD:
            self.end()

    def end(self) -> None:
        """Look at what waits for more; after this there is none."""
        if self._waiting:
            self._take(np.concatenate(self._waiting))
            self._waiting = []

    def _take(self, stamps: Float) -> None:
        time = stamps * self._seconds
        if not len(time):
            return
        begin = self.count
        if begin == 0:
            self.first = float(time[0])
            if len(time) > 1:
                self._settle(time)
        else:
            time = np.concatenate(([self.last], time))
            begin -= 1
        self.count += len(stamps)
        self.last = float(time[-1])
        with np.errstate(invalid="ignore"):
            step = np.diff(time)
            self._backward += (np.flatnonzero(step < 0.0)[:_SHOWN] + begin + 2).tolist()
            if not self.coarse:
                self._doubled += (np.flatnonzero(step == 0.0)[:_SHOWN] + begin + 2).tolist()
            far = np.flatnonzero(step > 1.5 * self._step + 2.0 * self.coarse)
        self._compare(step, far, begin)

    def _settle(self, time: Float) -> None:
        """Learn the usual step, and how coarse the stamps are, from the first ones."""
        step = np.diff(time[: _HEAD + 1])
        step = step[np.isfinite(step) & (step >= 0.0)]
        if not len(step):
            return
        first = step[:_FIRST]
        self._step = float(np.median(first))
        uneven = np.abs(first - self._step) > _ALIKE * self._step
        if uneven.mean() > _JITTERING:
            self._step = float(first.mean())
            self.coarse = 2.0 * float(np.quantile(np.abs(first - self._step), 0.99))
        digit = _last_digit(time[:_HEAD])
        if digit > _ALIKE * self._step and (np.abs(step - step[0]) > 0.5 * digit).any():  # they are rounded
            self._step = float(step.mean())
            self.coarse = max(self.coarse, digit)

    def _compare(self, step: Float, far: Any, begin: int) -> None:
        """Tell a change of the rate from jumps."""
        if len(step) >= _LEAST_SAMPLES:
            parts = np.array_split(step, max(1, len(step) // _LEAST_SAMPLES))
            at = begin
            for part in parts:
                # a few dropouts move the mean alone; stamps of so many digits, which get coarser as the
                # time goes on, the median alone
                usual = float(np.median(part) if not self.coarse else part.mean())
                mean = min(usual, float(part.mean()), key=lambda each: abs(each - self._step))
                tolerance = _ALIKE * self._step + 2.0 * self.coarse / len(part)
                if self._change is None and abs(mean - self._step) > tolerance and mean > 0.0:
                    lonely = np.count_nonzero(part > 1.5 * self._step + 2.0 * self.coarse)
                    if lonely == 0 or lonely > 0.01 * len(part):
                        self._change = (at, 1.0 / usual)
                at += len(part)
        if self._change is None:
            self._jumps += [(int(k) + begin + 2, float(step[k])) for k in far[:_SHOWN]]

    @property
    def rate(self) -> float:
        """Mean rate, NaN for fewer than two stamps, [Hz]."""
        span = self.last - self.first
        return float(f"{(self.count - 1) / span:.9g}") if self.count > 1 and span > 0.0 else float("nan")

    @property
    def uncertainty(self) -> float:
        """Share by which that rate may be wrong because stamps are rounded or jitter."""
        span = self.last - self.first
        return self.coarse / span if span > 0.0 else float("nan")

    def problems(self, where: str) -> list[str]:
        """Write what is wrong with the stamps, in sentences; `where` is the file and the channel."""
        found = []
        if self._backward:
            found.append(
                f"{where}: the time goes back at sample {_numbers(self._backward)}; it must increase"
            )
        if self._doubled and not self._backward:
            found.append(
                f"{where}: the time stands still at sample {_numbers(self._doubled)}; it must increase"
            )
        if self._change is not None and not self._backward:
            at, rate = self._change
            found.append(
                f"{where}: has two sampling rates, {1.0 / self._step:.6g} Hz and from about "
                f"sample {at + 1} on {rate:.6g} Hz; split it, or give --rate-hz and --time-channel none "
                "if its time is wrong"
            )
        elif self._jumps and not self._backward:
            at, step = self._jumps[0]
            more = f", and at {len(self._jumps) - 1} samples more" if len(self._jumps) > 1 else ""
            found.append(
                f"{where}: the time jumps by {step:.6g} s at sample {at}{more}, where the usual step is "
                f"{self._step:.6g} s; split the file there, or give --rate-hz and "
                "--time-channel none if the time is wrong"
            )
        return found


def _numbers(found: list[int]) -> str:
    shown = ", ".join(map(str, found[:_SHOWN]))
    return f"{shown} and later" if len(found) > _SHOWN else shown


def _last_digit(time: Float) -> float:
    """Find the last decimal digit that stamps have, [s]; 0 when they have more than nine."""
    noise = 4.0 * np.spacing(np.abs(time).max()) if len(time) else 0.0
    for digits in range(10):
        if (np.abs(time - np.round(time, digits)) <= noise).all():
            return float(10.0**-digits)
    return 0.0

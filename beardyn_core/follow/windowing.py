"""Stretches out of blocks of vibration and shaft as they come."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.inference import FEWEST_TURNS, LONGEST_STEP, name_unmeasured_axes, turned_forward
from beardyn_core.monitor.chain import Stretch

_SAME_RATE = 1e-3
_STRETCHES_KEPT = 2.0


@dataclass
class StretchIntake:
    """Gathers vibration and shaft until both cover a stretch; a gap begins a new one.

    Of one that the other does not follow, the last two stretches are kept.
    """

    estimator: Estimator
    gaps: A[int, "in the vibration"] = 0
    unfit: A[int, "stretches with NaN, or in which the shaft stood, turned back or was too slow"] = 0
    received: A[int, "stretches that were given"] = 0
    _times: list[Int] = field(default_factory=list)
    _received: list[Float] = field(default_factory=list)
    _turn_times: list[Int] = field(default_factory=list)
    _turns: list[Float] = field(default_factory=list)

    @property
    def doubt(self) -> str:
        """Say why nothing has been read though whole stretches have come; empty when something has."""
        if self.received or not self.unfit:
            return ""
        return (
            f"no stretch was usable: of {self.unfit} stretches none is without NaN and has a shaft that "
            f"turns {FEWEST_TURNS:g} times one way"
        )

    def of(self, estimator: Estimator) -> StretchIntake:
        """Give an intake for another estimator that begins with the next vibration, and keeps the shaft."""
        return StretchIntake(estimator, _turn_times=self._turn_times, _turns=self._turns)

    def push_vibration(self, time_ns: Int, acceleration: Float) -> None:
        """Add a block, shape [sample, 3], [m/s^2].

        Raises
        ------
        InputError
            It is not sampled as the estimator needs, or an axis is not measured.
        """
        if len(time_ns) < 2:
            return
        period = float(time_ns[-1] - time_ns[0]) / (len(time_ns) - 1)
        if abs(1e9 / period / self.estimator.rate - 1.0) > _SAME_RATE:
            raise InputError(
                f"vibration is sampled at {1e9 / period:.0f} Hz, the estimator needs "
                f"{self.estimator.rate:.0f} Hz"
            )
        received = acceleration[:, [AXES.index(axis) for axis in self.estimator.axes]]
        if doubt := name_unmeasured_axes(received, self.estimator):
            raise InputError(f"vibration: {doubt}")
        if self._times and not 0.0 < time_ns[0] - self._times[-1][-1] < LONGEST_STEP * period:
            self.gaps += 1
            self._times, self._received = [], []
        self._times.append(time_ns)
        self._received.append(received)

    def push_shaft(self, time_ns: Int, angle: Float) -> None:
        """Add samples of the tachometer; an angle that wraps is unwrapped."""
        if self._turn_times and len(time_ns) and time_ns[0] <= self._turn_times[-1][-1]:
            self._turn_times, self._turns = [], []
        if len(time_ns):
            before = self._turns[-1][-1:] if self._turns else np.zeros(0)
            self._turn_times.append(time_ns)
            self._turns.append(np.unwrap(np.concatenate([before, angle]))[len(before) :])

    def stretch(self) -> Stretch | None:
        """Give the next stretch when all of it has come; what is unfit is left out."""
        length = round(self.estimator.stretch * self.estimator.rate) + 1
        if sum(map(len, self._times)) < length or not self._turn_times:
            self._forget()
            return None
        times, received = np.concatenate(self._times), np.concatenate(self._received)
        turn_times, turns = np.concatenate(self._turn_times), np.concatenate(self._turns)
        unknown = int(np.searchsorted(times, turn_times[0]))  # before the shaft was received
        times, received = times[unknown:], received[unknown:]
        self._keep(times, received)
        if len(times) < length or turn_times[-1] < times[length - 1]:
            self._forget()
            return None
        self._keep(times[length:], received[length:])
        kept = max(int(np.searchsorted(turn_times, times[length - 1])) - 1, 0)
        self._turn_times, self._turns = [turn_times[kept:]], [turns[kept:]]
        angle = np.interp(times[:length], turn_times, turns)
        whole = np.isfinite(received[:length]).all()
        forward = turned_forward(received[:length], angle) if whole else None
        if forward is None:
            self.unfit += 1
            return None
        self.received += 1
        return Stretch(self.estimator.rate, *forward, np.nan, int(times[length - 1]))

    def _keep(self, times: Int, received: Float) -> None:
        self._times, self._received = ([times], [received]) if len(times) else ([], [])

    def _forget(self) -> None:
        """Drop blocks that are too old for what the other stream may still bring."""
        longest_ns = _STRETCHES_KEPT * 1e9 * self.estimator.stretch
        for times, values in ((self._times, self._received), (self._turn_times, self._turns)):
            while times and times[-1][-1] - times[0][-1] > longest_ns:
                del times[0], values[0]

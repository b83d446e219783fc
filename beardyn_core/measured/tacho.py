"""Level of a tachometer's pulses, and what its pulses give: found in one pass over its channel.

Spikes and noise may reach far beyond the pulses. Of the levels between several quantiles the one is taken
whose pulses are the most even.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.measured.shaft import Pulses

_SHARES = (0.0, 1e-4, 1e-3, 1e-2, 0.05)  # of a block, beyond which its values may be spikes
_ALIKE = 0.1  # share of the range by which two pairs of levels are one
_AS_EVEN = 0.02  # share of uneven intervals by which two levels are equally good
_HOLES_SHOWN = 3
_RPM = 30.0 / np.pi


class PulseLevels:
    """Quantiles of the channel of a tachometer, block by block: the outermost of all blocks."""

    def __init__(self) -> None:
        self._low = np.full(len(_SHARES), np.inf)
        self._high = np.full(len(_SHARES), -np.inf)

    def take(self, values: Float) -> None:
        """Add the next samples."""
        values = values[np.isfinite(values)]
        if len(values):
            self._low = np.minimum(self._low, np.quantile(values, _SHARES))
            self._high = np.maximum(self._high, np.quantile(values, 1.0 - np.array(_SHARES)))

    def pairs(self) -> list[tuple[float, float]]:
        """List low and high levels that may be those of the pulses, the widest first."""
        found: list[tuple[float, float]] = []
        for low, high in zip(self._low.tolist(), self._high.tolist(), strict=True):
            known = any(abs(low - a) + abs(high - b) < _ALIKE * (b - a) for a, b in found)
            if high > low and not known:
                found.append((low, high))
        return found


@dataclass(frozen=True)
class Tacho:
    """What the pulses of a tachometer give."""

    low: A[float, "level between the pulses"]
    high: A[float, "level of the pulses"]
    pulses: A[Pulses, "that have seen all samples"]

    def told(self, name: str, seconds: float) -> str:
        """Say how the shaft turns."""
        found = self.pulses
        if not found.fastest:
            return f"the speed of the shaft is not known: {name} has {found.count} pulses"
        span = f"{found.slowest * _RPM:.6g} to {found.fastest * _RPM:.6g} rpm"
        return (
            f"the shaft turns with {span} by the {found.count} pulses of {name}, known for "
            f"{found.known_ns * 1e-9:.6g} of {seconds:.6g} s"
        )

    def warnings(self, name: str, begin_ns: int, end_ns: int) -> list[str]:
        """Say where the pulses give no speed, and that they are uneven."""
        found, out = self.pulses, []
        if found.count < 2:
            return [f"the tachometer {name} has {found.count} pulses; the speed of the shaft is not known"]
        usual_ns = found.known_ns / max(found.count - 1, 1)
        lacking = end_ns - begin_ns - found.known_ns
        if lacking > max(0.01 * (end_ns - begin_ns), 2.5 * usual_ns) or found.holes:
            spans = [(begin_ns, found.first_ns), *found.holes, (found.last_ns, end_ns)]
            long = [span for span in spans if span[1] - span[0] > 2.5 * usual_ns]
            shown = ", ".join(f"{a * 1e-9:.4g} to {b * 1e-9:.4g} s" for a, b in long[:_HOLES_SHOWN])
            more = f" and {len(long) - _HOLES_SHOWN} times more" if len(long) > _HOLES_SHOWN else ""
            out.append(
                f"the tachometer {name} gives a speed for {found.known_ns * 1e-9:.6g} of "
                f"{(end_ns - begin_ns) * 1e-9:.6g} s"
                + (f": no pulses from {shown}{more}; it is lost there, or the shaft stands" if shown else "")
            )
        if found.irregular:
            out.append(
                f"{found.irregular} of {found.count - 1} intervals between tacho pulses differ by "
                "more than 60 % from the one before; check --tacho-level"
            )
        return out


def judge_pulses(
    levels: PulseLevels, level: float | None, per_turn: int, feed: Callable[[Callable[..., None]], None]
) -> Tacho | None:
    """Find the level of the pulses and what they give; None for a channel that never changes.

    Parameters
    ----------
    levels : PulseLevels
        That have seen all samples.
    level : float, optional
        As asked.
    per_turn : int
        Pulses of a revolution.
    feed : function
        Passes all samples to a function of times [ns] and values, and with None where a gap begins.
    """
    tried = [(low, high, Pulses(low, high, level, per_turn)) for low, high in levels.pairs()]

    def take(time_ns: np.ndarray | None, values: Float | None) -> None:
        for _, _, pulses in tried:
            if time_ns is None or values is None:
                pulses.restart()
            else:
                pulses.take(time_ns, values)

    if not tried:
        return None
    feed(take)

    def uneven(pulses: Pulses) -> float:
        return (pulses.irregular + len(pulses.holes)) / max(pulses.count - 1, 1) if pulses.count > 2 else 1.0

    best = min(uneven(pulses) for _, _, pulses in tried)
    good = [each for each in tried if uneven(each[2]) <= best + _AS_EVEN]
    return Tacho(*max(good, key=lambda each: each[2].count))

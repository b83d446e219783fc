"""The load as a stream: samples that have arrived, those refused, those that cover the next block."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.jit import entry
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.load_check import problem_with


@dataclass
class LoadBuffer:
    """Samples that have arrived and are still needed."""

    refused: A[int, "pieces that were refused"] = 0
    reason: A[str, "why the last one was"] = ""
    _parts: list[tuple[NDArray[np.int64], NDArray[np.float64]]] = field(default_factory=list)

    @property
    def last_ns(self) -> int | None:
        """Time of the newest sample, ``None`` when there is none, [ns]."""
        return int(self._parts[-1][0][-1]) if self._parts else None

    def append(self, load: LoadHistory) -> bool:
        """Append samples to the stream; False, and counted as refused, when they cannot be used."""
        problem = problem_with(load, self.last_ns)
        if problem is not None:
            self.refused += 1
            self.reason = problem
            return False
        if len(load):
            self._parts.append((load.time_ns.copy(), load.columns()))  # own: kernels take no read-only ones
        return True

    def at_steps(self, start_ns: int, end_ns: int, steps: int, blocks: int = 1) -> NDArray[np.float64]:
        """Compute the load at the step boundaries, linear between samples, constant outside them.

        From start to end of all blocks together, of so many steps each; as many blocks as wanted give the
        same bits as one at a time. Shape [steps * blocks + 1, 10]: wrench [N, N m], shaft speed [rad/s],
        bogie displacement [m].
        """
        while len(self._parts) > 1 and self._parts[1][0][0] <= start_ns:
            del self._parts[0]
        parts = [_window(*part, start_ns, end_ns) for part in self._parts]
        time_ns, values = parts[0] if len(parts) == 1 else map(np.concatenate, zip(*parts, strict=True))
        rows = np.empty((steps * blocks + 1, 10))
        _interpolate_blocks(time_ns, values, start_ns, (end_ns - start_ns) // blocks, steps, rows)
        return rows

    def copy(self) -> LoadBuffer:
        """Return a copy; it shares the arrays of samples, which never change."""
        return LoadBuffer(self.refused, self.reason, list(self._parts))


def _window(
    time_ns: NDArray[np.int64], values: NDArray[np.float64], start_ns: int, end_ns: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the samples between two times, and one more on either side."""
    first = int(np.searchsorted(time_ns, start_ns, side="right")) - 1
    wanted = slice(max(first, 0), int(np.searchsorted(time_ns, end_ns, side="left")) + 1)
    return time_ns[wanted], values[wanted]


@partial(entry, allocates=True, flags=())
def _interpolate_blocks(time_ns, values, start_ns, span_ns, steps, rows):
    for first in range(0, len(rows) - 1, steps):
        start = start_ns + first // steps * span_ns
        _interpolate(time_ns, values, start, span_ns / steps, rows[first : first + steps + 1])


@partial(entry, allocates=True, flags=())
def _interpolate(time_ns, values, start_ns, spacing, rows):
    """Interpolate all columns at evenly spaced times, the same bits as `numpy.interp`."""
    last, sample, known = len(time_ns) - 1, 0, -1
    slope = np.empty(10)
    for row in range(len(rows)):
        at = row * spacing
        while sample < last and float(time_ns[sample + 1] - start_ns) <= at:
            sample += 1
        since = at - float(time_ns[sample] - start_ns)
        if sample == last or since <= 0.0:
            for i in range(10):
                rows[row, i] = values[sample, i]
            continue
        if sample != known:
            known = sample
            span = float(time_ns[sample + 1] - start_ns) - float(time_ns[sample] - start_ns)
            for i in range(10):
                slope[i] = (values[sample + 1, i] - values[sample, i]) / span
        for i in range(10):
            rows[row, i] = slope[i] * since + values[sample, i]

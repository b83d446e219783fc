"""The load as a stream: samples that have arrived, those refused, those that cover the next block."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.scene.band_limited import at_steps, seam
from beardyn_core.scene.load import LONGEST_SPACING_NS, LOOK_AHEAD, LoadHistory
from beardyn_core.scene.load_check import problem_with


@dataclass
class LoadBuffer:
    """Samples that have arrived and are still needed."""

    refused: A[int, "pieces that were refused"] = 0
    reason: A[str, "why the last one was"] = ""
    ended: A[bool, "whether no more samples will come: what lies behind the last one is not waited for"] = (
        False
    )
    _parts: list[tuple[Int, Float]] = field(default_factory=list)

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

    def covers(self, end_ns: int) -> bool:
        """Tell whether no later sample changes the load up to a time [ns].

        A sample at that time or after it has arrived; and, where samples are evenly spaced there,
        `LOOK_AHEAD` of them, or the stream has ended.
        """
        if not self._parts or self._parts[-1][0][-1] < end_ns:
            return False
        time_ns, _ = self._join_parts()
        after = int(np.searchsorted(time_ns, end_ns, side="left"))
        known = self.ended or after == 0 or len(time_ns) >= after + LOOK_AHEAD
        return known or any(seam(time_ns, k) for k in range(max(after - 1, 1), len(time_ns) - 1))

    def wanted_ns(self, end_ns: int) -> int:
        """Compute the time up to which samples are wanted for the load up to a time, [ns]."""
        times = [int(time) for part, _ in self._parts[-2:] for time in part[-2:]]
        spacing = times[-1] - times[-2] if len(times) > 1 else 0
        return end_ns + LOOK_AHEAD * spacing if spacing <= LONGEST_SPACING_NS else end_ns

    def at_steps(self, start_ns: int, end_ns: int, steps: int, blocks: int = 1) -> Float:
        """Compute the load at the step boundaries, as `LoadHistory` says, constant outside the samples.

        From start to end of all blocks together, of so many steps each; as many blocks as wanted give the
        same bits as one at a time. Shape [steps * blocks + 1, 10]: wrench [N, N m], shaft speed [rad/s],
        bogie displacement [m].
        """
        time_ns, values = self._join_parts(start_ns)
        return at_steps(time_ns, values, start_ns, (end_ns - start_ns) // blocks, steps, blocks)

    def _join_parts(self, start_ns: int | None = None) -> tuple[Int, Float]:
        """Join what has arrived to one part, less what nothing after a start depends on."""
        if len(self._parts) > 1:
            times, values = map(np.concatenate, zip(*self._parts, strict=True))
            self._parts = [(times, values)]
        if start_ns is not None:
            times, values = self._parts[0]
            needed = int(np.searchsorted(times, start_ns, side="right")) - 1 - LOOK_AHEAD
            if needed > 0:
                self._parts = [(times[needed:], values[needed:])]
        return self._parts[0]

    def copy(self) -> LoadBuffer:
        """Return a copy; it shares the arrays of samples, which never change."""
        return LoadBuffer(self.refused, self.reason, self.ended, list(self._parts))

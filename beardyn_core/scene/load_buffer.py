"""The load as a stream: samples that have arrived, those refused, those that cover the next block."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.jit import entry
from beardyn_core.scene.load import LoadHistory

LARGEST_FORCE = 1.0e7
LARGEST_MOMENT = 1.0e6
LARGEST_SPEED = 2000.0
LARGEST_DISPLACEMENT = 1.0
LARGEST_SPEED_JUMP = 50.0
QUANTITIES = (
    *((name, "N") for name in ("fx", "fy", "fz")),
    *((name, "N m") for name in ("mx", "my", "mz")),
    ("shaft_speed", "rad/s"),
    *((name, "m") for name in ("ux", "uy", "uz")),
)
SPEED_JUMP_WINDOW_NS = 100_000_000


def problem_with(load: LoadHistory, after_ns: int | None) -> str | None:
    """Say why samples of load cannot follow the one of a time [ns], if any; ``None`` when they can."""
    if len(load) == 0:
        return None
    values = load.columns()
    if not np.isfinite(values).all():
        return (
            "the load has a NaN or an infinite number; all of force, moment, speed and bogie must be finite"
        )
    if np.any(np.diff(load.time_ns) <= 0) or (after_ns is not None and load.time_ns[0] <= after_ns):
        return "the load goes back in time; samples must follow each other"
    limits = np.repeat([LARGEST_FORCE, LARGEST_MOMENT, LARGEST_SPEED, LARGEST_DISPLACEMENT], [3, 3, 1, 3])
    wild = np.argwhere(np.abs(values) > limits)
    if len(wild):
        sample, column = (int(each) for each in wild[0])
        name, unit = QUANTITIES[column]
        return (
            f"the load is absurd; {name} is {values[sample, column]:.4g} {unit} at "
            f"{load.time_ns[sample] * 1e-9:g} s, allowed is up to {limits[column]:g} {unit}"
        )
    jump = speed_jump(load.time_ns, load.shaft_speed)
    return f"the load is absurd; {jump}" if jump else None


def speed_jump(time_ns: NDArray[np.int64], shaft_speed: NDArray[np.float64]) -> str | None:
    """Report a jump of the shaft speed [rad/s] that no wheelset can make; ``None`` when there is none."""
    change = np.abs(np.diff(shaft_speed))
    jumps = np.flatnonzero((change > LARGEST_SPEED_JUMP) & (np.diff(time_ns) < SPEED_JUMP_WINDOW_NS))
    if len(jumps) == 0:
        return None
    first = int(jumps[0])
    return (
        f"shaft_speed jumps from {shaft_speed[first]:g} to {shaft_speed[first + 1]:g} rad/s within "
        f"{(time_ns[first + 1] - time_ns[first]) / 1e6:g} ms; allowed is a change of up to "
        f"{LARGEST_SPEED_JUMP:g} rad/s between samples closer than {SPEED_JUMP_WINDOW_NS / 1e9:g} s"
    )


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


@partial(entry, flags=())
def _interpolate_blocks(time_ns, values, start_ns, span_ns, steps, rows):
    for first in range(0, len(rows) - 1, steps):
        start = start_ns + first // steps * span_ns
        _interpolate(time_ns, values, start, span_ns / steps, rows[first : first + steps + 1])


@partial(entry, flags=())
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

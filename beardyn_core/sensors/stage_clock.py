"""Wall time of a run by stage: kernel with its stages, load, observe, sinks, and the rest."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.bodies.step_stages import KERNEL_STAGES

KERNEL, LOAD, OBSERVE, SINKS, REST = "kernel", "load", "observe", "sinks", "rest"
STAGES = (*KERNEL_STAGES, KERNEL, LOAD, OBSERVE, SINKS, REST)
"""All stages; ``kernel`` is the time step as a whole where its own stages are not known."""


@dataclass(frozen=True)
class StageTime:
    """Wall time of one stage."""

    stage: A[str, "one of `STAGES`"]
    seconds: A[float, "wall time, [s]"]


class StageClock:
    """Gives every moment since `begin` to one stage, so that the stages add up to the whole.

    The kernel's wall time is shared out by the cycles that its stages took in the timed steps, see
    `physics.bodies.stage_timer`; a tier that times no steps has the one stage ``kernel``.

    Parameters
    ----------
    now : callable
        Gives the time, [s].
    """

    def __init__(self, now: Callable[[], float] = time.perf_counter) -> None:
        self._now = now
        self._seconds = dict.fromkeys(STAGES, 0.0)
        self._last = now()

    def begin(self) -> None:
        """Ignore the time since the last lap, such as waiting."""
        self._last = self._now()

    def lap(self, stage: str) -> None:
        """Add the time since the last lap to a stage."""
        self._seconds[stage] += self._elapsed()

    def lap_kernel(self, cycles: NDArray[np.float64]) -> None:
        """Add the time since the last lap to the stages of the kernel.

        Parameters
        ----------
        cycles : float64 array, shape [stage]
            Of a step, by `KERNEL_STAGES`; zeros when not known.
        """
        passed, total = self._elapsed(), float(cycles.sum())
        if total <= 0.0:
            self._seconds[KERNEL] += passed
            return
        for stage, part in zip(KERNEL_STAGES, cycles.tolist(), strict=True):
            self._seconds[stage] += passed * part / total

    def times(self) -> tuple[StageTime, ...]:
        """List the wall time of every stage that took any, in the order of `STAGES`."""
        return tuple(StageTime(stage, spent) for stage, spent in self._seconds.items() if spent > 0.0)

    def _elapsed(self) -> float:
        now = self._now()
        passed = now - self._last
        self._last = now
        return passed


def stage_lines(times: tuple[StageTime, ...], simulated: float) -> list[str]:
    """Write the stages as a table for the terminal.

    Parameters
    ----------
    simulated : float
        Simulated time, [s].
    """
    total = sum(each.seconds for each in times)
    return [
        f"{'stage':20} {'ms per simulated s':>18} {'share':>8}",
        *(
            f"{name:20} {1e3 * seconds / simulated:18.2f} {100.0 * seconds / total:6.1f} %"
            for name, seconds in [*((each.stage, each.seconds) for each in times), ("sum", total)]
        ),
    ]

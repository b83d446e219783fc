"""Stages of a time step, and the array in which the kernel counts what they take."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

KERNEL_STAGES = (
    "contact", "film", "traction", "rib", "cage", "losses", "solve", "settle", "motion", "rings",
)  # fmt: skip
"""Stages of a time step of the full tier, see `kernels.stage_timer`."""
CONTACT, FILM, TRACTION, RIB, CAGE, LOSS, SOLVE, SETTLE, MOTION, RINGS = range(len(KERNEL_STAGES))
EMPTY = len(KERNEL_STAGES)  # an interval without work
TIMER_SLOTS = EMPTY + 1
_EMPTY_MARKS = 2  # in a marked step, the last of them kept

# Rows: the first is the timer's own, then how often each stage was marked, then cycles of the timed steps.
OWN, MARKS, CYCLES = 0, 1, 2
ROW, LAST = 0, 1  # in the own row: where this step counts, 0 for not at all; the counter at the last mark
TIMED_STEPS = 8
_TURNS = 3  # `model.build.HELD_STEPS`; the steps between two timed ones are no multiple of it
# times the usual cycles of a step; one that works all out has 1.5 times those of the others
_INTERRUPTED = 2.5


def new_timers() -> NDArray[np.float64]:
    """Make counters at zero, shape [CYCLES + TIMED_STEPS, TIMER_SLOTS]."""
    return np.zeros((CYCLES + TIMED_STEPS, TIMER_SLOTS))


def stage_cycles(timers: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Count cycles that each of `KERNEL_STAGES` took in a step, shape [stage]; zeros if none was timed.

    Means over the steps timed last, without what the marks themselves took. A step during which the
    processor did something else for a while is left out. What is worked out in every third step counts by
    a third: three steps timed one after the other are of all its turns.
    """
    if timers is None:
        return np.zeros(len(KERNEL_STAGES))
    counted = timers[CYCLES:][timers[CYCLES:, EMPTY] > 0.0]
    if not len(counted):
        return np.zeros(len(KERNEL_STAGES))
    turns = counted[: len(counted) - len(counted) % _TURNS or None]
    whole = turns.sum(axis=1)
    cycles = turns[whole <= _INTERRUPTED * np.median(whole)].mean(axis=0)
    per_step = timers[MARKS] / (timers[MARKS, EMPTY] / _EMPTY_MARKS)
    return np.maximum(cycles[:EMPTY] - per_step[:EMPTY] * cycles[EMPTY], 0.0)

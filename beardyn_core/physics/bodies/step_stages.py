"""Stages of a time step, and the array in which the kernel counts what they take."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

KERNEL_STAGES = (
    "contact", "film", "traction", "rib", "cage", "losses", "solve", "settle", "motion", "rings",
)  # fmt: skip
"""Stages of a time step of the full tier, see `physics.bodies.stage_timer`."""
CONTACT, FILM, TRACTION, RIB, CAGE, LOSS, SOLVE, SETTLE, MOTION, RINGS = range(len(KERNEL_STAGES))
EMPTY = len(KERNEL_STAGES)  # an interval without work
TIMER_SLOTS = EMPTY + 1
_EMPTY_MARKS = 2  # in a marked step, the last of them kept

# Rows: the first is the timer's own, then how often each stage was marked, then cycles of the timed steps.
OWN, MARKS, CYCLES = 0, 1, 2
ROW, LAST = 0, 1  # in the own row: where this step counts, 0 for not at all; the counter at the last mark
TIMED_STEPS = 64  # as many as a block of 16 steps a sample has
_TURNS = 2  # of the steps between two in which held friction is worked out, that a block times
_INTERRUPTED = 1.5  # times the least cycles of such a step


def new_timers() -> NDArray[np.float64]:
    """Make counters at zero, shape [CYCLES + TIMED_STEPS, TIMER_SLOTS]."""
    return np.zeros((CYCLES + TIMED_STEPS, TIMER_SLOTS))


def stage_cycles(timers: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Count cycles that each of `KERNEL_STAGES` took in a step, shape [stage]; zeros if none was timed.

    What is worked out in one step of six counts by a sixth: steps timed one after the other take turns, each
    place twice a block; means are over the steps of a place, then over the places. A step during which the
    processor did something else for a while is left out, and so is what the marks themselves took.
    """
    if timers is None:
        return np.zeros(len(KERNEL_STAGES))
    counted = timers[CYCLES:][timers[CYCLES:, EMPTY] > 0.0]
    if not len(counted):
        return np.zeros(len(KERNEL_STAGES))
    places = max(len(counted) // _TURNS, 1)
    steps = counted[: len(counted) // places * places].reshape(-1, places, TIMER_SLOTS)
    whole = steps.sum(axis=-1)
    kept = (whole <= _INTERRUPTED * whole.min(axis=0))[..., None]
    cycles = ((steps * kept).sum(axis=0) / kept.sum(axis=0)).mean(axis=0)
    per_step = timers[MARKS] / (timers[MARKS, EMPTY] / _EMPTY_MARKS)
    return np.maximum(cycles[:EMPTY] - per_step[:EMPTY] * cycles[EMPTY], 0.0)

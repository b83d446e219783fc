"""Status bits of a run, and the sentence each means to a user."""

from __future__ import annotations

from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from beardyn_core.integrate.state import State
from beardyn_core.model.layout import (
    CHATTER,
    CHATTER_FIELDS,
    CHATTER_LOAD,
    CHATTER_SQUARES,
    PENETRATION,
    ROLLER_STATES,
)

LARGEST_PENETRATION = 2.0e-4
LARGEST_CHATTER_INDEX = 0.05
CHATTER_LOAD_FLOOR = 5.0


class Status(IntFlag):
    """Why a run is no longer valid; 0 is fine."""

    FINE = 0
    NOT_FINITE = 1
    PENETRATION = 2
    CHATTER = 4
    LOAD_STALE = 8


SENTENCES = {
    Status.NOT_FINITE: "a number became NaN or infinite: use a smaller time step "
    "(numerics.steps_per_sample) or check the load",
    Status.PENETRATION: f"a roller is pressed more than {LARGEST_PENETRATION * 1e6:.0f} um into a raceway, "
    "where the contact law does not hold: lower the load",
    Status.CHATTER: "a friction force flips from step to step, so torque and slip are not converged: raise "
    "numerics.steps_per_sample",
    Status.LOAD_STALE: "the load stopped coming: the load was older than max_age",
}


def describe(status: int) -> str:
    """Sentences of all bits that are set; ``fine`` for none."""
    flags = Status(status)
    return "; ".join(text for flag, text in SENTENCES.items() if flag in flags) or "fine"


def is_fatal(status: int) -> bool:
    """Whether the run has to end."""
    return bool(Status(status) & (Status.NOT_FINITE | Status.PENETRATION | Status.LOAD_STALE))


def chatter_index(state: State, step_count: int) -> NDArray[np.float64]:
    """Chatter index of the last block for each raceway contact, shape [raceway, block, lane].

    The rms of the second difference of the friction force over the friction capacity; a period-2
    oscillation at full friction has the index 1, smooth friction nearly 0.
    """
    index = []
    for ring in range(2):
        first = CHATTER + ring * CHATTER_FIELDS
        rms = np.sqrt(state.rollers[:, first + CHATTER_SQUARES] / step_count)
        capacity = state.rollers[:, first + CHATTER_LOAD] / step_count
        index.append(rms / np.maximum(capacity, CHATTER_LOAD_FLOOR))
    return np.array(index)


def assess(state: State, step_count: int) -> Status:
    """Status after a block."""
    status = Status.FINE
    finite = np.isfinite(state.rollers[:, :ROLLER_STATES]).all() and np.isfinite(state.bodies).all()
    if not finite:
        return Status.NOT_FINITE
    if state.rollers[:, PENETRATION].max() > LARGEST_PENETRATION:
        status |= Status.PENETRATION
    if chatter_index(state, step_count).max() > LARGEST_CHATTER_INDEX:
        status |= Status.CHATTER
    return status

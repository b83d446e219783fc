"""What a run changes and what its steps write: the arrays that every tier shares."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.model.arrangement import Arrangement, aligned_copy, aligned_zeros
from beardyn_core.model.layout import CAGE_BODY, RING_FIELDS, SUM_FIELDS


class State(NamedTuple):
    """Everything that changes during a run."""

    rollers: Any  # float64 [block, ROLLER_FIELDS, lane]
    bodies: Any  # float64 [2 + row, BODY_STATES]: cup, cone, cages
    energy: Any  # float64 [ENERGY_TERMS], works since the start [J]
    flex: Any  # float64 [mode, 2, 2], bending of the cup: cosine and sine, place [m] and speed [m/s]

    def copy(self) -> State:
        """Copy all arrays, so that the copy shares nothing."""
        return State(*(aligned_copy(each) for each in self))


class WorkSpace(NamedTuple):
    """Arrays that a step writes before it reads them."""

    rings: Any  # float64 [group, 3, RING_FIELDS, lane]
    sums: Any  # float64 [group, 1, SUM_FIELDS + 2 x mode, lane]
    wrenches: Any  # float64 [2 + row, 6]
    box: Any  # float64 [12]


class Output(NamedTuple):
    """What a stretch of steps writes."""

    signals: Any  # float64 [step, SIGNAL_CHANNELS], what happens at the end of each step
    rollers: Any  # float64 [trend, ...], copies of the rollers at even spacing, the last at the end
    bodies: Any  # float64 [trend, 2 + row, BODY_STATES], likewise
    audit: Any  # float64 [ENERGY_TERMS], works up to, and energy stored at, the middle of the first step [J]


def work_space(arrangement: Arrangement, modes: int = 0) -> WorkSpace:
    """Make the work space for the rollers' arrangement and the bending modes of the cup."""
    groups, width = arrangement.group_count, arrangement.width
    return WorkSpace(
        aligned_zeros(groups, 3, RING_FIELDS, width),
        aligned_zeros(groups, 1, SUM_FIELDS + 2 * modes, width),
        np.zeros((CAGE_BODY + arrangement.rows, 6)),
        np.zeros(12),
    )

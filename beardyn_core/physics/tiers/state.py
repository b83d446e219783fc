"""What a run changes and what its steps write: the arrays that every tier shares."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.physics.bodies.arrangement import Arrangement, aligned_copy, aligned_zeros
from beardyn_core.physics.bodies.layout import CAGE_BODY, RING_FIELDS, SUM_FIELDS
from beardyn_core.physics.ring_modes import StructureParams
from beardyn_core.physics.suspension import BOX_FIELDS


class State(NamedTuple):
    """Everything that changes during a run."""

    rollers: Any  # float64 [block, ROLLER_FIELDS, lane]
    bodies: Any  # float64 [2 + row, BODY_STATES]: cup, cone, cages
    energy: Any  # float64 [ENERGY_TERMS], works since the start [J]
    flex: Any  # float64 [2, mode], bending of the box: places [m sqrt(kg)] and speeds of unit modal masses
    axle: Any  # float64 [2, plane, mode], likewise of the axle, empty when it is rigid

    def copy(self) -> State:
        """Copy all arrays, so that the copy shares nothing."""
        return State(*(aligned_copy(each) for each in self))


class BendSpace(NamedTuple):
    """How the box bends and what bends it; all that is read of the modes, empty without a structure."""

    bent: Any  # float64 [2, read], places and speeds
    lanes: Any  # float64 [group, 1, 2 x (series + slips), lane], opening; speeds of all series
    forces: Any  # float64 [read]
    change: Any  # float64 [mode], of the speeds over the step
    seats: Any  # float64 [6 + 3 x sensor], of the speeds of the seats


class WorkSpace(NamedTuple):
    """Arrays that a step writes before it reads them."""

    rings: Any  # float64 [group, 3, RING_FIELDS, lane]
    sums: Any  # float64 [group, 1, SUM_FIELDS + series + 2 x slips, lane]
    wrenches: Any  # float64 [2 + row, 6]
    box: Any  # float64 [BOX_FIELDS]
    bend: BendSpace
    response: Any  # float64 [4, 5, 5], matrices of `physics.tiers.kinematic_rings`


class Output(NamedTuple):
    """What a stretch of steps writes."""

    signals: Any  # float64 [step, SIGNAL_CHANNELS], what happens at the end of each step
    rollers: Any  # float64 [trend, ...], copies of the rollers at even spacing, the last at the end
    bodies: Any  # float64 [trend, 2 + row, BODY_STATES], likewise
    audit: Any  # float64 [ENERGY_TERMS], works up to, and energy stored at, the middle of the first step [J]


def work_space(arrangement: Arrangement, structure: StructureParams | None = None) -> WorkSpace:
    """Make the work space for the rollers' arrangement and the structure."""
    groups, width = arrangement.group_count, arrangement.width
    modes, reads = (0, 0) if structure is None else structure.shapes.shape
    series, slips = (0, 0) if structure is None else (structure.series, structure.slips)
    return WorkSpace(
        aligned_zeros(groups, 3, RING_FIELDS, width),
        aligned_zeros(groups, 1, SUM_FIELDS + series + 2 * slips, width),
        np.zeros((CAGE_BODY + arrangement.rows, 6)),
        np.zeros(BOX_FIELDS),
        BendSpace(
            np.zeros((2, reads)),
            aligned_zeros(groups, 1, 2 * (series + slips), width),
            np.zeros(reads),
            np.zeros(modes),
            np.zeros(0 if structure is None else len(structure.seats)),
        ),
        np.zeros((4, 5, 5)),
    )

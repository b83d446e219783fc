"""Status bits of a run, and the sentence each means to a user."""

from __future__ import annotations

from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from beardyn_core.integrate.state import State
from beardyn_core.model.guide_parameters import RibParams
from beardyn_core.model.layout import (
    AXIAL,
    AXIS,
    CHATTER,
    CHATTER_FIELDS,
    CHATTER_LOAD,
    CHATTER_SQUARES,
    CONE,
    CONTACT_OUTPUT,
    CUP,
    OUTPUT_ARM,
    OUTPUT_FIELDS,
    OUTPUT_FILM,
    OUTPUT_FORCE,
    PENETRATION,
    RADIUS,
    RIB,
    ROLLER_STATES,
)

LARGEST_PENETRATION = 2.0e-4
LARGEST_CHATTER_INDEX = 0.2
CHATTER_LOAD_FLOOR = 5.0
# Rib contacts and films are judged only where they carry this much [N].
SMALLEST_JUDGED_LOAD = 100.0
LARGEST_FILM = 1.0e-5
# A rib contact this far beyond the face bears on its edge [m]; the cone's own place is not looked at.
EDGE_MARGIN = 2.0e-4


class Status(IntFlag):
    """Why a run is no longer valid; 0 is fine."""

    FINE = 0
    NOT_FINITE = 1
    PENETRATION = 2
    CHATTER = 4
    OFF_RIB = 8
    FILM_RANGE = 16
    RIB_EDGE = 32


SENTENCES = {
    Status.NOT_FINITE: "a number became NaN or infinite: use a smaller time step "
    "(numerics.steps_per_sample) or check the load",
    Status.PENETRATION: f"a roller is pressed more than {LARGEST_PENETRATION * 1e6:.0f} um into a raceway, "
    "where the contact law does not hold: lower the load, or make the defects smaller",
    Status.CHATTER: "a friction force flips from step to step, so torque and slip are not converged: let "
    "numerics.steps_per_sample be auto, or raise it",
    Status.OFF_RIB: "a roller presses on its rib beyond the edge of its large end: lower the axial load "
    "or the sphere ratio, or let the rim of the roller carry (effects: rib: roller_end)",
    Status.FILM_RANGE: f"a loaded film is thicker than {LARGEST_FILM * 1e6:.0f} um, where the "
    "elastohydrodynamic formula does not hold: raise the temperature or take a thinner lubricant",
    Status.RIB_EDGE: "a roller bears on an edge of its rib and not on the face: pressure there is far above "
    "the rib's Hertz pressure; lower the axial load or the tilt, or change rib_contact_height",
}


def describe(status: int) -> str:
    """Sentences of all bits that are set; ``fine`` for none."""
    flags = Status(status)
    return "; ".join(text for flag, text in SENTENCES.items() if flag in flags) or "fine"


def is_fatal(status: int) -> bool:
    """Whether the run has to end."""
    fatal = Status.NOT_FINITE | Status.PENETRATION | Status.OFF_RIB
    return bool(Status(status) & fatal)


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


def _output(state: State, kind: int, first: int, count: int) -> NDArray[np.float64]:
    """Fields of one contact's output, shape [block, field, lane]."""
    start = CONTACT_OUTPUT + kind * OUTPUT_FIELDS + first
    return state.rollers[:, start : start + count]


def is_off_rib(state: State, large_end_radius: float) -> bool:
    """Whether a loaded rib contact lies outside the roller's large end.

    Parameters
    ----------
    state : State
    large_end_radius : float
        [m].
    """
    load = np.linalg.norm(_output(state, RIB, OUTPUT_FORCE, 3), axis=1)
    arm, axis = _output(state, RIB, OUTPUT_ARM, 3), state.rollers[:, AXIS : AXIS + 3]
    from_axis = np.linalg.norm(np.cross(arm, axis, axis=1), axis=1)
    return bool(np.any((load > SMALLEST_JUDGED_LOAD) & (from_axis > large_end_radius)))


def is_on_rib_edge(state: State, rib: RibParams | None) -> bool:
    """Whether a loaded rib contact lies on an edge of the rib face.

    Parameters
    ----------
    state : State
    rib : RibParams or None
    """
    if rib is None or rib.window is None:
        return False
    load = np.linalg.norm(_output(state, RIB, OUTPUT_FORCE, 3), axis=1)
    axis = state.rollers[:, AXIS : AXIS + 3]
    radial = np.hypot(state.rollers[:, RADIUS] + rib.sphere_place * axis[:, 0], rib.sphere_place * axis[:, 1])
    axial = state.rollers[:, AXIAL] + rib.sphere_place * axis[:, 2]
    height = radial * rib.normal_axial - axial * rib.normal_radial
    edge = rib.window.rounding
    beyond = np.maximum(rib.window.low - edge - height, height - rib.window.high - edge)
    return bool(np.any((load > SMALLEST_JUDGED_LOAD) & (beyond > EDGE_MARGIN)))


def is_film_out_of_range(state: State) -> bool:
    """Whether a loaded raceway film is too thick for the elastohydrodynamic formula."""
    for kind in (CUP, CONE):
        load = np.linalg.norm(_output(state, kind, OUTPUT_FORCE, 3), axis=1)
        film = _output(state, kind, OUTPUT_FILM, 1)[:, 0]
        if np.any((load > SMALLEST_JUDGED_LOAD) & (film > LARGEST_FILM)):
            return True
    return False


def assess(state: State, step_count: int, large_end_radius: float, rib: RibParams | None = None) -> Status:
    """Status after a block.

    Parameters
    ----------
    state : State
    step_count : int
        Steps of the block.
    large_end_radius : float
        Of a roller, [m].
    rib : RibParams or None
        Rib contact of the run.

    Returns
    -------
    Status
    """
    status = Status.FINE
    finite = np.isfinite(state.rollers[:, :ROLLER_STATES]).all() and np.isfinite(state.bodies).all()
    if not finite:
        return Status.NOT_FINITE
    if state.rollers[:, PENETRATION].max() > LARGEST_PENETRATION:
        status |= Status.PENETRATION
    if chatter_index(state, step_count).max() > LARGEST_CHATTER_INDEX:
        status |= Status.CHATTER
    if is_off_rib(state, large_end_radius):
        status |= Status.OFF_RIB
    if is_on_rib_edge(state, rib):
        status |= Status.RIB_EDGE
    if is_film_out_of_range(state):
        status |= Status.FILM_RANGE
    return status

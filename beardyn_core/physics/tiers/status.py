"""Status bits of a run, and the sentence each means to a user."""

from __future__ import annotations

import math
from enum import IntFlag

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies.layout import (
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
from beardyn_core.physics.cage.watch import CageWatch
from beardyn_core.physics.flanges import FlangeParams
from beardyn_core.physics.lanes.vectors import cross, dot
from beardyn_core.physics.rib import RibParams
from beardyn_core.physics.tiers.friction_steps import LARGEST_CHATTER_INDEX
from beardyn_core.physics.tiers.state import State

LARGEST_PENETRATION = 2.0e-4
CHATTER_LOAD_FLOOR = 5.0
# Rib contacts and films are judged only where they carry this much [N].
SMALLEST_JUDGED_LOAD = 100.0
LARGEST_FILM = 1.0e-5
# A rib contact this far beyond the face bears on its edge [m]; the cone's own place is not looked at.
EDGE_MARGIN = 2.0e-4


_OF_RING = {"cup": 1.0, "cone": -1.0}  # where a contact is from the roller's axis


class Status(IntFlag):
    """Why a run is no longer valid; 0 is fine."""

    FINE = 0
    NOT_FINITE = 1
    PENETRATION = 2
    CHATTER = 4
    OFF_RIB = 8
    FILM_RANGE = 16
    RIB_EDGE = 32
    CAGE_FAST = 64
    CAGE_BACKWARDS = 128


# what compiled code can see of them
_NOT_FINITE, _PENETRATION, _CHATTER, _OFF_RIB, _FILM_RANGE, _RIB_EDGE = list(map(int, Status))[:6]

SENTENCES = {
    Status.NOT_FINITE: "a number became NaN or infinite: use a smaller time step "
    "(numerics.steps_per_sample) or check the load",
    Status.PENETRATION: f"a roller is pressed more than {LARGEST_PENETRATION * 1e6:.0f} um into a raceway, "
    "where the contact law does not hold: lower the load, or make the defects smaller",
    Status.CHATTER: "a friction force flips from step to step, so torque and slip are not converged: raise "
    "numerics.steps_per_sample, or let it be auto where it is not",
    Status.OFF_RIB: "a roller presses on its rib beyond the edge of its large end: lower the axial load "
    "or the sphere ratio, or let the rim of the roller carry (effects: rib: roller_end)",
    Status.FILM_RANGE: f"a loaded film is thicker than {LARGEST_FILM * 1e6:.0f} um, where the "
    "elastohydrodynamic formula does not hold: raise the temperature or take a thinner lubricant",
    Status.RIB_EDGE: "a roller bears on an edge of its rib and not on the face: pressure there is far above "
    "the rib's Hertz pressure; lower the axial load or the tilt, or change rib_contact_height",
    Status.CAGE_FAST: "a cage runs more than 1 % ahead of rolling rollers: a dry rib drives idle rollers, or "
    "the shaft slows down faster than its cages; lubricate the rib (effects: rib: lubrication), or raise the "
    "load",
    Status.CAGE_BACKWARDS: "a cage runs against the shaft: the rollers hardly touch the cone; raise the load",
}


def describe(status: int) -> str:
    """Write the sentences of all bits that are set; ``fine`` for none."""
    flags = Status(status)
    return "; ".join(text for flag, text in SENTENCES.items() if flag in flags) or "fine"


def is_fatal(status: int) -> bool:
    """Check whether the run has to end."""
    fatal = Status.NOT_FINITE | Status.PENETRATION | Status.OFF_RIB
    return bool(Status(status) & fatal)


def status_of_cages(cages: CageWatch) -> Status:
    """Judge the speeds of the cages, once these have turned around."""
    fast = Status.CAGE_FAST if cages.is_fast else Status.FINE
    return fast | (Status.CAGE_BACKWARDS if cages.is_backwards else Status.FINE)


def chatter_index(state: State, step_count: int) -> NDArray[np.float64]:
    """Work out the chatter index of the last block for each raceway contact, shape [raceway, block, lane].

    The rms of what flips in the friction force (`bodies.contact_output.watch_chatter`) over the rms of the
    friction capacity. Full friction that flips every step has the index 2, every second step 0.7; smooth
    friction has nearly 0, and a strike what it is compared with its own load.
    """
    index = []
    for ring in range(2):
        first = CHATTER + ring * CHATTER_FIELDS
        rms = np.sqrt(state.rollers[:, first + CHATTER_SQUARES] / step_count)
        capacity = np.sqrt(state.rollers[:, first + CHATTER_LOAD] / step_count)
        index.append(rms / np.maximum(capacity, CHATTER_LOAD_FLOOR))
    return np.array(index)


def assess(
    state: State,
    step_count: int,
    large_end_radius: float,
    rib: RibParams | None = None,
    flanges: FlangeParams | None = None,
) -> Status:
    """Judge the status after a block.

    Parameters
    ----------
    step_count : int
        Steps of the block.
    large_end_radius : float
        Of a roller, [m].
    rib, flanges :
        Rib contacts of the run.
    """
    faces = [] if rib is None else [_face(0.0, 0.0, rib)]
    if flanges is not None:
        for name, flange in flanges._asdict().items():
            if flange is not None:
                ring, side = name.split("_")
                faces.append(_face(_OF_RING[ring], 1.0 if side == "outer" else -1.0, flange.rib))
    known = np.array(faces).reshape(-1, 7)
    return Status(int(_judge(state.rollers, state.bodies, float(step_count), large_end_radius, known)))


def _face(ring: float, side: float, rib: RibParams) -> list[float]:
    """Describe a face: ring and side of its rib, 0 where there is but one; without a window no edges."""
    low, high = -math.inf, math.inf
    if rib.window is not None:
        low, high = rib.window.low - rib.window.rounding, rib.window.high + rib.window.rounding
    return [ring, side, rib.sphere_place, rib.normal_radial, rib.normal_axial, low, high]


@entry
def _judge(rollers, bodies, step_count, large_end_radius, faces):
    """Set the bits of the status; rollers [block, ROLLER_FIELDS, lane]."""
    flags = 0
    for block in range(rollers.shape[0]):
        for field in range(ROLLER_STATES):
            for lane in range(rollers.shape[2]):
                if not math.isfinite(rollers[block, field, lane]):
                    return _NOT_FINITE
    for body in range(bodies.shape[0]):
        for field in range(bodies.shape[1]):
            if not math.isfinite(bodies[body, field]):
                return _NOT_FINITE
    for block in range(rollers.shape[0]):
        for lane in range(rollers.shape[2]):
            if rollers[block, PENETRATION, lane] > LARGEST_PENETRATION:
                flags |= _PENETRATION
            if _chatters(rollers, block, lane, step_count):
                flags |= _CHATTER
            if _contact_load(rollers, block, RIB, lane) > SMALLEST_JUDGED_LOAD:
                if _from_axis(rollers, block, lane) > large_end_radius:
                    flags |= _OFF_RIB
                if _beyond_face(rollers, block, lane, faces) > EDGE_MARGIN:
                    flags |= _RIB_EDGE
            for kind in (CUP, CONE):
                film = rollers[block, CONTACT_OUTPUT + kind * OUTPUT_FIELDS + OUTPUT_FILM, lane]
                if film > LARGEST_FILM and _contact_load(rollers, block, kind, lane) > SMALLEST_JUDGED_LOAD:
                    flags |= _FILM_RANGE
    return flags


@inline
def _chatters(rollers, block, lane, step_count):
    """Check whether the chatter index of a roller is too large on cup or cone; see `chatter_index`."""
    found = False
    for ring in range(2):
        first = CHATTER + ring * CHATTER_FIELDS
        rms = math.sqrt(rollers[block, first + CHATTER_SQUARES, lane] / step_count)
        capacity = math.sqrt(rollers[block, first + CHATTER_LOAD, lane] / step_count)
        found = found or rms / max(capacity, CHATTER_LOAD_FLOOR) > LARGEST_CHATTER_INDEX
    return found


@inline
def _contact_load(rollers, block, kind, lane):
    first = CONTACT_OUTPUT + kind * OUTPUT_FIELDS + OUTPUT_FORCE
    x, y, z = rollers[block, first, lane], rollers[block, first + 1, lane], rollers[block, first + 2, lane]
    return math.sqrt(x * x + y * y + z * z)


@inline
def _from_axis(rollers, block, lane):
    """Work out the distance of the rib contact from the roller's axis, [m]."""
    first = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS + OUTPUT_ARM
    arm = (rollers[block, first, lane], rollers[block, first + 1, lane], rollers[block, first + 2, lane])
    axis = (rollers[block, AXIS, lane], rollers[block, AXIS + 1, lane], rollers[block, AXIS + 2, lane])
    across = cross(arm, axis)
    return math.sqrt(dot(across, across))


@inline
def _beyond_face(rollers, block, lane, faces):
    """Measure how far the rib contact is beyond the edges of its face, the cone's place neglected, [m]."""
    first = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS + OUTPUT_ARM
    out, along = rollers[block, first, lane], rollers[block, first + 2, lane]
    beyond = -math.inf
    for face in range(faces.shape[0]):
        ring, side, place = faces[face, 0], faces[face, 1], faces[face, 2]
        if ring * out < 0.0 or side * along < 0.0:
            continue
        turn = 1.0 if side == 0.0 else side  # seen from its own side
        sphere = turn * place
        radial = math.hypot(
            rollers[block, RADIUS, lane] + sphere * rollers[block, AXIS, lane],
            sphere * rollers[block, AXIS + 1, lane],
        )
        axial = turn * (rollers[block, AXIAL, lane] + sphere * rollers[block, AXIS + 2, lane])
        height = radial * faces[face, 4] - axial * faces[face, 3]
        beyond = max(beyond, max(faces[face, 5] - height, height - faces[face, 6]))
    return beyond

"""The state of the full tier: the arrays that a run changes, and its start from static equilibrium."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.integrate.static import StaticSolution
from beardyn_core.model.aligned import aligned_copy, aligned_zeros
from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.layout import (
    ANGLE,
    AXIAL,
    AXIS,
    BODY_STATES,
    CAGE_BODY,
    CONE_BODY,
    ENERGY_TERMS,
    MOMENTUM,
    POSITION,
    RADIUS,
    RATE,
    RING_FIELDS,
    ROLLER_FIELDS,
    SUM_FIELDS,
    TILT,
    VELOCITY,
)

Float = NDArray[np.float64]


@dataclass
class State:
    """Everything that changes during a run.

    Parameters
    ----------
    rollers : float64 array, shape [block, ROLLER_FIELDS, lane]
    bodies : float64 array, shape [2 + row, BODY_STATES]
    energy : float64 array, shape [ENERGY_TERMS]
    flex : float64 array, shape [mode, 2, 2]
        Bending of the cup: cosine and sine amplitude, displacement [m] and velocity [m/s].
    """

    rollers: Float
    bodies: Float
    energy: Float
    flex: Float

    def copy(self) -> State:
        """A copy that shares nothing."""
        return State(**{field.name: aligned_copy(getattr(self, field.name)) for field in fields(self)})


@dataclass(frozen=True)
class WorkSpace:
    """Arrays that a step writes before it reads them."""

    rings: Float
    sums: Float
    wrenches: Float
    box: Float


def work_space(arrangement: Arrangement, modes: int = 0) -> WorkSpace:
    """Work space for the rollers' arrangement and the bending modes of the cup."""
    groups, width = arrangement.group_count, arrangement.width
    return WorkSpace(
        aligned_zeros(groups, 3, RING_FIELDS, width),
        aligned_zeros(groups, 1, SUM_FIELDS + 2 * modes, width),
        np.zeros((CAGE_BODY + arrangement.rows, 6)),
        np.zeros(12),
    )


def kinematic_spin(bearing: Bearing, cage_speed: float) -> float:
    """Spin of a roller about its axis relative to the orbit frame when it rolls on the cup, [rad/s]."""
    return -cage_speed * math.sin(bearing.cup_angle) / math.sin(bearing.half_angle)


def initial_state(
    bearing: Bearing,
    arrangement: Arrangement,
    static: StaticSolution,
    shaft_speed: float,
    cage_speed: float,
) -> State:
    """State in static equilibrium, rolling at the given speeds.

    Parameters
    ----------
    bearing : Bearing
    arrangement : Arrangement
    static : StaticSolution
        Equilibrium under the first load.
    shaft_speed, cage_speed : float
        [rad/s].

    Returns
    -------
    State
    """
    lanes = arrangement.to_lanes
    rollers = aligned_zeros(arrangement.block_count, ROLLER_FIELDS, arrangement.width)
    angle = bearing.contact_angle + lanes(static.roller_tilt)
    offset = bearing.roller_mass_offset
    radius = 0.5 * bearing.pitch_diameter + lanes(static.roller_radial) + offset * np.sin(angle)
    rollers[:, RADIUS] = radius
    rollers[:, ANGLE] = 2.0 * math.pi * arrangement.roller / arrangement.roller_count
    rollers[:, AXIAL] = 0.5 * bearing.row_spacing + lanes(static.roller_axial) + offset * np.cos(angle)
    rollers[:, VELOCITY + 1] = cage_speed * radius
    sine, cosine = np.sin(angle), np.cos(angle)
    rollers[:, AXIS], rollers[:, AXIS + 2] = sine, cosine

    spin = kinematic_spin(bearing, cage_speed)
    about = bearing.roller_axial_inertia * (spin + cage_speed * cosine)
    across = bearing.roller_transverse_inertia * cage_speed
    # omega = spin b + cage_speed e_axial, split along and across the roller axis b
    rollers[:, MOMENTUM] = about * sine - across * cosine * sine
    rollers[:, MOMENTUM + 2] = about * cosine + across * sine * sine

    bodies = np.zeros((CAGE_BODY + arrangement.rows, BODY_STATES))
    bodies[CONE_BODY, POSITION : POSITION + 3] = static.displacement
    bodies[CONE_BODY, TILT], bodies[CONE_BODY, TILT + 2] = static.tilt
    bodies[CONE_BODY, RATE] = shaft_speed
    bodies[CAGE_BODY:, RATE] = cage_speed
    # through the end play rollers move further than their pockets allow, and take the cage with them
    rows, room = arrangement.rows, 0.5 * bearing.cage.axial_clearance
    shift, outward = static.roller_axial.mean(axis=1)[:rows], np.array([-1.0, 1.0])[:rows]
    bodies[CAGE_BODY:, POSITION + 1] = outward * (shift - np.clip(shift, -room, room))
    flex = np.zeros((*static.bending.shape, 2))
    flex[..., 0] = static.bending
    return State(rollers, bodies, np.zeros(ENERGY_TERMS), flex)

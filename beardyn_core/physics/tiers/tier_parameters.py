"""Kernel parameters of the tiers without roller dynamics; see `parameters` for the rules."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.physics.bodies.arrangement import Arrangement, aligned_copy
from beardyn_core.physics.bodies.layout import MASK, OVERSIZE, POCKET_ANGLE
from beardyn_core.physics.cage.play import LooseParams
from beardyn_core.physics.defect import FaultParams
from beardyn_core.physics.pure_rolling import KinematicParams
from beardyn_core.physics.roller_spring import SpringParams
from beardyn_core.physics.rolling_waves import RollingWaveParams
from beardyn_core.physics.scatter import mean_crown
from beardyn_core.physics.tiers.massless_flanges import ThrustParams
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.sliding import SlideParams
from beardyn_core.physics.tiers.tier_bending import BendingParams
from beardyn_core.scene.scene import Scene


class RingMotionParams(NamedTuple):
    """Axlebox and journal as the tiers without roller dynamics move them; order x, y, z, about x, y, z."""

    steady: Any  # [6], force on the box that does not change: preload and weight
    box_push: Any  # [6], acceleration of the box by a force, 0 when it is held [1/kg], [1/(kg m^2)]
    journal_push: float  # [1/kg]
    journal_turn: float  # 0 when the journal does not tilt [1/(kg m^2)]
    rate: float  # steps in a second [1/s]


class RingResponseParams(NamedTuple):
    """How a step takes stiffness and damping of the rollers; see `physics.tiers.kinematic_rings`."""

    lag: float  # h^2/12 and half a step of the dampers' time [s^2]
    damper_share: float  # of the dampers in that
    give: Any  # [5, 5], acceleration of the cone against the cup by a wrench between them
    lever: float  # arm of the cup's normal about the bearing centre [m]


class LumpedParameters(NamedTuple):
    """Everything constant during a lumped run; `faults` is ``None`` in a bearing without patches."""

    step: float  # [s]
    base: Parameters
    kinematic: KinematicParams
    motion: RingMotionParams
    response: RingResponseParams
    spring: SpringParams
    pockets: Any  # [block, 5, lane]: as of `pocket_directions`
    sides: Any  # [1, 1, lane]: -1 in lanes of row 0, +1 in lanes of row 1
    faults: FaultParams | None
    waves: RollingWaveParams | None
    highest: float  # bound of what waves and rims bring cup and cone nearer by [m]
    bending: BendingParams | None
    slide: SlideParams | None  # ``None``: without a film
    thrust: ThrustParams | None  # of cylinders


class DirectParams(NamedTuple):
    """Axial forces of the rollers on the cup are summed by themselves: ribs push, and normals turn."""

    summed: float


class QuasistaticParameters(NamedTuple):
    """Everything constant during a quasistatic run."""

    step: float  # [s]
    base: Parameters
    kinematic: KinematicParams
    motion: RingMotionParams
    response: RingResponseParams
    tangent: float  # stiffness of a pressed roller over the tenth root of its load [N^0.9/m]
    pockets: Any  # [block, 5, lane]: as of `pocket_directions`
    sides: Any  # [1, 1, lane]: -1 in lanes of row 0, +1 in lanes of row 1
    highest_wave: float  # bound of what waviness of cone and roller brings them nearer by [m]
    bending: BendingParams | None
    loose: LooseParams | None  # ``None``: rollers stay in the middle of their pockets
    slide: SlideParams | None  # ``None``: without a film, and of cylinders and barrels
    grip: SlideParams | None  # of cylinders and barrels, which slide along both raceways by themselves
    direct: DirectParams | None  # ``None`` where the cup is pushed along its nominal normal alone


def without_roller_dynamics(base: Parameters) -> Parameters:
    """Leave out what only the dynamics of the rollers read: each number costs time in every call."""
    effects = base.effects._replace(
        coulomb=None, mixed=None, load_sharing=None, small_rib=None, cage=None,
        structure=None,
    )  # fmt: skip
    return base._replace(effects=effects, explicit=None, held=None)


def without_surfaces(base: Parameters) -> Parameters:
    """Leave out laminae and faults of raceways and rollers, which the lumped tier has in forms of its own."""
    faults = base.effects.faults._replace(
        cup=None, cone=None, roller=None, cup_damage=None, cone_damage=None,
        cup_waves=None, cone_waves=None, roller_waves=None,
    )  # fmt: skip
    return base._replace(effects=base.effects._replace(faults=faults, coupling=None))


def flatten_profiles(base: Parameters, scene: Scene) -> Parameters:
    """Take the errors of the rollers' profiles as their mean along the contact, for rollers without tilt."""
    faults = base.effects.faults
    if faults.crowns is None:
        return base
    rollers = aligned_copy(base.rollers)
    width, count = rollers.shape[2], scene.bearing.roller_count
    arrangement = Arrangement(count, width, scene.rows, scene.missing_places)
    rollers[:, OVERSIZE] -= arrangement.to_lanes(mean_crown(scene))
    return base._replace(rollers=rollers, effects=base.effects._replace(faults=faults._replace(crowns=None)))


def ring_motion_params(base: Parameters) -> RingMotionParams:
    """Work out the motion of axlebox and journal.

    The suspension damps with the velocity of the middle of the step, (m + h c/2) a = F; a box that hangs
    next to its centre keeps that of the beginning.
    """
    mounting, gravity = base.mounting, base.effects.gravity
    steady = mounting.preload.copy()
    steady[2] -= mounting.box_mass * (gravity.acceleration if gravity else 0.0)
    inertia = np.concatenate([np.full(3, mounting.box_mass), mounting.box_inertia])
    push = mounting.cup_moves / inertia
    if mounting.coupling is None:
        push = push / (1.0 + 0.5 * base.step * mounting.damping * push)
    return RingMotionParams(
        steady=steady,
        box_push=push,
        journal_push=1.0 / mounting.journal_mass,
        journal_turn=mounting.journal_tilts / mounting.journal_inertia,
        rate=1.0 / base.step,
    )


def ring_response_params(base: Parameters, motion: RingMotionParams, lever: float) -> RingResponseParams:
    """Work out the correction of the step to fourth order, and to second order in the damping."""
    damping, coupling = base.effects.damping, base.mounting.coupling
    dampers = 0.0 if damping is None else 0.5 * base.step * damping.time_constant
    lag = base.step**2 / 12.0 + dampers
    box = np.diag(motion.box_push) if coupling is None else base.mounting.cup_moves * coupling.inverse_mass
    moving = [0, 1, 2, 3, 5]
    journal = np.array([*[motion.journal_push] * 3, *[motion.journal_turn] * 2])
    give = np.ascontiguousarray(box[np.ix_(moving, moving)] + np.diag(journal))
    bending = base.mounting.journal
    if bending is not None:
        for axis, turn, side in ((2, 3, 1.0), (0, 4, -1.0)):
            shapes = np.zeros((5, len(bending.place)))
            shapes[axis], shapes[turn] = bending.place, side * bending.slope
            give += (shapes / bending.inertia) @ shapes.T
    return RingResponseParams(lag, dampers / lag, give, lever)


def pocket_directions(base: Parameters) -> Any:
    """Take cosine and sine of the pocket angles, and the mask of the rollers, alone and times these."""
    angle, mask = base.rollers[:, POCKET_ANGLE], base.rollers[:, MASK]
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.ascontiguousarray(np.stack([cosine, sine, mask, mask * cosine, mask * sine], axis=1))


def row_sides(base: Parameters, rows: int) -> Any:
    """Take the side of the row of each lane, shape [1, 1, lane]."""
    width = base.rollers.shape[2]
    return np.repeat([-1.0, 1.0][:rows], width // rows)[None, None]


def patches_or_none(faults: FaultParams) -> FaultParams | None:
    """Take the faults of a bearing as those of its patches alone, ``None`` when it has none."""
    if faults.cup is None and faults.cone is None and faults.roller is None:
        return None
    return faults._replace(cup_waves=None, cone_waves=None, roller_waves=None, pockets=None, crowns=None)

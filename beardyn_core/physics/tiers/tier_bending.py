"""Bending of the axlebox as kernel parameters of the tiers with kinematic rollers."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.physics.bodies.arrangement import aligned_zeros
from beardyn_core.physics.bodies.layout import MASK, POCKET_ANGLE
from beardyn_core.physics.modal_body import ModalBody, body_of
from beardyn_core.physics.oscillators import exact_oscillators
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import seat_of

# Rate of a mode times the step up to which it moves by itself: 6.4 kHz at one step a sample. The lumped tier,
# which lives from its speed, carries those to 5.1 kHz.
RESOLVED = {"lumped": 1.25, "quasistatic": 0.5 * math.pi}
# The same of those that stand for all others; it only scales their shapes.
_STATIC_TURN = 4.0
_LEFT_OUT = 1e-3  # of the compliance of raceways and seats, by the directions that these leave out
_LEFT_OUT_WAVES = 2e-4  # likewise of the raceways, by the highest waves; 2e-3 cost 1.6 % of roller load


class JointParams(NamedTuple):
    """Few modes and the motion of rigid rings together, and their work space; see `tiers.joint_bending`.

    Rows in blocks of lanes with zeros behind the last number: modes, then x, y, z and tilts about x and z.
    """

    motions: Any  # [opening, block, lane], approach of the raceways by modes and by motion of the cone
    give: Any  # [row, block, lane], acceleration by forces [-], [1/kg]
    springs: Any  # work space [row, block, lane]: of the rollers, times `lag`
    springs_rows: Any  # the same memory [row, number]
    system: Any  # work space [row, block, lane]
    system_rows: Any  # the same memory [row, number]
    response: Any  # work space [row, block, lane]
    vectors: Any  # work space [2, block, lane]
    rows: Any  # the same memory [2, number]


class BendingParams(NamedTuple):
    """Modes of the box along the normals of the cups, and their work space.

    What is read of the modes stands in one row: openings of the raceways as series, row after row, mean,
    cosines, sines; six motions of the suspension's seats where these bend the box; sensors. Forces act on
    the first two. Matrices are stored by columns, their rows in blocks of lanes with zeros behind the last.
    """

    shapes: Any  # [block of reads, mode, lane], of the openings along the normals [1/sqrt(kg)]
    pushes: Any  # [block of modes, force, lane], the same the other way round
    stiffness: Any  # [mode], over the inertia of the step [1/s^2]
    damping: Any  # [mode], likewise [1/s]
    inverse: Any  # [mode], of the inertia of the step [-]
    rigid: Any  # [opening, 5], approach of the raceways by motion of the cone, as of `relative_cone`
    give: Any  # [block of openings, opening, lane], acceleration by forces, modes and rings [1/kg]
    sensor_give: Any  # [block, opening, lane], of the sensors' seats by what is held, or None
    lag: float  # share of the rollers' springs and dampers in the inertia of the step [s^2]
    damper_share: float  # of the dampers in that
    basis: Any  # [block, series, lane], one, cosines and sines at the pocket angles
    row_lanes: Any  # [1, row, lane], 1 where a lane holds rollers of the row
    seen: Any  # work space [2, block of reads, lane]: places and speeds of what forces act on
    seen_row: Any  # the same memory [2, read], [m], [m/s]
    shown: Any  # work space [1, 2 x series, lane]: openings and speeds in the cages' frame
    tangents: Any  # work space [block, 1, lane]: stiffness of the rollers [N/m]
    forces: Any  # work space [force], [N]
    vectors: Any  # work space [4, block of reads, lane]
    rows: Any  # the same memory [4, read]
    response: Any  # work space [block of openings, opening, lane], see `physics.tiers.kinematic_bending`
    pushed: Any  # work space [1, block of modes, lane]
    pushed_row: Any  # the same memory [mode]
    draw: Any  # work space [mode]
    joint: JointParams | None  # where modes are few


@dataclass(frozen=True, eq=False)
class StepBody:
    """A modal body for a long step: modes that it resolves, and a few that stand for the rest."""

    body: ModalBody
    opening: A[Float, "shape [mode, row x series], along the cup's normal, [1/sqrt(kg)]"]
    sensors: A[Float | None, "shape [mode, 3 x sensor], [1/sqrt(kg)]"]
    share: A[Float, "shape [mode, mode of the table]: amplitudes at rest from those of the table"]


@lru_cache(maxsize=8)
def _kept_shares(body: ModalBody, step: float, tier: str) -> tuple[Float, Float, Float]:
    """Find rates [rad/s], shares and damping of the modes of a step in a tier.

    Modes that the step does not resolve follow their forces at once. What they give way, P P^T with the
    shapes over their rates P, is kept by the largest singular values of P, each as a stiff mode.
    """
    unresolved = body.rate * step >= RESOLVED[tier]
    kept, rest = np.flatnonzero(~unresolved), np.flatnonzero(unresolved)
    shares = np.eye(len(body.rate))[kept]
    if len(rest) == 0:
        return body.rate, shares, body.damping_ratio
    reads = [body.opening.reshape(len(body.rate), -1)]
    if body.suspension is not None:
        reads.append(body.suspension[:3].T)
    shapes = np.concatenate(reads, axis=1) / body.rate[:, None]
    _, sizes, vectors = np.linalg.svd(shapes[rest].T, full_matrices=False)
    left = (shapes**2).sum() * _LEFT_OUT
    count = int(np.count_nonzero(np.cumsum(sizes[::-1] ** 2)[::-1] > left))
    rate = _STATIC_TURN / step
    still = np.zeros((count, len(body.rate)))
    still[:, rest] = vectors[:count] * (body.rate[rest] / rate)
    rates = np.concatenate([body.rate[kept], np.full(count, rate)])
    ratio = np.concatenate([body.damping_ratio[kept], np.full(count, float(body.damping_ratio[rest].mean()))])
    return rates, np.concatenate([shares, still]), ratio


def step_body(scene: Scene, step: float) -> StepBody | None:
    """Fit the modal body of a scene to a step [s]; ``None`` where its box is rigid."""
    body = body_of(scene)
    if body is None:
        return None
    rate, share, ratio = _kept_shares(body, step, scene.tier)
    # a shape of the table adds to a new mode with the squared rates, so that w^2 q = F for both
    shapes_of = share * (rate[:, None] / body.rate) ** 2
    sensors = None
    if body.modes is not None:
        seats = [body.modes.seats[seat_of(sensor, body.modes)] for sensor in scene.sensors]
        sensors = shapes_of @ np.concatenate(seats, axis=1)
    suspension = None if body.suspension is None else body.suspension @ shapes_of.T
    modes = len(body.rate)
    raceway = (shapes_of @ body.raceway.reshape(modes, -1)).reshape(len(rate), *body.raceway.shape[1:])
    fitted = replace(body, rate=rate, damping_ratio=ratio, raceway=raceway, suspension=suspension)
    opening = math.cos(scene.bearing.cup_angle) * _without_fine_waves(fitted.opening, rate)
    return StepBody(fitted, opening, sensors, share)


def bending_params(
    scene: Scene, base: Parameters, give: Float, lever: float, sides: Float
) -> BendingParams | None:
    """Work out the parameters of the bending of a scene's box.

    Parameters
    ----------
    give : array, shape [5, 5]
        Acceleration of the cone against the cup by a wrench between them, rings rigid.
    lever : float
        Arm of the cup's normal about the bearing centre, [m].
    sides : array, shape [1, 1, lane]
        Side of the row of each lane.
    """
    fitted = step_body(scene, base.step)
    if fitted is None:
        return None
    body, opening = fitted.body, fitted.opening
    damping, inertia = _oscillators(body, base.step)
    modes, openings = opening.shape
    series = openings // scene.rows
    rigid = np.zeros((openings, 5))
    cup = base.cup
    for row in range(scene.rows):
        side = float(sides[0, 0, -1 if row else 0])
        rigid[row * series, 1] = -side * cup.sine
        rigid[row * series + 1, [2, 3]] = cup.cosine, side * lever
        rigid[row * series + 1 + series // 2, [0, 4]] = cup.cosine, -side * lever
    acting = opening if body.suspension is None else np.concatenate([opening, body.suspension.T], axis=1)
    read, sensor_give = acting, None
    contacts = base.effects.damping
    dampers = 0.0 if contacts is None else 0.5 * base.step * contacts.time_constant
    lag = base.step**2 / 12.0 + dampers
    if fitted.sensors is not None:
        # The acceleration of the instant of a resolved mode is that of its force: what the step is short of
        # is in its inertia and in what is held for the springs. Modes that follow forces move as these do.
        resolved = body.rate * base.step < 0.99 * _STATIC_TURN
        sensors = fitted.sensors * np.where(resolved, inertia, 1.0)[:, None]
        read = np.concatenate([acting, sensors], axis=1)
        held = np.where(resolved, dampers / lag, 1.0)
        sensor_give = _in_lanes((sensors.T * (held / inertia)) @ opening, base.rollers.shape[2])
    modal_give = (opening.T / inertia) @ opening
    few = fitted.sensors is None and body.suspension is None and modes < openings
    blocks, width = base.rollers.shape[0], base.rollers.shape[2]
    read_blocks, open_blocks, mode_blocks = (-(-n // width) for n in (read.shape[1], openings, modes))
    seen = aligned_zeros(2, read_blocks, width)
    vectors = aligned_zeros(4, read_blocks, width)
    pushed = aligned_zeros(1, mode_blocks, width)
    return BendingParams(
        shapes=_in_lanes(read.T, width),
        pushes=_in_lanes(acting, width),
        stiffness=body.stiffness / inertia,
        damping=damping / inertia,
        inverse=1.0 / inertia,
        rigid=rigid,
        give=_in_lanes(modal_give + rigid @ give @ rigid.T, width),
        sensor_give=sensor_give,
        lag=lag,
        damper_share=dampers / lag,
        basis=_basis(base, series),
        row_lanes=_row_lanes(scene.rows, width),
        seen=seen,
        seen_row=seen.reshape(2, -1),
        shown=aligned_zeros(1, 2 * series, width),
        tangents=aligned_zeros(blocks, 1, width),
        forces=np.zeros(acting.shape[1]),
        vectors=vectors,
        rows=vectors.reshape(4, -1),
        response=aligned_zeros(open_blocks, openings, width),
        pushed=pushed,
        pushed_row=pushed.reshape(-1),
        draw=np.zeros(modes),
        joint=_joint_params(acting[:, :openings], rigid, inertia, give, width) if few else None,
    )


def _joint_params(opening: Float, rigid: Float, inertia: Float, give: Float, width: int) -> JointParams:
    """Put modes and rigid motions together; arguments as of `bending_params`."""
    modes = len(inertia)
    count = modes + len(give)
    whole = np.zeros((count, count))
    whole[range(modes), range(modes)] = 1.0 / inertia
    whole[modes:, modes:] = give
    matrices = [aligned_zeros(count, -(-count // width), width) for _ in range(3)]
    vectors = aligned_zeros(2, -(-count // width), width)
    springs, system, response = matrices
    return JointParams(
        motions=_in_rows(np.concatenate([-opening.T, rigid], axis=1), width),
        give=_in_rows(whole, width),
        springs=springs,
        springs_rows=springs.reshape(count, -1),
        system=system,
        system_rows=system.reshape(count, -1),
        response=response,
        vectors=vectors,
        rows=vectors.reshape(2, -1),
    )


def _oscillators(body: ModalBody, step: float) -> tuple[Float, Float]:
    """Find damping [1/s] and inertia of the step: exact motion, and for those that stand for others x^2 / 2.

    With that these are at four steps a turn and as far from the limit of stability as their own stiffness is
    large: right at rest, late in motion.
    """
    turn, ratio = body.rate * step, body.damping_ratio
    still = turn > 0.99 * _STATIC_TURN
    _, damping, inertia = exact_oscillators(np.where(still, 1.0 / step, body.rate), ratio, step)
    half = ratio * turn
    return np.where(still, 2.0 * half / step, damping), np.where(still, 0.5 * turn**2 + half, inertia)


def _in_lanes(matrix: Float, width: int) -> Float:
    """Store a matrix by columns, its rows in blocks of lanes, shape [block, column, lane]."""
    rows, columns = matrix.shape
    blocks = -(-rows // width)
    padded = np.zeros((blocks * width, columns))
    padded[:rows] = matrix
    stored = aligned_zeros(blocks, columns, width)
    stored[:] = np.moveaxis(padded.reshape(blocks, width, columns), 1, 2)
    return stored


def _in_rows(matrix: Float, width: int) -> Float:
    """Store a matrix by rows in blocks of lanes, shape [row, block, lane]."""
    rows, columns = matrix.shape
    stored = aligned_zeros(rows, -(-columns // width), width)
    stored.reshape(rows, -1)[:, :columns] = matrix
    return stored


def _without_fine_waves(opening: Float, rate: Float) -> Float:
    """Leave out the highest waves, which hardly yield; shapes [mode, row, series] -> [mode, row x series]."""
    waves = opening.shape[-1] // 2
    yields = ((opening / rate[:, None, None]) ** 2).sum(axis=(0, 1))
    of_wave = yields[1 : waves + 1] + yields[waves + 1 :]
    left = np.cumsum(of_wave[::-1])[::-1]  # by leaving out this wave and all above
    most = int(np.count_nonzero(left > _LEFT_OUT_WAVES * yields.sum()))
    most = max(most, 1)  # waves that rigid motion has
    columns = [*range(most + 1), *range(waves + 1, waves + 1 + most)]
    return np.ascontiguousarray(opening[..., columns]).reshape(len(rate), -1)


def _basis(base: Parameters, series: int) -> Float:
    """Take one, cosines and sines of the pocket angles, shape [block, series, lane]."""
    order = np.arange(1, series // 2 + 1)[None, :, None] * base.rollers[:, POCKET_ANGLE, None]
    basis = aligned_zeros(base.rollers.shape[0], series, base.rollers.shape[2])
    basis[:] = np.concatenate([np.ones_like(order[:, :1]), np.cos(order), np.sin(order)], axis=1)
    return basis


def _row_lanes(rows: int, width: int) -> Float:
    """Mark the lanes of each row, shape [1, row, lane]."""
    marks = aligned_zeros(1, rows, width)
    for row in range(rows):
        marks[0, row, row * width // rows : (row + 1) * width // rows] = 1.0
    return marks


def openings_at_pockets(bending: BendingParams, base: Parameters, rows: int) -> Float:
    """Evaluate the shapes at all pockets at the beginning of a run, shape [block, lane, mode]."""
    _, modes, width = bending.shapes.shape
    shapes = np.moveaxis(bending.shapes, 1, 2).reshape(-1, modes)
    series, blocks = len(bending.rigid) // rows, base.rollers.shape[0]
    found = np.zeros((blocks, width, modes))
    for lane in range(width):
        first = rows * lane // width * series
        found[:, lane] = bending.basis[:, :, lane] @ shapes[first : first + series]
    return found * base.rollers[:, MASK, :, None]

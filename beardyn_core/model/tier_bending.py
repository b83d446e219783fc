"""Bending of the axlebox as kernel parameters of the tiers with kinematic rollers."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.config.structure import seat_of
from beardyn_core.model.arrangement import aligned_zeros
from beardyn_core.model.layout import MASK, POCKET_ANGLE
from beardyn_core.model.parameters import Parameters
from beardyn_core.model.structure import ModalBody, body_of, exact_oscillators
from beardyn_core.scene.scene import Scene

RESOLVED = 2.5  # rate of a mode times the step up to which it moves by itself, as of `exact_oscillators`
_STATIC_TURN = 6.0  # the same of those that stand for all others: they follow their forces
_LEFT_OUT = 1e-3  # of the compliance of raceways and seats, by what these leave out


class BendingParams(NamedTuple):
    """Modes of the box along the normals of the cups, and their work space.

    Openings stand as series around the raceways, row after row: mean, cosines, sines; ``read`` is row x
    series.
    """

    shapes: Any  # [mode, read], opening of a raceway along its normal [1/sqrt(kg)]
    stiffness: Any  # [mode], of unit modal masses [1/s^2]
    damping: Any  # [mode] [1/s]
    inertia: Any  # [mode], of the step [-]
    suspension: Any  # [6, mode], as of `StructureParams`, or None
    sensors: Any  # [3 x sensor, mode], acceleration of the seats by change of speed over step, or None
    rigid: Any  # [read, 5], approach of the raceways by motion of the cone, as of `relative_cone`
    give: Any  # [read, read], acceleration of all openings by forces along the normals, modes and rings [1/kg]
    modal_give: Any  # [read, read], the part of the modes
    seat_give: Any  # [read, 6], by forces of the suspension, zeros without
    sensor_give: Any  # [3 x sensor, read], of the sensors' seats, or None
    lag: float  # share of the rollers' springs and dampers in the inertia of the step [s^2]
    damper_share: float  # of the dampers in that
    basis: Any  # [block, series, lane], one, cosines and sines at the pocket angles
    seen: Any  # work space [3, read]: openings, their speeds, and how modes draw back [m], [m/s], [m/s^2]
    shown: Any  # work space [1, 2 x series, lane]: openings and speeds in the cages' frame
    tangents: Any  # work space [block, 1, lane]: stiffness of the rollers [N/m]
    forces: Any  # work space [2, read]: on the openings by the rollers, and what acceleration adds [N]
    approach: Any  # work space [3, read]
    response: Any  # work space [read, read], see `kernels.kinematic_bending`
    push: Any  # work space [mode]


@dataclass(frozen=True, eq=False)
class StepBody:
    """A modal body for a long step: modes that it resolves, and a few that stand for the rest."""

    body: ModalBody
    opening: A[Float, "shape [mode, row x series], along the cup's normal, [1/sqrt(kg)]"]
    sensors: A[Float | None, "shape [mode, 3 x sensor], [1/sqrt(kg)]"]
    share: A[Float, "shape [mode, mode of the table]: amplitudes at rest from those of the table"]


@lru_cache(maxsize=8)
def _kept_shares(body: ModalBody, step: float) -> tuple[Float, Float, Float]:
    """Find rates [rad/s], shares and damping of the modes of a step.

    Modes that the step does not resolve follow their forces at once. What they give way, P P^T with the
    shapes over their rates P, is kept by the largest singular values of P, each as a stiff mode.
    """
    unresolved = body.rate * step >= RESOLVED
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
    ratio = np.concatenate(
        [body.damping_ratio[kept], np.full(count, float(body.damping_ratio[rest].mean()))]
    )
    return rates, np.concatenate([shares, still]), ratio


def step_body(scene: Scene, step: float) -> StepBody | None:
    """Fit the modal body of a scene to a step [s]; ``None`` where its box is rigid."""
    body = body_of(scene)
    if body is None:
        return None
    rate, share, ratio = _kept_shares(body, step)
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
    opening = math.cos(scene.bearing.cup_angle) * fitted.opening.reshape(len(rate), -1)
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
    body, shapes = fitted.body, np.ascontiguousarray(fitted.opening)
    mass, damping, inertia = exact_oscillators(body.rate, body.damping_ratio, base.step)
    modes, reads = shapes.shape
    series = reads // scene.rows
    rigid = np.zeros((reads, 5))
    cup = base.cup
    for row in range(scene.rows):
        side = float(sides[0, 0, -1 if row else 0])
        rigid[row * series, 1] = -side * cup.sine
        rigid[row * series + 1, [2, 3]] = cup.cosine, side * lever
        rigid[row * series + 1 + series // 2, [0, 4]] = cup.cosine, -side * lever
    modal_give = (shapes.T / inertia) @ shapes
    seat_give = np.zeros((reads, 6))
    if body.suspension is not None:
        seat_give = (shapes.T / inertia) @ body.suspension.T
    sensors = sensor_give = None
    if fitted.sensors is not None:
        # unit modal masses: what a step of a resolved mode is short of is in its inertia
        true = np.where(body.rate * base.step < RESOLVED, inertia, 1.0)
        sensors = np.ascontiguousarray((fitted.sensors * true[:, None]).T)
        sensor_give = np.ascontiguousarray(sensors @ (shapes / inertia[:, None]))
    contacts = base.effects.damping
    dampers = 0.0 if contacts is None else 0.5 * base.step * contacts.time_constant
    lag = base.step**2 / 12.0 + dampers
    blocks, width = base.rollers.shape[0], base.rollers.shape[2]
    return BendingParams(
        shapes, body.stiffness, damping, inertia,
        None if body.suspension is None else np.ascontiguousarray(body.suspension),
        sensors, rigid, np.ascontiguousarray(modal_give + rigid @ give @ rigid.T),
        np.ascontiguousarray(modal_give), np.ascontiguousarray(seat_give), sensor_give, lag, dampers / lag,
        _basis(base, series), np.zeros((3, reads)), aligned_zeros(1, 2 * series, width),
        aligned_zeros(blocks, 1, width), np.zeros((2, reads)), np.zeros((3, reads)),
        np.zeros((reads, reads)), np.zeros(modes),
    )  # fmt: skip


def _basis(base: Parameters, series: int) -> Float:
    """Take one, cosines and sines of the pocket angles, shape [block, series, lane]."""
    order = np.arange(1, series // 2 + 1)[None, :, None] * base.rollers[:, POCKET_ANGLE, None]
    basis = aligned_zeros(base.rollers.shape[0], series, base.rollers.shape[2])
    basis[:] = np.concatenate([np.ones_like(order[:, :1]), np.cos(order), np.sin(order)], axis=1)
    return basis


def openings_at_pockets(bending: BendingParams, base: Parameters, rows: int) -> Float:
    """Evaluate the shapes at all pockets at the beginning of a run, shape [block, lane, mode]."""
    modes, reads = bending.shapes.shape
    series, (blocks, _, width) = reads // rows, base.rollers.shape
    found = np.zeros((blocks, width, modes))
    for lane in range(width):
        row = rows * lane // width
        found[:, lane] = bending.basis[:, :, lane] @ bending.shapes[:, row * series : (row + 1) * series].T
    return found * base.rollers[:, MASK, :, None]

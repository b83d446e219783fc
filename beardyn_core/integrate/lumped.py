"""Steps of the lumped tier: rings on suspension and journal, rollers as springs that orbit."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.errors import ValidityError
from beardyn_core.integrate.kinematic_step import (
    TRENDS_PER_BLOCK,
    begin_advance,
    begin_step,
    cage_direction,
    finish_step,
)
from beardyn_core.integrate.roller_contacts import Float
from beardyn_core.integrate.roller_spring import spring_params
from beardyn_core.jit import entry
from beardyn_core.kernels.kinematic_rings import add_response, hold_response, journal_velocity
from beardyn_core.kernels.kinematic_rollers import cup_wrench, relative_cone
from beardyn_core.kernels.kinematic_torque import held_losses
from beardyn_core.kernels.spring_roller import load_rollers, show_springs, sum_rollers, torque_and_stiffness
from beardyn_core.model.layout import MASK, POCKET_ANGLE
from beardyn_core.model.parameters import Parameters
from beardyn_core.model.tier_parameters import (
    LumpedParameters,
    faults_or_none,
    kinematic_params,
    pocket_directions,
    ring_motion_params,
    ring_response_params,
    row_sides,
)
from beardyn_core.scene.scene import Scene

_ITERATIONS = 60
_TOLERANCE = 1e-9


def lumped_parameters(scene: Scene, base: Parameters) -> LumpedParameters:
    """Kernel parameters of the lumped tier."""
    motion, spring = ring_motion_params(base), spring_params(scene.bearing, scene.numerics.laminae)
    return LumpedParameters(
        step=base.step,
        base=base,
        kinematic=kinematic_params(scene),
        motion=motion,
        response=ring_response_params(base, motion, spring.lever),
        spring=spring,
        pockets=pocket_directions(base),
        sides=row_sides(base, scene.rows),
        faults=faults_or_none(base),
    )


@entry
def advance_lumped(
    lanes: Any,
    rollers: Any,
    bodies: Any,
    flex: Any,
    rings: Any,
    sums: Any,
    wrenches: Any,
    box: Any,
    loads: Any,
    signals: Any,
    roller_trend: Any,
    body_trend: Any,
    energy: Any,
    audit: Any,
    p: Any,
) -> None:
    """Advance the lumped tier over whole blocks of steps; arguments as of the full tier's `advance`.

    Parameters
    ----------
    rings : float64 array, shape [1, 3, 13, lane]
        Work space of `kernels.kinematic_rings`.
    flex, audit : float64 arrays
        Not used: rings are rigid, the cone is seen as a whole, and no energy balance is kept.
    roller_trend : float64 array, shape [trend, block + TREND_EXTRAS, 1, lane]
        Written: loads, from which `show_lumped` makes the rollers.
    p : LumpedParameters
    """
    steps = signals.shape[0]
    stride = steps // roller_trend.shape[0]
    begin_advance(rollers)
    direction = cage_direction(bodies)
    losses = (0.0, 0.0)
    work = rings[0]
    for step in range(steps):
        if step % (TRENDS_PER_BLOCK * stride) == 0:
            direction = cage_direction(bodies)  # several blocks at once have the bits of one at a time
        direction, turns, speeds = begin_step(bodies, direction, p)
        due, shown = step % stride == 0, (step + 1) % stride == 0
        trend = roller_trend[step // stride]
        motion = relative_cone(bodies)
        load_rollers(lanes, rollers, sums[0], motion, direction, turns, speeds, trend, p)
        totals, rib = sum_rollers(sums, speeds, p)
        wrench = cup_wrench(totals, direction, p.base.cup.cosine, p.base.cup.sine)
        if due:
            torque_and_stiffness(lanes, rollers.shape[0], sums[0], motion, direction, speeds, trend, p)
            losses = held_losses(sums, speeds, rib, p)
            hold_response(sums, direction, work, p)
        before = journal_velocity(bodies)
        finish_step(
            bodies, wrench, rib, losses, wrenches, box, loads[step], loads[step + 1], signals[step], energy, p
        )
        add_response(bodies, before, signals[step], work, p)
        if shown:
            for i, value in enumerate((turns[0], speeds[0], speeds[1])):
                trend[rollers.shape[0] + i] = value
            body_trend[step // stride] = bodies
    show_springs(lanes, rollers, roller_trend[roller_trend.shape[0] - 1], p)


@entry
def show_lumped(lanes: Any, trends: Any, rollers: Any, p: Any) -> None:
    """Write the rollers of some instants as the full tier keeps them.

    Parameters
    ----------
    trends : float64 array, shape [time, block + TREND_EXTRAS, 1, lane]
        From `advance_lumped`.
    rollers : float64 array, shape [time, block, ROLLER_FIELDS, lane]
        Written, but for friction memory and the largest approach.
    p : LumpedParameters
    """
    for t in range(trends.shape[0]):
        show_springs(lanes, rollers[t], trends[t], p)


def settle_lumped(p: LumpedParameters, pose: Float, load: Float, cage_rate: float) -> Float:
    """Pose of the cone in the static equilibrium of the lumped tier.

    Parameters
    ----------
    p : LumpedParameters
    pose : float64 array, shape [5]
        Displacement and tilt about x and z to start from, [m], [rad].
    load : float64 array, shape [5] or [3]
        Force on the cup and, with a free tilt, moment about x and z, [N], [N m].
    cage_rate : float
        [rad/s].

    Raises
    ------
    ValidityError
        When no equilibrium is found.
    """
    spring, cup = p.spring, p.base.cup
    counted = p.base.rollers[:, MASK] > 0.0
    sides = np.broadcast_to(p.sides[0, 0], counted.shape)
    springs = np.zeros(len(load))
    springs[1] = p.base.mounting.prop_stiffness
    idle = spring.idle * p.kinematic.centrifugal * cage_rate**2
    rows = []
    for side in np.unique(sides):
        azimuth = np.sort(p.base.rollers[:, POCKET_ANGLE][counted & (sides == side)])
        outward = np.stack([np.sin(azimuth), np.cos(azimuth)])
        lean = np.full(azimuth.size, -side * cup.sine)
        tilt_x, tilt_z = spring.lever * side * outward[1], -spring.lever * side * outward[0]
        rows.append(
            np.stack([cup.cosine * outward[0], lean, cup.cosine * outward[1], tilt_x, tilt_z], axis=1)
        )
    normal = np.concatenate(rows)[:, : len(load)]
    found = np.array(pose[: len(load)], dtype=float)
    scale = np.array([1.0, 1.0, 1.0, spring.lever, spring.lever])[: len(load)]
    terms = np.arange(len(spring.series))
    for _ in range(_ITERATIONS):
        approach = normal @ found - cup.gap
        root = np.maximum(approach, 1e-12) ** (1.0 / 9.0)
        pressing = approach > 0.0
        pressed = pressing * approach * root * (root[:, None] ** terms @ spring.series)
        tangent = 10.0 / 9.0 * pressed / np.maximum(approach, 1e-12)
        force = np.maximum(pressed + 0.5 * idle, idle)
        missing = load - force @ normal - springs * found
        if np.abs(missing / scale).max() <= _TOLERANCE * max(np.abs(load / scale).max(), 1.0):
            break
        tangent = tangent * (pressed > 0.5 * idle)
        stiffness = (normal * tangent[:, None]).T @ normal + np.diag(1e3 * scale**2 + springs)
        change = np.linalg.solve(stiffness, missing)
        found = found + change * min(1.0, 2e-5 / float(np.abs(change * scale).max()))
    else:
        raise ValidityError("the lumped tier found no static equilibrium under the first load")
    return np.concatenate([found, pose[len(load) :]])

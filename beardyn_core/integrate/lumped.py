"""Steps of the lumped tier: rings on suspension and journal, rollers as springs that orbit."""

from __future__ import annotations

from typing import Any

from beardyn_core.integrate.kinematic_step import (
    TRENDS_PER_BLOCK,
    Drive,
    begin_advance,
    begin_step,
    cage_direction,
    finish_step,
)
from beardyn_core.jit import entry
from beardyn_core.kernels.kinematic_rings import add_response, hold_response, journal_velocity
from beardyn_core.kernels.kinematic_rollers import cup_wrench, relative_cone
from beardyn_core.kernels.kinematic_torque import held_losses
from beardyn_core.kernels.spring_roller import load_rollers, show_springs, sum_rollers, torque_and_stiffness


@entry
def advance_lumped(lanes: Any, state: Any, work: Any, loads: Any, output: Any, p: Any) -> None:
    """Advance the lumped tier over whole blocks of steps.

    Parameters
    ----------
    state : State
        Changed in place, but for the bending of the cup: rings are rigid.
    work : WorkSpace
        The first page of the rings is the work space of `kernels.kinematic_rings`.
    loads : float64 array, shape [step + 1, 10]
        As of the full tier's `advance`.
    output : Output
        Written; the trend of the rollers, shape [trend, block + TREND_EXTRAS, 1, lane], has the loads, from
        which `show_lumped` makes the rollers. The energy balance is not kept.
    """
    rollers, bodies, energy = state.rollers, state.bodies, state.energy
    sums, wrenches, box, signals = work.sums, work.wrenches, work.box, output.signals
    roller_trend, body_trend = output.rollers, output.bodies
    steps = signals.shape[0]
    stride = steps // roller_trend.shape[0]
    begin_advance(rollers)
    direction = cage_direction(bodies)
    losses = (0.0, 0.0)
    response = work.rings[0]
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
            hold_response(sums, direction, response, p)
        before = journal_velocity(bodies)
        finish_step(
            bodies, Drive(wrench, rib, losses), wrenches, box, loads[step], loads[step + 1], signals[step],
            energy, p,
        )  # fmt: skip
        add_response(bodies, before, signals[step], response, p)
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
    """
    for t in range(trends.shape[0]):
        show_springs(lanes, rollers[t], trends[t], p)

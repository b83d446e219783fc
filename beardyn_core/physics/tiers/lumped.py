"""Steps of the lumped tier: rings on suspension and journal, rollers as springs that orbit.

At the instants of a trend only loads are kept; all else of the rollers is made when it is asked for.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.contact_output import clear_largest
from beardyn_core.physics.bodies.layout import ANGLE, POCKET_ANGLE, RADIUS, ROLLER_FIELDS, VELOCITY
from beardyn_core.physics.tiers.kinematic_bending import show_openings, turn_reaction
from beardyn_core.physics.tiers.kinematic_rings import hold_stiffness
from beardyn_core.physics.tiers.kinematic_rollers import cup_wrench, held_losses, keep_losses, relative_cone
from beardyn_core.physics.tiers.kinematic_step import (
    TRENDS_PER_BLOCK,
    Drive,
    begin_advance,
    begin_step,
    cage_direction,
    copy_table,
    finish_step,
)
from beardyn_core.physics.tiers.massless_roller import (
    TREND_EXTRAS,
    add_tilt,
    begin_largest,
    load_rollers,
    show_springs,
    sum_rollers,
    tilt_stiffness,
    torque_and_stiffness,
)
from beardyn_core.physics.tiers.planar_flanges import axial_sine
from beardyn_core.physics.tiers.sliding import add_sliding, hold_sliding
from beardyn_core.physics.tiers.tier_parameters import LumpedParameters

_ORBIT_FIELDS = VELOCITY + 2


@entry
def advance_lumped(lanes, state, work, loads, output, p):
    """Advance the lumped tier over whole blocks of steps; arguments as of the full tier's `advance`.

    The energy balance is not kept, but what each source loses. The trend of the rollers [trend,
    row, 1, lane], see `trend_shape`, has the loads, from which `show_lumped` makes the rollers.
    """
    rollers, bodies, energy, flex, axle = state.rollers, state.bodies, state.energy, state.flex, state.axle
    bending = p.bending
    sums, wrenches, box, signals = work.sums, work.wrenches, work.box, output.signals
    roller_trend, body_trend = output.rollers, output.bodies
    steps = signals.shape[0]
    stride = steps // roller_trend.shape[0]
    begin_advance(rollers)
    direction = cage_direction(bodies)
    losses, tilting = (0.0, 0.0), (0.0, 0.0, 0.0)
    response = work.response
    for step in range(steps):
        if step % (TRENDS_PER_BLOCK * stride) == 0:
            direction = cage_direction(bodies)  # several blocks at once have the bits of one at a time
        direction, turns, speeds = begin_step(bodies, direction, p)
        due, shown = step % stride == 0, (step + 1) % stride == 0
        show_openings(lanes, flex, direction, box, p.step, due, bending)
        trend = roller_trend[step // stride]
        if due:
            begin_largest(roller_trend, step // stride, rollers.shape[0])
        motion = relative_cone(bodies)
        load_rollers(lanes, rollers, sums[0], motion, direction, turns, speeds, trend, p)
        totals, rib = sum_rollers(sums, speeds, p)
        turn_reaction(sums, direction, bending)
        sine = axial_sine(p.base.cup.sine, p.thrust)
        wrench = cup_wrench(totals, direction, p.base.cup.cosine, sine)
        if due:
            torque_and_stiffness(lanes, rollers.shape[0], sums[0], motion, direction, speeds, trend, p)
            losses = held_losses(sums, speeds, rib, p)
            keep_losses(energy, sums, speeds, 0.0, stride * p.step, p)
            hold_stiffness(lanes, sums, direction, response, p, bending)
            hold_sliding(sums, direction, response, p, p.slide)
            tilting = tilt_stiffness(sums, direction)
        wrench = add_tilt(wrench, tilting, motion, p.base.effects.damping)
        wrench = add_sliding(wrench, motion, response, p.slide)
        finish_step(
            lanes, bodies, flex, axle, Drive(wrench, rib, losses, None), wrenches, box, loads[step],
            loads[step + 1], signals[step], energy, response, p,
        )  # fmt: skip
        if shown:
            for i, value in enumerate((turns[0], speeds[0], speeds[1])):
                trend[rollers.shape[0] + i] = value
            copy_table(bodies, body_trend[step // stride])
    clear_largest(rollers)
    show_springs(lanes, rollers, roller_trend[roller_trend.shape[0] - 1], p)


@entry
def show_lumped(lanes, trends, rollers, p):
    """Write ``rollers`` [time, ...] at the instants of ``trends`` [time, ...], see `show_springs`."""
    for t in range(trends.shape[0]):
        show_springs(lanes, rollers[t], trends[t], p)


def trend_shape(rollers: tuple[int, ...], parameters: LumpedParameters) -> tuple[int, ...]:
    """Shape what `advance_lumped` writes at an instant, from the shape of the rollers' state.

    Rows: loads of each block of rollers, instant, largest loads, and of cylinders what each passes on along
    the axle.
    """
    block, _fields, lane = rollers
    return (2 if parameters.thrust is None else 3) * block + TREND_EXTRAS, 1, lane


class SpringTrend:
    """Rollers at some instants, see `physics.tiers.kinematics.Instants`.

    ``trends`` [time, row, 1, lane] are from `advance_lumped`, see `trend_shape`; nobody changes them any
    more.
    """

    def __init__(self, lanes: Any, trends: NDArray[np.float64], parameters: LumpedParameters) -> None:
        self._lanes, self._trends, self._parameters = lanes, trends, parameters

    def __getitem__(self, times: slice) -> SpringTrend:
        return SpringTrend(self._lanes, self._trends[times], self._parameters)

    def hardest(self) -> SpringTrend:
        """Take the instant with the largest load of a roller since the snapshot before."""
        blocks = len(self._parameters.base.rollers)
        first = blocks + TREND_EXTRAS
        largest = self._trends[:, first : first + blocks].max(axis=(1, 2, 3))
        time = int(largest.argmax())
        return self[time : time + 1]

    def _empty(self, fields: int) -> NDArray[np.float64]:
        times, _rows, _one, lane = self._trends.shape
        return np.zeros((times, len(self._parameters.base.rollers), fields, lane))

    def whole(self) -> NDArray[np.float64]:
        """Make the state as the full tier has it, shape [time, block, ROLLER_FIELDS, lane]."""
        rollers = self._empty(ROLLER_FIELDS)
        show_lumped(self._lanes, np.ascontiguousarray(self._trends), rollers, self._parameters)
        return rollers

    def orbits(self) -> NDArray[np.float64]:
        """Make angle, and speed as if at the radius 1: the first fields, shape [time, block, field, lane]."""
        rollers = self._empty(_ORBIT_FIELDS)
        _orbits(np.ascontiguousarray(self._trends), self._parameters.base.rollers, rollers)
        return rollers


@entry
def _orbits(trends, constants, rollers):
    blocks = rollers.shape[1]
    for t in range(rollers.shape[0]):
        turn, speed = trends[t, blocks, 0, 0], trends[t, blocks + 2, 0, 0]
        for block in range(blocks):
            for lane in range(rollers.shape[3]):
                rollers[t, block, RADIUS, lane] = 1.0
                rollers[t, block, ANGLE, lane] = constants[block, POCKET_ANGLE, lane] + turn
                rollers[t, block, VELOCITY + 1, lane] = speed

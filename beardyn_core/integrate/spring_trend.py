"""Rollers of the lumped tier at some instants: loads are kept, all else is made when it is asked for."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.integrate.lumped import show_lumped
from beardyn_core.integrate.roller_contacts import Float
from beardyn_core.jit import entry
from beardyn_core.kernels.spring_roller import TREND_EXTRAS
from beardyn_core.model.layout import ANGLE, POCKET_ANGLE, RADIUS, ROLLER_FIELDS, VELOCITY
from beardyn_core.model.tier_parameters import LumpedParameters

_ORBIT_FIELDS = VELOCITY + 2


def trend_shape(rollers: tuple[int, ...]) -> tuple[int, ...]:
    """Shape what `advance_lumped` writes at an instant, from the shape of the rollers' state."""
    block, _fields, lane = rollers
    return block + TREND_EXTRAS, 1, lane


class SpringTrend:
    """Rollers at some instants, see `observe.kinematics.Instants`.

    Parameters
    ----------
    lanes : Lanes
    trends : float64 array, shape [time, block + TREND_EXTRAS, 1, lane]
        From `advance_lumped`; nobody changes it any more.
    parameters : LumpedParameters
    """

    def __init__(self, lanes: Any, trends: Float, parameters: LumpedParameters) -> None:
        self._lanes, self._trends, self._parameters = lanes, trends, parameters

    def __getitem__(self, times: slice) -> SpringTrend:
        return SpringTrend(self._lanes, self._trends[times], self._parameters)

    def _empty(self, fields: int) -> Float:
        times, blocks, _one, lane = self._trends.shape
        return np.zeros((times, blocks - TREND_EXTRAS, fields, lane))

    def whole(self) -> Float:
        """Make the state as the full tier has it, shape [time, block, ROLLER_FIELDS, lane]."""
        rollers = self._empty(ROLLER_FIELDS)
        show_lumped(self._lanes, np.ascontiguousarray(self._trends), rollers, self._parameters)
        return rollers

    def orbits(self) -> Float:
        """Make angle, and speed as if at the radius 1: the first fields, shape [time, block, field, lane]."""
        rollers = self._empty(_ORBIT_FIELDS)
        _orbits(self._trends, self._parameters.base.rollers, rollers)
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

"""Torque budget of a run: mean power and equivalent torque of every loss."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.model.layout import LOSS_NAMES

NUMERICAL = "time_step"


@dataclass(frozen=True)
class LossShare:
    """One source of loss."""

    source: A[str, "one of ``LOSS_NAMES``, or `NUMERICAL` for what the implicit time step itself loses"]
    power: A[float, "mean dissipated power, [W]"]
    torque: A[float, "the same power over the mean shaft speed, NaN with the shaft at rest, [N m]"]


@dataclass(frozen=True)
class TorqueBudget:
    """Losses of a run by source.

    Notes
    -----
    In a steady run the equivalent torques add up to the mean torque of the bearing on the shaft, with the
    other sign; else the change of the stored energy and the work of the load make the difference.
    """

    begin: A[float, "time from which the means are taken, [s]"]
    end: A[float, "time up to which they are, [s]"]
    shaft_speed: A[float, "mean amount of the shaft speed in that time, [rad/s]"]
    shares: A[tuple[LossShare, ...], "every source, the time step last"]

    @property
    def power(self) -> float:
        """Power of all sources, [W]."""
        return math.fsum(share.power for share in self.shares)

    @property
    def torque(self) -> float:
        """Torque of all sources, [N m]."""
        return math.fsum(share.torque for share in self.shares)

    def to_json(self) -> dict[str, Any]:
        """Give the budget as a mapping, units in the keys; torques are NaN with the shaft at rest."""
        return {
            "begin_s": self.begin,
            "end_s": self.end,
            "shaft_speed_rad_per_s": self.shaft_speed,
            "power_W": {share.source: share.power for share in self.shares},
            "torque_N_m": {share.source: share.torque for share in self.shares},
            "power_sum_W": self.power,
            "torque_sum_N_m": self.torque,
        }

    def lines(self) -> list[str]:
        """Write a table for a terminal, with the sources that lose something."""
        rows = [share for share in self.shares if share.power != 0.0]
        rows = [*sorted(rows, key=lambda share: -abs(share.power)), LossShare("sum", self.power, self.torque)]
        return [
            f"{'loss':20} {'power W':>10} {'torque N m':>11}   {self.begin:.3f} s to {self.end:.3f} s",
            *(f"{row.source.replace('_', ' '):20} {row.power:10.2f} {row.torque:11.4f}" for row in rows),
        ]


def torque_budget(
    times: Sequence[float], lost: NDArray[np.float64], shaft_speed: float
) -> TorqueBudget | None:
    """Compute the budget from the energies lost up to some times; ``None`` when no time lies between.

    Parameters
    ----------
    times : sequence of float
        Growing; the first and the last one bound the budget, [s].
    lost : float64 array, shape [time, LOSSES + 1]
        Energy lost by source since the start of the run, the time step last, [J].
    shaft_speed : float
        Mean amount of the shaft speed between the first and the last time, [rad/s].
    """
    if len(times) < 2 or not times[-1] > times[0]:
        return None
    power = (lost[-1] - lost[0]) / (times[-1] - times[0])
    shares = tuple(
        LossShare(source, float(watts), float(watts) / shaft_speed if shaft_speed else math.nan)
        for source, watts in zip((*LOSS_NAMES, NUMERICAL), power, strict=True)
    )
    return TorqueBudget(float(times[0]), float(times[-1]), shaft_speed, shares)

"""Summary of a run: means over whole cage revolutions, losses, life."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.sensors.stage_clock import StageTime

if TYPE_CHECKING:
    from beardyn_core.physics.statics.rating_life import RatingLife

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


COMPLETE = "complete"
# Oscillations of the start have died away by then; shorter runs are averaged over their second half.
SETTLING_S = 0.25


@dataclass(frozen=True)
class RunSummary:
    """Summary of a run; means over the last whole cage revolutions."""

    scene: str
    tier: str
    effects: A[tuple[str, ...], "names of the effects that were present"]
    not_in_tier: A[tuple[str, ...], "names of effects of the scene that the tier does not represent"]
    duration: A[float, "simulated, [s]"]
    wall_time: A[float, "spent in the simulation itself, without compiling, recording and drawing, [s]"]
    status: A[str, "``complete``, or the sentence on how the run left its validity"]
    mean_force: A[tuple[float, float, float], "of the rollers on the cup, world axes, [N]"]
    shaft_torque: A[float, "mean torque of the bearing on the shaft, [N m]"]
    cage_speed_ratio: A[tuple[float, ...], "one a row, over FTF and shaft speed, nominal 1; NaN at rest"]
    energy_residual: A[float | None, "of the audit at the end; ``None`` without audit"]
    budget: A[TorqueBudget | None, "losses by source over the time of the means; ``None`` without audit"]
    averaged: A[tuple[float, float], "first and last time of the means, [s]"]
    cage_revolutions: A[int, "whole revolutions of the cage in the means; 0 in a run shorter than one"]
    life: A[RatingLife | None, "under the run's load; ``None`` at rest, or where nothing carries it"] = None
    faults: A[tuple[str, ...], "defects and waviness of the scene in words"] = ()
    temperatures: A[tuple[tuple[str, float], ...], "of each part at the end, with the effect, [K]"] = ()
    # (sensor, samples, all samples): accelerometers that have read their largest value, and how often
    clipped: tuple[tuple[str, int, int], ...] = ()
    stages: A[tuple[StageTime, ...], "where the wall time went, recording and drawing included"] = ()
    chosen: A[str, "what the effects were chosen for, its errors and what it leaves out; '' where named"] = ""
    shaft_speed: A[float, "mean, NaN where nothing is averaged, [rad/s]"] = math.nan
    # of any roller with the cup in any step, [N]
    largest_roller_load: A[float, "NaN in recordings of earlier versions"] = math.nan
    # of any roller with a raceway, its load spread along it by its profile, [Pa]
    largest_pressure: A[float, "see `physics.hertz_pressure`"] = math.nan
    wheel_diameter: A[float | None, "of the wheel on the axle; ``None`` where the scene has none, [m]"] = None

    def __repr__(self) -> str:
        """Give scene, length, torque, force and end of the run in one line."""
        fx, fy, fz = (round(each * 1e-3, 2) + 0.0 for each in self.mean_force)  # + 0.0: no minus zero
        return (
            f"RunSummary of {self.scene}: {self.duration:.2f} s, tier {self.tier}, torque on the shaft "
            f"{self.shaft_torque:.4g} N m, force on the cup {fx:.2f}, {fy:.2f}, {fz:.2f} kN, largest "
            f"roller load {self.largest_roller_load * 1e-3:.2f} kN; {self.status}"
        )

    @property
    def rings(self) -> str:
        """Whether the rings bend: ``elastic`` or ``rigid``."""
        return "elastic" if "structure" in self.effects else "rigid"

    @property
    def real_time_factor(self) -> float:
        """Simulated over wall time."""
        return self.duration / self.wall_time if self.wall_time > 0.0 else math.inf

    @property
    def nothing_to_average(self) -> bool:
        """Whether the run ended before its first trend sample had passed the filters."""
        return self.averaged[1] == 0.0

    @property
    def complete(self) -> bool:
        """Whether the run came to its end inside the model's validity."""
        return self.status.startswith(COMPLETE)


@dataclass(frozen=True)
class TrendMeans:
    """Means of a run over its last whole cage revolutions."""

    # of the rollers on the cup, [N]; NaN like the others when there is nothing to average
    force: tuple[float, float, float] = (math.nan, math.nan, math.nan)
    torque: A[float, "[N m]"] = math.nan
    shaft_speed: A[float, "[rad/s]"] = math.nan
    cage_speed: A[tuple[float, ...], "of each row, [rad/s]"] = (math.nan, math.nan)
    averaged: A[tuple[float, float], "first and last time, [s]"] = (0.0, 0.0)
    revolutions: A[int, "whole revolutions of the cage"] = 0

    def cage_speed_ratio(self, ftf: float, rows: int) -> tuple[float, ...]:
        """Compare the speed of each cage with that of pure rolling: nominal 1, NaN with the shaft at rest."""
        epicyclic = ftf * self.shaft_speed
        return tuple(speed / epicyclic if epicyclic else math.nan for speed in self.cage_speed[:rows])


def trend_means(
    times: Float, force: Float, torque: Float, shaft_speed: Float, cage_speed: Float
) -> TrendMeans:
    """Average the signals of a run over its last whole cage revolutions after the settling time.

    Parameters
    ----------
    times : float64 array, shape [sample], [s]
    force : float64 array, shape [sample, 3], [N]
    torque, shaft_speed : float64 array, shape [sample], [N m], [rad/s]
    cage_speed : float64 array, shape [sample, row], [rad/s]
    """
    if not len(times):
        return TrendMeans()
    first, revolutions = averaging_start(times, cage_speed[:, 0])
    fx, fy, fz = (time_mean(times, component, first) for component in force.T)
    return TrendMeans(
        (fx, fy, fz),
        time_mean(times, torque, first),
        time_mean(times, shaft_speed, first),
        tuple(time_mean(times, row, first) for row in cage_speed.T),
        (first, float(times[-1])),
        revolutions,
    )


def averaging_start(times: Float, cage_speed: Float) -> tuple[float, int]:
    """Find where the last whole cage revolutions begin, not before the start has settled, [s].

    Also returned are the whole revolutions from there to the end. A run without one is averaged from the
    settling time on.
    """
    settled = times[0] + min(SETTLING_S, 0.5 * (times[-1] - times[0]))
    if len(times) < 2:
        return float(settled), 0
    turned = _running_integral(times, np.abs(cage_speed)) / (2.0 * math.pi)
    to_end = turned[-1] - turned
    revolutions = int(turned[-1] - np.interp(settled, times, turned) + 1e-9)
    if revolutions == 0:
        return float(settled), 0
    return float(np.interp(-revolutions, -to_end, times)), revolutions


def time_mean(times: Float, values: Float, first: float) -> float:
    """Average a sampled signal, linear between its samples, from ``first`` to the last sample."""
    if len(times) < 2:
        return float(values[-1])
    integral = _running_integral(times, values)
    return float((integral[-1] - np.interp(first, times, integral)) / (times[-1] - first))


def _running_integral(times: Float, values: Float) -> Float:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
    return np.concatenate([[0.0], np.cumsum(steps)])

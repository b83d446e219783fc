"""Statistics of a run against those of the same run with half the step.

The bearing is chaotic: two runs share statistics, not trajectories. The blocks of both are compared in pairs
first. Where that finds a difference, runs whose rollers begin up to a micrometre from the middle of their
pockets tell what the same step makes of the same scene, and only a difference beyond that band counts. A
nanometre of end play is not enough for that: identical rollers strike all at once at first, alike in all runs
of one step for 20 ms, and what luck that leaves in a lightly loaded bearing lives for 0.2 s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from beardyn_core.physics.bodies.layout import ANGLE
from beardyn_core.twin import Twin
from evidence.hard.watch import STATISTICS

Float = NDArray[np.float64]

# Converged: torque mean within 0.5 % and scatter within 20 % of the small step's. The other means are held
# to what is said of torque.
_LIMITS = {"force": 0.005, "force_scatter": 0.2, "torque": 0.005, "cage_speed": 0.005, "roller_load": 0.005}
# Beyond these no scatter between blocks excuses a difference: 5 % in force, torque and roller load.
_COARSEST = {"force": 0.05, "force_scatter": 0.2, "torque": 0.05, "cage_speed": 0.05, "roller_load": 0.05}
# Smaller values are compared with these: [N], [N], [N m], [rad/s], [N].
_FLOORS = {"force": 1000.0, "force_scatter": 200.0, "torque": 1.0, "cage_speed": 1.0, "roller_load": 500.0}
_SETTLING_BLOCKS = 2
REPEATS = 5
APART = 1.0e-9  # of end play, between the starts of a case [m]
_DISPLACED = 1.0e-6  # rollers along the pitch circle, between runs that should share statistics [m]


@dataclass(frozen=True)
class Change:
    """What half the step changes in one statistic.

    Parameters
    ----------
    statistic : str
        One of `watch.STATISTICS`.
    change : float
        Of the mean over the run, relative to it, [-].
    band : float
        What it may be: limit of convergence and scatter of blocks or of runs, [-].
    runs : int
        Runs with each step.
    """

    statistic: str
    change: float
    band: float
    runs: int = 1

    @property
    def inside(self) -> bool:
        """Whether the statistic is converged as far as the runs can tell."""
        return abs(self.change) <= self.band


def changes(coarse: Float, fine: Float) -> tuple[Change, ...]:
    """Change of each statistic between two runs.

    Parameters
    ----------
    coarse, fine : float64 arrays, shape [block, statistic]
        Of the run and of the one with half the step.
    """
    found = []
    ours, theirs = run_means(coarse), run_means(fine)
    for index, name in enumerate(STATISTICS):
        scale = max(abs(float(theirs[index])), _FLOORS[name])
        noise = 0.0
        if name != "force_scatter":  # its limit leaves no room for the scatter of the blocks
            pairs = (coarse - fine)[_SETTLING_BLOCKS:, index]
            noise = 2.0 * float(pairs.std(ddof=1)) / np.sqrt(len(pairs)) / scale
        band = min(_LIMITS[name] + noise, _COARSEST[name])
        found.append(Change(name, float(ours[index] - theirs[index]) / scale, band))
    return tuple(found)


def changes_of_runs(coarse: list[Float], fine: list[Float]) -> tuple[Change, ...]:
    """Change of each statistic between the means of several runs each, with the 95 % band between runs."""
    ours, theirs = (np.array([run_means(rows) for rows in runs]) for runs in (coarse, fine))
    freedom = len(ours) + len(theirs) - 2
    squares = ours.var(axis=0) * len(ours) + theirs.var(axis=0) * len(theirs)
    error = np.sqrt(squares / freedom * (1.0 / len(ours) + 1.0 / len(theirs)))
    noise = float(stats.t.ppf(0.975, freedom)) * error
    found = []
    for index, name in enumerate(STATISTICS):
        scale = max(abs(float(theirs[:, index].mean())), _FLOORS[name])
        change = float(ours[:, index].mean() - theirs[:, index].mean()) / scale
        found.append(Change(name, change, _LIMITS[name] + float(noise[index]) / scale, len(ours)))
    return tuple(found)


def displace(twin: Twin, number: int) -> None:
    """Move each roller of a started twin at random along the pitch circle; 0 leaves all where they are.

    Only in tier full; the others hold their rollers where the cage has them.
    """
    if number == 0 or twin.scene.tier != "full":
        return
    start = twin.snapshot()
    angle = start.state.rollers[:, ANGLE]
    most = 2.0 * _DISPLACED / twin.scene.bearing.pitch_diameter
    angle += np.random.default_rng(number).uniform(-most, most, angle.shape)
    twin.restore(start)


def run_means(rows: Float) -> Float:
    """Average the statistics of a settled run, shape [statistic]; the scatter by its mean variance."""
    means = np.asarray(rows[_SETTLING_BLOCKS:].mean(axis=0))
    scatter = STATISTICS.index("force_scatter")
    means[scatter] = np.sqrt(means[scatter])
    return means

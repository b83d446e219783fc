"""Differences from the reference, how well they are known, and what runs of the reference differ by.

The bearing is chaotic: runs that begin a hair apart share statistics, not trajectories. The variance of a
statistic of a run is that among all equal parts of all runs over the number of parts; where whole runs
scatter by more than that, in the mean over a spectrum, it is raised as much. From it come the uncertainty of
the difference of two means of runs (95 %, Welch), and the run-to-run band: what the difference of two single
runs of the reference stays in (95 %). Spectra take both for all their bands together (Bonferroni).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

Float = NDArray[np.float64]

WITHIN, NOT, OPEN = "within", "not", "open"
MEAN_LIMIT, SCATTER_LIMIT, LEVEL_LIMIT = 5.0e-3, 0.2, 1.5
_TAIL = 0.025


@dataclass(frozen=True)
class Difference:
    """Of the mean of some runs from the mean of the reference runs, one value a component.

    Parameters
    ----------
    value : float64 array, shape [component]
    doubt : float64 array, shape [component]
        Half-width of what the difference is known to.
    band : float64 array, shape [component]
        Half-width of the run-to-run band of single runs of the reference.
    """

    value: Float
    doubt: Float
    band: Float

    def against(self, limit: float) -> str:
        """Judge all components against a fixed limit: ``within``, ``not`` or ``open``."""
        size = np.abs(self.value)
        if np.all(size + self.doubt <= limit):
            return WITHIN
        return NOT if np.any(size - self.doubt > limit) else OPEN

    def against_band(self) -> str:
        """Judge by the run-to-run band: ``within``, ``not``, or ``open`` where doubt remains."""
        size = np.abs(self.value)
        if np.all(size <= self.band):
            return WITHIN
        return NOT if np.any(size - self.doubt > self.band) else OPEN


def difference(found: Sequence[Float], reference: Sequence[Float], neighbours: int = 1) -> Difference:
    """Compare runs with the reference.

    Parameters
    ----------
    found : sequence of float64 arrays, shape [1 + part, component]
        The whole run and its parts; with one run its scatter is taken to be the reference's.
    reference : sequence of such arrays
        Two or more.
    neighbours : int
        Components side by side whose variance is alike: it is averaged over so many, odd.
    """
    here, there = np.array([run[0] for run in found]), np.array([run[0] for run in reference])
    scatterers = found if len(found) > 1 else reference
    parts = np.array([len(scatterers), len(reference)]) * (len(reference[0]) - 1)
    single = np.array([_averaged(run_variance(runs), neighbours) for runs in (scatterers, reference)])
    # under a Hann window every second line is independent
    degrees = (parts - 1) * (neighbours + 1) / 2.0
    means = single / np.array([[len(found)], [len(reference)]])
    tail = _TAIL / here.shape[1]
    doubt = student.isf(tail, _freedom(means, degrees)) * np.sqrt(means.sum(axis=0))
    band = student.isf(tail, degrees[1]) * np.sqrt(2.0 * single[1])
    return Difference(here.mean(axis=0) - there.mean(axis=0), doubt, band)


def run_variance(runs: Sequence[Float]) -> Float:
    """Return the variance of a statistic of one run; runs as of `difference`, two or more."""
    between = np.var([run[0] for run in runs], axis=0, ddof=1)
    parts = np.concatenate([run[1:] for run in runs])
    within = parts.var(axis=0, ddof=1) / (len(runs[0]) - 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = float(np.nanmean(between / within)) if np.any(within > 0.0) else 1.0
    return np.asarray(max(ratio, 1.0) * within)


def _averaged(values: Float, count: int) -> Float:
    """Average over neighbours; at the ends over those that exist."""
    window = np.ones(count)
    whole = np.convolve(values, window, mode="same")
    return np.asarray(whole / np.convolve(np.ones(len(values)), window, mode="same"))


def _freedom(variances: Float, degrees: Float) -> Float:
    """Return the degrees of freedom of a sum of variances (Welch and Satterthwaite)."""
    total = variances.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = total**2 / (variances**2 / degrees[:, None]).sum(axis=0)
    return np.where(total > 0.0, found, math.inf)

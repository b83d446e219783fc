"""Errors of a level against the reference, each with the scatter between runs of one level.

The bearing is chaotic: two runs that begin a hair apart share statistics, not trajectories. Repeated runs
give the variance of every component twice: between whole runs, and between the same windows of two runs
(which feel the same load), divided by the number of windows. The larger one counts. The band of an error is
what the difference of two means stays in with 95 % probability, for all components of a quantity together
(Student's t with the degrees of freedom of Welch, Bonferroni).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Annotated as A

import numpy as np
from scipy.stats import t as student

from beardyn_core.arrays import Float
from beardyn_core.study.measures import MEASURES, QUANTITIES, UNITS, Measure, Outcome

CONFIDENCE = 0.95
BAND_LIMIT_DB = 1.5


@dataclass(frozen=True)
class Part:
    """Error of one component."""

    name: str
    error: A[float, "signed; a share, or dB. NaN where the component does not exist"]
    band: A[float, "half-width of the run-to-run band, in the same unit"]

    @property
    def resolved(self) -> bool:
        """Whether the error is larger than the run-to-run band."""
        return abs(self.error) > self.band

    def verdict(self, limit: float) -> str:
        """Judge an error: ``yes`` surely within, ``no`` surely beyond, ``open`` in between."""
        if abs(self.error) + self.band <= limit:
            return "yes"
        return "no" if abs(self.error) - self.band > limit else "open"


@dataclass(frozen=True)
class QuantityError:
    """Errors of the components of one quantity."""

    quantity: str
    unit: A[str, "``%`` (errors are shares) or ``dB``"]
    parts: A[tuple[Part, ...], "components that exist; empty when the scene has none"]

    @property
    def worst(self) -> Part | None:
        """The largest resolved error; the largest one when none is resolved."""
        resolved = [part for part in self.parts if part.resolved]
        return max(resolved or self.parts, key=lambda part: abs(part.error), default=None)

    def limit(self, accuracy: float) -> float:
        """Return the largest error at an accuracy (share): the accuracy itself, or 1.5 dB."""
        return accuracy if self.unit == "%" else BAND_LIMIT_DB

    def verdict(self, accuracy: float) -> str:
        """Judge all components together: ``yes``, ``no`` or ``open``."""
        found = {part.verdict(self.limit(accuracy)) for part in self.parts}
        return "no" if "no" in found else "open" if "open" in found else "yes"


def errors(found: Sequence[Outcome], reference: Sequence[Outcome]) -> tuple[QuantityError, ...]:
    """Compare the runs of a level with the runs of the reference.

    Parameters
    ----------
    found : sequence of Outcome
        One or more; with one its scatter is taken to be the reference's.
    reference : sequence of Outcome
        Two or more.

    Returns
    -------
    tuple of QuantityError, in the order of `QUANTITIES`
    """
    results = []
    for quantity in QUANTITIES:
        own = [(index, each) for index, each in enumerate(MEASURES) if each.quantity == quantity]
        tail = 0.5 * (1.0 - CONFIDENCE) / sum(len(measure.parts) for _, measure in own)
        parts = (_parts(measure, index, found, reference, tail) for index, measure in own)
        results.append(QuantityError(quantity, UNITS[quantity], tuple(chain.from_iterable(parts))))
    return tuple(results)


def _parts(
    measure: Measure, index: int, found: Sequence[Outcome], reference: Sequence[Outcome], tail: float
) -> list[Part]:
    here = _stacked(found, index).mean(axis=0)
    there = _stacked(reference, index).mean(axis=0)
    if np.all(np.isnan(there)):
        return []
    scatterers = found if len(found) > 1 else reference
    pairs = ((scatterers, found), (reference, reference))
    variances = np.array([variance(scattered, index) / len(runs) for scattered, runs in pairs])
    windows = len(reference[0].windows)
    degrees = windows * np.array([[len(scatterers) - 1], [len(reference) - 1]])
    scale = np.ones(1) if measure.scale is None else measure.scale(there)
    with np.errstate(divide="ignore", invalid="ignore"):
        error = (here - there) / scale
        variances = variances / scale**2
    if measure.weighed is not None:
        counts = measure.weighed(there)
        error = np.sqrt(np.mean(error[counts] ** 2, keepdims=True))
        variances = np.mean(variances[:, counts], axis=1, keepdims=True)
    total = variances.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        effective = np.where(total > 0.0, total**2 / (variances**2 / degrees).sum(axis=0), 1.0)
    band = student.isf(tail, effective) * np.sqrt(total)
    columns = zip(measure.parts, error, band, strict=True)
    return [Part(name, float(e), float(b)) for name, e, b in columns if math.isfinite(e)]


def variance(runs: Sequence[Outcome], index: int) -> Float:
    """Return the variance of a measure's components among two or more runs, shape [component].

    The larger of what whole runs and what equal windows of them say.
    """
    between = np.var(_stacked(runs, index), axis=0, ddof=1)
    windows = np.array([[window[index] for window in run.windows] for run in runs])
    spread = np.var(windows, axis=0, ddof=1)
    # a bin of the load distribution may be empty in a short window
    seen = np.isfinite(spread)
    total = np.where(seen, spread, 0.0).sum(axis=0)
    within = total / np.maximum(seen.sum(axis=0), 1) / windows.shape[1]
    return np.fmax(between, within)


def _stacked(runs: Sequence[Outcome], index: int) -> Float:
    return np.array([run.whole[index] for run in runs])

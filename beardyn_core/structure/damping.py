"""Damping of the modes of a box: one ratio for all, or a table over their frequency."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At

DAMPING = At(gt=0.0, le=0.2)


@dataclass(frozen=True)
class DampingTable:
    """Damping ratio over the frequency: linear in its logarithm between the points, constant beyond them."""

    frequency: A[tuple[float, ...], At("Hz", gt=0.0, le=100_000.0, size=(2, 20)), "in rising order"]
    ratio: A[tuple[float, ...], At(gt=0.0, le=0.2, size=(2, 20)), "at each frequency, over the critical one"]

    def rules(self) -> Iterator[str]:
        """Check that there is one ratio for each frequency and that the frequencies rise."""
        if len(self.frequency) != len(self.ratio):
            yield (
                f"frequency_Hz has {len(self.frequency)} entries and ratio {len(self.ratio)}; give one ratio "
                "for each frequency"
            )
        if any(one >= other for one, other in pairwise(self.frequency)):
            yield f"frequency_Hz is {list(self.frequency)}; it must rise from entry to entry"


def damping_ratios(damping: float | DampingTable, frequency: Float) -> Float:
    """Work out the damping ratio of each mode.

    Parameters
    ----------
    damping : float or DampingTable
        One ratio for all modes, or a table.
    frequency : array, shape [mode]
        [Hz].

    Returns
    -------
    array, shape [mode]
        Over the critical one.
    """
    if isinstance(damping, DampingTable):
        return np.interp(np.log(frequency), np.log(damping.frequency), damping.ratio)
    return np.full(len(frequency), damping)

"""Weight."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Gravity:
    """Weight of rollers, cages and axlebox.

    Parameters
    ----------
    acceleration : float
        Acceleration of free fall, [m/s^2].
    """

    about: ClassVar[About] = About(
        adds="Weight of rollers, cages and axlebox.",
        states="none",
        cost="low",
        validity="Always.",
        source="Standard gravity, CGPM (1901)",
    )

    acceleration: float = 9.80665

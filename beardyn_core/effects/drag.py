"""Drag and churning of the rollers in grease, oil and air."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Drag:
    """Drag on the orbit and churning on the spin of the rollers; the medium rests on the cup.

    Parameters
    ----------
    fill : float
        Part of the free space that the lubricant fills where the rollers run, 0 to 1. Grease that has
        settled leaves little there; freshly filled bearings come to 0.3.
    drag_coefficient : float
        Of a roller across its orbit, over its length and diameter.
    churning : float
        Churning couple on the spin over that of a roller alone in the medium.
    """

    about: ClassVar[About] = About(
        adds="Drag on the orbit and churning on the spin of the rollers.",
        states="none",
        cost="low",
        validity="A homogeneous medium at rest on the cup; neither wakes nor the cage are seen.",
        source="Gupta (1984), drag and disc; Theodorsen and Regier (1944), cylinder",
    )

    fill: float = 0.02
    drag_coefficient: float = 1.2
    churning: float = 1.0

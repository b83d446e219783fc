"""Weight."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import At
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Gravity:
    """Weight of rollers, cages and axlebox."""

    about: ClassVar[About] = About(
        loss="",
        adds="Weight of rollers, cages and axlebox.",
        states="none",
        cost="low",
        validity="Always.",
        source="Standard gravity, CGPM (1901)",
    )

    acceleration: A[float, At("m_per_s2", ge=0.0), "of free fall"] = STANDARD_GRAVITY

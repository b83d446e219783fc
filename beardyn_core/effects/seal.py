"""Seals between cup and shaft."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.edge import At
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Seal:
    """Friction of the two seals, one at each end of the cup, on the shaft."""

    about: ClassVar[About] = About(
        adds="Torque of both seals on the shaft.",
        states="none",
        cost="none",
        validity="Seals in steady rubbing contact; neither run-in nor temperature.",
        source="Recalled catalogue rule for rubbing seals, 0.032 mm^-2 d^2 + 50 N mm for a pair: 0.59 N m at "
        "130 mm; speed part assumed",
    )

    torque: A[float, At("N_m", ge=0.0), "of one seal, independent of speed"] = 0.3
    speed_coefficient: A[float, At("N_m_s_per_rad", ge=0.0), "torque of one seal over speed"] = 5e-4
    regularisation_speed: A[
        float, At("rad_per_s", gt=0.0), "shaft speed at which 71 % of the torque is reached"
    ] = 0.1

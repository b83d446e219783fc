"""Small roller end on the small rib of the cone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import RIB_HEAT, About, SlipSpeed


@dataclass(frozen=True)
class SmallRib:
    """Contact of the flat small roller end with the small rib of the cone.

    Height and clearance of the rib are the bearing's.
    """

    about: ClassVar[About] = About(
        loss="small_rib",
        heat=RIB_HEAT,
        adds="Stop of the small roller end: holds a roller that the load does not press to the large rib.",
        states="none",
        cost="low",
        validity="Brief contacts; the rib bears on a circle at half its height, with a linear spring.",
        source="Plane on circle, exact; stiffness and damping assumed",
        bearings=("tapered",),
    )

    stiffness: A[float, At("MN_per_m", gt=0.0), "of one contact"] = 2.0e8
    damping: A[float, At("N_s_per_m", ge=0.0), "of one contact"] = 1.0e3
    friction: A[float, SHARE, "coefficient of friction"] = 0.1
    regularisation_speed: SlipSpeed = 0.05

"""Small roller end on the small rib of the cone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class SmallRib:
    """Contact of the flat small roller end with the small rib of the cone.

    Height and clearance of the rib are the bearing's.

    Parameters
    ----------
    stiffness : float
        Of one contact, [N/m].
    damping : float
        Of one contact, [N s/m].
    friction : float
        Coefficient of friction.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Stop of the small roller end: holds a roller that the load does not press to the large rib.",
        states="none",
        cost="low",
        validity="Brief contacts; the rib bears on a circle at half its height, with a linear spring.",
        source="Plane on circle, exact; stiffness and damping assumed",
    )

    stiffness: float = 2.0e8
    damping: float = 1.0e3
    friction: float = 0.1
    regularisation_speed: float = 0.05

"""Cage of each row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Cage:
    """Cage of each row as a rigid body, touched by every roller in its pocket.

    Parameters
    ----------
    friction : float
        Coefficient of friction between roller and pocket.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    bar_inclination : float
        Angle of the bar faces against the radial plane: the bars stand outside the pitch circle, so the
        rollers also guide the cage radially, [rad].
    initial_speed_ratio : float
        Cage and roller orbit speed at the start over the kinematic one.
    """

    about: ClassVar[About] = About(
        adds="Cage of each row in six degrees of freedom, touched by every roller in its pocket.",
        states="12 positions and 12 velocities",
        cost="medium",
        validity="Rigid cage; pocket contacts are dry springs with damping.",
        source="Disc-on-plane contact of both bars and both pocket ends",
    )

    friction: float = 0.08
    regularisation_speed: float = 0.1
    bar_inclination: float = 0.44
    initial_speed_ratio: float = 1.0

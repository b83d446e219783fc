"""Seals between cup and shaft."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Seal:
    """Friction of the two seals, one at each end of the cup, on the shaft.

    Parameters
    ----------
    torque : float
        Of one seal, independent of speed, [N m].
    speed_coefficient : float
        Torque of one seal over speed, [N m s/rad].
    regularisation_speed : float
        Shaft speed at which 71 % of the torque is reached, [rad/s].
    """

    about: ClassVar[About] = About(
        adds="Torque of both seals on the shaft.",
        states="none",
        cost="none",
        validity="Seals in steady rubbing contact; neither run-in nor temperature.",
        source="Recalled catalogue rule for rubbing seals, 0.032 mm^-2 d^2 + 50 N mm for a pair: 0.59 N m at "
        "130 mm; speed part assumed",
    )

    torque: float = 0.3
    speed_coefficient: float = 5e-4
    regularisation_speed: float = 0.1

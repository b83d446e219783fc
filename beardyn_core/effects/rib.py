"""Large roller end on the cone rib."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Rib:
    """Contact of the spherical large roller end with the conical cone rib.

    Parameters
    ----------
    friction : float
        Coefficient of friction of the rib contact.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Sphere-on-cone contact of the large roller end with the cone rib.",
        states="none",
        cost="low",
        validity="Contact within the rib; elliptic Hertz contact.",
        source="Hertz (1881), fit of Hamrock and Brewe (1983)",
    )

    friction: float = 0.05
    regularisation_speed: float = 0.05

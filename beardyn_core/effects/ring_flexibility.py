"""Bending of the cup in its housing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class RingFlexibility:
    """Ovalisation of the cup and of the housing wall around it.

    The cup and the wall are two thin rings that bend together without sticking to each other, so their
    bending stiffnesses add.

    Parameters
    ----------
    highest_mode : int
        The ring bends with 2, 3, ... up to this many waves around its circumference.
    housing_wall : float
        Thickness of the housing around the cup, 0 for a cup that stands alone, [m].
    housing_modulus : float
        Young's modulus of the housing, [Pa].
    housing_density : float
        [kg/m^3].
    stiffness_factor : float
        Factor on the stiffness of every mode, for a housing that has been measured or computed.
    damping_ratio : float
        Damping of every mode over the critical one.
    """

    about: ClassVar[About] = About(
        adds="Bending of the cup in its housing: it opens under the loaded rollers.",
        states="2 positions and 2 velocities per mode, the same for both rows",
        cost="low",
        validity="Thin ring without stretching or shear, up to a wall of about a fifth of its radius (above "
        "that too stiff); uniform along the axle; the cone on its journal stays rigid.",
        source="Rayleigh (1894), The theory of sound, art. 233; Roark's formulas for stress and strain, "
        "circular rings, case 1",
    )

    highest_mode: int = 4
    housing_wall: float = 0.025
    housing_modulus: float = 170.0e9
    housing_density: float = 7100.0
    stiffness_factor: float = 1.0
    damping_ratio: float = 0.03

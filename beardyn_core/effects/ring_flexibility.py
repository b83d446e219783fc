"""Bending of the cup in its housing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.edge import SHARE, At
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class RingFlexibility:
    """Ovalisation of the cup and of the housing wall around it.

    The cup and the wall are two thin rings that bend together without sticking to each other, so their
    bending stiffnesses add.
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

    highest_mode: A[int, At(ge=2, le=12), "waves around the circumference, 2 to this number"] = 4
    housing_wall: A[float, At("mm", ge=0.0, le=200.0), "0 for a cup that stands alone"] = 0.025
    housing_modulus: A[float, At("GPa", gt=0.0), "Young's modulus of the housing"] = 170.0e9
    housing_density: A[float, At("kg_per_m3", gt=0.0), "of the housing"] = 7100.0
    stiffness_factor: A[float, At(gt=0.0), "on every mode, for a housing measured or computed"] = 1.0
    damping_ratio: A[float, SHARE, "damping of every mode over the critical one"] = 0.03

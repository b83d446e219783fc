"""Seals between cup and shaft."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import At
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Seal:
    """Friction of the two seals, one at each end of the cup, on the shaft."""

    about: ClassVar[About] = About(
        loss="seal",
        heat={"cone": 0.5, "axlebox": 0.5},
        adds="Torque of both seals on the shaft, the larger the stiffer the oil is.",
        states="none",
        cost="none",
        validity="Seals in steady rubbing contact, run in, with the base oil under their lips; neither the "
        "stiffness of cold rubber nor dry lips.",
        source="Recalled catalogue rule for rubbing seals, 0.032 mm^-2 d^2 + 50 N mm for a pair: 0.59 N m at "
        "130 mm, taken for an oil at service temperature; speed part assumed. Friction of lips with the cube "
        "root of the viscosity: Hirano and Ishiwata (1965), Proc. IMechE 180 (3B), 187, from memory",
    )

    torque: A[float, At("N_m", ge=0.0), "of one seal, independent of speed"] = 0.3
    speed_coefficient: A[float, At("N_m_s_per_rad", ge=0.0), "torque of one seal over speed"] = 5e-4
    regularisation_speed: A[
        float, At("rad_per_s", gt=0.0), "shaft speed at which 71 % of the torque is reached"
    ] = 0.1
    viscosity_exponent: A[
        float, At(ge=0.0, le=1.0), "power of the oil's viscosity with which the torque grows"
    ] = 0.33
    rated_viscosity: A[float, At("mm2_per_s", gt=0.0), "of the oil with which torque and speed part hold"] = (
        3.0e-5
    )

    def stiffening(self, viscosity: float) -> float:
        """Compute the torque with an oil of a kinematic viscosity [m^2/s] over the rated one."""
        return float((viscosity / self.rated_viscosity) ** self.viscosity_exponent)

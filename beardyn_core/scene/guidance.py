"""What the lateral motion of a vehicle depends on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import SHARE, At, refuse


@dataclass(frozen=True)
class Guidance:
    """Wheel guidance, lateral secondary suspension and heights of a vehicle."""

    conicity: A[float, SHARE, "equivalent conicity of the wheelset"] = 0.1
    flange_clearance: A[
        float, At("mm", gt=0.0, ge=1.0, le=30.0), "from the middle of the track to either rail"
    ] = 6.0e-3
    flange_stiffness: A[float, At("MN_per_m", gt=0.0, ge=1.0, le=1000.0), "of a rail under a flange"] = 4.0e7
    flange_damping: A[float, At("kN_s_per_m", ge=0.0, le=10000.0), "of a rail under a flange"] = 1.0e5
    friction: A[float, At(ge=0.01, le=1.0), "limit of the creep force over the wheel load"] = 0.35
    secondary_stiffness: A[
        float, At("kN_per_mm", gt=0.0, ge=0.01, le=100.0), "lateral, one side of one bogie"
    ] = 1.7e5
    secondary_damping: A[float, At("kN_s_per_m", ge=0.0, le=10000.0), "lateral, one side of one bogie"] = (
        3.0e4
    )
    body_height: A[float, At("m", gt=0.0, ge=0.5, le=4.0), "centre of mass above the rail"] = 1.7
    bogie_height: A[float, At("m", gt=0.0, ge=0.2, le=2.0), "centre of mass above the rail"] = 0.6
    axlebox_spacing: A[
        float, At("m", gt=0.0, ge=1.0, le=3.0), "between the bearing centres of a wheelset"
    ] = 2.0

    def __post_init__(self) -> None:
        refuse(self, "guidance")

"""Suspension and guidance of a vehicle: springs of freight bogies, what its lateral motion depends on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import SHARE, At, refuse


@dataclass(frozen=True)
class ProgressiveSuspension:
    """Springs of one axlebox, vertical: soft while empty, stiff when the inner springs join in."""

    soft_stiffness: A[float, At("MN_per_m", gt=0.0, ge=0.01, le=100.0), "while the inner springs are free"]
    stiff_stiffness: A[float, At("MN_per_m", gt=0.0, ge=0.01, le=100.0), "with the inner springs"]
    meeting_load: A[float, At("kN", ge=0.0, le=1000.0), "spring load at which the inner springs join in"]
    friction_ratio: A[float, At(ge=0.0, le=0.5), "friction over spring load"] = 0.12
    friction_speed: A[
        float,
        At("m_per_s", gt=0.0, ge=0.001, le=1.0),
        "sliding speed at which friction has 76 % of its full value",
    ] = 0.005

    def __post_init__(self) -> None:
        refuse(self, "primary suspension")

    def compression(self, load: float) -> float:
        """Find the compression of the springs under a load, [m]."""
        soft = min(load, self.meeting_load) / self.soft_stiffness
        return soft + max(load - self.meeting_load, 0.0) / self.stiff_stiffness


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

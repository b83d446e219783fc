"""Primary suspension of freight bogies: progressive springs and load-dependent friction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, refuse


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

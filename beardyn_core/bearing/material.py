"""Material of rings and rollers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At


@dataclass(frozen=True)
class Material:
    """Steel of rings and rollers."""

    youngs_modulus: A[float, At("GPa", gt=0.0, ge=10.0, le=1000.0), "of the steel"] = 206.0e9
    poisson_ratio: A[float, At(ge=0.0, lt=0.5), "of the steel"] = 0.3
    density: A[float, At("kg_per_m3", gt=0.0, ge=500.0, le=25000.0), "of the steel"] = 7830.0

    @property
    def contact_modulus(self) -> float:
        """E' = 2 / ((1 - nu^2)/E + (1 - nu^2)/E), twice the Hertz modulus E*, [Pa]."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)

"""Material of rings and rollers."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """Elastic constants and density, the same for rings and rollers.

    Parameters
    ----------
    youngs_modulus : float
        [Pa].
    poisson_ratio : float
        [-].
    density : float
        [kg/m^3].
    """

    youngs_modulus: float = 206.0e9
    poisson_ratio: float = 0.3
    density: float = 7830.0

    @property
    def contact_modulus(self) -> float:
        """E' = 2 / ((1 - nu^2)/E + (1 - nu^2)/E), twice the Hertz modulus E*, [Pa]."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)

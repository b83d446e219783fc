"""What a rating life assumes of lubricant, cleanliness and load between recordings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.edge import At, refuse
from beardyn_core.base.units import ZERO_CELSIUS


@dataclass(frozen=True)
class LifeAssumptions:
    """What no recording holds of the service; ends of 90 % intervals."""

    temperature: A[
        tuple[float, float], At("C", ge=-40.0, le=180.0, size=(2, 2)), "of the lubricant, low and high"
    ] = (40.0 + ZERO_CELSIUS, 85.0 + ZERO_CELSIUS)
    contamination: A[
        tuple[float, float],
        At(gt=0.0, ge=0.05, le=1.0, size=(2, 2)),
        "e_C of ISO 281: slight contamination to high cleanliness",
    ] = (0.4, 0.8)
    viscosity: A[
        tuple[float, float],
        At(gt=0.0, ge=0.05, le=4.0, size=(2, 2)),
        "of the aged lubricant over the fresh one",
    ] = (0.7, 1.4)
    swing: A[
        tuple[float, float],
        At(ge=0.0, le=1.0, size=(2, 2)),
        "rms of the swings of the vertical load over its mean",
    ] = (0.05, 0.2)
    between: A[
        float,
        At("percent", ge=0.0, le=90.0),
        "half of the 90 % interval of the mean load between recordings, over that in them",
    ] = 0.15

    def __post_init__(self) -> None:
        refuse(self, "assumptions of the rating life")

    def sentence(self, is_stated: bool) -> str:
        """State what is assumed in a line."""
        low, high = (each - ZERO_CELSIUS for each in self.temperature)
        warm = "" if is_stated else f"lubricant at {low:.0f} to {high:.0f} °C, "
        return (
            f"assumed and varied: {warm}contamination e_C {self.contamination[0]:g} to "
            f"{self.contamination[1]:g}, viscosity of the aged lubricant {self.viscosity[0]:g} to "
            f"{self.viscosity[1]:g} times the fresh one, swings of the load {100 * self.swing[0]:.0f} to "
            f"{100 * self.swing[1]:.0f} % rms, mean load between recordings within "
            f"{100 * self.between:.0f} % of that in them"
        )

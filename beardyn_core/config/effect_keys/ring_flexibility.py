"""Keys of an effect: bending of the cup in its housing."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import Count, FileModel, Fraction, NonNegative, Positive
from beardyn_core.config.units import GIGA, MM
from beardyn_core.effects import RingFlexibility


class RingFlexibilityKeys(FileModel):
    """Bending of the cup in its housing."""

    highest_mode: Annotated[Count, Field(ge=2, le=12)] = Field(
        RingFlexibility.highest_mode, description="waves around the circumference, 2 to this number"
    )
    housing_wall_mm: Annotated[NonNegative, Field(le=200.0)] = Field(
        RingFlexibility.housing_wall * MM, description="0 for a cup that stands alone"
    )
    housing_modulus_GPa: Positive = RingFlexibility.housing_modulus / GIGA
    housing_density_kg_per_m3: Positive = RingFlexibility.housing_density
    stiffness_factor: Positive = Field(
        RingFlexibility.stiffness_factor, description="on every mode, for a housing measured or computed"
    )
    damping_ratio: Fraction = RingFlexibility.damping_ratio

    def noun(self) -> RingFlexibility:
        """The ring flexibility, SI."""
        return RingFlexibility(
            highest_mode=self.highest_mode,
            housing_wall=self.housing_wall_mm / MM,
            housing_modulus=self.housing_modulus_GPa * GIGA,
            housing_density=self.housing_density_kg_per_m3,
            stiffness_factor=self.stiffness_factor,
            damping_ratio=self.damping_ratio,
        )

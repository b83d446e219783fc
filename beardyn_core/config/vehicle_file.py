"""The vehicle file: sprung masses and secondary suspension."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from beardyn_core.config.file_model import Name, Positive, SourcedModel, Text
from beardyn_core.config.units import KN, MEGA
from beardyn_core.scene.operation import Vehicle

TONNE = 1e3


class VehicleKeys(SourcedModel):
    """A car with two bogies of two axles."""

    name: Name
    description: Text = ""
    body_mass_t: Annotated[Positive, Field(ge=1.0, le=200.0)] = Field(
        description="whole car body with its payload"
    )
    bogie_mass_t: Annotated[Positive, Field(ge=0.1, le=30.0)] = Field(
        description="one bogie frame without wheelsets"
    )
    secondary_stiffness_kN_per_mm: Annotated[Positive, Field(ge=0.01, le=100.0)] = Field(
        description="vertical, one side of one bogie"
    )
    secondary_damping_kN_s_per_m: Annotated[Positive, Field(le=10000.0)] = Field(
        description="vertical, one side of one bogie"
    )
    wheel_profile: Literal["worn", "cone"] = "worn"

    def noun(self) -> Vehicle:
        """The vehicle, SI."""
        return Vehicle(
            name=self.name,
            description=self.description,
            body_mass=self.body_mass_t * TONNE,
            bogie_mass=self.bogie_mass_t * TONNE,
            secondary_stiffness=self.secondary_stiffness_kN_per_mm * MEGA,
            secondary_damping=self.secondary_damping_kN_s_per_m * KN,
            wheel_profile=self.wheel_profile,
            sources=tuple(self.sources.items()),
        )

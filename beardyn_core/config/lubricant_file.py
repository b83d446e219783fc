"""The lubricant file."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from beardyn_core.bearing.lubricant import Lubricant, gold_pressure_viscosity, walther_viscosity
from beardyn_core.config.file_model import Name, NonNegative, Number, Positive, SourcedModel, Text, problem
from beardyn_core.config.units import MM2_PER_S, ZERO_CELSIUS

PER_GPA = 1e9


class LubricantKeys(SourcedModel):
    """An oil, or the base oil of a grease."""

    name: Name
    description: Text = ""
    kinematic_viscosity_40C_mm2_per_s: Annotated[Positive, Field(ge=1.0, le=5000.0)]
    kinematic_viscosity_100C_mm2_per_s: Annotated[Positive, Field(ge=0.5, le=500.0)]
    density_kg_per_m3: Annotated[Positive, Field(ge=500.0, le=2500.0)]
    base_oil: Literal["mineral", "pao"] = "mineral"
    pressure_viscosity_per_GPa: Annotated[Positive, Field(ge=1.0, le=100.0)] | None = Field(
        None,
        description="Barus coefficient at pressure_viscosity_temperature_C; without it that of "
        "Gold et al. (2001) for the base oil",
    )
    pressure_viscosity_temperature_C: Annotated[Number, Field(ge=-50.0, le=200.0)] = 40.0
    thermal_conductivity_W_per_m_K: Positive
    temperature_coefficient_per_K: NonNegative = Field(description="-d(ln viscosity)/dT at film temperature")

    @model_validator(mode="after")
    def _thins_when_warm(self) -> Self:
        at_40, at_100 = self.kinematic_viscosity_40C_mm2_per_s, self.kinematic_viscosity_100C_mm2_per_s
        if at_100 >= at_40:
            raise problem(
                f"kinematic_viscosity_100C_mm2_per_s is {at_100:g}; it must be less than the "
                f"{at_40:g} mm2/s at 40 degrees"
            )
        return self

    def noun(self) -> Lubricant:
        """The lubricant, SI."""
        at_40 = self.kinematic_viscosity_40C_mm2_per_s / MM2_PER_S
        at_100 = self.kinematic_viscosity_100C_mm2_per_s / MM2_PER_S
        temperature = self.pressure_viscosity_temperature_C + ZERO_CELSIUS
        if self.pressure_viscosity_per_GPa is None:
            viscosity = walther_viscosity(at_40, at_100, temperature)
            coefficient = gold_pressure_viscosity(viscosity, self.base_oil)
        else:
            coefficient = self.pressure_viscosity_per_GPa / PER_GPA
        return Lubricant(
            name=self.name,
            description=self.description,
            kinematic_viscosity_40=at_40,
            kinematic_viscosity_100=at_100,
            density=self.density_kg_per_m3,
            pressure_viscosity=coefficient,
            thermal_conductivity=self.thermal_conductivity_W_per_m_K,
            temperature_coefficient=self.temperature_coefficient_per_K,
            pressure_viscosity_temperature=temperature,
            base_oil=self.base_oil,
            sources=tuple(self.sources.items()),
        )

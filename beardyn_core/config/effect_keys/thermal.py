"""Keys of an effect: slow warming."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import FileModel, NonNegative, Number, Positive
from beardyn_core.config.units import MM, UM, ZERO_CELSIUS
from beardyn_core.effects import Thermal


class ThermalKeys(FileModel):
    """Temperatures of cup, cone, rollers, cages, grease and axlebox, fed by what friction loses."""

    ambient_C: Annotated[Number, Field(ge=-60.0, le=80.0)] = Thermal.ambient - ZERO_CELSIUS
    time_scale: Annotated[Positive, Field(le=1e5)] = Field(
        Thermal.time_scale, description="heating goes on this many times as fast, 1 is real"
    )
    wheel_diameter_mm: Annotated[Positive, Field(le=2000.0)] = Field(
        Thermal.wheel_diameter * MM, description="for the speed of the air along the axlebox"
    )
    box_area_m2: Positive = Field(Thermal.box_area, description="surface of the axlebox in the air")
    still_air_W_per_m2_K: NonNegative = Field(
        Thermal.still_air, description="axlebox at standstill: free convection and radiation"
    )
    axle_heat_transfer_W_per_m2_K: NonNegative = Thermal.axle_heat_transfer
    contact_conductance_W_per_K: Positive = Field(
        Thermal.contact_conductance, description="of one roller to each raceway"
    )
    grease_heat_transfer_W_per_m2_K: Positive = Thermal.grease_heat_transfer
    grease_mass_kg: Positive = Thermal.grease_mass
    seat_gap_um: Positive = Field(Thermal.seat_gap * UM, description="air gap that stands for the cup's seat")
    expansion_um_per_m_K: NonNegative = Field(Thermal.expansion * UM, description="of rings and rollers")

    def noun(self) -> Thermal:
        """The thermal effect, SI."""
        return Thermal(
            ambient=self.ambient_C + ZERO_CELSIUS,
            time_scale=self.time_scale,
            wheel_diameter=self.wheel_diameter_mm / MM,
            box_area=self.box_area_m2,
            still_air=self.still_air_W_per_m2_K,
            axle_heat_transfer=self.axle_heat_transfer_W_per_m2_K,
            contact_conductance=self.contact_conductance_W_per_K,
            grease_heat_transfer=self.grease_heat_transfer_W_per_m2_K,
            grease_mass=self.grease_mass_kg,
            seat_gap=self.seat_gap_um / UM,
            expansion=self.expansion_um_per_m_K / UM,
        )

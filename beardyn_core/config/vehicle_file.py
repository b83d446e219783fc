"""The vehicle file: sprung masses, suspensions, guidance."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from beardyn_core.config.file_model import (
    Fraction,
    Name,
    NonNegative,
    Positive,
    SourcedModel,
    SourcedPart,
    Text,
)
from beardyn_core.config.units import KN, MEGA, MM
from beardyn_core.scene.guidance import Guidance
from beardyn_core.scene.operation import Vehicle
from beardyn_core.scene.suspension import ProgressiveSuspension

TONNE = 1e3
SpringRate = Annotated[Positive, Field(ge=0.01, le=100.0)]


class PrimarySuspensionKeys(SourcedPart):
    """Springs that join in one after the other and friction with their load, one axlebox, vertical."""

    soft_stiffness_MN_per_m: SpringRate = Field(description="while the inner springs are free")
    stiff_stiffness_MN_per_m: SpringRate = Field(description="with the inner springs")
    meeting_load_kN: Annotated[NonNegative, Field(le=1000.0)] = Field(
        description="spring load at which the inner springs join in"
    )
    friction_ratio: Annotated[NonNegative, Field(le=0.5)] = Field(
        ProgressiveSuspension.friction_ratio, description="friction over spring load"
    )

    def noun(self) -> ProgressiveSuspension:
        """The suspension, SI."""
        return ProgressiveSuspension(
            self.soft_stiffness_MN_per_m * MEGA,
            self.stiff_stiffness_MN_per_m * MEGA,
            self.meeting_load_kN * KN,
            self.friction_ratio,
        )


class GuidanceKeys(SourcedPart):
    """What the sideways motion depends on."""

    conicity: Fraction = Guidance.conicity
    flange_clearance_mm: Annotated[Positive, Field(ge=1.0, le=30.0)] = Field(
        Guidance.flange_clearance * MM, description="from the middle of the track to either rail"
    )
    flange_stiffness_MN_per_m: Annotated[Positive, Field(ge=1.0, le=1000.0)] = Field(
        Guidance.flange_stiffness / MEGA, description="of a rail under a flange"
    )
    friction: Annotated[Fraction, Field(ge=0.01)] = Guidance.friction
    secondary_stiffness_kN_per_mm: SpringRate = Field(
        Guidance.secondary_stiffness / MEGA, description="lateral, one side of one bogie"
    )
    secondary_damping_kN_s_per_m: Annotated[NonNegative, Field(le=10000.0)] = Field(
        Guidance.secondary_damping / KN, description="lateral, one side of one bogie"
    )
    body_height_m: Annotated[Positive, Field(ge=0.5, le=4.0)] = Field(
        Guidance.body_height, description="centre of mass above the rail"
    )
    bogie_height_m: Annotated[Positive, Field(ge=0.2, le=2.0)] = Field(
        Guidance.bogie_height, description="centre of mass above the rail"
    )
    axlebox_spacing_m: Annotated[Positive, Field(ge=1.0, le=3.0)] = Field(
        Guidance.axlebox_spacing, description="between the bearing centres of a wheelset"
    )

    def noun(self) -> Guidance:
        """The guidance, SI."""
        return Guidance(
            conicity=self.conicity,
            flange_clearance=self.flange_clearance_mm / MM,
            flange_stiffness=self.flange_stiffness_MN_per_m * MEGA,
            friction=self.friction,
            secondary_stiffness=self.secondary_stiffness_kN_per_mm * MEGA,
            secondary_damping=self.secondary_damping_kN_s_per_m * KN,
            body_height=self.body_height_m,
            bogie_height=self.bogie_height_m,
            axlebox_spacing=self.axlebox_spacing_m,
        )


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
    primary_suspension: PrimarySuspensionKeys | None = Field(
        None, description="of freight bogies; the vertical springs of the mounting when not given"
    )
    guidance: GuidanceKeys = GuidanceKeys()

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
            primary_suspension=None if self.primary_suspension is None else self.primary_suspension.noun(),
            guidance=self.guidance.noun(),
            sources=tuple(self.sources.items()),
        )

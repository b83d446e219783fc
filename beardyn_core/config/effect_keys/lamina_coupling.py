"""Keys of an effect: laminae of a raceway contact that sink with each other."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import (
    FileModel,
    Number,
    Positive,
)
from beardyn_core.config.units import MEGA
from beardyn_core.effects import LaminaCoupling


class LaminaCouplingKeys(FileModel):
    """Laminae coupled through the half-space: edge load."""

    pressure_MPa: Annotated[Positive, Field(ge=10.0, le=5000.0)] = Field(
        LaminaCoupling.pressure / MEGA,
        description="Hertz pressure of the contact whose width is taken for the influence",
    )
    strength: Annotated[Number, Field(ge=0.0, le=1.0)] = Field(
        LaminaCoupling.strength, description="share of the influence between different laminae"
    )

    def noun(self) -> LaminaCoupling:
        """The coupling, SI."""
        return LaminaCoupling(pressure=self.pressure_MPa * MEGA, strength=self.strength)

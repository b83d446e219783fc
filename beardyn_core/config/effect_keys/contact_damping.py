"""Keys of an effect: loss of contacts that are pressed together."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from beardyn_core.config.file_model import (
    FileModel,
    Positive,
)
from beardyn_core.config.units import US
from beardyn_core.effects import ContactDamping


class ContactDampingKeys(FileModel):
    """Velocity-proportional loss of raceway and rib contacts."""

    time_constant_us: Annotated[Positive, Field(le=1000.0)] = ContactDamping.time_constant * US

    def noun(self) -> ContactDamping:
        """The contact damping, SI."""
        return ContactDamping(time_constant=self.time_constant_us / US)

"""Keys of an effect: large roller end on the cone rib."""

from __future__ import annotations

from beardyn_core.config.file_model import (
    FileModel,
    Friction,
    Positive,
)
from beardyn_core.effects import Rib


class RibKeys(FileModel):
    """Contact of the large roller end with the cone rib."""

    friction: Friction = Rib.friction
    regularisation_speed_m_per_s: Positive = Rib.regularisation_speed

    def noun(self) -> Rib:
        """The rib, SI."""
        return Rib(friction=self.friction, regularisation_speed=self.regularisation_speed_m_per_s)

"""Keys of an effect: weight."""

from __future__ import annotations

from beardyn_core.config.file_model import (
    FileModel,
    NonNegative,
)
from beardyn_core.effects import Gravity


class GravityKeys(FileModel):
    """Weight of rollers, cages and axlebox."""

    acceleration_m_per_s2: NonNegative = Gravity.acceleration

    def noun(self) -> Gravity:
        """The gravity, SI."""
        return Gravity(acceleration=self.acceleration_m_per_s2)

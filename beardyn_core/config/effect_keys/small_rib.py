"""Keys of an effect: small roller end on the small rib of the cone."""

from __future__ import annotations

from beardyn_core.config.file_model import (
    FileModel,
    Friction,
    NonNegative,
    Positive,
)
from beardyn_core.config.units import MEGA
from beardyn_core.effects import SmallRib


class SmallRibKeys(FileModel):
    """Contact of the flat small roller end with the small rib of the cone."""

    stiffness_MN_per_m: Positive = SmallRib.stiffness / MEGA
    damping_N_s_per_m: NonNegative = SmallRib.damping
    friction: Friction = SmallRib.friction
    regularisation_speed_m_per_s: Positive = SmallRib.regularisation_speed

    def noun(self) -> SmallRib:
        """The small rib, SI."""
        return SmallRib(
            stiffness=self.stiffness_MN_per_m * MEGA,
            damping=self.damping_N_s_per_m,
            friction=self.friction,
            regularisation_speed=self.regularisation_speed_m_per_s,
        )

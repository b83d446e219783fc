"""Keys of an effect: seals between cup and shaft."""

from __future__ import annotations

from beardyn_core.config.file_model import (
    FileModel,
    NonNegative,
    Positive,
)
from beardyn_core.effects import Seal


class SealKeys(FileModel):
    """Friction of the two seals; every number is that of one seal."""

    torque_N_m: NonNegative = Seal.torque
    speed_coefficient_N_m_s_per_rad: NonNegative = Seal.speed_coefficient
    regularisation_speed_rad_per_s: Positive = Seal.regularisation_speed

    def noun(self) -> Seal:
        """The seals, SI."""
        return Seal(
            torque=self.torque_N_m,
            speed_coefficient=self.speed_coefficient_N_m_s_per_rad,
            regularisation_speed=self.regularisation_speed_rad_per_s,
        )
